// What drawing shares among programs, compiled once a level.
#include "backends/cpu/draw_cover.h"
#include "backends/cpu/draw_shade.h"

#define NAME_(level) rg_cpu_raster_##level
#define NAME(level)  NAME_(level)

extern const struct cpu_raster NAME(RG_LEVEL);
const struct cpu_raster NAME(RG_LEVEL) = {.cover = cover_shapes, .shade = shade_tile};
