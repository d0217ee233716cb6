// What streaks add in the mean over all oscillations and a whole swing, from the atlas' level whose
// pictures are one texel wide.
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

enum { SAMPLES = TURNS * RG_ATLAS_OSCILLATIONS, CELLS = RG_ATLAS_VIEWS * STREAKS_FAR_MEANS };

// What a streak adds of each direction, at any time of the swing of each oscillation.
struct samples {
    float of[CELLS][SAMPLES];
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
        float(*to)[SAMPLES] = samples->of + (ptrdiff_t)view * STREAKS_FAR_MEANS;
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

static double covariance_of(const float *a, const float *b)
{
    const double mean_a = mean_of(a), mean_b = mean_of(b);
    double sum = 0;
    for (int i = 0; i < SAMPLES; i++)
        sum += ((double)a[i] - mean_a) * ((double)b[i] - mean_b) / SAMPLES;
    return sum;
}

// How alike a cell's picture is to that of a cell further on; of the last ones it does not matter.
static float alike(const struct samples *samples, int cell, int further)
{
    const float *a = samples->of[cell], *b = samples->of[(cell + further) % CELLS];
    const double variances = covariance_of(a, a) + covariance_of(b, b);
    return variances > 0 ? (float)(2 * covariance_of(a, b) / variances) : 1;
}

static void find_figures(const struct samples *samples, float *figures)
{
    for (int cell = 0; cell < CELLS; cell++) {
        float *to = figures + (ptrdiff_t)cell * STREAKS_FAR_FIGURES;
        to[0] = (float)mean_of(samples->of[cell]);
        to[1] = (float)covariance_of(samples->of[cell], samples->of[cell]);
        to[2] = alike(samples, cell, 1);
        to[3] = alike(samples, cell, STREAKS_AZIMUTHS);
        to[4] = alike(samples, cell, STREAKS_FAR_MEANS);
    }
}

struct rg_buf *streaks_far_means(struct rg_device *device, const struct rg_atlas *atlas)
{
    const size_t count = (size_t)CELLS * STREAKS_FAR_FIGURES;
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
