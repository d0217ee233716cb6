#include "harness/compare/gate/sides/sides.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/devices/names.h"
#include "harness/record/named.h"

bool rg_side_launch(struct rg_side *side)
{
    rg_side_close(side);
    side->device = rg_devices_open_one(side->name);
    side->was_lacking |= !side->device && rg_failure_take().outcome == RG_LACKING;
    return side->device != NULL;
}

void rg_side_close(struct rg_side *side)
{
    side->was_closed_badly = !rg_device_close(side->device) || side->was_closed_badly;
    side->device = NULL;
}

enum rg_outcome rg_side_failure(bool *is_ours, char *why, size_t size)
{
    const struct rg_failure failure = rg_failure_take();
    *is_ours = failure.fault != RG_FAULT_DRIVER && failure.fault != RG_FAULT_NONE;
    rg_text_copy(why, size, failure.line);
    return failure.outcome;
}

void rg_side_look(struct rg_side *side)
{
    side->is_name = side->is_there = true;
    if (rg_side_launch(side)) {
        side->info = side->device->info;
        return;
    }
    const struct rg_failure failure = rg_failure_take();
    rg_text_copy(side->why, sizeof(side->why), failure.line);
    side->is_name = failure.fault != RG_FAULT_INPUT;
    side->is_there = failure.outcome != RG_UNSUPPORTED;
}

bool rg_side_is_missing(const char *name, const struct rg_side *side, struct rg_report *report)
{
    char text[RG_DEVICE_NAME_SIZE + 16];
    snprintf(text, sizeof(text), "required.%s", name);
    rg_report_add(report, &(struct rg_report_case){.name = text,
                                                   .devices = side ? &side->name : NULL,
                                                   .device_count = side != NULL,
                                                   .ending = RG_ENDING_ERROR,
                                                   .message = rg_last_error(),
                                                   .details = side ? side->why : NULL,
                                                   RG_UNMEASURED});
    return false;
}

// A device that is there does not make up for a missing one of the same API, because the two are
// compared with each other.
static bool is_there(const struct rg_side *sides, int count, const char *name,
                     struct rg_report *report)
{
    bool any = false;
    for (int i = 0; i < count; i++) {
        if (!sides[i].name || !rg_device_is_of(sides[i].name, name))
            continue;
        if (!sides[i].is_there) {
            rg_driver_error("--require %s: '%s' is not there", name, sides[i].name);
            return rg_side_is_missing(name, &sides[i], report);
        }
        any = true;
    }
    if (any)
        return true;
    rg_driver_error("--require %s: it is not among the devices of this gate", name);
    return rg_side_is_missing(name, NULL, report);
}

bool rg_sides_are_apart(const char *names)
{
    struct rg_device_name name, other;
    while (*names) {
        if (!rg_device_name_read(&names, &name))
            return false;
        for (const char *rest = names; *rest;)
            if (!rg_device_name_read(&rest, &other))
                return false;
            else if (!strcmp(name.name, other.name))
                return rg_error("--device: '%s' stands there twice; name it once", name.name);
    }
    return true;
}

bool rg_sides_have(const struct rg_side *sides, int count, const char *require,
                   struct rg_report *report)
{
    struct rg_device_name name;
    bool all = true;
    while (require && *require) {
        if (!rg_device_name_read(&require, &name))
            return false;
        all = is_there(sides, count, name.name, report) && all;
    }
    return all;
}
