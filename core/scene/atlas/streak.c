#include "core/scene/atlas/streak.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/alloc.h"
#include "core/scene/atlas/trace.h"

#define PI 3.14159265358979323846

// One row of rays adds to at most so many rows of the picture: twice the fall between two moments,
// and one more at either end.
enum { MAX_BLUR = 256 };

// Everything that stays while one set of streaks is traced. Rows of the picture are counted down,
// rays and v go up.
struct tracing {
    const struct rg_lobes *lobes;
    struct rg_drop_view view;
    struct rg_streaks *streaks;
    int rays;                 // of the longest row: an even number
    float step;               // between rays and between rows of them, in radii
    float radius_x, radius_y; // of the drop, in columns and rows
    double fall_rows;         // over the exposure
    double top_row;           // of the drop's middle when the exposure begins
    double share;             // of one ray at one moment in a pixel
    int moments;
    int column[RG_TRACE_MAX]; // of each ray
    float (*light)[RG_ATLAS_CELL_PX];
    float env[RG_ATLAS_CELL_PX];
    bool lit[RG_LOBE_COUNT];
    struct rg_drop_row row;
};

struct rg_streak_detail rg_streak_detail(enum rg_atlas_size size)
{
    return size == RG_ATLAS_SMALL ? (struct rg_streak_detail){.moments = 32, .rays = 96}
                                  : (struct rg_streak_detail){.moments = 384, .rays = 160};
}

// The share of a moment's time for which a point that is at row `at` in its middle is above row y:
// the integral of a tent that reaches `fall` to both sides.
static double share_above(double y, double at, double fall)
{
    const double s = fmin(fmax((y - at) / fall, -1), 1);
    return 0.5 + s - 0.5 * s * fabs(s);
}

// What one ray saw by one way of light goes to the lights that it looked into.
static void scatter(struct tracing *t, int way, int i, int column)
{
    const float share = t->row.share[way][i];
    const float x = t->row.x[way][i], y = t->row.y[way][i], z = t->row.z[way][i];
    t->env[column] += share;
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

// The rays of one height v at one moment, in radii and rows.
static void trace_row(struct tracing *t, const struct rg_drop_shape *shape, float v, double at)
{
    const double fall = t->fall_rows / t->moments;
    memset(t->lit, 0, sizeof(t->lit));
    memset(t->env, 0, sizeof(t->env));
    const float reach = sqrtf(fmaxf(RG_DROP_REACH * RG_DROP_REACH - v * v, 0));
    const int half = (int)ceilf(reach / t->step), left = t->rays / 2 - half;
    rg_drop_trace(shape, &t->view, v, t->step * (0.5f - (float)half), t->step, 2 * half, &t->row);
    for (int way = 0; way < RG_DROP_WAYS; way++)
        for (int i = 0; i < 2 * half; i++)
            if (t->row.share[way][i] > 0)
                scatter(t, way, i, t->column[left + i]);
    float weights[MAX_BLUR];
    int first = (int)floor(at - fall), end = (int)floor(at + fall) + 1;
    first = first < 0 ? 0 : first;
    end = end < t->streaks->height ? end : t->streaks->height;
    for (int r = first; r < end; r++)
        weights[r - first] =
            (float)(t->share * (share_above(r + 1, at, fall) - share_above(r, at, fall)));
    const int pixels = t->streaks->width * t->streaks->height;
    for (int l = 0; l < t->lobes->count; l++)
        if (t->lit[l])
            add_row(t, t->light[l], weights, first, end - first, t->streaks->point + l * pixels);
    add_row(t, t->env, weights, first, end - first, t->streaks->env);
}

static bool prepare(struct tracing *t, int view, int level, const struct rg_streak_detail *detail)
{
    const int height = rg_atlas_row_height(view, level);
    const double shrink = (double)height / rg_atlas_row_height(view, 0);
    t->radius_x = 0.5f * RG_ATLAS_DROP_PX / (float)(1 << level);
    t->radius_y = (float)(0.5 * (double)RG_ATLAS_DROP_PX * shrink);
    t->fall_rows = RG_DROP_FALL * 2 * (double)t->radius_y * cos(view * 20 * PI / 180);
    t->top_row = 0.5 * (height - t->fall_rows);
    t->moments = detail->moments;
    t->step = 2.0f / (float)detail->rays;
    t->rays = 2 * (int)ceilf(RG_DROP_REACH / t->step);
    if (t->rays > RG_TRACE_MAX || 2 * t->fall_rows / detail->moments + 2 > MAX_BLUR)
        return rg_error(
            "streaks of %d moments and %d rays: at least %.0f and at most %d are traced",
            detail->moments, detail->rays, 2 * t->fall_rows / (MAX_BLUR - 2),
            (int)(RG_TRACE_MAX / (double)RG_DROP_REACH));
    const double area =
        (double)t->step * (double)t->step * (double)t->radius_x * (double)t->radius_y;
    t->share = area / t->moments;
    const int width = RG_ATLAS_CELL_PX >> level;
    for (int i = 0; i < t->rays; i++) {
        const float u = t->step * ((float)i - 0.5f * (float)(t->rays - 1));
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
    for (int k = 0; ready && k < t->moments; k++) {
        const double passed = (k + 0.5) / t->moments;
        const struct rg_drop_shape shape = rg_drop_shape(oscillation, passed * RG_EXPOSURE_S);
        for (int j = 0; j < t->rays; j++) {
            const float v = t->step * ((float)j - 0.5f * (float)(t->rays - 1));
            trace_row(t, &shape, v,
                      t->top_row + t->fall_rows * passed - (double)v * (double)t->radius_y);
        }
    }
    if (!ready)
        rg_streaks_free(streaks);
    if (t)
        free(t->light);
    free(t);
    return ready;
}

void rg_streaks_free(struct rg_streaks *streaks)
{
    free(streaks->point);
    free(streaks->env);
    *streaks = (struct rg_streaks){0};
}
