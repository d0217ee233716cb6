// A device and a technique that only take time, by a script, and a wall clock that only they move.
// So a test can work out by hand what the harness reports. As on a GPU, requested work takes its
// time at the next wait.
#ifndef RG_TESTS_HARNESS_DEVICES_MEASURING_FAKE_H
#define RG_TESTS_HARNESS_DEVICES_MEASURING_FAKE_H

#include <math.h>

#include "core/device/device.h"
#include "core/techniques/technique.h"

// The costs of a technique; its settings.
struct fake_script {
    char letter; // in the events, for each step
    double open_ms, step_ms, draw_ms;
    double cold_ms;          // added to a frame that follows another instance's
    const double *frames_ms; // the first `frame_count` drawings take these instead of draw_ms
    int frame_count;
    int interrupt_at; // the step that a signal ends; 0: none
};
extern const struct rg_technique fake_technique;

// The costs of a device. Fields may be changed while it is open.
struct fake_device {
    struct rg_device pub;
    double sync_ms;          // any wait
    double run_ms;           // a run of a pass
    double item_ms, word_ms; // added for each item, and for each item that copies a word
    double cache_items;      // a run of more items takes twice as long; 0: none does
    int slow_runs;           // this many more runs take ten times as long
    int slow_every;          // so does every slow_every-th run; 0: none
    double clock_rate;       // of the API's clock, relative to the wall clock
    double clock_ms;         // reading the API's clock
    int waits_left;          // the device is lost after this many; -1: never
    bool was_lost;
    int64_t waits, clock_reads, runs; // since it was opened
    double pending_ms;                // requested, and not waited for yet
    const void *last;                 // the instance that last stepped
    uint16_t shown;                   // the value of each half of images that are read
};
struct fake_device *fake_open(void);

// The events since fake_forget, of all devices: "(" opened, a script's letter for a step, "."
// drawn, "|" waited, "t" the clock read.
const char *fake_events(void);
void fake_forget(void);
// Moves the wall clock on.
void fake_pass(double ms);

#endif
