// The overlay of streaks: lines DEVICE. Lines against each pixel's distance from them, in double
// precision; sheets against the sides of a polygon.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/techniques/scenery/lights/lights.h"
#include "tests/core/techniques/scenery/overlay/rig.h"
#include "tests/tools/expect.h"

// A line's end on the grid of 1/256 pixel, and floats off by 1e-6 of a few hundred pixels.
static const double allowed = 0.006;

// Texels of an overlay drawn with a matrix, over a depth; the caller frees them.
static float *show(struct scenery_overlay *overlay, struct rg_device *device,
                   const float to_clip[16], const float *depth)
{
    struct picture p = picture_make(device, RG_RGBA32F, depth ? *depth : 1);
    assert_true(scenery_overlay_draw(overlay, to_clip, p.colour, depth ? p.depth : NULL));
    float *texels = picture_read(&p);
    picture_free(&p);
    return texels;
}

// --- lines ---

struct corner {
    double x, y, z, w;
};

static struct corner project(const float m[16], const float at[3])
{
    double v[4];
    for (int i = 0; i < 4; i++) {
        v[i] = (double)m[4 * i + 3];
        for (int c = 0; c < 3; c++)
            v[i] += (double)m[4 * i + c] * (double)at[c];
    }
    return (struct corner){v[0], v[1], v[2], v[3]};
}

static struct corner between_corners(struct corner a, struct corner b, double t)
{
    return (struct corner){a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t, a.z + (b.z - a.z) * t,
                           a.w + (b.w - a.w) * t};
}

// A line's ends in pixels with their depth, clipped at the near plane alone. False: nothing is
// left.
struct ends {
    double x[2], y[2], depth[2];
};

static bool find_ends(const float to_clip[16], const float a[3], const float b[3],
                      struct ends *ends)
{
    struct corner c[2] = {project(to_clip, a), project(to_clip, b)};
    if (c[0].z < 0 && c[1].z < 0)
        return false;
    for (int k = 0; k < 2; k++)
        if (c[k].z < 0)
            c[k] = between_corners(c[k], c[!k], c[k].z / (c[k].z - c[!k].z));
    for (int k = 0; k < 2; k++) {
        ends->x[k] = (c[k].x / c[k].w + 1) / 2 * WIDTH;
        ends->y[k] = (c[k].y / c[k].w + 1) / 2 * HEIGHT;
        ends->depth[k] = c[k].z / c[k].w;
    }
    return true;
}

static double ramp(double v)
{
    return fmin(fmax(v, 0), 1);
}

// How much of a pixel a line covers, and the line's depth there.
static double covered_by(const struct ends *e, double width, double x, double y, double *depth)
{
    const double dx = e->x[1] - e->x[0], dy = e->y[1] - e->y[0], length = hypot(dx, dy);
    const double ux = length > 0 ? dx / length : 1, uy = length > 0 ? dy / length : 0;
    const double s = (x - e->x[0]) * ux + (y - e->y[0]) * uy;
    const double off = fabs((y - e->y[0]) * ux - (x - e->x[0]) * uy);
    *depth = e->depth[0] + (e->depth[1] - e->depth[0]) * (length > 0 ? ramp(s / length) : 0);
    return ramp((width + 1) / 2 - off) * ramp((width + 1) / 2 - fmax(-s, s - length));
}

struct counts {
    int full, part, hidden;
};

static void check_line(struct rg_device *device, struct scenery_overlay *overlay,
                       const float to_clip[16], const float a[3], const float b[3], float width_px,
                       struct counts *counts)
{
    const struct scenery_ink ink = {0.5f, 0.25f, 1, 0.5f, width_px};
    const float behind = 0.96f;
    struct ends ends;
    scenery_overlay_begin(overlay);
    scenery_overlay_line(overlay, a, b, &ink);
    float *texels = show(overlay, device, to_clip, NULL),
          *tested = show(overlay, device, to_clip, &behind);
    const bool seen = find_ends(to_clip, a, b, &ends);
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        double depth = 0;
        const double due =
            seen ? covered_by(&ends, (double)width_px, i % WIDTH + 0.5, i / WIDTH + 0.5, &depth)
                 : 0;
        assert_at_most(fabs((double)texels[4 * i] - 0.25 * due), allowed);
        assert_at_most(fabs((double)texels[4 * i + 1] - 0.125 * due), allowed);
        assert_at_most(fabs((double)texels[4 * i + 3] - 0.5 * due), allowed);
        counts->full += due == 1;
        counts->part += due > 0 && due < 1;
        if (fabs(depth - (double)behind) < 1e-4)
            continue;
        counts->hidden += due > 0 && depth > (double)behind;
        assert_equals(tested[4 * i + 3], (depth < (double)behind ? texels[4 * i + 3] : 0));
    }
    free(texels);
    free(tested);
}

