#include "core/scene/atlas/streak.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/scene/atlas/optics/trace.h"

// The most rows of the picture that one row of rays adds to: twice the fall between two moments,
// and one more at either end.
enum { MAX_BLUR = 256 };

// State that is constant while one set of streaks is traced. Rows of the picture count downwards,
// rays and v upwards.
struct tracing {
    const struct rg_lobes *lobes;
    struct rg_drop_view view;
    struct rg_streaks *streaks;
    int rays, rows;           // rays in the longest row, and number of rows: both even
    float step_u, step_v;     // between rays and between rows of them, in radii
    float radius_x, radius_y; // of the drop, in columns and rows
    double fall_rows;         // over the exposure
    double top_row;           // row of the drop's middle when the exposure begins
    double share;             // weight of one ray at one moment in a pixel
    enum rg_swings swings;
    int moments;
    int column[RG_TRACE_MAX]; // the picture's column of each ray
    float (*light)[RG_ATLAS_CELL_PX];
    float env[RG_ATLAS_CELL_PX];
    bool lit[RG_LOBE_COUNT];
    struct rg_drop_row row;
};

// The integral of a tent of width 2 from its middle.
static double tent(double s)
{
    return s - 0.5 * s * fabs(s);
}

// Adds the light of one ray, on one way through the drop, to the lobes that it points into.
static void scatter(struct tracing *t, int way, int i, int column)
{
    const float share = t->row.share[way][i];
    const float x = t->row.x[way][i], y = t->row.y[way][i], z = t->row.z[way][i];
    const int square = rg_lobes_square(x, y, z);
    for (int k = 0; k < t->lobes->listed[square]; k++) {
        const int l = t->lobes->list[square][k];
        const float *to = t->lobes->direction[l];
        const float radiance = rg_lobe_radiance(t->lobes, x * to[0] + y * to[1] + z * to[2]);
        if (radiance <= 0)
            continue;
        if (!t->lit[l])
            memset(t->light[l], 0, sizeof(t->light[l]));
        t->lit[l] = true;
        t->light[l][column] += share * radiance;
    }
}

// Adds a row's light to the picture, blurred by the fall.
static void add_row(const struct tracing *t, const float *light, const float *weights, int first,
                    int count, float *picture)
{
    const int width = t->streaks->width;
    for (int r = 0; r < count; r++)
        for (int c = 0; c < width; c++)
            picture[(first + r) * width + c] += weights[r] * light[c];
}

// The share of the exposure that a point spends in each row of the picture while moment k fades in
// and out. At the moment itself the point is at row `at`. Fills weights from the first row on, and
// returns the number of rows. Only the exposure counts, not the time before and after it.
static int find_weights(const struct tracing *t, int k, double at, float weights[MAX_BLUR],
                        int *first)
{
    const double fall = t->fall_rows / t->moments;
    const double low = k ? -1 : 0, high = k < t->moments ? 1 : 0;
    const int begin = (int)floor(at + low * fall), end = (int)floor(at + high * fall) + 1;
    *first = begin < 0 ? 0 : begin;
    const int count = (end < t->streaks->height ? end : t->streaks->height) - *first;
    for (int r = 0; r < count; r++) {
        const double above = fmin(fmax((*first + r - at) / fall, low), high);
        const double below = fmin(fmax((*first + r + 1 - at) / fall, low), high);
        weights[r] = (float)(t->share * (tent(below) - tent(above)));
    }
    return count;
}

// Traces the rays of one height v, in radii, at moment k.
static void trace_row(struct tracing *t, const struct rg_drop_shape *shape, int k, float v)
{
    memset(t->lit, 0, sizeof(t->lit));
    memset(t->env, 0, sizeof(t->env));
    const float reach = sqrtf(fmaxf(RG_DROP_REACH * RG_DROP_REACH - v * v, 0));
    const int half = (int)ceilf(reach / t->step_u), left = t->rays / 2 - half;
    rg_drop_trace(shape, &t->view, v, t->step_u * (0.5f - (float)half), t->step_u, 2 * half,
                  &t->row);
    // Light of 1 from everywhere stays 1 inside the drop, after any number of reflections.
    for (int i = 0; i < 2 * half; i++)
        t->env[t->column[left + i]] += t->row.hit[i];
    for (int way = 0; way < RG_DROP_WAYS; way++)
        for (int i = 0; i < 2 * half; i++)
            if (t->row.share[way][i] > 0)
                scatter(t, way, i, t->column[left + i]);
    float weights[MAX_BLUR];
    int first;
    const double passed = (double)k / t->moments;
    const int count = find_weights(
        t, k, t->top_row + t->fall_rows * passed - (double)(v * t->radius_y), weights, &first);
    const int pixels = t->streaks->width * t->streaks->height;
    for (int l = 0; l < t->lobes->count; l++)
        if (t->lit[l])
            add_row(t, t->light[l], weights, first, count, t->streaks->point + l * pixels);
    add_row(t, t->env, weights, first, count, t->streaks->env);
}

