#include "core/image/compare/compare.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "core/image/srgb.h"

static void encode_row(const struct rg_picture *picture, int y, float exposure, uint8_t *codes)
{
    const struct rg_srgb *srgb = rg_srgb();
    int channels = picture->channels, colours = rg_picture_colours(picture);
    int green = colours > 1, blue = 2 * green;
    const float *texel = picture->texels + (int64_t)y * picture->width * channels;
    codes += (int64_t)y * picture->width * 4;
    for (int x = 0; x < picture->width; x++, texel += channels, codes += 4) {
        codes[0] = rg_srgb_code(srgb, texel[0] * exposure);
        codes[1] = rg_srgb_code(srgb, texel[green] * exposure);
        codes[2] = rg_srgb_code(srgb, texel[blue] * exposure);
        codes[3] = channels > colours ? rg_alpha_code(texel[colours]) : 255;
    }
}

void rg_encode(const struct rg_picture *picture, float exposure, uint8_t *codes)
{
#pragma omp parallel for schedule(static)
    for (int y = 0; y < picture->height; y++)
        encode_row(picture, y, exposure, codes);
}

static bool same_shape(const struct rg_picture *a, const char *name_a, const struct rg_picture *b,
                       const char *name_b)
{
    if (a->width != b->width || a->height != b->height)
        return rg_error("%s: is %d x %d pixels but %s is %d x %d; compare pictures of one size",
                        name_b, b->width, b->height, name_a, a->width, a->height);
    if (a->channels != b->channels)
        return rg_error("%s: has %d channels but %s has %d; write both with the same channels",
                        name_b, b->channels, name_a, a->channels);
    return true;
}

// The arrays of a comparison, in one allocation: codes of each picture, and the mask.
struct planes {
    uint8_t *a, *b, *background, *mask;
};

static bool compute(const struct rg_picture *a, const struct rg_picture *b,
                    const struct rg_picture *background, const struct planes *planes,
                    struct rg_comparison *c)
{
    rg_encode(a, c->exposure, planes->a);
    rg_encode(b, c->exposure, planes->b);
    if (background)
        rg_encode(background, c->exposure, planes->background);
    return rg_metrics_compute(a, b, &c->metrics) &&
           rg_tiers_compute(a, b, planes->a, planes->b, background ? planes->background : NULL,
                            c->exposure, &c->metrics, planes->mask, &c->tiers) &&
           rg_flip_map(planes->a, planes->b, a->width, a->height, c->pixels_per_degree,
                       c->flip_map) &&
           rg_flip_pool(c->flip_map, background ? planes->mask : NULL,
                        (int64_t)a->width * a->height, &c->flip);
}

// Computes the additional metrics: of codes, and HDR-FLIP.
static bool compute_beside(const struct rg_picture *a, const struct rg_picture *b,
                           const uint8_t *mask, bool wants_hdr, struct rg_comparison *c)
{
    const int64_t pixels = (int64_t)a->width * a->height;
    c->has_codes = a->decoded && b->decoded;
    c->has_hdr_flip = wants_hdr && !a->decoded && !b->decoded;
    if (c->has_codes && !rg_code_metrics(a, b, &c->code_metrics))
        return false;
    if (!c->has_hdr_flip)
        return true;
    float *map = malloc((size_t)pixels * sizeof(*map));
    const bool ok = (map || rg_harness_error("HDR-FLIP of %d x %d pixels: no memory for it",
                                             a->width, a->height)) &&
                    rg_hdr_flip_map(a, b, c->pixels_per_degree, map, &c->hdr_flip) &&
                    rg_flip_pool(map, mask, pixels, &c->hdr_flip.flip);
    free(map);
    return ok;
}

static const char *tier_name(const struct rg_tiers *tiers)
{
    const int tier = rg_tiers_strictest(tiers);
    return tier < RG_TIER_COUNT ? rg_tier_name((enum rg_tier)tier) : "none";
}

bool rg_compare(const struct rg_picture *a, const char *name_a, const struct rg_picture *b,
                const char *name_b, const struct rg_picture *background,
                const struct rg_compare_options *options, struct rg_comparison *comparison)
{
    memset(comparison, 0, sizeof(*comparison));
    if (!same_shape(a, name_a, b, name_b))
        return false;
    if (background && (background->width != a->width || background->height != a->height))
        return rg_error(
            "the background: is %d x %d pixels but %s is %d x %d; render it at that size",
            background->width, background->height, name_a, a->width, a->height);
    struct rg_comparison *c = comparison;
    c->width = a->width;
    c->height = a->height;
    c->channels = a->channels;
    c->exposure = options->exposure != 0.0f ? options->exposure : 1.0f;
    c->pixels_per_degree =
        options->pixels_per_degree != 0.0f ? options->pixels_per_degree : 67.0206433f;
    if (!(c->exposure > 0.0f && isfinite(c->exposure)))
        return rg_error("exposure %g: has to be above 0", (double)c->exposure);
    size_t pixels = (size_t)a->width * (size_t)a->height;
    uint8_t *memory = malloc(pixels * (background ? 13 : 9));
    c->flip_map = malloc(pixels * sizeof(*c->flip_map));
    struct planes planes = {memory, memory + pixels * 4, background ? memory + pixels * 9 : NULL,
                            memory + pixels * 8};
    bool good =
        memory && c->flip_map
            ? compute(a, b, background, &planes, c) &&
                  compute_beside(a, b, background ? planes.mask : NULL, options->hdr_flip, c)
            : rg_harness_error("%s: no memory to compare %d x %d pixels; crop it", name_a, a->width,
                               a->height);
    free(memory);
    c->tier = tier_name(&c->tiers);
    if (!good)
        rg_comparison_destroy(c);
    return good;
}

bool rg_picture_shows_rain(const struct rg_picture *picture, const struct rg_picture *background,
                           float exposure, bool *shows)
{
    const size_t pixels = (size_t)picture->width * (size_t)picture->height;
    uint8_t *codes = malloc(pixels * 8);
    if (!codes)
        return rg_harness_error("pictures of %d x %d pixels: no memory to compare them; crop them",
                                picture->width, picture->height);
    rg_encode(picture, exposure, codes);
    rg_encode(background, exposure, codes + pixels * 4);
    *shows = rg_shows_rain(codes, codes + pixels * 4, (int64_t)pixels);
    free(codes);
    return true;
}

void rg_comparison_destroy(struct rg_comparison *comparison)
{
    if (!comparison)
        return;
    free(comparison->flip_map);
    memset(comparison, 0, sizeof(*comparison));
}
