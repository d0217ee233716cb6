// `cpu` skips texels that report nothing to do (rg_is_idle in flow's kernels), and cpu:reference
// runs them all. Water and all that passes write is the same to the last bit at every step, and the
// ledger balances on both.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/techniques/flow/instance.h"
#include "tests/core/techniques/flow/rig.h"
#include "tests/tools/expect.h"

enum { DEVICES = 2, UNIT = 65536, BLOCK = 16 }; // texels that `cpu` asks at once

struct both {
    struct rig rigs[DEVICES];
    const char *assignments;
    int64_t came; // water put or fallen, less water drained by the ledgers
    uint32_t words[FLOW_LEDGER_WORDS];
};

static void both_open(struct both *both, const char *assignments)
{
    static const char *const names[DEVICES] = {"cpu", "cpu:reference"};
    *both = (struct both){.assignments = assignments};
    for (int i = 0; i < DEVICES; i++)
        rig_open(&both->rigs[i], names[i], assignments);
    both->came = rig_sum(&both->rigs[0]);
    for (int word = 0; word < FLOW_LEDGER_WORDS; word++)
        both->words[word] = rig_ledger(&both->rigs[0], word);
}

static void both_close(struct both *both)
{
    for (int i = 0; i < DEVICES; i++)
        rig_close(&both->rigs[i]);
}

static uint32_t *contents(const struct rg_asset *asset)
{
    uint32_t *words = malloc(asset->buf->size);
    assert_non_null(words);
    assert_true(rg_buf_read(asset->buf, 0, words, (int64_t)asset->buf->size));
    return words;
}

static void expect_equal(const struct both *both, const struct rg_asset *a,
                         const struct rg_asset *b)
{
    uint32_t *x = contents(a), *y = contents(b);
    for (size_t i = 0; i < a->buf->size / sizeof(*x); i++)
        if (x[i] != y[i])
            fail_msg("%s, frame %lld: %s[%zu] is %08x, and %08x where all texels run",
                     both->assignments, (long long)both->rigs[0].instance->frame, a->name, i, x[i],
                     y[i]);
    free(x);
    free(y);
}

static void expect_balance(struct both *both)
{
    const struct rig *rig = &both->rigs[0];
    for (int word = 0; word < FLOW_LEDGER_WORDS; word++) {
        const uint32_t now = rig_ledger(rig, word);
        const int64_t more = (uint32_t)(now - both->words[word]);
        both->came += word == FLOW_LEDGER_SOURCED ? more : -more;
        both->words[word] = now;
    }
    assert_int_equal(rig_sum(rig), both->came);
}

// Compares every buffer of both instances after each of these steps.
static void both_step(struct both *both, int steps)
{
    const struct rg_instance *a = both->rigs[0].instance, *b = both->rigs[1].instance;
    for (int step = 0; step < steps; step++) {
        for (int i = 0; i < DEVICES; i++)
            rig_step(&both->rigs[i], 1);
        assert_int_equal(a->asset_count, b->asset_count);
        for (int i = 0; i < a->asset_count; i++)
            if (!a->assets[i].is_image && a->assets[i].buf)
                expect_equal(both, &a->assets[i], &b->assets[i]);
        expect_balance(both);
    }
}

// --- one texel of water ---

static void both_put(struct both *both, int pane, int x, int y, int64_t droplets)
{
    for (int i = 0; i < DEVICES; i++) {
        const struct rig *rig = &both->rigs[i];
        int64_t *water = calloc((size_t)(rig->panes * rig->size * rig->size), sizeof(*water));
        water[rig_texel(rig, pane, x, y)] = droplets;
        rig_put(&both->rigs[i], water);
        free(water);
    }
    both->came = droplets;
}

// Water beside a block's edge and a pane's, in all eight directions, enters a dry block and leaves
// a block dry.
static void test_water_comes_from_the_next_block(void **state)
{
    (void)state;
    static const int columns[] = {BLOCK - 2, BLOCK - 1, BLOCK, 2 * BLOCK - 1, 3 * BLOCK - 1, 0};
    char text[160];
    for (int eighth = 0; eighth < 8; eighth++) {
        snprintf(text, sizeof(text),
                 "move=paper resolution_px=48 drops=0 rain_drops_s=0 reach_texels=4 "
                 "pane_roll_deg=%d",
                 45 * eighth - 180);
        struct both both;
        both_open(&both, text);
        for (size_t i = 0; i < sizeof(columns) / sizeof(columns[0]); i++) {
            both_put(&both, 0, columns[i], columns[i], 3 * UNIT);
            both_step(&both, 6);
        }
        both_close(&both);
    }
}

