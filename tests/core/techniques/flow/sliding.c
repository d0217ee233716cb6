// Sliding drops against an independent model in double precision, in closed cases, and by laws.
// sliding DEVICE runs on it.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/core/techniques/flow/rig.h"
#include "tests/oracle/flow/box.h"
#include "tests/oracle/flow/slide.h"
#include "tests/tools/expect.h"

static const char *device = "cpu:reference";

static const double PI = 3.14159265358979323846;

// 64 texels of 1.5 mm unless the assignments say otherwise; no rain.
static void open_sliding(struct rig *rig, const char *assignments)
{
    char text[512];
    snprintf(text, sizeof(text), "move=sliding resolution_px=64 pane_mm=96 pane_rain_mm_h=0 %s",
             assignments);
    rig_open(rig, device, text);
}

// --- against the model ---

// A speed in texels a run, as the whole texels of this run, by its phase of the golden ratio.
static int whole(double texels, int64_t run)
{
    const double phase = (double)run * 0.6180339887498949;
    return fabs(texels) < 1e-9 ? 0 : (int)floor(texels + phase - floor(phase));
}

static void set_ways(struct slide_oracle *o, int64_t run)
{
    for (int pace = 1; pace < 8; pace++) {
        const double texels =
            o->slide_most_mm_s * pow(2, (pace - 7) / 2.0) * o->run_s * o->n / o->pane_mm;
        o->ways[pace][0] = whole(texels * o->down_x, run);
        o->ways[pace][1] = whole(texels * o->down_y, run);
    }
}

// Which way is down on a pane, and how steep the pane is, by where the box has it.
static void set_down(struct slide_oracle *o, const struct flow_settings *s, int pane)
{
    struct box_oracle box;
    box_oracle_turn(&box, s->pitch_deg, s->yaw_deg, s->roll_deg);
    const double x = -box.frames[pane][0][1], y = -box.frames[pane][1][1];
    o->cos_alpha = hypot(x, y);
    o->down_x = x / o->cos_alpha;
    o->down_y = y / o->cos_alpha;
}

static struct slide_oracle oracle_of(const struct rig *rig, int pane, int cells, int runs)
{
    const struct flow_settings *s = &rig->settings;
    struct slide_oracle o = {
        .n = rig->size,
        .cells = cells,
        .pane_mm = s->pane_mm,
        .cell_mm = s->pane_mm / cells,
        .run_s = s->step_s / runs,
        .slide_above_mm3 = s->slide_above_mm3,
        .slide_gain_mm_s = s->slide_gain_mm_s,
        .slide_most_mm_s = s->slide_most_mm_s,
        .levelling_mm_s = s->levelling_mm_s,
        .cohesion = s->cohesion,
        .contact_slope = s->contact_slope,
        .drying_mm2_s = s->drying_mm2_s,
    };
    set_down(&o, s, pane);
    return o;
}

// The beads of a pane are those of the first, moved to the left by as many sixths of the side.
static double *beads_of(const struct rig *rig, int pane)
{
    const int n = rig->size;
    float *beads = flow_bead_map(&rig->settings);
    double *beads_mm = malloc((size_t)(n * n) * sizeof(*beads_mm));
    for (int i = 0; i < n * n; i++)
        beads_mm[i] =
            (double)beads[i / n * n + (i % n + pane * (n / 6)) % n] * rig->settings.relief;
    free(beads);
    return beads_mm;
}

struct apart {
    int64_t off, wet; // texels of all frames
    double most_mm;
};

// Both run a frame from the same water on a pane.
static void compare_frame(struct rig *rig, struct slide_oracle *o, int pane, int frame, int runs,
                          struct apart *all)
{
    const int texels = rig->size * rig->size;
    int64_t *water = rig_water(rig);
    for (int i = 0; i < texels; i++)
        o->mm[i] = rig_mm(rig, water[pane * texels + i]);
    free(water);
    for (int run = 0; run < runs; run++) {
        set_ways(o, frame * runs + run);
        slide_oracle_run(o);
    }
    rig_step(rig, 1);
    water = rig_water(rig);
    for (int i = 0; i < texels; i++) {
        const int64_t found = water[pane * texels + i];
        const double apart = fabs(o->mm[i] - rig_mm(rig, found));
        all->wet += found > 0 || o->mm[i] > 0;
        all->off += apart > 2e-3;
        all->most_mm = fmax(all->most_mm, apart);
    }
    free(water);
}

