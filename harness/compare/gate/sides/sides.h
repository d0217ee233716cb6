// The two things of a gate: devices in workers of their own, which are started anew for every
// launch.
#ifndef RG_HARNESS_COMPARE_GATE_SIDES_SIDES_H
#define RG_HARNESS_COMPARE_GATE_SIDES_SIDES_H

#include "harness/compare/gate/report/report.h"
#include "harness/devices/devices.h"

// A is what B is held against.
enum { RG_SIDE_A, RG_SIDE_B, RG_SIDES };

struct rg_side {
    const char *name;         // as --device takes one device; not owned
    struct rg_device *device; // NULL: not open
    bool was_closed_badly;    // once: something was left on it, or its driver crashed
    bool was_lacking;         // once: raingauge itself lacked what opening it needs
};

// Closes the device, if one is open, and opens it again: its worker is another process then. False,
// with one logged line, on failure.
bool rg_side_launch(struct rg_side *side);
void rg_side_close(struct rg_side *side);

// What came of a first launch.
struct rg_side_seen {
    const char *name; // not owned
    bool is_name;     // such that a device could have it
    bool is_there;    // on this machine, though its driver may fail: that ends its cases
    bool is_open;
    char why[RG_LIST_WHY_SIZE + 64]; // it is not open
};
// Launches a side, of which `info` is then told.
struct rg_side_seen rg_side_look(struct rg_side *side, struct rg_device_info *info);
// Whether all that `require` names, NULL: nothing, is among them and is there; of each that is not,
// one line is logged, and the report gets a case, "required.vulkan", so that a CI's page shows it.
bool rg_sides_have(const struct rg_side_seen *seen, int count, const char *require,
                   struct rg_report *report);

// The case of a required side, NULL: of none, with the last error for its message. False.
bool rg_side_is_missing(const char *name, const struct rg_side_seen *side,
                        struct rg_report *report);

// Whether a list of names has each once: cells of a device that stands there twice would share a
// name. False, and one logged line, also where one is no name.
bool rg_sides_are_apart(const char *names);

#endif
