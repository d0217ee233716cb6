// Compares the pictures of two runs of a cell by a tier.
#ifndef RG_HARNESS_COMPARE_GATE_SIDES_ALIKE_H
#define RG_HARNESS_COMPARE_GATE_SIDES_ALIKE_H

#include "core/base/outcome.h"
#include "core/image/picture.h"
#include "core/device/device.h"
#include "harness/compare/gate/cells/cells.h"
#include "harness/compare/gate/sides/sides.h"
#include "harness/devices/frames/session.h"
#include "harness/record/record.h"

enum { RG_AGREEMENT_TEXT = 640 };

struct rg_agreement {
    enum rg_outcome outcome; // OK: they agree; fail: they differ; else why they were not compared
    bool is_ours;            // the reason was input, memory or the cell itself, not a driver
    const char *device;      // the side that failed alone; NULL: it concerns both
    char message[RG_AGREEMENT_TEXT]; // why, in one line; if they agree, a remark or ""
    char details[RG_AGREEMENT_TEXT]; // the first stage whose bits differ; ""
    // Folder and name for pictures that differ (harness/compare/gate/pictures/); NULL: none are
    // written. has_pictures: some have been.
    const char *folder, *name;
    bool has_pictures;
    // If pictures differ: the name of the device whose picture counts as true, which outlives the
    // gate and is not owned; and the strictest tier that the pictures pass, RG_TIER_COUNT: none.
    const char *truth;
    int would_hold;
    bool has_code;                         // `code` is known and can be reported
    struct rg_session_code code[RG_SIDES]; // of a side that runs alone, B's
    double pixels,
        difference; // count of differing pixels, largest difference of a channel; NAN: not compared
};

// Ends the agreement with a difference. False.
bool rg_agreement_differs(struct rg_agreement *agreement, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
// Ends the agreement with the last error, which happened on `device`. False.
bool rg_agreement_fails(struct rg_agreement *agreement, const char *device);

// A cell's picture and the device that drew it.
struct rg_drawn {
    const char *name; // of the device; that of `a` outlives the agreement
    struct rg_device *device;
    struct rg_picture picture;
};
// Whether memory suffices for both pictures, for one without rain, and to compare them.
bool rg_alike_has_room(const struct rg_gate_cell *cell, struct rg_agreement *agreement);
// Compares b with a by the tier that their devices owe each other. The picture without rain, which
// shows where it rains, is drawn on the device of a. Returns whether they are equivalent, and has
// ended the agreement if they are not.
bool rg_alike_pictures(const struct rg_gate_cell *cell, const struct rg_drawn *a,
                       const struct rg_drawn *b, struct rg_agreement *agreement);

struct rg_counters {
    int count;
    struct rg_count counters[RG_MAX_COUNTERS];
};

#endif
