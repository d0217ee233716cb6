#include "harness/measure/messages.h"

#include <limits.h>

// Beyond any time in ms or us, any ratio of times and any rate of a device, and far from infinity.
static const double most = 1e18;

// --- the probe: names and kinds of its operations are the same in both processes ---

void rg_put_probe(struct rg_message *message, const struct rg_probe_result results[RG_PROBE_COUNT])
{
    for (int i = 0; i < RG_PROBE_COUNT; i++) {
        rg_put_int(message, results[i].compared);
        rg_put_int(message, results[i].different);
        rg_put_int(message, results[i].largest_ulps);
    }
}

bool rg_take_probe(struct rg_message *message, struct rg_probe_result results[RG_PROBE_COUNT])
{
    rg_probe_name(results);
    for (int i = 0; i < RG_PROBE_COUNT; i++) {
        struct rg_probe_result *result = &results[i];
        result->compared = rg_take_index(message, RG_PROBE_INPUTS + 1);
        result->different = rg_take_index(message, result->compared + 1);
        const int64_t ulps = rg_take_int(message);
        result->largest_ulps = (uint32_t)ulps;
        // Zeros of unlike signs differ by nothing; what does not differ has no distance.
        if (ulps < 0 || ulps > UINT32_MAX || result->compared != RG_PROBE_INPUTS ||
            (ulps && !result->different))
            rg_message_fail(message);
    }
    return !message->failed;
}

// --- the timer ---

void rg_put_audit(struct rg_message *message, const struct rg_timer_audit *audit)
{
    rg_put_int(message, audit->passes);
    rg_put_int(message, audit->has_timer);
    RG_PUT(message, audit->wall_ms);
    RG_PUT(message, audit->api_ms);
    RG_PUT(message, audit->ratio);
    RG_PUT(message, audit->sync_us);
    RG_PUT(message, audit->dispatch_us);
    RG_PUT(message, audit->round_trip_us);
}

bool rg_take_audit(struct rg_message *message, struct rg_timer_audit *audit)
{
    *audit = (struct rg_timer_audit){.passes = rg_take_index(message, INT_MAX)};
    audit->has_timer = rg_take_index(message, 2);
    audit->wall_ms = rg_take_number(message, 0, most);
    audit->api_ms = rg_take_number(message, -most, most); // a bad timer may go backwards
    audit->ratio = rg_take_number(message, -most, most);
    audit->trusted = audit->has_timer && rg_timer_is_trusted(audit->ratio);
    audit->sync_us = rg_take_number(message, 0, most);
    audit->dispatch_us = rg_take_number(message, 0, most);
    audit->round_trip_us = rg_take_number(message, 0, most);
    return (audit->passes && !message->failed) || rg_message_fail(message);
}

// --- ceilings ---

void rg_put_ceilings(struct rg_message *message, const struct rg_ceilings *ceilings)
{
    RG_PUT(message, ceilings->memory_gb_s);
    RG_PUT(message, ceilings->cache_gb_s);
    RG_PUT(message, ceilings->arithmetic_gop_s);
}

bool rg_take_ceilings(struct rg_message *message, struct rg_ceilings *ceilings)
{
    ceilings->memory_gb_s = rg_take_number(message, 0, most);
    ceilings->cache_gb_s = rg_take_number(message, 0, most);
    ceilings->arithmetic_gop_s = rg_take_number(message, 0, most);
    return !message->failed;
}
