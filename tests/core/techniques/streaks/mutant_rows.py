"""Places of streaks' kernels that are changed, and the tests that ought to notice, by file."""
import collections

Row = collections.namedtuple("Row", "about file old new tests")

COVER = ("picture/cover",)
LOOKS = ("picture/looks",)
PARTICLES = ("particles",)
FAR = ("far_rain/far",)
MEET = ("far_rain/meet",)
OUTSIDE = ("picture/outside",)
SIZES = ("sizes",)
SPLASH = ("picture/splash",)
LANDING = ("landing",)

ROWS = [Row(*row) for row in (
    # particles
    ("drops rise", "particle.h", "t.s = p.top + p.local_height * (fallen - rg_floor(fallen))",
     "t.s = p.top + p.local_height * (1.0f - (fallen - rg_floor(fallen)))", PARTICLES),
    ("drops end a streak too late", "particle.h", "(t.s - streaks_behind(p, t)) - t.hit", "t.s - t.hit", PARTICLES),
    ("the map's rows run across", "hit.h", "(y - p.map_y) * p.map_per_y * height",
     "(x - p.map_y) * p.map_per_y * height", PARTICLES),
    ("splashes last half as long", "particle.h", "rg_min(p.splash_s * fall_speed, p.local_height)",
     "rg_min(0.5f * p.splash_s * fall_speed, p.local_height)", PARTICLES),
    ("all drops begin their swing together", "particle.h", "(streaks_hash(t.number) & 1023u)",
     "(streaks_hash(0u) & 1023u)", PARTICLES),
    ("drops do not swing as they fall", "particle.h", "t.s * (p.cycles_per_m * (t.swing / t.speed)) + begin", "begin", PARTICLES),
    # what streaks cover
    ("streaks twice as wide", "rain.h", "shape.half_width = splash != 0 ? 0.5f * p.splash_width * size : half_width",
     "shape.half_width = splash != 0 ? 0.5f * p.splash_width * size : 2.0f * half_width", COVER),
    ("streaks twice as long", "rain.h", "splash != 0 ? shape.up.z * tall : -fall);",
     "splash != 0 ? shape.up.z * tall : -2.0f * fall);", COVER),
    ("thin streaks as bright as wide ones", "rain.h", "(shape.half_width / shape.covering)", "1.0f", COVER),
    ("thin streaks missed", "rain.h", "rg_max(half_width, 0.5f * thinnest)", "half_width", COVER),
    ("short streaks missed", "rain.h", "rg_max(0.5f * (thinnest - way), 0.0f)", "0.0f", COVER),
    ("no foreshortening of the way", "rain.h", "float way = fall * rg_hypot(to_eye.x, to_eye.y)",
     "float way = fall", COVER),
    ("the atlas' share of the exposure", "rain.h", "2.0f / (shape.way * streaks_steadiness_at(shown))", "1.0f", COVER),
    ("the share of the lower view", "cells.h",
     "first + (streaks_steadiness(view + 1) - first) * (shown - rg_to_float(view))", "first", COVER),
    ("streaks without ends", "rain.h", "t.window = rg_max(passes, 0.0f) / (2.0f * half_chord)",
     "t.window = 1.0f", COVER),
    ("half of a swing", "rain.h", "(size - 2.0f * rim) * turn", "0.5f * (size - 2.0f * rim) * turn", LOOKS),
    ("the way of another view", "cells.h", "return 1009.12f", "return 1100.0f", COVER),
    # which streak is seen
    ("streaks upside down", "rain.h", "streaks_part(r.turn - r.cycles * streaks_place_of(r, u, v).passed)",
     "1.0f - streaks_part(r.turn - r.cycles * streaks_place_of(r, u, v).passed)", LOOKS),
    ("swings run backwards", "rain.h", "r.turn - r.cycles *", "r.turn + r.cycles *", LOOKS),
    ("swings twice as fast", "rain.h", "r.turn - r.cycles *", "r.turn - 2.0f * r.cycles *", LOOKS),
    ("always the same oscillation", "rain.h", "s.oscillation = streaks_layer_of(r) * drop",
     "s.oscillation = 3 * drop", LOOKS),
    # light
    ("mirrored to the wrong side", "rain.h", "streaks_to_left(to_light, spot.ray) > 0.0f ? 1.0f - spot.u : spot.u",
     "streaks_to_left(to_light, spot.ray) > 0.0f ? spot.u : 1.0f - spot.u", LOOKS),
    ("never mirrored", "rain.h", "streaks_to_left(to_light, spot.ray) > 0.0f ? 1.0f - spot.u : spot.u", "spot.u", LOOKS),
    ("light from behind as from before", "cells.h", "rg_atan2(rg_abs(streaks_to_left(to_light, ray)), cosine)",
     "rg_atan2(rg_abs(streaks_to_left(to_light, ray)), -cosine)", LOOKS),
    ("light from above as from below", "rain.h", "streaks_elevation(to_light) * below + 4.5f",
     "-streaks_elevation(to_light) * below + 4.5f", LOOKS),
    ("no brightness factors", "rain.h", "s.level - p.first_level).r * factor;\n}\n\nRG_FN float streaks_between",
     "s.level - p.first_level).r;\n}\n\nRG_FN float streaks_between", LOOKS),
    ("no brightness factors of the sky", "rain.h", "return skies_between(rg, x, y, s.oscillation, s.level - p.first_level).r * factor",
     "return skies_between(rg, x, y, s.oscillation, s.level - p.first_level).r", COVER),
    ("no shadows", "rain.h", "reach.share * scenery_unshadowed(rg, l, spot.at) * streaks_between",
     "reach.share * streaks_between", LOOKS),
    ("irradiance without pi", "rain.h", "float streak = SCENERY_IRRADIANCE * streaks_streak",
     "float streak = streaks_streak", ("picture/furnace",)),
    # splashes
    ("splashes played backwards", "rain.h", "float passed = rg_clamp(t.age / p.splash_s, 0.0f, 1.0f) * frames;",
     "float passed = (1.0f - rg_clamp(t.age / p.splash_s, 0.0f, 1.0f)) * frames;", LOOKS),
    ("splashes stand still", "rain.h", "r.shown = rg_clamp(passed - 0.5f, 0.0f, frames - 1.001f)",
     "r.shown = 0.9f * frames", LOOKS),
    ("frames half a frame late", "rain.h", "rg_clamp(passed - 0.5f, 0.0f", "rg_clamp(passed, 0.0f", SPLASH),
    ("splashes end at once", "rain.h", "rg_min(frames - passed, 1.0f)", "1.0f", SPLASH),
    ("splashes float", "rain.h", "float under = splash != 0 ? tall * p.splash_foot : 0.0f;", "float under = 0.0f;", SPLASH),
    ("the ground hides a splash's foot", "rain.h", "return below / rg_max(sine, 0.05f) + 0.002f;",
     "return 0.0f * below * sine;", SPLASH),
    ("splashes of one width", "rain.h", "float size = streaks_size(random) * t.radius;", "float size = t.radius;", SPLASH),
    ("splashes too high", "rain.h", "streaks_size(random >> 22) * t.radius", "1.4f * t.radius", SPLASH),
    ("splashes lean aside", "material.h", "follows != 0 ? turned.x * side : p.up_x", "follows != 0 ? 0.2f : p.up_x", SPLASH),
    ("normals turned the wrong way", "material.h",
     "p.from_world.zx * n.x + p.from_world.zy * n.y + p.from_world.zz * n.z",
     "p.from_world.xz * n.x + p.from_world.yz * n.y + p.from_world.zz * n.z", SPLASH),
    ("splashes lit as if upright", "rain.h", "v3_dot(reach.to_light, mesh_normal_unpack(r.up))",
     "(reach.to_light.x * p.up_x + reach.to_light.y * p.up_y + reach.to_light.z * p.up_s)", SPLASH),
    ("drops fall beside a dynamic map", "particle.h", "(1 - p.around * under.outside)", "1", PARTICLES),
    # far rain
    ("far rain rises", "far/far.h", "rg_floor((s - p.fallen) /", "rg_floor((s + p.fallen) /", FAR),
    ("slabs hide half", "far/far.h", "p.rain.opacity * section * sky", "0.5f * p.rain.opacity * section * sky", FAR),
    ("slabs begin too near", "far/far.h", "rg_max(low, p.nearest)", "rg_max(low, 0.5f * p.nearest)", FAR),
    ("slabs end too far", "far/far.h", "rg_min(low + p.thickness, p.farthest)", "low + 2.0f * p.thickness", FAR),
    ("slanting rays cross slabs straight", "far/far.h", "way.last = last / steep * length", "way.last = first / steep * length + (last - first)", MEET),
    ("no sky", "far/far.h", "light_g = p.rain.sky_g * sky + lit.g", "light_g = lit.g", MEET),
    ("lamps as strong everywhere", "far/far.h", "fall.mean = sun != 0 ? 1.0f : angle / (beside * length)", "fall.mean = 1.0f", MEET),
    ("lights without pi", "far/far.h", "float reaches = SCENERY_IRRADIANCE * cone", "float reaches = cone", MEET),
    ("the density of the whole map", "far/far.h", "return p.drops_m3 * there *", "return p.drops_m3 *", MEET),
    ("the map turned over", "far/far.h", "float v = (at.y / p.rain.half_y + 1.0f) * 0.5f", "float v = (1.0f - at.y / p.rain.half_y) * 0.5f", MEET),
    ("streaks as short as drops", "far/far.h", "float longer = rg_max(fallen, chord)", "float longer = rg_max(chord, chord)", MEET),
    ("streaks twice as wide", "far/far.h", "return covering * longer * longer", "return 2.0f * covering * longer * longer", MEET),
    ("a pattern without variance", "far/far.h", "streaks_far_spread(grain, spread)", "1.0f", MEET),
    ("few grains too weak", "far/far.h", "2.0f * random / (some * some)", "2.0f * random / some", MEET),
    ("the views' sections", "far/far.h", "streaks_steadiness_at(shown)", "streaks_steadiness(0) * 1.1f", FAR),
    # the view from outside
    ("marks coloured upside down", "outside/marks.h", "rg_clamp((s - p.map_top) / p.map_height, 0.0f, 1.0f)",
     "1.0f - rg_clamp((s - p.map_top) / p.map_height, 0.0f, 1.0f)", OUTSIDE),
    ("marks hang from their drops", "outside/marks.h", "v3_make(t.x, t.y, s - up)", "v3_make(t.x, t.y, s + up)", OUTSIDE),
    ("splashes as long as drops", "outside/marks.h", "splash != 0 ? 0.5f * p.fall : p.fall", "p.fall", OUTSIDE),
    ("splashes marked where their drops would be", "outside/marks.h", "splash != 0 ? t.hit : t.s", "t.s", OUTSIDE),
    ("particles that are nothing are marked", "outside/marks.h", "(t.state == STREAKS_NOTHING ? 0 : 1) *", "1 *", OUTSIDE),
    # sizes
    ("splashes of slow drops last longer", "particle.h", "rg_min(p.splash_s * fall_speed",
     "rg_min(p.splash_s * p.fall_speed", LANDING),
    ("small drops are fewer", "particle.h", "int size = streaks_size_class(number, p.sizes) * STREAKS_SIZE_WORDS",
     "int size = rg_imax(streaks_size_class(number, p.sizes), p.sizes / 8) * STREAKS_SIZE_WORDS", LANDING),
    ("drops of one radius", "particle.h", "t.radius = rg_bits_float(blocks_at(rg, size))", "t.radius = 1.0f", SIZES),
    ("the first class alone", "size.h", "(streaks_hash(particle) >> 14)", "(streaks_hash(0u * particle) >> 14)", SIZES),
    ("half of the classes", "size.h", "rg_to_uint(sizes - 1)", "rg_to_uint(sizes / 2 - 1)", SIZES),
    ("drops do not move apart", "particle.h", "rg_bits_float(blocks_at(rg, size + 4))",
     "rg_bits_float(blocks_at(rg, 4))", SIZES),
    ("each drop for one", "rain.h", "* shape.weight;", ";", COVER),
    ("streaks of one length", "rain.h", "float fall = p.fall * t.speed;", "float fall = p.fall;", LOOKS),
    ("streaks of one width", "rain.h", "float half_width = p.half_width * t.radius;", "float half_width = p.half_width;", COVER),
    ("small drops end where large ones do", "particle.h", "p.drop_radius * (t.radius - 1.0f)", "0.0f", PARTICLES),
    ("small drops as slow splashes", "particle.h", "t.age = since / fall_speed", "t.age = since / p.fall_speed", PARTICLES),
    ("drops of all sizes swing alike", "rain.h", "r.cycles = p.cycles * t.swing", "r.cycles = p.cycles", LOOKS),
)]