// Runs both frame after frame. At most the share `most_off` of wet texels is off in all, because
// single precision now and then puts a cell on the other side of a pace.
static void compare_pane(const char *assignments, int pane, int frames, int cells, int runs,
                         double most_off)
{
    struct rig rig;
    open_sliding(&rig, assignments);
    struct slide_oracle o = oracle_of(&rig, pane, cells, runs);
    double *beads_mm = beads_of(&rig, pane);
    o.beads_mm = beads_mm;
    o.mm = malloc((size_t)(rig.size * rig.size) * sizeof(*o.mm));
    struct apart all = {0};
    for (int frame = 0; frame < frames; frame++)
        compare_frame(&rig, &o, pane, frame, runs, &all);
    print_message("%s, pane %d: %lld of %lld wet texels off, %.2g mm at most\n", assignments, pane,
                  (long long)all.off, (long long)all.wet, all.most_mm);
    assert_above(all.wet, frames * rig.size * rig.size / 20);
    if ((double)all.off > most_off * (double)all.wet)
        fail_msg("%s, pane %d: %lld of %lld wet texels off, %g mm at most", assignments, pane,
                 (long long)all.off, (long long)all.wet, all.most_mm);
    rig_close(&rig);
    free(o.mm);
    free(beads_mm);
}

static void compare(const char *assignments, int cells, int runs, double most_off)
{
    compare_pane(assignments, 0, 12, cells, runs, most_off);
}

// Drops of 3 mm at most lie near a pace: at the defaults 0.87 % of wet texels are off, with calmer
// water 0.15 %.
#define SMALL                                                                                      \
    "seed=5 drops=60 resolution_px=96 pane_mm=48 drop_radius_max_mm=3 pane_roll_deg=-120 "         \
    "step_s=0.05"

static void test_water_moves_as_in_the_model(void **state)
{
    (void)state;
    compare("seed=3 drops=90", 64, 1, 0.002);
    compare("seed=4 drops=70 pane_roll_deg=30 pane_pitch_deg=40 slide_above_mm3=5", 64, 1, 0.002);
    compare(SMALL, 32, 3, 0.01);
    compare(SMALL " levelling_mm_s=40 slide_above_mm3=8", 32, 3, 0.002);
    compare("seed=7 drops=30 resolution_px=160 pane_mm=48", 40, 1, 0.002);
    compare("seed=7 drops=30 resolution_px=160 pane_mm=48 levelling_mm_s=150 slide_above_mm3=8", 40,
            1, 0.002);
    compare("seed=6 drops=60 pane_roll_deg=180 bead_mm=0 cohesion=1.5 contact_slope=0.3", 64, 1,
            0.002);
}

// Each of the six panes of a turned box slopes, and holds water at places of its own.
static void test_every_pane_has_beads_of_its_own(void **state)
{
    (void)state;
    for (int pane = 0; pane < BOX_PANES; pane++)
        compare_pane("view=box seed=3 drops=90 pane_pitch_deg=40 pane_roll_deg=30", pane, 3, 64, 1,
                     0.002);
}

// --- closed cases ---

// The centre of the water, in millimetres from the upper left corner.
static void middle_of(const struct rig *rig, double middle_mm[2])
{
    int64_t *water = rig_water(rig);
    double sum = 0, x = 0, y = 0;
    for (int i = 0; i < rig->size * rig->size; i++) {
        sum += (double)water[i];
        x += (double)water[i] * (i % rig->size + 0.5);
        y += (double)water[i] * ((double)(i / rig->size) + 0.5);
    }
    free(water);
    middle_mm[0] = x / sum * rig->settings.pane_mm / rig->size;
    middle_mm[1] = y / sum * rig->settings.pane_mm / rig->size;
}

