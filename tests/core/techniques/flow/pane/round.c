// Panes at the defaults after a minute and two: how round drops at rest are, by two readings of
// their outlines (`round drops`), and how wet panes are (`round wet`). On cpu. Without an argument
// only the readings are tried, on perfect caps.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/scene/mesh/hull.h"
#include "core/techniques/flow/inputs/sliding.h"
#include "core/techniques/flow/instance.h"
#include "core/techniques/flow/survey/convex.h"
#include "tests/core/techniques/flow/rig.h"
#include "tests/tools/expect.h"
#include "tests/tools/instance.h"

static const double PI = 3.14159265358979323846;

enum { N = 512, POINTS = 1 << 16 };

// Heights, and the drop that each texel is of; 0: of none.
static double mm[N][N];
static int drop_of[N][N];
static double points[POINTS][2], hull[2 * POINTS][2];
static int point_count;

static double area_of(double (*corners)[2], int count)
{
    double sum = 0;
    for (int i = 0; i < count; i++) {
        const double *a = corners[i], *b = corners[(i + 1) % count];
        sum += a[0] * b[1] - a[1] * b[0];
    }
    return fabs(sum) / 2;
}

static void add_point(double x, double y)
{
    assert_below(point_count, POINTS);
    points[point_count][0] = x;
    points[point_count++][1] = y;
}

// --- the outline between texels ---

// Of other drops there is no water.
static double height(int drop, double wet_mm, int x, int y)
{
    const bool is_on = x >= 0 && y >= 0 && x < N && y < N;
    return is_on && (drop_of[y][x] == drop || mm[y][x] < wet_mm) ? mm[y][x] : 0;
}

// The part above wet_mm of a square between four texels' middles. The outline's points are kept.
static double area_in_square(int drop, double wet_mm, int x, int y)
{
    static const int dx[] = {0, 1, 1, 0, 0}, dy[] = {0, 0, 1, 1, 0};
    double part[8][2];
    int count = 0;
    for (int i = 0; i < 4; i++) {
        const double a = height(drop, wet_mm, x + dx[i], y + dy[i]);
        const double b = height(drop, wet_mm, x + dx[i + 1], y + dy[i + 1]);
        if (a >= wet_mm) {
            part[count][0] = x + dx[i];
            part[count++][1] = y + dy[i];
        }
        if ((a >= wet_mm) == (b >= wet_mm))
            continue;
        const double along = (wet_mm - a) / (b - a);
        part[count][0] = x + dx[i] + along * (dx[i + 1] - dx[i]);
        part[count][1] = y + dy[i] + along * (dy[i + 1] - dy[i]);
        add_point(part[count][0], part[count][1]);
        count++;
    }
    return area_of(part, count);
}

struct box {
    int x0, y0, x1, y1; // to before the last
};

// The share of its convex hull that the outline at wet_mm, interpolated between texels, encloses.
static double outline_share(int drop, double wet_mm, struct box box)
{
    double sum = 0;
    point_count = 0;
    for (int y = box.y0 - 1; y < box.y1; y++)
        for (int x = box.x0 - 1; x < box.x1; x++)
            sum += area_in_square(drop, wet_mm, x, y);
    return sum / area_of(hull, rg_hull(points, point_count, hull));
}

// Texels over the area of the convex hull of their corners.
static double corner_share(const int *texels, int count)
{
    point_count = 0;
    for (int i = 0; i < 4 * count; i++)
        add_point(texels[i / 4] % N + i % 2, (int)(texels[i / 4] / N) + i / 2 % 2);
    return count / area_of(hull, rg_hull(points, point_count, hull));
}

// --- drops ---

static int texels[N * N];

