// Tables of drawing itself. There is no paper: rows compare devices with each other.
#include "harness/tables/papers/published.h"

static const struct rg_table_row rows_1[] = {
    {"scene=billboards", {0}, "785,000 billboards"},
    {"scene=mesh", {0}, "bunny"},
    {"scene=triangles", {0}, "a million triangles"},
    {"scene=quads", {0}, "overlapping quads"},
};

const struct rg_table rg_table_raster_1 = {
    .id = "raster-1",
    .technique = "raster",
    .about = "frame rate by the scene that is rasterised",
    .names = "scene",
    .variants = {{"full", "", NULL}},
    .width = 1280,
    .height = 720,
    .row_count = 4,
    .rows = rows_1,
    .note = "Nothing of this is in print. For the billboards, llvmpipe takes 120 to 170 ms a frame "
            "on two cores when they are drawn its own way: 6 corners pulled by the vertex shader, "
            "4 corners an instance, or a geometry shader.",
};