#define ALONE "drops=0 drying_mm2_s=0 bead_mm=0 levelling_mm_s=0 "

// This much water slides at the fastest pace, 70 mm a second down the pane, for any texels and
// steps. Only whole texels may make a difference.
static void test_a_drop_slides_at_its_speed(void **state)
{
    (void)state;
    static const struct {
        const char *set;
        double seconds, x, y; // the path in shares of the speed
    } cases[] = {
        {"resolution_px=64 step_s=0.0166666666666667", 0.5, 0, 1},
        {"resolution_px=128 step_s=0.0333333333333333", 0.5, 0, 1},
        {"resolution_px=200 step_s=0.0333333333333333 pane_roll_deg=30", 0.5, 0.5, 0.8660254},
        {"resolution_px=64 step_s=0.00625 pane_roll_deg=-30", 0.5, -0.5, 0.8660254},
    };
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        char text[256];
        snprintf(text, sizeof(text), ALONE "%s", cases[i].set);
        struct rig rig;
        open_sliding(&rig, text);
        double before[2], after[2];
        rig_put_drop(&rig, 48, 20, 4, 4);
        middle_of(&rig, before);
        const int64_t sum = rig_sum(&rig);
        rig_step(&rig, (int)(cases[i].seconds / rig.settings.step_s + 0.5));
        middle_of(&rig, after);
        const double way_mm = 70 * cases[i].seconds, texel_mm = 96.0 / rig.size;
        if (fabs(after[0] - before[0] - way_mm * cases[i].x) > 2 * texel_mm ||
            fabs(after[1] - before[1] - way_mm * cases[i].y) > 2 * texel_mm)
            fail_msg("%s: slid by (%g, %g) mm", cases[i].set, after[0] - before[0],
                     after[1] - before[1]);
        assert_int_equal(rig_sum(&rig), sum);
        rig_close(&rig);
    }
}

// Whether a drop of 3 mm moves in half a second.
static bool does_slide(const char *assignments)
{
    char text[256];
    snprintf(text, sizeof(text), ALONE "resolution_px=128 %s", assignments);
    struct rig rig;
    double before[2], after[2];
    open_sliding(&rig, text);
    rig_put_drop(&rig, 48.75, 48.75, 3, 3); // in the middle of a cell
    middle_of(&rig, before);
    rig_step(&rig, 30);
    middle_of(&rig, after);
    rig_close(&rig);
    return after[1] > before[1] + 0.5;
}

// The water around the middle of a drop, which is in the middle of a cell. The weight is the
// Gaussian of 4 x 0.69 mm2 a side, integrated in polar coordinates. Cells of 1.5 mm widen the
// average by a twelfth of their square.
static double water_around_mm3(double radius_mm, double height_mm)
{
    const double step_mm = 1e-3, smoothed_mm2 = 4 * 0.69, all_mm2 = smoothed_mm2 + 1.5 * 1.5 / 12;
    double sum = 0;
    for (double r = step_mm / 2; r < radius_mm; r += step_mm)
        sum += 2 * PI * r * step_mm * height_mm * sqrt(1 - r * r / (radius_mm * radius_mm)) *
               exp(-r * r / (2 * all_mm2));
    return sum * smoothed_mm2 / all_mm2;
}