// Traces the drop as it is after k parts of the exposure. Each moment shifts the rows of rays by
// the golden ratio, so that later moments fill the gaps of earlier ones.
static void trace_moment(struct tracing *t, int oscillation, int k)
{
    const struct rg_drop_shape shape =
        rg_drop_shape(t->swings, oscillation, RG_EXPOSURE_S * k / t->moments);
    const double turn = k * 0.6180339887498949;
    const float shift = (float)(turn - floor(turn)) - 0.5f;
    for (int j = 0; j < t->rows; j++)
        trace_row(t, &shape, k, t->step_v * ((float)j + shift - 0.5f * (float)(t->rows - 1)));
}

static bool prepare(struct tracing *t, int view, int level, const struct rg_streak_detail *detail)
{
    const int height = rg_atlas_row_height(view, level);
    const double shrink = (double)height / rg_atlas_row_height(view, 0);
    t->radius_x = 0.5f * RG_ATLAS_DROP_PX / (float)(1 << level);
    t->radius_y = (float)(0.5 * (double)RG_ATLAS_DROP_PX * shrink);
    const double foreshortening = cos(view * 20 * M_PI / 180);
    t->swings = detail->swings;
    t->fall_rows = RG_DROP_FALL * 2 * (double)t->radius_y * foreshortening;
    t->top_row = 0.5 * (height - t->fall_rows);
    t->moments = detail->moments;
    t->step_u = 1 / ((float)detail->column * t->radius_x);
    t->step_v = 2.0f / (float)detail->along * (float)fmax(foreshortening, 2.0 / 3);
    t->rays = 2 * (int)ceilf(RG_DROP_REACH / t->step_u);
    t->rows = 2 * (int)ceilf(RG_DROP_REACH / t->step_v);
    if (t->rays > RG_TRACE_MAX || 2 * t->fall_rows / detail->moments + 2 > MAX_BLUR)
        return rg_error("streaks of %d moments and %d rays a column: too few or too many; at least "
                        "%.0f moments, at most %.0f rays",
                        detail->moments, detail->column, ceil(2 * t->fall_rows / (MAX_BLUR - 2)),
                        floor(RG_TRACE_MAX / (2 * (double)(RG_DROP_REACH * t->radius_x)) - 0.5));
    const double area = (double)(t->step_u * t->radius_x) * (double)(t->step_v * t->radius_y);
    t->share = area / t->moments;
    const int width = RG_ATLAS_CELL_PX >> level;
    for (int i = 0; i < t->rays; i++) {
        const float u = t->step_u * ((float)i - 0.5f * (float)(t->rays - 1));
        const int column = (int)floorf(0.5f * (float)width + u * t->radius_x);
        t->column[i] = column < 0 ? 0 : column < width ? column : width - 1;
    }
    return true;
}

static bool allocate(struct rg_streaks *streaks, int view, int level, int lobes)
{
    streaks->width = RG_ATLAS_CELL_PX >> level;
    streaks->height = rg_atlas_row_height(view, level);
    const size_t pixels = (size_t)streaks->width * (size_t)streaks->height;
    streaks->point = rg_alloc(pixels * (size_t)lobes, sizeof(float), "streaks");
    streaks->env = streaks->point ? rg_alloc(pixels, sizeof(float), "streaks") : NULL;
    return streaks->env != NULL;
}

bool rg_streaks_trace(int oscillation, int view, int level, const struct rg_streak_detail *detail,
                      const struct rg_lobes *lobes, struct rg_streaks *streaks)
{
    *streaks = (struct rg_streaks){0};
    struct tracing *t = rg_alloc(1, sizeof(*t), "streaks");
    if (t)
        t->light = rg_alloc(RG_LOBE_COUNT, sizeof(*t->light), "streaks");
    const bool ready = t && t->light && allocate(streaks, view, level, lobes->count) &&
                       prepare(t, view, level, detail);
    if (ready) {
        t->lobes = lobes;
        t->streaks = streaks;
        t->view = rg_drop_view(20 * view);
    }
    for (int k = 0; ready && k <= t->moments; k++)
        trace_moment(t, oscillation, k);
    if (!ready)
        rg_streaks_free(streaks);
    if (t)
        free(t->light);
    free(t);
    return ready;
}

static double sum_of(const float *texels, int count)
{
    double sum = 0;
    for (int i = 0; i < count; i++)
        sum += (double)texels[i];
    return sum;
}

float rg_streaks_balance(const struct rg_streaks *streaks)
{
    const int pixels = streaks->width * streaks->height;
    double lights = 0;
    for (int lobe = 0; lobe < RG_LOBE_COUNT; lobe++)
        lights +=
            rg_lobe_share_sr(lobe) * sum_of(streaks->point + (size_t)lobe * (size_t)pixels, pixels);
    return (float)(sum_of(streaks->env, pixels) / lights);
}

void rg_streaks_free(struct rg_streaks *streaks)
{
    free(streaks->point);
    free(streaks->env);
    *streaks = (struct rg_streaks){0};
}
