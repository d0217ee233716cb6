// Whether what two runs of a cell left is alike: its picture by a tier, its counters and the work
// of a frame exactly.
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
    enum rg_outcome outcome; // OK: they agree; fail: they do not; else what kept it from being seen
    bool is_ours;            // what kept it was input, memory or the cell itself, and no driver
    const char *device;      // the side that it is about, where one alone failed; NULL: both
    char message[RG_AGREEMENT_TEXT]; // why, one line; where they agree what is to be known of it,
                                     // or ""
    char details[RG_AGREEMENT_TEXT]; // the first stage that left other bits; ""
    // Where pictures that differ are written (harness/compare/gate/pictures/), and under which
    // name; NULL: nowhere. Whether they have been.
    const char *folder, *name;
    bool has_pictures;
    // Where pictures differ: the device that drew what is held for the truth, which is not owned
    // and outlives the gate, and the strictest tier that would hold, RG_TIER_COUNT: none.
    const char *truth;
    int would_hold;
    bool has_code; // which code ran on both sides, which are held against each other
    struct rg_session_code code[RG_SIDES]; // of one that ran alone, B's
    double pixels,
        difference; // that differ, and the most a channel of them does; NAN: not compared
};

enum { RG_AGREEMENT_CODE = 512 };
// Which code ran as a text, the same where the code is.
void rg_agreement_code(const struct rg_agreement *agreement, char code[RG_AGREEMENT_CODE]);

// Ends it: they do not agree. False.
bool rg_agreement_differs(struct rg_agreement *agreement, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
// Ends it by what the last error comes to, on a device. False.
bool rg_agreement_fails(struct rg_agreement *agreement, const char *device);

// Says in the details which stage was the first to leave other bits on a device than on the one
// that is held for the truth, where one was. Whether that could be found out.
bool rg_agreement_blame(const struct rg_gate_cell *cell, struct rg_device *device,
                        struct rg_device *truth, struct rg_agreement *agreement);

// A picture of a cell, and whose it is.
struct rg_drawn {
    const char *name; // of the device; a's outlives the agreement
    struct rg_picture picture;
};
// Whether there is room for both, for one without rain, and to compare them.
bool rg_alike_has_room(const struct rg_gate_cell *cell, struct rg_agreement *agreement);
// Compares b with a by the tier that they owe each other; the picture without rain, which says
// where it rains, is drawn on `device`, which is a's. Each of these functions returns whether they
// are alike, and has else ended the agreement.
bool rg_alike_pictures(const struct rg_gate_cell *cell, struct rg_device *device, enum rg_tier owed,
                       const struct rg_drawn *a, const struct rg_drawn *b,
                       struct rg_agreement *agreement);

struct rg_counters {
    int count;
    struct rg_count counters[RG_MAX_COUNTERS];
};
bool rg_alike_counters(const struct rg_counters *a, const struct rg_counters *b,
                       struct rg_agreement *agreement);
// How many dispatches a frame has, is an API's own; what a device cannot count says nothing.
bool rg_alike_work(const struct rg_tally *a, const struct rg_tally *b,
                   struct rg_agreement *agreement);

#endif
