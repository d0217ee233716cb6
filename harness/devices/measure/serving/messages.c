#include "harness/devices/measure/serving/messages.h"

#include <limits.h>

#include "core/device/probe.h"
#include "harness/devices/measure/ceilings.h"
#include "harness/devices/measure/drawing.h"
#include "harness/devices/measure/timer_audit.h"

// Larger than any time in ms or us, any ratio of times and any rate, yet far from infinity.
#define MOST INT64_C(1000000000000000000)

// Zeros of opposite sign have distance 0 but different bits; equal results have no distance.
static bool is_result(const void *all)
{
    const struct rg_probe_result *result = all;
    return result->different || !result->largest_ulps;
}

static const struct rg_field result_fields[] = {
    RG_FIELD_INTEGER(struct rg_probe_result, compared, RG_PROBE_INPUTS, RG_PROBE_INPUTS),
    RG_FIELD_INTEGER(struct rg_probe_result, different, 0, RG_PROBE_INPUTS),
    RG_FIELD_BYTES(struct rg_probe_result, largest_ulps),
    RG_FIELD_CHECK(is_result),
    RG_FIELDS_END,
};

const struct rg_field rg_probe_fields[] = {
    {RG_KIND_STRUCT, 0, sizeof(struct rg_probe_result), .entries = RG_PROBE_COUNT,
     .of = result_fields},
    RG_FIELDS_END,
};

static const struct rg_field drawn_fields[] = {
    RG_FIELD_INTEGER(struct rg_drawn, format, RG_FORMAT_NONE + 1,
                     RG_RGBA32F), // formats that can be drawn to
    RG_FIELD_INTEGER(struct rg_drawn, differing, 0, RG_DRAWING_PIXELS),
    RG_FIELDS_END,
};

const struct rg_field rg_drawing_fields[] = {
    RG_FIELD_SOME(struct rg_drawing, formats, count, drawn_fields),
    RG_FIELD_NUMBER(struct rg_drawing, ms, 0, MOST),
    RG_FIELDS_END,
};

const struct rg_field rg_audit_fields[] = {
    RG_FIELD_INTEGER(struct rg_timer_audit, passes, 1, INT_MAX),
    RG_FIELD_FLAG(struct rg_timer_audit, has_timer),
    RG_FIELD_NUMBER(struct rg_timer_audit, wall_ms, 0, MOST),
    RG_FIELD_NUMBER(struct rg_timer_audit, api_ms, -MOST, MOST), // a bad timer may run backwards
    RG_FIELD_NUMBER(struct rg_timer_audit, ratio, -MOST, MOST),
    RG_FIELD_NUMBER(struct rg_timer_audit, sync_us, 0, MOST),
    RG_FIELD_NUMBER(struct rg_timer_audit, dispatch_us, 0, MOST),
    RG_FIELD_NUMBER(struct rg_timer_audit, round_trip_us, 0, MOST),
    RG_FIELDS_END,
};

const struct rg_field rg_ceilings_fields[] = {
    RG_FIELD_NUMBER(struct rg_ceilings, memory_gb_s, 0, MOST),
    RG_FIELD_NUMBER(struct rg_ceilings, cache_gb_s, 0, MOST),
    RG_FIELD_NUMBER(struct rg_ceilings, arithmetic_gop_s, 0, MOST),
    RG_FIELDS_END,
};
