#include "tests/core/device/draws/quads.h"

#include <math.h>

#include "kernels/dialect/rng.h"

struct random {
    uint32_t seed, item, step;
};

static float uniform(struct random *r)
{
    return rg_uniform(rg_random(r->seed, r->item, r->step++, 7).x);
}

static float between(struct random *r, float low, float high)
{
    return low + (high - low) * uniform(r);
}

// A rectangle about (x, y), in pixels, turned by `angle`.
static void rectangle(float px[8], float x, float y, float length, float width, float angle)
{
    const float ux = cosf(angle) * length / 2, uy = sinf(angle) * length / 2;
    const float vx = -sinf(angle) * width / 2, vy = cosf(angle) * width / 2;
    const float corners[8] = {x - ux - vx, y - uy - vy, x + ux - vx, y + uy - vy,
                              x + ux + vx, y + uy + vy, x - ux + vx, y - uy + vy};
    for (int i = 0; i < 8; i++)
        px[i] = corners[i];
}

static float angle(struct random *r)
{
    return between(r, 0, 6.2831853f);
}

static void corners_px(struct random *r, enum quad_kind kind, float w, float h, float px[8])
{
    const float x = between(r, 0, w), y = between(r, 0, h);
    switch (kind) {
    case QUAD_ON_CENTRES:
        rectangle(px, floorf(x) + 0.5f, floorf(y) + 0.5f, 2 * floorf(between(r, 0, 9)),
                  2 * floorf(between(r, 0, 3)), 0);
        break;
    case QUAD_LARGE:
        rectangle(px, x, y, between(r, 20, 400), between(r, 1, 60), angle(r));
        break;
    case QUAD_CROSSING:
        rectangle(px, uniform(r) < 0.5f ? floorf(between(r, 0, 2)) * w : x,
                  uniform(r) < 0.5f ? floorf(between(r, 0, 2)) * h : y, between(r, 1, 30),
                  between(r, 0.2f, 6), angle(r));
        break;
    case QUAD_DEGENERATE:
        rectangle(px, x, y, uniform(r) < 0.3f ? 0 : between(r, 0, 20), 0, angle(r));
        if (uniform(r) < 0.5f) { // folded over its diagonal
            px[4] = px[0];
            px[5] = px[1] + between(r, -3, 3);
        }
        break;
    case QUAD_OFF:
        rectangle(px, x + w * (uniform(r) < 0.5f ? -1.5f : 1.5f), y, between(r, 1, 40), 2,
                  angle(r));
        break;
    case QUAD_HUGE:
        rectangle(px, x, y, powf(10, between(r, 3, 8)), between(r, 0.2f, 3), angle(r));
        break;
    default:
        rectangle(px, x, y, between(r, 0.2f, 40), between(r, 0.2f, 2), angle(r));
    }
}

static void fill(float *quad, struct random *r, enum quad_kind kind, float w, float h)
{
    float px[8];
    corners_px(r, kind, w, h, px);
    const float depth = uniform(r);
    for (int k = 0; k < 4; k++) {
        const float near_w = kind == QUAD_BEHIND && uniform(r) < 0.3f   ? between(r, -2, 0.3f)
                             : kind == QUAD_BEHIND || uniform(r) < 0.5f ? between(r, 0.5f, 4)
                                                                        : 1;
        float *corner = quad + 4 * k;
        corner[0] = (2 * px[2 * k] / w - 1) * near_w;
        corner[1] = (2 * px[2 * k + 1] / h - 1) * near_w;
        corner[2] = kind == QUAD_BEHIND ? near_w - 0.1f : depth * near_w;
        corner[3] = near_w;
    }
    if (kind == QUAD_NO_NUMBER)
        quad[(int)between(r, 0, 15.99f)] = uniform(r) < 0.5f ? NAN : INFINITY;
    const float alpha = uniform(r);
    for (int c = 0; c < 3; c++)
        quad[16 + c] = uniform(r) * alpha;
    quad[19] = alpha;
}

void quads_fill(float *quads, int count, int width, int height, enum quad_kind only, uint32_t seed)
{
    for (int i = 0; i < count; i++) {
        struct random r = {seed, (uint32_t)i, 0};
        enum quad_kind kind = only;
        if (only == QUAD_KINDS) {
            kind = (enum quad_kind)((uint32_t)i % QUAD_KINDS);
            // Keep large kinds rare, since they cover much.
            if ((kind == QUAD_LARGE || kind == QUAD_HUGE || kind == QUAD_BEHIND) && i % 8)
                kind = QUAD_STREAK;
        }
        fill(quads + (int64_t)i * TEST_QUAD_WORDS, &r, kind, (float)width, (float)height);
    }
}
