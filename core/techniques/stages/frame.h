// What a technique has drawn, brought to the host.
#ifndef RG_CORE_TECHNIQUES_STAGES_FRAME_H
#define RG_CORE_TECHNIQUES_STAGES_FRAME_H

#include "core/image/picture.h"
#include "core/techniques/stages/instance.h"

// The target's texels as the device holds them: *size bytes, which the caller frees. NULL, and one
// logged line, on failure.
void *rg_frame_read(struct rg_instance *instance, size_t *size);

// The same, of so many pixels, as a picture of 4 channels, which the caller destroys; `texels` as
// rg_frame_read gave them. False, and one logged line, without memory.
bool rg_frame_picture(const void *texels, int width, int height, struct rg_picture *picture);

// Both at once; the caller destroys the picture. False, and one logged line, on failure.
bool rg_frame_read_picture(struct rg_instance *instance, struct rg_picture *picture);

#endif
