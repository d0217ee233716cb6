// Two devices and a technique that are made up: stand-ins for all functions that run something on a
// device. A test says of each run how the device's ends, and which items of a kernel it gets wrong.
//
// A run of n frames has two stages a frame: rain_step writes the buffer "water", rain_draw the
// image "target". The truth leaves multiples of the frame in both. A digest's hash is its frame and
// the number of its stages, and one more where the device is wrong.
#ifndef RG_TESTS_HARNESS_VERIFYING_SHRINKING_MADE_H
#define RG_TESTS_HARNESS_VERIFYING_SHRINKING_MADE_H

#include "harness/compare/shrink/shrink.h"

struct made_settings {
    int view, drops, seed;
    double amount, light;
    char map[RG_PATH_SIZE];
};
// view: box, pane or jar; drops: 0 to 100, 50; seed: 1; amount: 1 to 9, 4; light: 0 to 99, 1.
extern const struct rg_technique made_technique;

// "doubtful" and "trusted"; how they are called in full is "doubtful@A=1" and "trusted@B=2".
extern struct rg_device made_device, made_truth;

// How the device's run ends, from frame made_frame on.
enum made_way {
    MADE_SAME,
    MADE_OFF,     // a word of `water` is off by its last bit
    MADE_OTHER,   // the word is another number
    MADE_LEFT,    // the word is as it was a frame before
    MADE_TEXEL,   // the word made_word of `target` is another
    MADE_FEWER,   // rain_draw does not write
    MADE_REFUSED, // the settings are refused
    MADE_TIRED,   // the driver reports an error
    MADE_CRASH,   // the driver ends its worker while it runs rain_step
};
enum { MADE_WORDS = 8, MADE_WRONG = 5, MADE_TEXELS = 20 };
extern enum made_way (*made_way)(const struct rg_digest_run *run);
extern int made_frame, made_word;
// The work of a run, which is the weight of its digests. NULL: its drops.
extern int64_t (*made_work)(const struct rg_digest_run *run);

// Counts since made_reset.
extern int made_takes;    // runs of the device
extern int made_open;     // sessions that are open
extern int made_renewals; // of the device's worker

// Whether the device lives in a worker, as it does after made_reset.
extern bool made_has_worker;

// Each run of the device takes so long, by a clock that nothing else moves.
extern double made_run_ms;

// The dispatches of a stage, of which each kernel adds 1 to all words of slot 1 into slot 2; and
// whether the device gets a dispatch wrong, or fails at it (MADE_TIRED, MADE_CRASH).
extern struct rg_dispatches made_dispatches;
extern enum made_way (*made_dispatch)(const struct rg_dispatched *dispatched);

// Before each test.
int made_reset(void **state);

#endif