static void lines_cover_what_is_near_them(void **state)
{
    struct rg_instance instance;
    struct scenery_overlay *overlay = open_overlay(*state, &instance);
    struct counts counts = {0};
    float to_clip[16];
    overlay_look(to_clip);
    for (uint32_t i = 0; i < 120; i++) {
        const double spread = i % 3 ? 4 : 12; // every third line may pass the eye
        float a[3], b[3];
        for (uint32_t c = 0; c < 3; c++) {
            a[c] = between(i, c, -spread, spread);
            b[c] = between(i, 3 + c, -spread, spread);
        }
        if (i % 8 == 0) { // one end is between the eye and the near plane
            a[0] = between(i, 7, -0.2, 0.2);
            a[1] = 2 + between(i, 8, -0.2, 0.1);
            a[2] = 6 - between(i, 9, 0.2, 0.4);
        }
        check_line(*state, overlay, to_clip, a, b, between(i, 6, 1, 9), &counts);
    }
    print_message("lines: %d pixels whole, %d in part, %d behind the depth\n", counts.full,
                  counts.part, counts.hidden);
    assert_above(counts.full, 10000);
    assert_above(counts.part, 10000);
    assert_above(counts.hidden, 1000);
    close_overlay(overlay, &instance);
}

// A long line past the eye ends millions of pixels beside the picture, and is still drawn in its
// place.
static void long_lines_stay_in_place(void **state)
{
    struct rg_instance instance;
    struct scenery_overlay *overlay = open_overlay(*state, &instance);
    struct counts counts = {0};
    float to_clip[16];
    overlay_look_from(0.005f, to_clip);
    for (uint32_t i = 0; i < 40; i++) {
        const float side = i % 2 ? 1 : -1,
                    a[3] = {300 * side, 2 + between(i, 0, -0.1, 0.1), 6 - between(i, 1, 0.01, 0.1)},
                    b[3] = {between(i, 2, -4, 4), between(i, 3, -3, 3), between(i, 4, -20, 0)};
        check_line(*state, overlay, to_clip, a, b, 3, &counts);
    }
    assert_above(counts.full, 1000);
    close_overlay(overlay, &instance);
}

// Lines along rows of pixels, where every pixel is known; a point, and unseen lines.
static void plain_lines_are_exact(void **state)
{
    static const float flat[16] = {2.0f / WIDTH, 0, 0, -1, 0, 2.0f / HEIGHT, 0, -1, 0, 0, 0,
                                   0.5f,         0, 0, 0,  1}; // pixels
    static const struct {
        float a[3], b[3];
        int x0, x1, y0, y1; // covered pixels
        float width_px;
    } cases[] = {
        {{10.5f, 20.5f, 0}, {30.5f, 20.5f, 0}, 10, 31, 20, 21, 1},
        {{30.5f, 20.5f, 0}, {10.5f, 20.5f, 0}, 10, 31, 20, 21, 1},
        {{40.5f, 10.5f, 0}, {40.5f, 60.5f, 0}, 39, 42, 9, 62, 3},
        {{50, 50, 0}, {50, 50, 0}, 48, 52, 48, 52, 4},
        {{-1e6f, 8, 0}, {1e6f, 8, 0}, 0, WIDTH, 7, 9, 2},
        {{-50, 8, 0}, {-20, 8, 0}, 0, 0, 0, 0, 2},
        {{20, 2000, 0}, {90, 3000, 0}, 0, 0, 0, 0, 2},
    };
    struct rg_instance instance;
    struct scenery_overlay *overlay = open_overlay(*state, &instance);
    for (size_t k = 0; k < sizeof(cases) / sizeof(cases[0]); k++) {
        const struct scenery_ink ink = {1, 1, 1, 1, cases[k].width_px};
        scenery_overlay_begin(overlay);
        scenery_overlay_line(overlay, cases[k].a, cases[k].b, &ink);
        float *texels = show(overlay, *state, flat, NULL);
        for (int i = 0; i < WIDTH * HEIGHT; i++) {
            const int x = i % WIDTH, y = i / WIDTH;
            const float due =
                x >= cases[k].x0 && x < cases[k].x1 && y >= cases[k].y0 && y < cases[k].y1;
            if (fabsf(texels[4 * i + 3] - due) > 1e-3f)
                fail_msg("line %zu: pixel %d, %d is %g, not %g", k, x, y, (double)texels[4 * i + 3],
                         (double)due);
        }
        free(texels);
    }
    close_overlay(overlay, &instance);
}

