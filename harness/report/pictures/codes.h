// The codes of a page's pictures, and the bytes that hold them without a loss.
#ifndef RG_HARNESS_REPORT_PICTURES_CODES_H
#define RG_HARNESS_REPORT_PICTURES_CODES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

// A picture of width * height texels: red, green, blue and alpha, straight, sRGB's codes of 8 bits.
struct rg_codes {
    int width, height;
    uint8_t *texels; // owned; NULL: none
};

// The codes of a PNG. False, without a message, if it has more than one frame, more than 8 bits or
// more pixels than WebP can hold, if it is damaged, or without memory.
bool rg_codes_of_png(const void *png, size_t size, struct rg_codes *codes);
void rg_codes_free(struct rg_codes *codes);

// The same for codes of one picture, whatever file held them.
uint64_t rg_codes_digest(const struct rg_codes *codes);

// Lossless WebP, which the caller frees; the same bytes for the same codes. NULL, without a
// message, if libwebp refuses.
uint8_t *rg_codes_webp(const struct rg_codes *codes, size_t *size);

#endif
