// Trails that break into beads (trail=beads): what a drop leaves on a dry pane once it is gone.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/core/techniques/drops/rig.h"
#include "tests/tools/expect.h"

static struct rg_device *device;

// A pane of 96 x 72 mm on which one drop runs straight down, 24 mm from the left.
#define PANE "columns=192 rows=144 drops_s=0 residual=off meander_rad=0 max_drops=10 seed=3 trail="

static struct drops *after_a_drop(const char *trail, int steps)
{
    char settings[200];
    snprintf(settings, sizeof(settings), PANE "%s", trail);
    struct drops *d = rig_open(device, settings);
    const drops_drop one = {.mass = (uint32_t)(40 * DROPS_QUANTA_MG), .x = 24.1f, .y = 6.1f};
    rig_put(d, &one, 1, 1);
    rig_step(d, steps);
    return d;
}

struct patches {
    int count, longest_cells; // and the length of the longest down the pane
    double highest_mm;
};

// Marks the wet cells around one; returns the row of the lowest.
static int take(struct drops *d, float *height, int column, int row)
{
    int lowest = row;
    if (!drops_on_pane(d->params, column, row))
        return 0;
    float *h = &height[drops_cell(d->params, column, row)];
    if (*h == 0)
        return 0;
    *h = 0;
    for (int k = 0; k < 9; k++) {
        const int below = take(d, height, column + k % 3 - 1, row + k / 3 - 1);
        lowest = below > lowest ? below : lowest;
    }
    return lowest;
}

static struct patches patches_of(struct drops *d)
{
    struct patches p = {0};
    float *height = rig_words(d, "height");
    for (int row = 0; row < d->settings.rows; row++)
        for (int column = 0; column < d->settings.columns; column++) {
            const float h = height[drops_cell(d->params, column, row)];
            p.highest_mm = fmax(p.highest_mm, (double)h);
        }
    for (int row = 0; row < d->settings.rows; row++)
        for (int column = 0; column < d->settings.columns; column++) {
            if (height[drops_cell(d->params, column, row)] == 0)
                continue;
            const int length = take(d, height, column, row) + 1 - row;
            p.count++;
            p.longest_cells = length > p.longest_cells ? length : p.longest_cells;
        }
    free(height);
    return p;
}

// The drop is off the pane after 60 steps. The band that it leaves breaks into beads, which stay;
// by the paper's rules it thins as one band, and is gone.
static void test_a_trail_breaks_into_beads(void **state)
{
    (void)state;
    static const struct {
        const char *trail;
        int steps, least, most, longest_cells;
    } cases[] = {
        {"hemispheres", 400, 0, 0, 0}, {"beads", 400, 10, 60, 14}, {"beads", 900, 10, 60, 14}};
    int before = 0;
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        struct drops *d = after_a_drop(cases[i].trail, cases[i].steps);
        const struct patches p = patches_of(d);
        print_message("%s, %d steps: %d patches, %d cells long at most, %.3g mm high\n",
                      cases[i].trail, cases[i].steps, p.count, p.longest_cells, p.highest_mm);
        assert_int_equal(rig_tally(d, DROPS_COUNT), 0);
        assert_in_range(p.count, cases[i].least, cases[i].most);
        assert_in_range(p.longest_cells, 0, cases[i].longest_cells);
        assert_below(p.highest_mm, 0.5);
        assert_true(i < 2 || p.count == before);
        before = p.count;
        rig_close(d);
    }
}

// While the drop is on its way, nothing of its trail stands as a band lower than what breaks.
static void test_no_low_band_stands(void **state)
{
    (void)state;
    struct drops *d = after_a_drop("beads", 40);
    float *height = rig_words(d, "height"), *held = rig_words(d, "held");
    for (int row = 0; row < d->settings.rows; row++)
        for (int column = 0; column < d->settings.columns; column++) {
            const int cell = drops_cell(d->params, column, row);
            if (height[cell] > 0 && height[cell] < DROPS_BEAD_GAP_MM && height[cell] > held[cell])
                fail_msg("cell %d, %d: %g mm, where the glass holds %g", column, row,
                         (double)height[cell], (double)held[cell]);
        }
    free(height);
    free(held);
    rig_close(d);
}

int main(int argc, char **argv)
{
    device = rg_device_open(argc > 1 ? argv[1] : "cpu");
    assert_non_null(device);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_trail_breaks_into_beads),
        cmocka_unit_test(test_no_low_band_stands),
    };
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    return rg_device_close(device) ? failed : 1;
}
