// Pictures out of focus, and pictures of half the size.
#ifndef RG_CORE_IMAGE_DISC_H
#define RG_CORE_IMAGE_DISC_H

#include "core/image/picture.h"

// Replaces a picture by one of half the size, rounded down but at least 1, each texel the mean of
// four. False, and one logged line, when memory runs out; the picture is then unchanged.
bool rg_picture_halve(struct rg_picture *picture);

// Replaces each texel by the mean of a disc around it, as an unfocused lens does. Beyond its edges
// the picture is mirrored. False, and one logged line, when memory runs out; the picture is then
// unchanged.
bool rg_picture_blur(struct rg_picture *picture, double diameter_px);

#endif