// --- sheets ---

// How far inside a convex polygon a point is, in pixels; negative outside.
static double inside_by(const struct corner px[4], double x, double y)
{
    double least = INFINITY, turn = 0;
    for (int k = 0; k < 4; k++) {
        const struct corner *a = &px[k], *b = &px[(k + 1) % 4];
        turn += a->x * b->y - a->y * b->x;
    }
    for (int k = 0; k < 4; k++) {
        const struct corner *a = &px[k], *b = &px[(k + 1) % 4];
        const double cross = (b->x - a->x) * (y - a->y) - (b->y - a->y) * (x - a->x);
        least = fmin(least, (turn > 0 ? cross : -cross) / hypot(b->x - a->x, b->y - a->y));
    }
    return least;
}

static void sheets_fill_their_polygons(void **state)
{
    static float corners[4][3] = {{-4, 0, 0}, {0, 0, 3}, {4, 0, 0}, {0, 0, -7}};
    const struct scenery_ink ink = {0, 1, 0, 0.5f, 1};
    const float half_way = 0.945f; // among the depths beyond the first three corners
    float to_clip[16];
    overlay_look(to_clip);
    struct corner px[4];
    for (int k = 0; k < 4; k++) {
        const struct corner c = project(to_clip, corners[k]);
        px[k] = (struct corner){(c.x / c.w + 1) / 2 * WIDTH, (c.y / c.w + 1) / 2 * HEIGHT, 0, 1};
    }
    struct rg_instance instance;
    struct scenery_overlay *overlay = open_overlay(*state, &instance);
    scenery_overlay_begin(overlay);
    scenery_overlay_sheet(overlay, corners, &ink, 0.25f);
    float *texels = show(overlay, *state, to_clip, NULL),
          *tested = show(overlay, *state, to_clip, &half_way);
    int filled = 0, hidden = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        const double x = i % WIDTH + 0.5, y = i / WIDTH + 0.5, margin = inside_by(px, x, y);
        if (fabs(margin) < 2.5)
            continue; // the edges are lines
        assert_float_equal(texels[4 * i + 3], margin > 0 ? 0.125f : 0, 1e-6f);
        assert_float_equal(texels[4 * i + 1], margin > 0 ? 0.125f : 0, 1e-6f);
        if (margin < 0)
            continue;
        // The pixel's ray meets the floor at this distance ahead of the eye.
        const double down = (2 * y / HEIGHT - 1) * tan(M_PI / 6);
        const double slope = 2.0 / 6, ahead = 2 * sqrt(1 + slope * slope) / (slope + down);
        const double depth = 50 / 49.5 * (1 - 0.5 / ahead);
        filled++;
        if (fabs(depth - (double)half_way) < 1e-4)
            continue;
        hidden += depth > (double)half_way;
        assert_float_equal(tested[4 * i + 3], depth < (double)half_way ? 0.125f : 0, 1e-6f);
    }
    print_message("sheet: %d pixels, %d behind the depth\n", filled, hidden);
    assert_above(filled, 1000);
    assert_above(hidden, filled / 20);
    assert_below(hidden, filled * 9 / 10);
    free(texels);
    free(tested);
    close_overlay(overlay, &instance);
}

// --- boxes and frusta ---

static double difference(const float *a, const float *b)
{
    double most = 0;
    for (int i = 0; i < WIDTH * HEIGHT * 4; i++) {
        const double off = fabs((double)a[i] - (double)b[i]);
        most = off > most ? off : most; // gcc 12 fails to compile fmax for arm64, in vectors
    }
    return most;
}

static double sum_of(const float *texels)
{
    double sum = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        sum += (double)texels[4 * i + 3];
    return sum;
}