// A drop stays while its water is below the volume that the contact line holds. The pane's slope
// counts to the power of 1.5 (Furmidge). The slowest pace is 70 / 8 mm/s. The lattice is not
// exactly a Gaussian, which allows 6 % to both sides.
static void test_the_contact_line_holds_small_drops(void **state)
{
    (void)state;
    const double slowest = 70 / 8.0, gain = 30;
    const double limit = water_around_mm3(3, 3) / (1 + slowest / gain);
    char text[128];
    for (int pitch_deg = 0; pitch_deg <= 70; pitch_deg += 35) {
        const double held = limit * pow(cos(pitch_deg * PI / 180), 1.5);
        snprintf(text, sizeof(text), "pane_pitch_deg=%d slide_above_mm3=%g", pitch_deg,
                 held * 1.06);
        if (does_slide(text))
            fail_msg("%s: slides", text);
        snprintf(text, sizeof(text), "pane_pitch_deg=%d slide_above_mm3=%g", pitch_deg,
                 held * 0.94);
        if (!does_slide(text))
            fail_msg("%s: stays", text);
    }
    assert_false(does_slide("pane_pitch_deg=90 slide_above_mm3=0.001"));
}

// Half the square of a height falls by drying_mm2_s a second, and the ledger has the dried water.
static void test_water_dries_evenly(void **state)
{
    (void)state;
    static const double step_s[] = {1 / 240.0, 1 / 60.0, 1 / 20.0};
    for (int i = 0; i < 3; i++) {
        char text[192];
        snprintf(text, sizeof(text),
                 "drops=0 bead_mm=0 levelling_mm_s=0 drying_mm2_s=0.02 step_s=%.17g", step_s[i]);
        struct rig rig;
        open_sliding(&rig, text);
        rig_put_one(&rig, 32, 32, rig_droplets(&rig, 0.5));
        const int64_t before = rig_sum(&rig);
        rig_step(&rig, (int)(2 / step_s[i] + 0.5)); // 0.25 - 2 * 0.02 * 2 mm2 are left
        const double left_mm = rig_mm(&rig, rig_sum(&rig));
        if (fabs(left_mm - sqrt(0.17)) > 5e-4)
            fail_msg("%s: %g mm left, not %g", text, left_mm, sqrt(0.17));
        assert_int_equal(rig_ledger(&rig, FLOW_LEDGER_DRAINED), (uint32_t)(before - rig_sum(&rig)));
        rig_step(&rig, (int)(5 / step_s[i]));
        assert_int_equal(rig_sum(&rig), 0);
        rig_close(&rig);
    }
}

// --- laws ---

// In rain, over edges and on a turned box, the water there is what came less what left.
static void test_the_ledger_balances(void **state)
{
    (void)state;
    static const char *const poses[] = {
        "", "view=box run_on=on pane_pitch_deg=40 pane_roll_deg=30",
        "view=box run_on=on spin_yaw_deg_s=90 spin_roll_deg_s=120 drop_radius_max_mm=9"};
    for (int pose = 0; pose < 3; pose++) {
        char text[256];
        snprintf(text, sizeof(text),
                 "move=sliding resolution_px=64 drops=300 pane_rain_mm_h=300 seed=%d %s", pose + 1,
                 poses[pose]);
        struct rig rig;
        rig_open(&rig, device, text);
        int64_t sourced = 0, drained = 0;
        uint32_t words[2] = {0, 0};
        for (int step = 0; step < 40; step++) {
            const uint32_t now[2] = {rig_ledger(&rig, FLOW_LEDGER_SOURCED),
                                     rig_ledger(&rig, FLOW_LEDGER_DRAINED)};
            sourced += (uint32_t)(now[0] - words[0]);
            drained += (uint32_t)(now[1] - words[1]);
            memcpy(words, now, sizeof(words));
            assert_int_equal(rig_sum(&rig), sourced - drained);
            rig_step(&rig, 1);
        }
        assert_above(drained, 0);
        rig_close(&rig);
    }
}

int main(int argc, char **argv)
{
    device = argc > 1 ? argv[1] : device;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_water_moves_as_in_the_model),
        cmocka_unit_test(test_every_pane_has_beads_of_its_own),
        cmocka_unit_test(test_a_drop_slides_at_its_speed),
        cmocka_unit_test(test_the_contact_line_holds_small_drops),
        cmocka_unit_test(test_water_dries_evenly),
        cmocka_unit_test(test_the_ledger_balances),
    };
    return cmocka_run_group_tests(tests, NULL, rig_close_devices);
}
