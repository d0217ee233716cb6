// The evidence by which `raingauge verify` proves a technique: scenes to run, laws that its state
// obeys, and small changes of the model that a comparison of images must notice. One set of data
// for each technique.
#ifndef RG_CORE_TECHNIQUES_PROOF_H
#define RG_CORE_TECHNIQUES_PROOF_H

#include <stdbool.h>
#include <stddef.h>

struct rg_instance;

enum { RG_POSE_LEFT_OUT = -1 };

// A scene of verify, and its numbers of steps with --full and with --quick; 0 takes verify's
// default, RG_POSE_LEFT_OUT skips it. Without either option it takes a part of the full number.
struct rg_pose {
    const char *set; // "panes=mirror"
    int full_steps, quick_steps;
};

// A law that the state obeys on every device, whatever happened before.
struct rg_law {
    const char *name; // "conservation"
    // Whether the law holds now. If not, `detail` says in one line what is wrong; if the state
    // cannot be read, which is logged, the result is false and `detail` stays as it is: "".
    bool (*holds)(const struct rg_instance *instance, char *detail, size_t size);
};

// A slightly wrong model: a numeric parameter becomes value * factor + offset, which must be within
// its range and differ from the value.
struct rg_mutant {
    const char *about; // "one drop fewer"
    const char *param;
    double factor, offset;
};

// A mutant with a scene of its own, or one that no factor makes: `truth` is assigned over the
// defaults, and `mutant` over both for the mutant.
struct rg_contrast {
    const char *about;  // "culling reversed"
    const char *truth;  // "scene=mesh"
    const char *mutant; // "cull=front"
};

// Assignments are "key=value key=value", "" for none; they override the user's settings.
struct rg_proof {
    const struct rg_pose *poses;     // ends with one whose `set` is NULL
    const char *dry;                 // assignments that remove all rain, for the rain mask
    const char *mutant_scene;        // assignments over the defaults for mutants; NULL: no mutants
    const struct rg_law *laws;       // ends with one without a name
    const struct rg_mutant *mutants; // ends with one without an `about`
    const struct rg_contrast *contrasts; // ends with one without an `about`; NULL: none
};

#endif
