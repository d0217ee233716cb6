#include "harness/compare/gate/sides/alike.h"

#include <stdarg.h>
#include <stdio.h>

#include "core/base/log.h"
#include "core/base/memory.h"
#include "core/image/compare/compare.h"
#include "harness/compare/gate/pictures/pictures.h"
#include "harness/devices/frames/frame.h"

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
    agreement->outcome =
        rg_side_failure(&agreement->is_ours, agreement->message, RG_AGREEMENT_TEXT);
    agreement->device = device;
    return false;
}

// A cell without rain would pass whatever a device draws. This is the cell's fault, not a
// difference.
static bool shows_nothing(const struct rg_gate_cell *cell, struct rg_device *device,
                          struct rg_agreement *agreement)
{
    agreement->outcome = RG_NOTHING;
    agreement->is_ours = true;
    rg_frame_tell_dry(device, &cell->subject, cell->frames, 1, "FRAMES", agreement->message);
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
    const int64_t bytes = rg_pictures_bytes(cell->subject.width, cell->subject.height, PICTURES);
    if (rg_memory_allows(bytes))
        return true;
    snprintf(begin, sizeof(begin), "a comparison of %dx%d pixels", cell->subject.width,
             cell->subject.height);
    rg_memory_refuse(begin, bytes, "a cell with a smaller picture");
    return rg_agreement_fails(agreement, NULL);
}

bool rg_alike_pictures(const struct rg_gate_cell *cell, const struct rg_drawn *a,
                       const struct rg_drawn *b, struct rg_agreement *agreement)
{
    const enum rg_tier owed = rg_tier_owed(&a->device->info, &b->device->info);
    struct rg_picture dry = {0};
    struct rg_comparison c = {0};
    if (!rg_frame_draw_dry(a->device, &cell->subject, cell->frames, &dry))
        return rg_agreement_fails(agreement, a->name);
    bool ok = rg_frame_compare(b->device, &cell->subject, cell->frames, &a->device->info,
                               &a->picture, &dry, &b->picture, &c);
    if (!ok) {
        rg_agreement_fails(agreement, a->name);
    } else if (rg_comparison_outcome(&c, owed) == RG_NOTHING) {
        ok = shows_nothing(cell, a->device, agreement);
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
