#include "backends/cpu/draw/raster.h"

#include "backends/cpu/draw/cover_tmpl.h"
#include "backends/cpu/draw/shade_tmpl.h"

#define NAME_(level) rg_cpu_raster_##level
#define NAME(level)  NAME_(level)

extern const struct cpu_raster NAME(RG_LEVEL);
const struct cpu_raster NAME(RG_LEVEL) = {.cover = cover_shapes, .shade = shade_tile};
