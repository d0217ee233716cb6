// The level of detail as the camera moves: when it changes, and where the water goes. On cpu.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "core/techniques/flow/instance.h"
#include "tests/core/techniques/flow/rig.h"
#include "tests/tools/expect.h"

enum { WIDTH = 160, HEIGHT = 120 };

static struct flow *flow_of(const struct rig *rig)
{
    return (struct flow *)rig->instance;
}

static void open_box(struct rig *rig, const char *more)
{
    char text[512];
    snprintf(text, sizeof(text),
             "view=box resolution_px=128 texels_a_pixel=1 distance_mm=210 drops=60 %s", more);
    rig_open_sized(rig, "cpu", text, WIDTH, HEIGHT);
}

// Sets the level, whatever the camera asks for, from now on.
static void change_to(struct rig *rig, int texels)
{
    flow_of(rig)->settings.texels_a_pixel = 0;
    assert_true(flow_change_detail(flow_of(rig), texels));
    rig->size = texels;
}

static int64_t sum_of(const int64_t *water, int count)
{
    int64_t sum = 0;
    for (int i = 0; i < count; i++)
        sum += water[i];
    return sum;
}

static void expect_balance(const struct rig *rig)
{
    assert_int_equal((uint32_t)rig_sum(rig),
                     rig_ledger(rig, FLOW_LEDGER_SOURCED) - rig_ledger(rig, FLOW_LEDGER_DRAINED));
}

// --- what becomes of the water ---

// A droplet is four droplets of the next finer level; the test counts the finer ones.
static void a_coarser_level_keeps_the_volume(const char *move)
{
    struct rig rig;
    char text[96];
    snprintf(text, sizeof(text), "camera_mm_s=1e-6 %s", move); // so that levels may change
    open_box(&rig, text);
    change_to(&rig, 128);
    rig_step(&rig, 20);
    int64_t *fine = rig_water(&rig);
    change_to(&rig, 64);
    int64_t *coarse = rig_water(&rig);
    for (int pane = 0; pane < 6; pane++) {
        const int64_t lost = sum_of(fine + pane * 128 * 128, 128 * 128) -
                             4 * sum_of(coarse + pane * 64 * 64, 64 * 64);
        assert_between(lost, 0, 3);
    }
    for (int i = 0; i < 6 * 64 * 64; i++) {
        const int pane = i / (64 * 64), x = i % 64, y = i / 64 % 64;
        int64_t four = 0;
        for (int k = 0; k < 4; k++)
            four += fine[(pane * 128 + 2 * y + k / 2) * 128 + 2 * x + k % 2];
        assert_at_most(llabs(four - 4 * coarse[i]), 3);
    }
    expect_balance(&rig);
    rig_step(&rig, 5); // the water runs on
    expect_balance(&rig);
    free(fine);
    free(coarse);
    rig_close(&rig);
}

static void test_a_coarser_level_keeps_the_volume(void **state)
{
    (void)state;
    a_coarser_level_keeps_the_volume("move=sliding");
    a_coarser_level_keeps_the_volume("move=paper");
    a_coarser_level_keeps_the_volume("move=paper direction=texel");
}

// Four fine texels hold their coarse texel's water, to the droplet. None is outside the range of
// the texels around, and they lean where water leans.
static void test_a_finer_level_keeps_the_volume(void **state)
{
    (void)state;
    struct rig rig;
    open_box(&rig, "camera_mm_s=1e-6 move=sliding");
    change_to(&rig, 64);
    rig_step(&rig, 20);
    int64_t *coarse = rig_water(&rig);
    change_to(&rig, 128);
    int64_t *fine = rig_water(&rig);
    int leaning = 0, wet = 0;
    for (int i = 0; i < 6 * 64 * 64; i++) {
        const int pane = i / (64 * 64), x = i % 64, y = i / 64 % 64;
        int64_t four = 0, least = INT64_MAX, most = 0;
        for (int k = 0; k < 9; k++) {
            const int ax = x + k % 3 - 1, ay = y + k / 3 - 1;
            if (ax < 0 || ay < 0 || ax > 63 || ay > 63)
                continue;
            const int64_t one = coarse[(pane * 64 + ay) * 64 + ax];
            least = one < least ? one : least;
            most = one > most ? one : most;
        }
        const int64_t *corner = &fine[(pane * 128 + 2 * y) * 128 + 2 * x];
        for (int k = 0; k < 4; k++) {
            const int64_t one = corner[k / 2 * 128 + k % 2];
            assert_at_least(one, least);
            assert_at_most(one, most);
            four += one;
        }
        assert_int_equal(four, 4 * coarse[i]);
        leaning += corner[0] != corner[1] || corner[0] != corner[128];
        wet += coarse[i] > 0;
    }
    assert_above(leaning, wet / 4);
    expect_balance(&rig);
    change_to(&rig, 64);
    int64_t *again = rig_water(&rig);
    assert_memory_equal(again, coarse, 6 * 64 * 64 * sizeof(*coarse));
    free(coarse);
    free(fine);
    free(again);
    rig_close(&rig);
}

// --- when it changes ---

