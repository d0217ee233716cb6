"""Places of drawing's kernels that are changed, and the tests that ought to notice, by file."""
import collections

Row = collections.namedtuple("Row", "about file old new tests")

CLIP = "../dialect/draw/clip.h"
COVER = "../dialect/draw/coverage.h"
PLANES = "../dialect/draw/triangle.h"
RANGES = "../packing/ranges.h"
TESTS = ("drawing", "rays")

ROWS = [Row(*row, TESTS) for row in (
    # corners on the grid
    ("corners are rounded down", CLIP, "* 256.0f + 0.5f", "* 256.0f"),
    ("boxes of corners begin a pixel late", CLIP, "(low + 127) >> 8", "(low + 383) >> 8"),
    ("boxes of corners end a pixel early", CLIP, "(high - 128) >> 8", "(high - 384) >> 8"),
    # what is drawn
    ("culling is turned round", CLIP, "draw.cull == 1 ? -turn : turn", "draw.cull == 1 ? turn : -turn"),
    ("nothing is culled", CLIP, "(draw.cull == 0 ? 1 : 0) | (facing > 0.0f ? 1 : 0)", "1"),
    ("what is half behind the near plane is left out", CLIP,
     "(farthest >= 0.0f ? 1 : 0)", "(nearest >= 0.0f ? 1 : 0)"),
    ("what is half beside the picture is left out", CLIP,
     "(rg_min(rg_min(left, right), rg_min(top, bottom)) >= 0.0f ? 1 : 0)", "(slack >= 0.0f ? 1 : 0)"),
    # clipping
    ("corners behind the near plane stay", CLIP, "float inside = c.z;", "float inside = c.w;"),
    ("edges are cut in their middle", CLIP,
     "float t = inner_by / (inner_by - outer_by);", "float t = 0.5f;"),
    ("nothing is cut on the left", CLIP, "inside = across + c.x * draw.half_width;", "inside = across;"),
    ("nothing is cut below", CLIP, "inside = down - c.y * draw.half_height;", "inside = down;"),
    # coverage
    ("top edges do not count", COVER, "e.dx < 0 || (e.dx == 0 && e.dy > 0)", "e.dx < 0"),
    ("left edges do not count", COVER, "e.dx < 0 || (e.dx == 0 && e.dy > 0)", "e.dx == 0 && e.dy > 0"),
    ("right edges count too", COVER, "e.dx < 0 || (e.dx == 0 && e.dy > 0)", "e.dx != 0 || e.dy > 0"),
    ("pixels' centres lie at their left", COVER, "(rg_long)e.dx * (x - 128)", "(rg_long)e.dx * x"),
    ("pixels' centres lie at their top", COVER, "(rg_long)e.dy * (y - 128)", "(rg_long)e.dy * y"),
    ("faces that turn the other way are not turned", COVER, "bool turned = area < 0;", "bool turned = false;"),
    ("the third edge is not tested", COVER, "t.c = rg_edge_make(cx, cy, x0, y0);", "t.c = t.b;"),
    # depth and weights
    ("depth is the nearest corner's", PLANES,
     "return rg_clamp(rg_plane_at(s.depth, dx, dy), s.nearest, s.farthest);", "return s.nearest;"),
    ("depth begins at 0", PLANES, "s.depth.at = s.depth.at + base;", "s.depth.at = s.depth.at;"),
    ("depth leaves out the second corner", PLANES, "for_b, (b.z - base * b.w) * inverse", "for_b, 0.0f"),
    ("the second corner's weight has no perspective", PLANES,
     "rg_clamp(rg_plane_at(s.b, dx, dy) * w, 0.0f, 1.0f)", "rg_clamp(rg_plane_at(s.b, dx, dy), 0.0f, 1.0f)"),
    ("the third corner's weight has no perspective", PLANES,
     "rg_clamp(rg_plane_at(s.c, dx, dy) * w, 0.0f, 1.0f - k.b)",
     "rg_clamp(rg_plane_at(s.c, dx, dy), 0.0f, 1.0f - k.b)"),
    ("weights are exchanged", PLANES, "s.b = rg_plane_sum(for_b, inverse,", "s.b = rg_plane_sum(for_c, inverse,"),
)] + [Row(*row, ("scenes",)) for row in (
    # panes
    ("panes are skewed", "quads.h", "float across_x = -rg_sin(angle)", "float across_x = rg_sin(angle)"),
    ("panes turn the other way", "quads.h", "+ p.turned * raster", "- p.turned * raster"),
    ("panes are folded", "quads.h",
     "t.c = raster_corner(rg, p, i, along_x + across_x, along_y + across_y);",
     "t.c = raster_corner(rg, p, i, along_x - across_x, along_y + across_y);"),
    ("panes stretch with the picture", "quads.h", "2.0f * x / p.aspect", "2.0f * x"),
    ("green is blue", "quads.h", "raster_quad_word(rg, i, 8),", "raster_quad_word(rg, i, 9),"),
    # billboards
    ("all drops lie in one plane", "drops.h", "rg_uniform(r.z)", "rg_uniform(r.x)"),
    ("drops depend on their number", "drops.h", "rg_to_uint(p.seed)", "rg_to_uint(p.count)"),
    ("all drops are equally far", "drops.h", "rg_uniform(r.z)", "0.5f"),
    ("streaks hang below their drops", "streaks.h", "v3 tail = v3_add(head, streak);", "v3 tail = v3_add(head, v3_scale(streak, -1.0f));"),
    ("streaks have twice their width", "streaks.h", "v3 other = v3_scale(side, -1.0f);", "v3 other = v3_scale(side, -3.0f);"),
    ("streaks look along the view, not to the eye", "streaks.h",
     "v3 beside = v3_cross(streak, head);", "v3 beside = v3_cross(streak, v3_make(0.0f, 0.0f, head.z));"),
    ("drops that leave do not come in again", "streaks.h", "return now - rg_floor(now);", "return now;"),
    ("wind does not carry drops", "streaks.h", "drops_at(rg, i), p.fallen_x", "drops_at(rg, i), 0.0f"),
)] + [Row(*row, ("../../device/device_suite ranges",)) for row in (
    # what queries draw
    ("queries begin at a primitive's number", RANGES, "first * vertices);", "first);"),
    ("queries draw as many vertices as primitives", RANGES, "(before_at(rg, end) - first) * vertices", "before_at(rg, end) - first"),
    ("queries draw what earlier ones drew, too", RANGES, "(before_at(rg, end) - first) * vertices", "before_at(rg, end) * vertices"),
    ("the last query goes on beyond the draw", RANGES, "rg_imin(begin + p.chunks_a_query, p.chunks)", "begin + p.chunks_a_query"),
)]
