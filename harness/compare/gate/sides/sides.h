// The sides of a gate: devices in workers of their own, restarted for every launch.
#ifndef RG_HARNESS_COMPARE_GATE_SIDES_SIDES_H
#define RG_HARNESS_COMPARE_GATE_SIDES_SIDES_H

#include "harness/compare/gate/report/report.h"
#include "harness/devices/devices.h"

// B is compared with A.
enum { RG_SIDE_A, RG_SIDE_B, RG_SIDES };

struct rg_side {
    const char *name;         // as an argument of --device for one device; not owned
    struct rg_device *device; // NULL: not open
    bool was_closed_badly;    // at least once closing it found a leak or a crash
    bool was_lacking;         // at least once raingauge lacked something for opening it
    // What its first launch showed (rg_side_look).
    struct rg_device_info info;      // without a name if it did not open
    bool is_name;                    // the name is a valid device name
    bool is_there;                   // on this machine; a driver that fails ends its cases
    char why[RG_LIST_WHY_SIZE + 64]; // why it did not open
    // Of a side that runs alone.
    json_t *parts;  // of its comparison key; owned by the gate
    bool same_key;  // equal to the baseline's key
    bool has_fixed; // its fixed functions are among the cases
};

// Closes the device if it is open, and opens it again in a new worker process. False, with one
// logged line, on failure.
bool rg_side_launch(struct rg_side *side);
void rg_side_close(struct rg_side *side);

// Takes the failure that was just met and writes its line to `why`. *is_ours tells whether it is of
// raingauge, its input or the machine's set-up; then no expectation of a driver applies.
enum rg_outcome rg_side_failure(bool *is_ours, char *why, size_t size);

// Launches a side for the first time, and notes what that showed.
void rg_side_look(struct rg_side *side);
// Whether all devices that `require` names are there; NULL: none are required. For each missing
// one, logs a line and adds a case "required.vulkan" to the report, so that it shows on a CI's
// page. Sides without a name are left out.
bool rg_sides_have(const struct rg_side *sides, int count, const char *require,
                   struct rg_report *report);

// Adds the case of a missing required side, with the last error as its message; NULL: no side has
// that name. False.
bool rg_side_is_missing(const char *name, const struct rg_side *side, struct rg_report *report);

// Whether no name is listed twice: cells of a device listed twice would share a name. False, and
// one logged line, also for a bad name.
bool rg_sides_are_apart(const char *names);

#endif