// By docs/flow.md: the coarsest of 128, 64, 32 and 16 that gives each pixel of the box's middle one
// texel. A level coarser than before needs a tenth to spare.
static int texels_due(const struct flow_settings *s, double distance_mm, int before)
{
    const double px = HEIGHT * s->pane_mm / (2 * distance_mm * tan(s->view_angle_deg * M_PI / 360));
    int due = 128, spare = 128;
    while (due / 2 >= px && due > 16)
        due /= 2;
    while (spare / 2 >= 1.1 * px && spare > 16)
        spare /= 2;
    return due > before ? due : spare < before ? spare : before;
}

static void follow(const char *way, double mm_s, int steps, int first, int last, int changes)
{
    struct rig rig;
    open_box(&rig, way);
    int texels = flow_of(&rig)->settings.resolution_px, changed = 0;
    assert_int_equal(texels, first);
    for (int i = 0; i < steps; i++) {
        const struct flow_settings *s = &rig.settings;
        const double nearest = fmin(s->distance_mm, 1.3660254 * s->pane_mm);
        const double distance_mm = fmax(s->distance_mm + mm_s * i / 20, nearest);
        const int due = texels_due(s, distance_mm, texels);
        rig_step(&rig, 1);
        rig.size = flow_of(&rig)->settings.resolution_px;
        changed += rig.size != texels;
        texels = rig.size;
        if (texels != due)
            fail_msg("%s: step %d, %g mm: %d texels, not %d", way, i, distance_mm, texels, due);
        assert_equals(flow_of(&rig)->texels->number, texels);
        expect_balance(&rig);
        free(rig_draw(&rig));
    }
    assert_int_equal(texels, last);
    assert_int_equal(changed, changes);
    rig_close(&rig);
}

static void test_the_level_follows_the_camera(void **state)
{
    (void)state;
    follow("step_s=0.05 camera_mm_s=1000", 1000, 60, 128, 16, 3);
    follow("step_s=0.05 distance_mm=3000 camera_mm_s=-1500", -1500, 50, 16, 128, 3);
    follow("step_s=0.05 move=paper direction=texel distance_mm=400 camera_mm_s=800", 800, 20, 64,
           32, 1);
}

// Within a tenth, the camera crosses the border between two levels to and fro without a change.
static void test_a_camera_at_the_border_changes_nothing(void **state)
{
    (void)state;
    struct rig rig;
    open_box(&rig, "camera_mm_s=1e-6");
    struct flow *flow = flow_of(&rig);
    const double half = tan(rig.settings.view_angle_deg * M_PI / 360);
    const double border_mm = HEIGHT * rig.settings.pane_mm / (2 * 64 * half);
    flow->settings.distance_mm = border_mm * 1.15;
    rig_step(&rig, 1);
    assert_int_equal(flow->settings.resolution_px, 64);
    flow->settings.distance_mm = border_mm * 0.99;
    rig_step(&rig, 1);
    assert_int_equal(flow->settings.resolution_px, 128);
    flow->settings.distance_mm = border_mm * 1.05;
    rig_step(&rig, 1);
    assert_int_equal(flow->settings.resolution_px, 128);
    rig_close(&rig);
}

struct pane {
    double wet, centre; // shares of the panes
};

static struct pane panes_of(struct rig *rig)
{
    rig->size = flow_of(rig)->settings.resolution_px;
    int64_t *water = rig_water(rig);
    const int n = rig->size, count = 4 * n * n; // the upright panes
    double wet = 0, sum = 0, down = 0;
    for (int i = 0; i < count; i++) {
        wet += (double)water[i] >= rig->settings.wet_height * 65536;
        sum += (double)water[i];
        down += (double)water[i] * (i / n % n + 0.5) / n;
    }
    free(water);
    return (struct pane){wet / count, down / sum};
}

// Panes whose level changed on the way are as wet as panes with the last level all along, within 10
// %. Their water is as far down, within 3 %.
static void test_the_water_is_where_it_would_be(void **state)
{
    (void)state;
    struct pane panes[3];
    static const char *const ways[] = {"texels_a_pixel=0 resolution_px=256",
                                       "texels_a_pixel=0 resolution_px=128",
                                       "resolution_px=256 texels_a_pixel=2 camera_mm_s=190"};
    for (int i = 0; i < 3; i++) {
        struct rig rig;
        open_box(&rig, ways[i]);
        rig_step(&rig, 60);
        panes[i] = panes_of(&rig);
        print_message("%s: %d texels, %.2f %% wet, %.2f %% down\n", ways[i], rig.size,
                      100 * panes[i].wet, 100 * panes[i].centre);
        assert_int_equal(rig.size, i ? 128 : 256);
        rig_close(&rig);
    }
    assert_below(fabs(panes[2].wet / panes[1].wet - 1), 0.1);
    assert_below(fabs(panes[2].centre - panes[1].centre), 0.03);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_coarser_level_keeps_the_volume),
        cmocka_unit_test(test_a_finer_level_keeps_the_volume),
        cmocka_unit_test(test_the_level_follows_the_camera),
        cmocka_unit_test(test_a_camera_at_the_border_changes_nothing),
        cmocka_unit_test(test_the_water_is_where_it_would_be),
    };
    return cmocka_run_group_tests(tests, NULL, rig_close_devices);
}
