"""Places of drawing's kernels that are changed, and the tests that ought to notice, by file."""
import collections

Row = collections.namedtuple("Row", "about file old new tests")

CLIP = "../dialect/draw/clip.h"
COVER = "../dialect/draw/coverage.h"
PLANES = "../dialect/draw/triangle.h"
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
)]
