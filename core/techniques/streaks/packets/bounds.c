// Groups nearby particles into blocks, and finds the blocks that a view can see.
//
// Neighbours on the Morton curve are neighbours on the top plane, but at different heights. So
// every 1024 of them are sorted by start: a block of 32 is then a small falling box, and most
// blocks of a packet that is partly out of view are culled.
#include <math.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/scene/vector.h"
#include "core/techniques/streaks/packets/inner.h"

enum { GROUP = 1024, KEYS = 1024 }; // particles, and steps of the sorting key

// Bounds of rounding in particles' places, on the device and here, in metres and in turns.
static const double slack_m = 0.01;
static const float slack_turns = 1e-5f;

static float start_of(const float *particle)
{
    return particle[2] - floorf(particle[2]);
}

// A stable counting sort by the leading bits of the start.
static void sort_group(float *particles, int count)
{
    float sorted[GROUP * 3];
    int next[KEYS + 1] = {0};
    for (int i = 0; i < count; i++)
        next[(int)(start_of(particles + 3 * i) * KEYS) + 1]++;
    for (int key = 0; key < KEYS; key++)
        next[key + 1] += next[key];
    for (int i = 0; i < count; i++) {
        const int at = next[(int)(start_of(particles + 3 * i) * KEYS)]++;
        memcpy(sorted + 3 * at, particles + 3 * i, STREAKS_PARTICLE_BYTES);
    }
    memcpy(particles, sorted, (size_t)count * STREAKS_PARTICLE_BYTES);
}

static void widen(struct streaks_bounds bounds, int64_t block, int axis, float value)
{
    float *low = &bounds.low[axis][block], *high = &bounds.high[axis][block];
    *low = fminf(*low, value);
    *high = fmaxf(*high, value);
}

static void bound_block(struct streaks_bounds bounds, int64_t block, const float *particles,
                        int count)
{
    for (int axis = 0; axis < 3; axis++) {
        bounds.low[axis][block] = INFINITY;
        bounds.high[axis][block] = -INFINITY;
    }
    for (int i = 0; i < count; i++) {
        widen(bounds, block, 0, particles[3 * i]);
        widen(bounds, block, 1, particles[3 * i + 1]);
        widen(bounds, block, 2, start_of(particles + 3 * i));
    }
}

static void pack_packet(struct streaks_packets *p, const struct streaks_packet *packet)
{
    float *const particles = p->particles + 3 * packet->first;
#pragma omp parallel for schedule(static)
    for (int32_t first = 0; first < packet->count; first += GROUP) {
        const int32_t left = packet->count - first;
        const int count = left < GROUP ? left : GROUP;
        sort_group(particles + 3 * (int64_t)first, count);
        for (int k = 0; k < count; k += STREAKS_BLOCK)
            bound_block(p->bounds, (packet->first + first + k) / STREAKS_BLOCK,
                        particles + 3 * (int64_t)(first + k),
                        count - k < STREAKS_BLOCK ? count - k : STREAKS_BLOCK);
    }
}

bool streaks_bounds_make(struct streaks_packets *p)
{
    const int64_t blocks = p->slots / STREAKS_BLOCK;
    p->bounds.memory = rg_alloc((size_t)blocks, STREAKS_BOUNDS_BYTES, "rain: bounds of blocks");
    if (!p->bounds.memory)
        return false;
    for (int axis = 0; axis < 3; axis++) {
        p->bounds.low[axis] = p->bounds.memory + 2 * axis * blocks;
        p->bounds.high[axis] = p->bounds.memory + (2 * axis + 1) * blocks;
    }
    for (int64_t i = 0; i < p->info.packets && p->info.scheme != STREAKS_GRID; i++)
        pack_packet(p, &p->packets[i]);
    for (int level = 1; level < STREAKS_LEVELS && p->info.scheme == STREAKS_GRID; level++)
        pack_packet(p, &p->grid.buckets[level]);
    p->info.host_bytes += blocks * STREAKS_BOUNDS_BYTES;
    return true;
}

// --- the view ---

