"""Places of the kernels of cartoon's scene that are changed, and the tests that ought to notice, by file."""
import collections

Row = collections.namedtuple("Row", "about file old new tests")

STYLES = ("styles",)
OUTLINES = ("outlines",)

ROWS = [Row(*row) for row in (
    # maps
    ("sheets have one side", "faces.h", "> 0.0f ? -1.0f : 1.0f", "> 0.0f ? 1.0f : 1.0f", STYLES),
    ("normals of any length", "faces.h", "r.side / rg_sqrt(rg_max(v3_dot(n, n), 1e-12f))", "r.side", STYLES),
    ("the next material", "faces.h", "rg_to_int(materials_at(rg, p.first + i)) + 1",
     "rg_to_int(materials_at(rg, p.first + i)) + 2", STYLES),
    ("every face's first material", "faces.h", "materials_at(rg, p.first + i)", "materials_at(rg, 0)", STYLES),
    ("thin faces are the first ones", "faces.h", "return mesh_item(rg, p.to_clip, p.first + i);",
     "return mesh_item(rg, p.to_clip, i);", STYLES),
    # what styles see
    ("red and green swapped", "seen.h", "v3_make(cartoon_byte(material), cartoon_byte(material >> 8),",
     "v3_make(cartoon_byte(material >> 8), cartoon_byte(material),", STYLES),
    ("shine of blue", "seen.h", "s.shine = cartoon_byte(material >> 24);", "s.shine = cartoon_byte(material >> 16);", STYLES),
    ("a highlight to the 16th power", "seen.h", "return c16 * c16 * s.shine;", "return c16 * s.shine;", STYLES),
    ("a highlight in the shade", "seen.h", "s.facing > 0.0f ? rg_max(v3_dot(view, mirrored), 0.0f) : 0.0f",
     "rg_max(v3_dot(view, mirrored), 0.0f)", STYLES),
    ("a highlight about the light", "seen.h", "v3_scale(s.normal, 2.0f * s.facing)", "v3_scale(s.normal, s.facing)", STYLES),
    ("a pixel's corner, not its middle", "seen.h", "rg_to_float(px) + 0.5f, rg_to_float(py) + 0.5f, depth",
     "rg_to_float(px), rg_to_float(py), depth", STYLES),
    ("the sky upside down", "seen.h", "float t = (rg_to_float(py) + 0.5f) / p.height_px;",
     "float t = 1.0f - (rg_to_float(py) + 0.5f) / p.height_px;", STYLES),
    ("no ink", "seen.h", "float ink = 1.0f - ink_texel", "float ink = 0.0f * ink_texel", STYLES),
    ("display values as light", "seen.h", "rg_rgba(r * r, g * g, b * b, 1.0f)", "rg_rgba(r, g, b, 1.0f)", STYLES),
    # Gooch
    ("cool where it is lit", "gooch.h", "0.5f + 0.5f * s.facing", "0.5f - 0.5f * s.facing", STYLES),
    ("the same share everywhere", "gooch.h", "cartoon_mix(p.alpha, p.beta, t)", "p.beta", STYLES),
    ("blue everywhere", "gooch.h", "p.blue * (1.0f - t)", "p.blue", STYLES),
    ("no highlight", "gooch.h", "float yellow = p.yellow * t + shine;", "float yellow = p.yellow * t;", STYLES),
    # tones
    ("a step 2 % later", "tones.h", "(value - edge) * p.per_softness + 0.5f", "(value - edge - 0.02f) * p.per_softness + 0.5f", STYLES),
    ("a step that begins at its edge", "tones.h", "p.per_softness + 0.5f", "p.per_softness", STYLES),
    ("light ends where shadow does", "tones.h", "cartoon_step(p, u, p.lit_from)", "cartoon_step(p, u, p.middle_from)", STYLES),
    ("shadows without blue", "tones.h", "p.shadow_blue * (1.0f - tone)", "0.12f * (1.0f - tone)", STYLES),
    ("a wider glint", "tones.h", "cartoon_step(p, shine, p.glint_from)", "cartoon_step(p, shine, 0.75f * p.glint_from)", STYLES),
    ("everything glints", "tones.h", "s.shine * cartoon_step(p, shine, p.glint_from)", "cartoon_step(p, shine, p.glint_from)", STYLES),
    # hatching
    ("strokes down walls", "hatching.h", "t.v = (level ? at.z : at.y) * p.per_tile;", "t.v = (level ? at.z : at.x) * p.per_tile;", STYLES),
    ("walls to the side have no strokes of theirs", "hatching.h", "sideways ? at.z : at.x", "at.x", STYLES),
    ("the darker tone alone", "hatching.h", "float t = tones - rg_to_float(tone);", "float t = 0.0f;", STYLES),
    ("five tones", "hatching.h", "* rg_to_float(CARTOON_TONES)", "* rg_to_float(CARTOON_TONES - 1)", STYLES),
    ("the finer level alone", "hatching.h", "fine - rg_to_float(level)) * (1.0f", "0.0f) * (1.0f", STYLES),
    ("a level too fine", "hatching.h", "float fine = rg_clamp(lod, ", "float fine = rg_clamp(lod - 1.0f, ", STYLES),
    ("slant does not count", "hatching.h", "rg_log2(far2 / slant)", "rg_log2(far2)", STYLES),
    ("tiles end at a texel's corner", "hatching.h", "float x = at.u * size - 0.5f;", "float x = at.u * size;", STYLES),
    ("the second layer's tones one off", "hatching.h", "rg_to_uint(tone - 3 * layer)", "rg_to_uint(tone - 2 * layer)", STYLES),
    ("grey things are as light", "hatching.h", "(0.5f + 0.5f * grey)", "(1.0f + 0.0f * grey)", STYLES),
    ("no ambient light", "hatching.h", "cartoon_mix(p.ambient, p.lit,", "cartoon_mix(0.0f, p.lit,", STYLES),
    ("the light's tone is fixed", "hatching.h", "cartoon_mix(p.ambient, p.lit,", "cartoon_mix(p.ambient, 1.15f,", STYLES),
    ("ink's green is its red", "seen.h", "rg_clamp(c.y, 0.0f, 1.0f), p.ink_g", "rg_clamp(c.y, 0.0f, 1.0f), p.ink_r", STYLES),
    ("paper's blue is its green", "paper.h", "p.paper_b", "p.paper_g", STYLES),
    ("strokes are black", "hatching.h", "cartoon_mix(p.ink_b, ", "cartoon_mix(0.0f, ", STYLES),
    ("all wash", "hatching.h", "cartoon_mix(1.0f, s.colour.y, p.wash)", "s.colour.y", STYLES),
    # outlines
    ("contours where both faces look alike", "ink.h", "return contour < 0.0f ?", "return contour > 0.0f ?", OUTLINES),
    ("creases where faces are flat", "ink.h", "bend < p.cos_crease", "bend > p.cos_crease", OUTLINES),
    ("no boundaries", "ink.h", "boundary < 0.5f ?", "boundary < -0.5f ?", OUTLINES),
    ("a contour by one face", "ink.h", "v3_dot(n, to_eye) * v3_dot(m, to_eye)", "v3_dot(n, to_eye)", OUTLINES),
    ("creases as wide as contours", "ink.h", "? p.crease_px : 0.0f", "? p.contour_px : 0.0f", OUTLINES),
    ("lines do not thin", "ink.h", "* (p.full_m / far)", "* (p.full_m / p.full_m)", OUTLINES),
    ("a line is as wide as at its nearer end", "ink.h", "rg_max(rg_max(a.w, b.w), p.full_m)", "rg_max(rg_min(a.w, b.w), p.full_m)", OUTLINES),
    ("half as wide", "ink.h", "s.reach = 0.5f * width_px + 0.5f;", "s.reach = 0.25f * width_px + 0.5f;", OUTLINES),
    ("sharp sides", "ink.h", "s.reach = 0.5f * width_px + 0.5f;", "s.reach = 0.5f * width_px + 1.0f;", OUTLINES),
    ("nothing hides lines", "ink.h", "depth <= farthest + r.slack ? 1 : 0", "depth <= 2.0f ? 1 : 0", OUTLINES),
    ("lines that bound nothing are seen", "ink.h", "depth <= farthest + r.slack ? 1 : 0", "depth >= farthest + r.slack ? 1 : 0", OUTLINES),
    ("a line's own pixel hides it", "ink.h",
     "return rg_max(here, rg_max(rg_max(left_of, right_of), rg_max(above, below)));", "return here;", OUTLINES),
    ("ten times the slack", "ink.h", "#define CARTOON_MOST_SLACK  0.005f", "#define CARTOON_MOST_SLACK  0.5f", OUTLINES),
    ("as much slack on what faces the viewer", "ink.h", "#define CARTOON_LEAST_SLACK 0.0005f", "#define CARTOON_LEAST_SLACK 0.2f", OUTLINES),
    ("the depth where a line begins", "ink.h", "(s.depth_there - s.depth) * along", "(s.depth_there - s.depth) * 0.0f", OUTLINES),
    ("lines without ends", "ink.h", "rg_clamp(x * s.along_x + y * s.along_y, 0.0f, s.length_px)",
     "(x * s.along_x + y * s.along_y)", OUTLINES),
    ("the least ink stays", "ink.h", "0.0f), 1.0f - ink);", "0.0f), ink);", OUTLINES),
)]
