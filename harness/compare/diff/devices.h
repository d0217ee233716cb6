// Compares one frame of a technique on several devices: `raingauge diff TECHNIQUE`.
#ifndef RG_HARNESS_COMPARE_DIFF_DEVICES_H
#define RG_HARNESS_COMPARE_DIFF_DEVICES_H

#include <stdbool.h>

#include "harness/devices/devices.h"
#include "harness/devices/frames/session.h"

// Nothing in it is owned.
struct rg_diff_devices_request {
    struct rg_subject subject;
    const struct rg_devices_asked *devices;
    int frames;                 // simulated before the picture is drawn
    const char *heatmap_prefix; // NULL: none; else PREFIX-A-B-flip.png and -difference.png,
                                // and PREFIX-A.exr
    double exposure;
    bool mutants;  // for a failing pair: which mutants the tier that holds would accept
    bool features; // for a native device that differs: which of its features do
    bool json;     // instead of a table
};

// Renders on every device, compares every pair and prints the results. Returns an enum rg_exit:
// pass when every pair meets the tier required of its devices (core/device/device.h).
int rg_diff_devices(const struct rg_diff_devices_request *request);

#endif
