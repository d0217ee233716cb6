// FLIP for high dynamic range: Andersson, Nilsson, Shirley, Akenine-Moeller, "Visualizing Errors in
// Rendered High Dynamic Range Images", Eurographics 2021. Both pictures are tone-mapped at all
// exposures that show something of the reference, and each pixel keeps its largest difference.
#include <float.h>
#include <math.h>
#include <string.h>

#include "core/image/compare/compare.h"
#include "core/image/compare/multiversion.h"

// The tone mapping: Narkowicz's fit of ACES with its exposure of 0.6 folded in: (k[0] x^2 + k[1] x
// + k[2]) / (k[3] x^2 + k[4] x + k[5]).
static const double k[6] = {0.6 * 0.6 * 2.51, 0.6 * 0.03, 0, 0.6 * 0.6 * 2.43, 0.6 * 0.59, 0.14};
// Exposures stop where the tone-mapped value reaches this.
#define BRIGHT 0.85
// Tone mapping gives 1 from far below this value on; clamping to it keeps squares from overflowing.
#define LARGEST 1e9f

// Negative values and NaN show as black.
static inline float seen(float texel, float scale)
{
    const float x = texel * scale;
    return x > LARGEST ? LARGEST : x > 0 ? x : 0;
}

static inline float tone_mapped(float x)
{
    const float k0 = (float)k[0], k1 = (float)k[1], k3 = (float)k[3], k4 = (float)k[4],
                k5 = (float)k[5];
    const float y = (k0 * x + k1) * x / ((k3 * x + k4) * x + k5);
    return y < 1 ? y : 1;
}

RG_MULTIVERSION static void map_tones(float *values, int count, float scale)
{
    for (int i = 0; i < count; i++)
        values[i] = tone_mapped(seen(values[i], scale));
}

// --- the exposures ---

// The value of a rank in ascending order; none may be NaN, and the array is reordered. Hoare's
// selection, because a large picture need not be sorted whole.
static float value_at_rank(float *values, int64_t count, int64_t rank)
{
    int64_t first = 0, last = count - 1;
    while (first < last) {
        const float pivot = values[first + (last - first) / 2];
        int64_t i = first - 1, j = last + 1;
        for (;;) {
            while (values[++i] < pivot)
                ;
            while (values[--j] > pivot)
                ;
            if (i >= j)
                break;
            const float value = values[i];
            values[i] = values[j];
            values[j] = value;
        }
        if (rank <= j)
            last = j;
        else
            first = j + 1;
    }
    return values[rank];
}

static void fill_luminances(const struct rg_picture *picture, float *luminances)
{
    const int64_t pixels = (int64_t)picture->width * picture->height;
    const int channels = picture->channels, colours = rg_picture_colours(picture);
    const int green = colours > 1, blue = 2 * green;
    for (int64_t i = 0; i < pixels; i++) {
        const float *t = picture->texels + i * channels;
        luminances[i] =
            0.2126f * seen(t[0], 1) + 0.7152f * seen(t[green], 1) + 0.0722f * seen(t[blue], 1);
    }
}

// Finds the range of exposures: from where the reference's brightest pixel is just bright to where
// its median is.
static void find_exposures(const struct rg_picture *reference, float *luminances,
                           struct rg_hdr_flip *hdr)
{
    const int64_t pixels = (int64_t)reference->width * reference->height;
    const double a = k[0] - BRIGHT * k[3], b = k[1] - BRIGHT * k[4], c = k[2] - BRIGHT * k[5];
    const double bright = -b / (2 * a) + sqrt(b * b / (4 * a * a) - c / a);
    fill_luminances(reference, luminances);
    const double brightest = value_at_rank(luminances, pixels, pixels - 1);
    const double median = 0.5 * ((double)value_at_rank(luminances, pixels, (pixels - 1) / 2) +
                                 value_at_rank(luminances, pixels, pixels / 2));
    hdr->start_exposure = log2(bright / fmax(brightest, (double)FLT_EPSILON));
    hdr->stop_exposure = log2(bright / fmax(median, (double)FLT_EPSILON));
    hdr->exposures = (int)fmax(2, ceil(hdr->stop_exposure - hdr->start_exposure));
}

// --- the largest difference ---

static bool is_same(const struct rg_picture *a, const struct rg_picture *b)
{
    const size_t texels = (size_t)a->width * (size_t)a->height * (size_t)a->channels;
    return a->channels == b->channels && !memcmp(a->texels, b->texels, texels * sizeof(*a->texels));
}

bool rg_hdr_flip_map(const struct rg_picture *a, const struct rg_picture *b,
                     float pixels_per_degree, float *map, struct rg_hdr_flip *hdr)
{
    const size_t pixels = (size_t)a->width * (size_t)a->height;
    find_exposures(a, map, hdr);
    memset(map, 0, pixels * sizeof(*map));
    const double step = (hdr->stop_exposure - hdr->start_exposure) / (hdr->exposures - 1);
    const int shown = is_same(a, b) ? 0 : hdr->exposures; // equal pictures differ at no exposure
    bool good = true;
    for (int i = 0; good && i < shown; i++)
        good = rg_flip_map_shown(a, b, map_tones, (float)exp2(hdr->start_exposure + i * step),
                                 pixels_per_degree, map);
    return good;
}
