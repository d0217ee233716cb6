// The mean light of streaks over all oscillations and a whole period, from the atlas's level with
// pictures one texel wide.
#include "core/techniques/streaks/far/means.h"

#include <math.h>
#include <stddef.h>
#include <stdlib.h>

#include "core/base/alloc.h"
#include "core/scene/atlas/levels.h"
#include "core/techniques/streaks/far/join.h"
#include "kernels/streaks/cells.h"
#include "kernels/streaks/far/params.h"

enum { LEVEL = RG_ATLAS_CELL_LEVELS - 1, TURNS = 64 };

enum { SAMPLES = TURNS * RG_ATLAS_OSCILLATIONS };

// The pictures of a view: the sky, then the columns.
enum { PICTURES = 1 + STREAKS_COLUMNS };

// A streak's contribution from each picture, at any time of each oscillation.
struct samples {
    float of[RG_ATLAS_VIEWS][PICTURES][SAMPLES];
};

static void sample_column(const uint16_t *rows, int pitch, int view, double factor, float *to)
{
    const double rim = (double)STREAKS_RIM_PX / (1 << LEVEL);
    const int start = rg_atlas_row_start(view, LEVEL), count = rg_atlas_row_height(view, LEVEL);
    for (int turn = 0; turn < TURNS; turn++) {
        const double at = rim + (count - 2 * rim) * (turn + 0.5) / TURNS - 0.5;
        const int row = (int)floor(at);
        const double first = (double)rg_half_value(rows[(start + row) * pitch]),
                     second = (double)rg_half_value(rows[(start + row + 1) * pitch]);
        to[turn] = (float)(factor * (first + (second - first) * (at - row)));
    }
}

static bool sample_oscillation(const struct rg_atlas *atlas, int layer, struct samples *samples)
{
    const int own = LEVEL - atlas->first_level;
    const int pitch = atlas->images[RG_ATLAS_POINT].width >> own;
    const int sky_pitch = atlas->images[RG_ATLAS_ENV].width >> own;
    uint16_t *points = streaks_joined(atlas, RG_ATLAS_POINT, layer, own);
    uint16_t *skies = streaks_joined(atlas, RG_ATLAS_ENV, layer, own);
    for (int view = 0; points && skies && view < RG_ATLAS_VIEWS; view++) {
        float(*to)[SAMPLES] = samples->of[view];
        const float *factors = &atlas->point_factor[layer][view][0][0];
        sample_column(skies, sky_pitch, view, (double)atlas->env_factor[layer][view],
                      to[0] + layer * TURNS);
        for (int column = 0; column < STREAKS_COLUMNS; column++)
            sample_column(points + column, pitch, view, (double)factors[column],
                          to[1 + column] + layer * TURNS);
    }
    const bool ok = points && skies;
    free(points);
    free(skies);
    return ok;
}

static double mean_of(const float *a)
{
    double sum = 0;
    for (int i = 0; i < SAMPLES; i++)
        sum += (double)a[i] / SAMPLES;
    return sum;
}

static double product_of(const float *a, const float *b)
{
    double sum = 0;
    for (int i = 0; i < SAMPLES; i++)
        sum += (double)a[i] * (double)b[i] / SAMPLES;
    return sum;
}

// Corner 0 to 7 of a block; the bits are azimuth, elevation and view.
static const float *corner_of(const struct samples *samples, int view, int low, int left,
                              int corner)
{
    const int column = (low + (corner >> 1 & 1)) * STREAKS_AZIMUTHS + left + (corner & 1);
    return samples->of[view + (corner >> 2)][1 + column];
}

// The square of a blend is a sum over pairs of corners. Pairs with equally many upper corners along
// each axis have the same weights, so that their products are averaged.
static int square_of(int a, int b)
{
    return (a & 1) + (b & 1) + 3 * ((a >> 1 & 1) + (b >> 1 & 1)) + 9 * ((a >> 2) + (b >> 2));
}

static void find_block(const struct samples *samples, int view, int low, int left, float *to)
{
    double squares[27] = {0};
    int alike[27] = {0};
    for (int a = 0; a < 8; a++) {
        const float *first = corner_of(samples, view, low, left, a);
        to[a] = (float)mean_of(first);
        for (int b = 0; b < 8; b++) {
            squares[square_of(a, b)] += product_of(first, corner_of(samples, view, low, left, b));
            alike[square_of(a, b)]++;
        }
    }
    for (int i = 0; i < 27; i++)
        to[STREAKS_FAR_SQUARES + i] = (float)(squares[i] / alike[i]);
}

static void find_sky(const struct samples *samples, int view, float *to)
{
    const float *first = samples->of[view][0], *second = samples->of[view + 1][0];
    to[0] = (float)mean_of(first);
    to[1] = (float)mean_of(second);
    to[2] = (float)product_of(first, first);
    to[3] = (float)product_of(first, second);
    to[4] = (float)product_of(second, second);
}

static void find_figures(const struct samples *samples, float *figures)
{
    float *to = figures;
    for (int view = 0; view < RG_ATLAS_VIEWS - 1; view++)
        for (int low = 0; low < STREAKS_FAR_HIGH; low++)
            for (int left = 0; left < STREAKS_FAR_WIDE; left++, to += STREAKS_FAR_BLOCK)
                find_block(samples, view, low, left, to);
    for (int view = 0; view < RG_ATLAS_VIEWS - 1; view++, to += STREAKS_FAR_SKY)
        find_sky(samples, view, to);
}

struct rg_buf *streaks_far_means(struct rg_device *device, const struct rg_atlas *atlas)
{
    const size_t count = (size_t)STREAKS_FAR_BLOCKS * STREAKS_FAR_BLOCK +
                         (size_t)(RG_ATLAS_VIEWS - 1) * STREAKS_FAR_SKY;
    struct samples *samples = rg_alloc(1, sizeof(*samples), "streaks' pictures");
    float *figures = rg_alloc(count, sizeof(*figures), "mean streaks");
    bool ok = samples && figures;
    for (int layer = 0; ok && layer < RG_ATLAS_OSCILLATIONS; layer++)
        ok = sample_oscillation(atlas, layer, samples);
    if (ok)
        find_figures(samples, figures);
    struct rg_buf *buf =
        ok ? rg_buf_create_with(device, figures, (int64_t)(count * sizeof(*figures)),
                                "mean streaks")
           : NULL;
    free(samples);
    free(figures);
    return buf;
}
