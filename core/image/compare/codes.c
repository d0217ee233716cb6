// Metrics of codes, as computed by programs that compare integer pictures without decoding them.
#include <math.h>

#include "core/image/compare/compare.h"
#include "core/image/srgb.h"

// Encodes a row back to the values that it was decoded from: code / largest code, alpha unchanged.
static void encode_back(const struct rg_picture *from, int y, float *row)
{
    const struct rg_srgb *srgb = rg_srgb();
    const int channels = from->channels, colours = rg_picture_colours(from);
    const float *texel = from->texels + (int64_t)y * from->width * channels;
    for (int x = 0; x < from->width; x++, texel += channels, row += channels)
        for (int c = 0; c < channels; c++)
            row[c] = c >= colours      ? texel[c]
                     : from->gamma > 0 ? (float)pow((double)texel[c], 1 / from->gamma)
                                       : rg_srgb_encoded(srgb, texel[c]);
}

bool rg_code_metrics(const struct rg_picture *a, const struct rg_picture *b,
                     struct rg_metrics *metrics)
{
    return rg_metrics_of_rows(a, b, encode_back, metrics);
}