// The plane through three corners of the frustum; the frustum is on its positive side.
static void plane_through(const double a[3], const double b[3], const double c[3],
                          const double inside[3], float plane[4])
{
    double ab[3], ac[3], out[3], to_inside[3];
    for (int i = 0; i < 3; i++) {
        ab[i] = b[i] - a[i];
        ac[i] = c[i] - a[i];
        to_inside[i] = inside[i] - a[i];
    }
    rg_cross(ab, ac, out);
    rg_to_unit(out);
    const double sign = rg_dot(out, to_inside) < 0 ? -1 : 1;
    for (int i = 0; i < 3; i++)
        plane[i] = (float)(sign * out[i]);
    plane[3] = (float)(slack_m - sign * rg_dot(out, a));
}

void streaks_sight_of(const struct streaks_packets *p, const struct streaks_view *view,
                      struct streaks_sight *sight)
{
    // Three corners of each side, two near and one far (rg_rain_view_corners).
    static const int sides[4][3] = {{0, 4, 6}, {1, 5, 7}, {0, 4, 5}, {2, 6, 7}};
    double middle[3] = {0};
    for (int i = 0; i < 24; i++)
        middle[i % 3] += view->corners[i / 3][i % 3] / 8;
    for (int side = 0; side < 4; side++)
        plane_through(view->corners[sides[side][0]], view->corners[sides[side][1]],
                      view->corners[sides[side][2]], middle, sight->planes[side]);
    sight->half_x = (float)p->half_x_m;
    sight->half_y = (float)p->half_y_m;
    sight->across = (float)view->across_m;
    sight->above = (float)view->above_m;
    sight->below = (float)view->below_m;
    sight->top = (float)view->top_m;
    sight->height = (float)p->settings.local_height_m;
    sight->apart = view->apart;
}

// The distance by which a box's best corner is inside a plane.
static inline float inside(const float plane[4], const float middle[3], const float half[3])
{
    return plane[0] * middle[0] + plane[1] * middle[1] + plane[2] * middle[2] + plane[3] +
           fabsf(plane[0]) * half[0] + fabsf(plane[1]) * half[1] + fabsf(plane[2]) * half[2];
}

// A block counts as high as the local space in three cases: its particles fall at different speeds,
// are re-entering at the local top, or have just re-entered, when they may still be splashes at the
// local ground.
static inline bool is_seen(const struct streaks_sight *s, const float low[3], const float high[3],
                           float turn)
{
    const float turned = low[2] + turn, from = turned - floorf(turned);
    const float to = from + (high[2] - low[2]);
    const bool whole =
        s->apart || from < slack_turns || to > 1 - slack_turns || from * s->height < s->above;
    const float first = s->top + (whole ? 0 : from * s->height) - s->above;
    const float last = s->top + (whole ? s->height : to * s->height) + s->below;
    const float middle[3] = {(low[0] + high[0]) / 2 * s->half_x, (low[1] + high[1]) / 2 * s->half_y,
                             (first + last) / 2};
    const float half[3] = {(high[0] - low[0]) / 2 * s->half_x + s->across,
                           (high[1] - low[1]) / 2 * s->half_y + s->across, (last - first) / 2};
    return inside(s->planes[0], middle, half) > 0 && inside(s->planes[1], middle, half) > 0 &&
           inside(s->planes[2], middle, half) > 0 && inside(s->planes[3], middle, half) > 0;
}

int64_t streaks_bounds_seen(const struct streaks_packets *p, const struct streaks_sight *sight,
                            const struct streaks_run *run, uint8_t *seen)
{
    const struct streaks_bounds b = p->bounds;
    const int64_t first = run->slot / STREAKS_BLOCK, count = streaks_blocks_in(run);
    int64_t total = 0;
#pragma omp simd reduction(+ : total)
    for (int64_t i = 0; i < count; i++) {
        const int64_t block = first + i;
        const float low[3] = {b.low[0][block] + run->shift_x, b.low[1][block] + run->shift_y,
                              b.low[2][block]};
        const float high[3] = {b.high[0][block] + run->shift_x, b.high[1][block] + run->shift_y,
                               b.high[2][block]};
        seen[i] = is_seen(sight, low, high, run->turn) ? 1 : 0;
        total += seen[i];
    }
    return total;
}
