#include "harness/compare/gate/sides/alike.h"

#include <inttypes.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "core/base/log.h"
#include "core/base/memory.h"
#include "core/image/compare/compare.h"
#include "harness/compare/blame/blame.h"
#include "harness/compare/gate/pictures/pictures.h"
#include "harness/devices/frames/frame.h"
#include "harness/record/named.h"

void rg_agreement_code(const struct rg_agreement *agreement, char code[RG_AGREEMENT_CODE])
{
    size_t used = 0;
    *code = 0;
    for (int side = 0; side < RG_SIDES; side++) {
        const struct rg_session_code *of = &agreement->code[side];
        used += (size_t)snprintf(code + used, RG_AGREEMENT_CODE - used,
                                 "%s%s %016" PRIx64 " %016" PRIx64, side ? ", " : "", of->program,
                                 of->libraries, of->passes.hash);
    }
}

bool rg_agreement_differs(struct rg_agreement *agreement, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    agreement->outcome = RG_FAIL;
    vsnprintf(agreement->message, RG_AGREEMENT_TEXT, format, args);
    va_end(args);
    return false;
}

bool rg_agreement_fails(struct rg_agreement *agreement, const char *device)
{
    const struct rg_failure failure = rg_failure_take();
    agreement->outcome = failure.outcome;
    agreement->is_ours = failure.fault != RG_FAULT_DRIVER && failure.fault != RG_FAULT_NONE;
    agreement->device = device;
    rg_text_copy(agreement->message, RG_AGREEMENT_TEXT, failure.line);
    return false;
}

bool rg_agreement_blame(const struct rg_gate_cell *cell, struct rg_device *device,
                        struct rg_device *truth, struct rg_agreement *agreement)
{
    const struct rg_digest_run run = {{cell->technique, cell->settings, cell->width, cell->height},
                                      cell->frames};
    struct rg_blame blame;
    const bool ok = rg_blame_find(&run, device, truth, &blame);
    if (ok && blame.found)
        snprintf(agreement->details, RG_AGREEMENT_TEXT, "%s", blame.text);
    return ok;
}

// A cell without rain would pass whatever a device draws. This is the cell's fault, not a
// difference.
static bool shows_nothing(const struct rg_gate_cell *cell, struct rg_device *device,
                          struct rg_agreement *agreement)
{
    const struct rg_subject subject = {cell->technique, cell->settings, cell->width, cell->height};
    agreement->outcome = RG_NOTHING;
    agreement->is_ours = true;
    rg_frame_tell_dry(device, &subject, cell->frames, 1, "FRAMES", agreement->message);
    return false;
}

// Also reports the strictest tier that the picture would pass, for a looser expectation.
static bool picture_differs(const struct rg_tiers *tiers, enum rg_tier owed, const char *truth,
                            struct rg_agreement *agreement)
{
    char holds[RG_TIERS_TEXT];
    rg_tiers_text(tiers, holds);
    agreement->truth = truth;
    agreement->would_hold = rg_tiers_strictest(tiers);
    return rg_agreement_differs(agreement, "the picture differs: %s; %s", tiers->of[owed].why,
                                holds);
}

bool rg_alike_has_room(const struct rg_gate_cell *cell, struct rg_agreement *agreement)
{
    enum { PICTURES = 5 }; // three, a worker's copy of the third, and the comparison's planes
    char begin[64];
    const int64_t bytes = rg_pictures_bytes(cell->width, cell->height, PICTURES);
    if (rg_memory_allows(bytes))
        return true;
    snprintf(begin, sizeof(begin), "a comparison of %dx%d pixels", cell->width, cell->height);
    rg_memory_refuse(begin, bytes, "a cell with a smaller picture");
    return rg_agreement_fails(agreement, NULL);
}

bool rg_alike_pictures(const struct rg_gate_cell *cell, struct rg_device *device, enum rg_tier owed,
                       const struct rg_drawn *a, const struct rg_drawn *b,
                       struct rg_agreement *agreement)
{
    const struct rg_subject subject = {cell->technique, cell->settings, cell->width, cell->height};
    struct rg_picture dry = {0};
    struct rg_comparison c = {0};
    if (!rg_frame_draw_dry(device, &subject, cell->frames, &dry))
        return rg_agreement_fails(agreement, a->name);
    bool ok = rg_compare(&a->picture, a->name, &b->picture, b->name, &dry,
                         &(struct rg_compare_options){0}, &c);
    if (!ok) {
        rg_agreement_fails(agreement, a->name);
    } else if (rg_comparison_outcome(&c, owed) == RG_NOTHING) {
        ok = shows_nothing(cell, device, agreement);
    } else {
        agreement->pixels = (double)c.metrics.differing_pixels;
        agreement->difference = c.tiers.max_codes;
        ok = c.tiers.of[owed].holds || picture_differs(&c.tiers, owed, a->name, agreement);
        if (!ok && agreement->folder)
            agreement->has_pictures = rg_gate_pictures_write(agreement->folder, agreement->name,
                                                             &a->picture, &b->picture, &c);
    }
    rg_comparison_destroy(&c);
    rg_picture_destroy(&dry);
    return ok;
}

bool rg_alike_counters(const struct rg_counters *a, const struct rg_counters *b,
                       struct rg_agreement *agreement)
{
    if (a->count != b->count)
        return rg_agreement_differs(agreement, "there are %d and %d counters", a->count, b->count);
    for (int i = 0; i < a->count; i++) {
        const struct rg_count *one = &a->counters[i], *other = &b->counters[i];
        if (strcmp(one->name, other->name) != 0)
            return rg_agreement_differs(agreement, "a counter is '%s' and '%s'", one->name,
                                        other->name);
        if (one->value != other->value)
            return rg_agreement_differs(agreement, "the counter '%s' is %lld and %lld", one->name,
                                        (long long)one->value, (long long)other->value);
    }
    return true;
}

bool rg_alike_work(const struct rg_tally *a, const struct rg_tally *b,
                   struct rg_agreement *agreement)
{
    for (int i = 0; i < RG_TALLY_FIELDS; i++) {
        const struct rg_tally_field *field = &rg_tally_fields[i];
        int64_t counts[2];
        memcpy(&counts[0], (const char *)a + field->offset, sizeof(int64_t));
        memcpy(&counts[1], (const char *)b + field->offset, sizeof(int64_t));
        if (strcmp(field->name, "dispatches") && counts[0] >= 0 && counts[1] >= 0 &&
            counts[0] != counts[1])
            return rg_agreement_differs(agreement, "a frame has %lld and %lld %s",
                                        (long long)counts[0], (long long)counts[1], field->name);
    }
    return true;
}
