// What `raingauge doctor` finds out, and the two forms that it is told in.
#ifndef RG_HARNESS_DOCTOR_REPORT_H
#define RG_HARNESS_DOCTOR_REPORT_H

#include <jansson.h>

#include "core/base/outcome.h"
#include "core/device/device.h"
#include "core/device/probe.h"
#include "harness/measure/ceilings.h"
#include "harness/measure/drawing.h"
#include "harness/measure/timer_audit.h"

// One device. Holds what was found until the driver failed, if it did.
struct rg_examination {
    bool is_unknown;            // no such name: the rest says nothing but why
    enum rg_outcome status;     // fail: an operation of the kernel dialect gives other bits than C,
                                // or it draws what cpu:reference does not
    char why[512];              // in one line; "" when all is well
    struct rg_device_info info; // until `opened`, only info.name is certain
    bool opened, probed, drawn, audited, measured;
    struct rg_probe_result probe[RG_PROBE_COUNT]; // when probed
    struct rg_drawing drawing;                    // when drawn
    struct rg_timer_audit timer;                  // when audited
    struct rg_ceilings ceilings;                  // when measured
};

struct rg_doctor_report {
    struct rg_device_list list; // all devices, asked for or not, and what is missing
    int count;
    struct rg_examination *examinations; // `count` of them
    json_t *passport;                    // harness/record/passport/passport.h
    json_t *warnings;                    // array of strings
};

// Opens the device that info.name names in a worker, probes its arithmetic, draws, and audits its
// timer.
// What fails has been logged; what was found before stays.
void rg_doctor_examine(struct rg_examination *examination);

// Traps that are visible from outside: one sentence each. The caller releases the array.
json_t *rg_doctor_warnings(const struct rg_device_list *list);

// Operations of the dialect that differ.
int rg_examination_failures(const struct rg_examination *examination);

void rg_doctor_print_text(const struct rg_doctor_report *report);
void rg_doctor_print_json(const struct rg_doctor_report *report);

#endif