// The same for sliding drops: one that is held and wets its surroundings, and one that runs.
static void test_drops_come_from_the_next_block(void **state)
{
    (void)state;
    static const char *const rolls[] = {"0", "90", "-135"};
    char text[160];
    for (int i = 0; i < 3; i++) {
        snprintf(text, sizeof(text),
                 "move=sliding resolution_px=128 pane_mm=37 drops=0 pane_rain_mm_h=0 "
                 "slide_above_mm3=0.05 pane_roll_deg=%s",
                 rolls[i]);
        struct both both;
        both_open(&both, text);
        for (int x = 2 * BLOCK - 1; x <= 2 * BLOCK; x++) {
            both_put(&both, 0, x, x, 12 * UNIT);
            both_step(&both, 8);
        }
        both_close(&both);
    }
}

// --- rain, edges, drying ---

static void compare(const char *assignments, int steps)
{
    struct both both;
    both_open(&both, assignments);
    both_step(&both, steps);
    assert_above(both.came, 0);
    both_close(&both);
}

static void test_rain_falls_on_dry_panes(void **state)
{
    (void)state;
    compare("move=paper resolution_px=64 drops=0 rain_drops_s=200", 30);
    compare("move=paper resolution_px=100 drops=0 rain_drops_s=200 direction=split "
            "pane_roll_deg=30",
            30);
    compare("move=paper resolution_px=100 drops=0 rain_drops_s=200 direction=texel "
            "pane_roll_deg=-160",
            30);
    compare("move=sliding resolution_px=64 drops=0 pane_rain_mm_h=100", 30);
    compare("move=sliding resolution_px=100 drops=0 pane_rain_mm_h=100 pane_roll_deg=30", 30);
}

// The panes are no whole number of blocks, and their water runs on to the next panes.
static void test_water_runs_over_the_edges(void **state)
{
    (void)state;
    compare("move=paper view=box run_on=on resolution_px=40 drops=60 rain_drops_s=300 "
            "pane_pitch_deg=40 pane_roll_deg=30 reach_texels=4 spin_roll_deg_s=200",
            40);
    compare("move=paper view=box run_on=on resolution_px=40 drops=60 rain_drops_s=300 "
            "pane_pitch_deg=40 pane_roll_deg=30 direction=texel spin_roll_deg_s=200",
            40);
    compare("move=sliding view=box run_on=on resolution_px=90 drops=60 pane_rain_mm_h=200 "
            "pane_pitch_deg=40 pane_roll_deg=30 spin_roll_deg_s=200 slide_above_mm3=2",
            40);
}

// Panes get as dry as before any water came, including the data that the next runs read.
static void test_panes_dry_up(void **state)
{
    (void)state;
    struct both both;
    both_open(&both, "move=sliding resolution_px=64 drops=40 pane_rain_mm_h=0 drying_mm2_s=20");
    assert_above(both.came, 0);
    both_step(&both, 60);
    assert_int_equal(both.came, 0);
    static const char *const dry[] = {"water", "moved", "given", "paced",
                                      "level", "pull",  "mean",  "wet"};
    for (size_t i = 0; i < sizeof(dry) / sizeof(dry[0]); i++) {
        const struct rg_asset *asset = rg_asset_find(both.rigs[0].instance, dry[i]);
        uint32_t *words = contents(asset);
        for (size_t word = 0; word < asset->buf->size / sizeof(*words); word++)
            if (words[word])
                fail_msg("%s[%zu] is %08x on dry panes", dry[i], word, words[word]);
        free(words);
    }
    both_close(&both);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_water_comes_from_the_next_block),
        cmocka_unit_test(test_drops_come_from_the_next_block),
        cmocka_unit_test(test_rain_falls_on_dry_panes),
        cmocka_unit_test(test_water_runs_over_the_edges),
        cmocka_unit_test(test_panes_dry_up),
    };
    return cmocka_run_group_tests(tests, NULL, rig_close_devices);
}