// A light's frustum is the box or the truncated pyramid of its settings.
static void check_frustum(struct rg_device *device, const scenery_light *light, float corners[8][3])
{
    struct rg_instance instance;
    struct scenery_overlay *overlay = open_overlay(device, &instance);
    const struct scenery_ink ink = {1, 1, 1, 1, 2};
    float to_clip[16];
    overlay_look(to_clip);
    scenery_overlay_begin(overlay);
    scenery_overlay_light(overlay, light, &ink);
    float *shown = show(overlay, device, to_clip, NULL);
    scenery_overlay_begin(overlay);
    static const int edges[12][2] = {{0, 1}, {1, 3}, {3, 2}, {2, 0}, {4, 5}, {5, 7},
                                     {7, 6}, {6, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
    for (int e = 0; e < 12; e++)
        scenery_overlay_line(overlay, corners[edges[e][0]], corners[edges[e][1]], &ink);
    float *due = show(overlay, device, to_clip, NULL);
    assert_above(sum_of(due), 100);
    assert_below(difference(shown, due), 0.02);
    free(shown);
    free(due);
    close_overlay(overlay, &instance);
}

static void frusta_are_where_lights_shine(void **state)
{
    static const float low[3] = {-1, 0, -2}, high[3] = {2, 2, 1};
    float box[8][3], stump[8][3];
    const double texel_x = 3.0 / 510, texel_z = 3.0 / 510;
    for (int k = 0; k < 8; k++) {
        box[k][0] = (float)(k & 1 ? 2 + texel_x : -1 - texel_x);
        box[k][1] = k & 4 ? -1.0f : 3.0f; // a metre above and below
        box[k][2] = (float)(k & 2 ? 1 + texel_z : -2 - texel_z);
        const double away = k & 4 ? 10 : 0.5, beside = 1.01 * tan(M_PI / 12) * away;
        stump[k][0] = (float)(k & 1 ? beside : -beside);
        stump[k][1] = (float)(4 - away);
        stump[k][2] = (float)(k & 2 ? beside : -beside);
    }
    const struct rg_light sun = {.kind = SCENERY_SUN, .direction = {0, -1, 0}, .outer_deg = 45},
                          spot = {.kind = SCENERY_SPOT,
                                  .position_m = {0, 4, 0},
                                  .direction = {0, -1, 0},
                                  .inner_deg = 10,
                                  .outer_deg = 15,
                                  .near_m = 0.5f};
    const float far_low[3] = {-40, -40, -40}, far_high[3] = {40, 40, 40};
    const scenery_light a = scenery_light_of(&sun, low, high, 512, -1),
                        b = scenery_light_of(&spot, far_low, far_high, 512, -1);
    check_frustum(*state, &a, box);
    check_frustum(*state, &b, stump);
}

// Draws each edge once: a box has as much ink as its twelve edges, all in view and apart.
static void boxes_have_twelve_edges(void **state)
{
    static const float flat[16] = {0.5f, 0.11f, 0, 0, 0, 0.5f, 0.17f, 0, 0, 0, 0, 0.5f, 0, 0, 0, 1};
    struct rg_instance instance;
    struct scenery_overlay *overlay = open_overlay(*state, &instance);
    const struct scenery_ink ink = {1, 1, 1, 0.001f, 1}; // so faint that inks add up
    float corners[8][3];
    double due = 0;
    for (int k = 0; k < 8; k++)
        for (int c = 0; c < 3; c++)
            corners[k][c] = k >> c & 1 ? 1 : -1;
    static const float ways[3][2] = {
        {0.5f * WIDTH, 0}, {0.11f * WIDTH, 0.5f * HEIGHT}, {0, 0.17f * HEIGHT}};
    for (int c = 0; c < 3; c++)
        due += 4 * (hypot((double)ways[c][0], (double)ways[c][1]) + 1);
    scenery_overlay_begin(overlay);
    scenery_overlay_box(overlay, corners, &ink);
    float *texels = show(overlay, *state, flat, NULL);
    assert_below(fabs(sum_of(texels) / 0.001 / due - 1), 0.02);
    free(texels);
    close_overlay(overlay, &instance);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lines_cover_what_is_near_them),
        cmocka_unit_test(long_lines_stay_in_place),
        cmocka_unit_test(plain_lines_are_exact),
        cmocka_unit_test(sheets_fill_their_polygons),
        cmocka_unit_test(frusta_are_where_lights_shine),
        cmocka_unit_test(boxes_have_twelve_edges),
    };
    return raster_tests_run(argc, argv, tests, sizeof(tests) / sizeof(tests[0]));
}
