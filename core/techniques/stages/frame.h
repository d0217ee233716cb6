// Reads a technique's picture to the host.
#ifndef RG_CORE_TECHNIQUES_STAGES_FRAME_H
#define RG_CORE_TECHNIQUES_STAGES_FRAME_H

#include "core/image/picture.h"
#include "core/techniques/stages/instance.h"

// The target's texels in the device's format: *size bytes, which the caller frees. NULL, and one
// logged line, on failure.
void *rg_frame_read(struct rg_instance *instance, size_t *size);

// Converts texels of rg_frame_read, of this many pixels, to a picture of 4 channels, which the
// caller destroys. False, and one logged line, when memory runs out.
bool rg_frame_picture(const void *texels, int width, int height, struct rg_picture *picture);

// Reads and converts; the caller destroys the picture. False, and one logged line, on failure.
bool rg_frame_read_picture(struct rg_instance *instance, struct rg_picture *picture);

#endif