// Lists the texels of the drop around one, in reading order of its rows, and marks them.
static int take_drop(int drop, double wet_mm, int x, int y, struct box *box)
{
    static const int dx[] = {1, -1, 0, 0}, dy[] = {0, 0, 1, -1};
    int count = 1;
    *box = (struct box){x, y, x + 1, y + 1};
    texels[0] = y * N + x;
    drop_of[y][x] = drop;
    for (int i = 0; i < count; i++)
        for (int side = 0; side < 4; side++) {
            const int to_x = texels[i] % N + dx[side], to_y = texels[i] / N + dy[side];
            if (to_x < 0 || to_y < 0 || to_x >= N || to_y >= N || drop_of[to_y][to_x] ||
                mm[to_y][to_x] < wet_mm)
                continue;
            drop_of[to_y][to_x] = drop;
            texels[count++] = to_y * N + to_x;
            *box = (struct box){box->x0 < to_x ? box->x0 : to_x, box->y0 < to_y ? box->y0 : to_y,
                                box->x1 > to_x ? box->x1 : to_x + 1,
                                box->y1 > to_y ? box->y1 : to_y + 1};
        }
    return count;
}

static double diameter_mm(int count, double texel_mm)
{
    return 2 * texel_mm * sqrt(count / PI);
}

// --- perfect caps ---

// Caps of 50 degrees, 2 to 8 mm wide, anywhere between texels: by the outline and by texels'
// middles all are convex. By corners few below 4 mm are, since the hull of a disc of few texels is
// too large: that reading tells nothing of such drops.
static void test_readings_of_caps(void **state)
{
    (void)state;
    static double room[FLOW_CONVEX_ROOM * N][2];
    const double texel_mm = 150.0 / N, wet_mm = 0.1;
    int small = 0, by_corners = 0;
    for (int i = 0; i < 600; i++) {
        const double radius_mm = 1.1 + 2.9 * i / 600, x_mm = 10 + 0.618 * i, y_mm = 20 + 0.414 * i;
        const double middle_x = 40 + x_mm - floor(x_mm), middle_y = 40 + y_mm - floor(y_mm);
        const double sphere_mm = radius_mm / sin(50 * PI / 180);
        const double depth_mm = sphere_mm * cos(50 * PI / 180);
        struct box box;
        memset(drop_of, 0, sizeof(drop_of));
        for (int y = 0; y < 80; y++)
            for (int x = 0; x < 80; x++) {
                const double off_mm = hypot(x - middle_x, y - middle_y) * texel_mm;
                mm[y][x] = off_mm < radius_mm
                               ? sqrt(sphere_mm * sphere_mm - off_mm * off_mm) - depth_mm
                               : 0;
            }
        const int count = take_drop(1, wet_mm, 40, 40, &box);
        assert_above(outline_share(1, wet_mm, box), 0.97);
        assert_above(flow_convexity(texels, count, N, room), 0.999);
        small += diameter_mm(count, texel_mm) < 4;
        by_corners += diameter_mm(count, texel_mm) < 4 && corner_share(texels, count) > 0.95;
    }
    print_message("by corners %d of %d caps below 4 mm are convex\n", by_corners, small);
    assert_above(small, 100);
    assert_below(by_corners, small / 20);
    memset(mm, 0, sizeof(mm));
}

// --- after minutes ---

struct sums {
    int resting, by_outline;
    double by_middles; // as the survey tells
};

static bool rests(const uint32_t *pace, int cells, int count)
{
    const int k = (N + cells - 1) / cells;
    for (int i = 0; i < count; i++)
        if (pace[flow_index(cells, texels[i] % N / k, texels[i] / N / k)])
            return false;
    return true;
}

static void look_at_drops(const struct rig *rig, const uint32_t *pace, int cells, struct sums *sums)
{
    const double texel_mm = rig->settings.pane_mm / N;
    const double wet_mm = rig->settings.wet_height * rig->settings.relief;
    int drop = 0;
    memset(drop_of, 0, sizeof(drop_of));
    for (int i = 0; i < N * N; i++) {
        struct box box;
        if (drop_of[i / N][i % N] || mm[i / N][i % N] < wet_mm)
            continue;
        const int count = take_drop(++drop, wet_mm, i % N, i / N, &box);
        if (diameter_mm(count, texel_mm) < 2 || !rests(pace, cells, count))
            continue;
        sums->resting++;
        sums->by_outline += outline_share(drop, wet_mm, box) > 0.95;
    }
}

