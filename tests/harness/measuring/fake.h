// A device and a technique that do nothing but take time, by a script, and a wall clock that only
// they move: what the harness says of them can be worked out by hand. As on a GPU, work that was
// asked for takes its time at the next wait.
//
// The program's rg_now_ms is fake.c's, in place of harness/console/clock.h's.
#ifndef RG_TESTS_HARNESS_MEASURING_FAKE_H
#define RG_TESTS_HARNESS_MEASURING_FAKE_H

#include <math.h>

#include "core/device/device.h"
#include "core/techniques/technique.h"

// What a technique does; its settings.
struct fake_script {
    char letter; // of its steps in the events
    double open_ms, step_ms, draw_ms;
    double cold_ms;          // more of a frame that follows one of another instance
    const double *frames_ms; // what the first `frame_count` drawings take instead of draw_ms
    int frame_count;
    int interrupt_at; // the step that ends with a signal; 0: none
};
extern const struct rg_technique fake_technique;

// What a device does. Fields may be changed while it is open.
struct fake_device {
    struct rg_device pub;
    double sync_ms;          // a wait, whatever it waits for
    double run_ms;           // a run of a pass
    double item_ms, word_ms; // more of each of its items, and of each that copies a word
    int slow_runs;           // so many runs more take ten times as long
    int slow_every;          // as does each of so many; 0: none
    double clock_rate;       // of the API's clock, by wall clock
    double clock_ms;         // reading it
    int waits_left;          // after so many waits it is lost; -1: never
    bool was_lost;
    int64_t waits, clock_reads, runs; // since it was opened
    double pending_ms;                // asked for, and not waited for
    const void *last;                 // the instance that stepped last
    uint16_t shown;                   // each half of the images that are read
};
struct fake_device *fake_open(void);

// Also false where the value is no number, or infinite.
#define assert_near(value, due, within) assert_true(fabs((double)(value) - (due)) <= (within))

// What happened since fake_forget, of all devices: "(" opened, a script's letter for a step, "."
// drawn, "|" waited, "t" the clock read.
const char *fake_events(void);
void fake_forget(void);
// The wall clock goes on by itself.
void fake_pass(double ms);

#endif
