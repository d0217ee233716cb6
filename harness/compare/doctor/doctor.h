// The findings of `raingauge doctor`, and their two printed forms.
#ifndef RG_HARNESS_COMPARE_DOCTOR_DOCTOR_H
#define RG_HARNESS_COMPARE_DOCTOR_DOCTOR_H

#include <jansson.h>

#include "core/base/outcome.h"
#include "core/device/device.h"
#include "core/device/probe.h"
#include "harness/devices/measure/ceilings.h"
#include "harness/devices/measure/drawing.h"
#include "harness/devices/measure/timer_audit.h"

// The findings about one device, up to the driver's failure if it failed.
struct rg_examination {
    bool is_unknown;            // there is no such name: only `why` is set
    enum rg_outcome status;     // fail: an operation of the dialect differs from C in some bits, or
                                // a drawing from cpu:reference
    char why[512];              // in one line; "" if all is well
    struct rg_device_info info; // until `opened`, only info.name is certain
    bool opened, probed, drawn, audited, measured;
    struct rg_probe_result probe[RG_PROBE_COUNT]; // when probed
    struct rg_drawing drawing;                    // when drawn
    struct rg_timer_audit timer;                  // when audited
    struct rg_ceilings ceilings;                  // when measured
};

struct rg_doctor_report {
    struct rg_device_list list; // all devices, asked for or not, and missing backends
    int count;
    struct rg_examination *examinations; // `count` of them
    json_t *passport;                    // harness/record/passport/passport.h
    json_t *warnings;                    // array of strings
};

// Opens the device in info.name in a worker, tests its arithmetic and drawing, and audits its
// timer. Failures have been logged; earlier findings remain.
void rg_doctor_examine(struct rg_examination *examination);

// Traps visible from outside the drivers, a sentence each. The caller releases the array.
json_t *rg_doctor_warnings(const struct rg_device_list *list);

// The number of differing operations of the dialect.
int rg_examination_failures(const struct rg_examination *examination);

void rg_doctor_print_text(const struct rg_doctor_report *report);
void rg_doctor_print_json(const struct rg_doctor_report *report);

#endif