static void look(struct rig *rig, struct sums *sums)
{
    const struct flow *flow = (const struct flow *)rig->instance;
    const int cells = flow_lattice_cells(&flow->settings);
    const size_t bytes = (size_t)flow_map_length(cells) * sizeof(uint32_t);
    int64_t *water = rig_water(rig);
    uint32_t *pace = malloc(bytes);
    assert_int_equal(rig->size, N);
    for (int i = 0; i < N * N; i++)
        mm[i / N][i % N] = rig_mm(rig, water[i]);
    assert_true(rg_buf_read(flow->pace->buf, 0, pace, (int64_t)bytes));
    const int before = sums->resting;
    look_at_drops(rig, pace, cells, sums);
    free(pace);
    free(water);
    free(rig_draw(rig));
    assert_equals(fact_of(rig->instance, "resting_above_2_mm"), sums->resting - before);
    sums->by_middles += fact_of(rig->instance, "resting_above_2_mm") *
                        fact_of(rig->instance, "resting_convex_percent") / 100;
}

static void open_defaults(struct rig *rig, int seed)
{
    char text[96];
    snprintf(text, sizeof(text), "move=sliding survey=on seed=%d", seed);
    rig_open_sized(rig, "cpu", text, 64, 64);
}

// After a minute 95 % of the drops at rest that are wider than 2 mm have an area of more than 95 %
// of their convex hull's, by both readings.
static void test_drops_stay_round(void **state)
{
    (void)state;
    enum { SEEDS = 6 };
    struct sums sums = {0};
    for (int seed = 1; seed <= SEEDS; seed++) {
        struct rig rig;
        open_defaults(&rig, seed);
        rig_step(&rig, 3600);
        look(&rig, &sums);
        rig_close(&rig);
        print_message("%d seeds: of %d drops %.2f %% by middles, %.2f %% by the outline\n", seed,
                      sums.resting, 100 * sums.by_middles / sums.resting,
                      100.0 * sums.by_outline / sums.resting);
    }
    assert_above(sums.resting, SEEDS * 100);
    assert_above(sums.by_middles / sums.resting, 0.95);
    assert_above((double)sums.by_outline / sums.resting, 0.95);
}

// From 10 s to 120 s the wet share stays within 10 % of its mean.
static void test_panes_stay_as_wet(void **state)
{
    (void)state;
    enum { LOOKS = 12 };
    double wet[LOOKS], mean = 0;
    struct rig rig;
    open_defaults(&rig, 1);
    for (int i = 0; i < LOOKS; i++) {
        rig_step(&rig, 600);
        free(rig_draw(&rig));
        wet[i] = fact_of(rig.instance, "wet_percent");
        mean += wet[i] / LOOKS;
        print_message("%.2f %% wet after %d s\n", wet[i], 10 * (i + 1));
    }
    rig_close(&rig);
    print_message("%.2f %% on average\n", mean);
    for (int i = 0; i < LOOKS; i++)
        assert_below(fabs(wet[i] / mean - 1), 0.1);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest quick[] = {cmocka_unit_test(test_readings_of_caps)};
    const struct CMUnitTest drops[] = {cmocka_unit_test(test_drops_stay_round)};
    const struct CMUnitTest wet[] = {cmocka_unit_test(test_panes_stay_as_wet)};
    if (argc > 1)
        return strcmp(argv[1], "wet") != 0 ? cmocka_run_group_tests(drops, NULL, rig_close_devices)
                                           : cmocka_run_group_tests(wet, NULL, rig_close_devices);
    return cmocka_run_group_tests(quick, NULL, NULL);
}
