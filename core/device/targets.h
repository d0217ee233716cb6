// The targets of a DRAW pass's run, and of texels that a native device draws.
#ifndef RG_CORE_DEVICE_TARGETS_H
#define RG_CORE_DEVICE_TARGETS_H

#include "backends/backend.h"

// The size in pixels of the image level that is drawn to.
void rg_target_size(const struct rg_draw *draw, int *width, int *height);
// Whether the draw has no scissor.
bool rg_target_is_whole(const struct rg_draw *draw);

// Whether a run of a DRAW pass has valid targets and items along x alone; else one logged line.
bool rg_target_check(const struct rg_pass *pass, const struct rg_run *run);

// Of a GRID kernel whose texels are drawn: whether its image can be drawn to; else one logged line.
bool rg_target_takes_texels(const struct rg_pass *pass, const struct rg_run *run);
// The draw of a run's texels, which have one layer. False: none lies in the image.
bool rg_target_of_texels(const struct rg_kernel *kernel, const struct rg_run *run,
                         struct rg_draw *draw);

#endif
