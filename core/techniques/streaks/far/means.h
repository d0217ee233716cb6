// The statistics of an atlas's streaks with which distant rain is drawn.
#ifndef RG_CORE_TECHNIQUES_STREAKS_FAR_MEANS_H
#define RG_CORE_TECHNIQUES_STREAKS_FAR_MEANS_H

#include "core/device/device.h"
#include "core/scene/atlas/atlas.h"

// Floats in the order of kernels/streaks/far/params.h. NULL, and one logged line, on failure.
struct rg_buf *streaks_far_means(struct rg_device *device, const struct rg_atlas *atlas);

#endif
