// Pictures as video has them: light and two differences of colour (ITU-R BT.709-6), of 8 bits in
// the limited range, the differences at half the size (4:2:0).
//
// The codes of the encoded picture become these in integers, exactly, with halves rounded up: so a
// clip has the same frames on every machine.
#ifndef RG_CORE_IMAGE_CLIP_YUV_H
#define RG_CORE_IMAGE_CLIP_YUV_H

#include "core/image/picture.h"

// The bytes of a frame. Sides may be odd.
static inline size_t rg_yuv_bytes(int width, int height)
{
    return (size_t)width * (size_t)height +
           2 * ((size_t)(width + 1) / 2 * ((size_t)(height + 1) / 2));
}

// Fills `yuv` with a frame: Y of every pixel, 16 to 235; then Cb, and then Cr, of every square of
// 2 x 2 pixels, 16 to 240, which are those of the mean of its codes. Where the picture ends within
// a square its last row or column counts twice. Colours are multiplied by `exposure`, clamped and
// sRGB-encoded as in a PNG; alpha is left out.
void rg_yuv_encode(const struct rg_picture *picture, float exposure, uint8_t *yuv);

#endif
