// Figures of codes, as programs have them that compare integer pictures without decoding them.
#include "core/image/compare/compare.h"
#include "core/image/srgb.h"

// A picture of what the texels were decoded from: code / largest code, alpha as it is.
static bool encode_back(const struct rg_picture *from, struct rg_picture *to)
{
    if (!rg_picture_create(to, from->width, from->height, from->channels, "codes"))
        return false;
    const int64_t values = rg_picture_values(from);
    const int channels = from->channels, colours = rg_picture_colours(from);
#pragma omp parallel for schedule(static)
    for (int64_t i = 0; i < values; i++)
        to->texels[i] = i % channels < colours ? (float)rg_srgb_encode((double)from->texels[i])
                                               : from->texels[i];
    return true;
}

bool rg_code_metrics(const struct rg_picture *a, const struct rg_picture *b,
                     struct rg_metrics *metrics)
{
    struct rg_picture codes[2] = {{0}};
    const bool ok = encode_back(a, &codes[0]) && encode_back(b, &codes[1]) &&
                    rg_metrics_compute(&codes[0], &codes[1], metrics);
    rg_picture_destroy(&codes[0]);
    rg_picture_destroy(&codes[1]);
    return ok;
}
