"""Places of scenery's kernels that are changed, and the tests that ought to notice, by file."""
import collections

Row = collections.namedtuple("Row", "about file old new tests")

REACH = ("lights/reach",)
SHADOWS = ("lights/shadows",)
LOOK = ("city/look",)
DEPTH = ("city/depth",)
LINES = ("overlay/lines",)
MAPS = ("overlay/maps",)

ROWS = [Row(*row) for row in (
    # how far lights reach
    ("light falls off with the distance, not its square", "light.h",
     "float fallen = 1.0f / rg_max(squared, SCENERY_NEAREST_SQUARED_M2)",
     "float fallen = 1.0f / rg_sqrt(rg_max(squared, SCENERY_NEAREST_SQUARED_M2))", REACH),
    ("near lights without a bound", "light.h", "rg_max(squared, SCENERY_NEAREST_SQUARED_M2)", "rg_max(squared, 1e-12f)", REACH),
    ("spots shine backwards", "light.h", "-v3_dot(towards, axis)", "v3_dot(towards, axis)", REACH),
    ("cones with a kink", "light.h", "t * t * (3.0f - 2.0f * t)", "t", REACH),
    ("spots shine all around", "light.h", "l.kind == SCENERY_SPOT ? cone : 1.0f", "1.0f", REACH),
    ("suns from below", "light.h", "reach.to_light.y = sun != 0 ? -axis.y", "reach.to_light.y = sun != 0 ? axis.y", REACH),
    ("suns fall off", "light.h", "reach.share = sun != 0 ? 1.0f", "reach.share = sun != 0 ? fallen", REACH),
    # shadows
    ("no shadow at all", "shadow.h", "return 1.0f - rg_to_float(place.known) * (1.0f - lit)", "return 1.0f", SHADOWS),
    ("light where there is shadow", "shadow.h", "place.depth <= shadows_texel", "place.depth > shadows_texel", SHADOWS),
    ("shadows of the neighbouring light", "shadow.h", "rg_imax(l.shadow_layer, 0) + (cube", "rg_imax(l.shadow_layer - 1, 0) + (cube", SHADOWS),
    ("cube maps of one face", "shadow.h", "(cube != 0 ? face : 0)", "0", SHADOWS),
    ("cube maps mirrored", "shadow.h", "cube_turn(-g.z, g.x)", "cube_turn(g.z, g.x)", SHADOWS),
    ("maps upside down", "shadow.h", "place.y = (y * over_w + 1.0f)", "place.y = (1.0f - y * over_w)", SHADOWS),
    ("no bias", "shadow.h", "scenery_light_reach(l, at).to_light, l.shadow_bias_m)", "scenery_light_reach(l, at).to_light, 0.0f)", SHADOWS),
    ("the bias leads away", "shadow.h", "scenery_light_reach(l, at).to_light, l.shadow_bias_m)",
     "scenery_light_reach(l, at).to_light, -l.shadow_bias_m)", SHADOWS),
    ("shadow outside of the map", "shadow.h", "(rg_max(rg_abs(x), rg_abs(y)) <= w ? 1 : 0)", "1", SHADOWS),
    ("soft shadows are hard on one side", "shadow.h", "float upper = scenery_shadow_tap(rg, place, left, above) * (1.0f - fx)",
     "float upper = 1.0f - fx", SHADOWS),
    ("soft shadows of one row", "shadow.h", "upper * (1.0f - fy) + lower * fy", "upper", SHADOWS),
    ("no step off the surface", "shadow.h", "2.0f * l.shadow_texel * distance", "0.0f * distance", SHADOWS),
    # faces
    ("quads without their second half", "city.h", "t.d = scenery_city_corner(rg, to_clip, word + 9)", "t.d = t.c", DEPTH),
    ("depth beyond a face's bounds", "city.h", "rg_clamp(rg_plane_at(r.depth, dx, dy), r.nearest, r.farthest)", "r.nearest", DEPTH),
    ("blocks' last faces twice", "city.h", "t.alive = k < count ? 1 : 0", "t.alive = k + 1 < count ? 1 : 0", DEPTH),
    ("the surface of the next face", "city.h", "r.surface = surface_of_at(rg, face)", "r.surface = surface_of_at(rg, face + 1)", LOOK),
    ("surfaces' numbers cut off", "city.h", "scenery_city_byte(r.surface >> 8)", "0.0f", LOOK),
    # what a pixel shows
    ("a pixel aside", "city_shade.h", "v3_make(rg_to_float(px) + 0.5f, rg_to_float(py) + 0.5f, depth)",
     "v3_make(rg_to_float(px) + 1.5f, rg_to_float(py) + 0.5f, depth)", LOOK),
    ("wet ground without lamps", "city_shade.h", "return 0.5f * reflected * rough * facing /", "return 0.0f * reflected * rough * facing /", LOOK),
    ("wet ground as rough as dry", "city_shade.h", "#define SCENERY_FILM 0.25f", "#define SCENERY_FILM 0.35f", LOOK),
    ("wet ground mirrors as much from all sides", "city_shade.h", "0.02f + 0.98f * between2 * between2 * between", "0.02f + 0.0f * between", LOOK),
    ("facets do not hide each other", "city_shade.h", "facing * rg_sqrt(rough + least * seen * seen)", "facing * seen", LOOK),
    ("suns are mirrored as lamps are", "city_shade.h", "kind == SCENERY_SUN ? SCENERY_CLOUDED", "kind == SCENERY_SUN ? SCENERY_FILM", LOOK),
    ("mirrored lamps have the ground's colour", "city_shade.h", "horizon_r + front * lit.gloss_r,", "horizon_r + t.r * front * lit.gloss_r,", LOOK),
    ("light from behind a surface", "city_shade.h", "rg_max(v3_dot(n, reach.to_light), 0.0f)", "rg_abs(v3_dot(n, reach.to_light))", LOOK),
    ("no shadows on surfaces", "city_shade.h",
     " * scenery_unshadowed_soft(rg, l, scenery_off_surface(l, s.at, n));", ";", LOOK),
    ("red lamps", "city_shade.h", "falls.g = l.g * matt;", "falls.g = l.r * matt;", LOOK),
    ("textures without a sign", "city_shade.h", "rg_to_int(word >> 16) - ((word >> 31) != 0u ? 65536 : 0)", "rg_to_int(word >> 16)", LOOK),
    ("textures not turned", "city_shade.h", "float ground_u = turned != 0 ? s.at.z : s.at.x", "float ground_u = s.at.x", LOOK),
    ("walls mirrored", "city_shade.h", "n.z * s.at.x - n.x * s.at.z", "n.x * s.at.z - n.z * s.at.x", LOOK),
    ("textures not in their place", "city_shade.h", "scenery_lower(offsets) * (1.0f / 65536.0f)", "0.0f", LOOK),
    ("slanted textures as sharp as straight ones", "city_shade.h", "rg_abs(scale_u * scale_v) / rg_max(facing, 0.04f)",
     "rg_abs(scale_u * scale_v)", LOOK),
    ("no tint", "city_shade.h", "t.r * (rg_to_float(tint & 31u) * (1.0f / 31.0f))", "t.r", LOOK),
    ("green's tint of five bits", "city_shade.h", "((tint >> 5) & 63u)", "((tint >> 5) & 31u)", LOOK),
    ("wet ground mirrors as much from above", "city_shade.h", "slant2 * slant2 * slant)", "slant2)", LOOK),
    ("dry and wet alike", "city_shade.h", "(1.0f - 0.45f * wet) * front", "front", LOOK),
    ("wet ground hardly darker", "city_shade.h", "(1.0f - 0.45f * wet) * front", "(1.0f - 0.3f * wet) * front", LOOK),
    ("openness inside the walls", "city_shade.h", "#define SCENERY_BEFORE_M 3.0f", "#define SCENERY_BEFORE_M 0.0f", LOOK),
    ("no light from beside", "city_shade.h", "float beside = p.bounced * (1.0f - open)", "float beside = 0.0f * open", LOOK),
    ("windows do not glow", "city_shade.h", "float glow = p.glow * t.a +", "float glow =", LOOK),
    ("lamps do not glow", "city_shade.h", "rg_to_float((look >> SCENERY_GLOW_BIT) & 7u) * (1.0f / 7.0f)", "0.0f", LOOK),
    ("lit windows as bright by their front", "city_shade.h", "front = 1.0f - 0.7f * t.a;", "front = 1.0f;", LOOK),
    ("haze twice as thick", "city_shade.h", "rg_exp(-s.distance * p.sky.haze_per_m)", "rg_exp(-2.0f * s.distance * p.sky.haze_per_m)", LOOK),
    ("the sky from behind", "city_shade.h", "v3 sky = scenery_sky_light(p.sky, s.ray)",
     "v3 sky = scenery_sky_light(p.sky, v3_make(-s.ray.x, s.ray.y, -s.ray.z))", LOOK),
    # textures
    ("texels half a texel aside", "texture.h", "float x = u * rg_to_float(size) - 0.5f", "float x = u * rg_to_float(size)", LOOK),
    ("textures end at their edge", "texture.h", "int x1 = x0 + 1 < size ? x0 + 1 : 0", "int x1 = x0 + 1 < size ? x0 + 1 : x0", LOOK),
    ("nearest texels", "texture.h", "rg_to_uint(rg_to_int((x - left) * 256.0f))", "0u", LOOK),
    ("channels swapped", "texture.h", "float b = rg_to_float(t.rb >> 16) * (1.0f / 255.0f)",
     "float b = rg_to_float(t.rb & 0xffffu) * (1.0f / 255.0f)", LOOK),
    ("texels are light, not its root", "texture.h", "rg_rgba(r * r, g * g, b * b,", "rg_rgba(r, g, b,", LOOK),
    ("levels one too fine", "texture.h", "rg_clamp(texels + texels, 1.0f, 1e9f)", "rg_clamp(0.5f * texels, 1.0f, 1e9f)", LOOK),
    ("always the finest level", "texture.h", "rg_imin(rg_to_int(bits >> 24), last_level)", "rg_imin(rg_to_int(bits >> 31), last_level)", LOOK),
    # openness
    ("openness of the next level", "openness.h", "scenery_openness_level(rg, ix, iz, iy, fx, fz)",
     "scenery_openness_level(rg, ix, iz, iy + 1, fx, fz)", LOOK),
    ("openness turned", "openness.h", "(level * SCENERY_OPEN_SIDE + z) * SCENERY_OPEN_SIDE + x",
     "(level * SCENERY_OPEN_SIDE + x) * SCENERY_OPEN_SIDE + z", LOOK),
    ("openness of the nearest point", "openness.h", "float near = a + (b - a) * fx", "float near = a", LOOK),
    # the sky
    ("an even sky", "sky.h", "float share = up * (2.0f - up)", "float share = up", LOOK),
    ("no clouds", "sky.h", "float lit = 1.0f + s.clouds *", "float lit = 1.0f + 0.0f *", LOOK),
    ("clouds of squares", "sky.h", "float wx = fx * fx * (3.0f - 2.0f * fx)", "float wx = 0.0f * fx", LOOK),
    ("clouds down to the horizon", "sky.h", "rg_min(up * 4.0f, 1.0f)", "1.0f", LOOK),
    # the overlay
    ("lines half as wide", "overlay/lines.h", "s.reach = 0.5f * rg_min(", "s.reach = 0.25f * rg_min(", LINES),
    ("lines brighter than their ink", "overlay/lines.h", "rg_rgba(r.colour.r * covered,", "rg_rgba(r.colour.r,", LINES),
    ("lines end in their beginning", "overlay/lines.h", "scenery_line_end(rg, p, i, 3)", "scenery_line_end(rg, p, i, 0)", LINES),
    ("sheets of three corners", "overlay/sheets.h", "t.d = scenery_sheet_corner(rg, p, i, 3)", "t.d = t.c", LINES),
    ("plates lie mirrored", "overlay/plate.h", "float across = rg_clamp(rg_plane_at(r.b, dx, dy) * w",
     "float across = rg_clamp(1.0f - rg_plane_at(r.b, dx, dy) * w", MAPS),
    ("plates as seen without perspective", "overlay/plate.h", "float w = rg_planes_w(r, px, py)", "float w = rg_planes_w(r, 80, 45)", MAPS),
    ("plates of depth are black", "overlay/plate.h", "/ (p.white_at - p.black_at)", "/ rg_abs(p.white_at - p.black_at)", MAPS),
    ("plates' greys from black", "overlay/plate.h", "(value - p.black_at) /", "value /", MAPS),
    ("insets upside down", "overlay/inset.h", "p.v0 + (p.v1 - p.v0) * down", "p.v1 - (p.v1 - p.v0) * down", MAPS),
    ("insets without a frame", "overlay/inset.h", "frame != 0 ? 1.0f : grey", "grey", MAPS),
    ("insets of another layer", "overlay/inset.h", "down, p.layer, 0", "down, 0, 0", MAPS),
)]
