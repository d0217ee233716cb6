// Pictures as video codes them: luma and two chroma planes (ITU-R BT.709-6), 8 bits in the limited
// range, chroma at half the size (4:2:0).
//
// The picture's sRGB codes are converted in exact integer arithmetic, halves rounded up, so that a
// clip has the same frames on every machine.
#ifndef RG_CORE_IMAGE_CLIP_YUV_H
#define RG_CORE_IMAGE_CLIP_YUV_H

#include "core/image/picture.h"

// The bytes of a frame. Width and height may be odd.
static inline size_t rg_yuv_bytes(int width, int height)
{
    return (size_t)width * (size_t)height +
           2 * ((size_t)(width + 1) / 2 * ((size_t)(height + 1) / 2));
}

// Fills `yuv` with a frame: Y of every pixel, 16 to 235; then Cb, and then Cr, of every square of 2
// x 2 pixels, 16 to 240, from the mean of its codes. If the picture ends within a square, its last
// row or column counts twice. Colours are multiplied by `exposure`, clamped and sRGB-encoded as in
// a PNG; alpha is ignored.
void rg_yuv_encode(const struct rg_picture *picture, float exposure, uint8_t *yuv);

#endif
