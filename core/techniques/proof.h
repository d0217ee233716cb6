// What `raingauge verify` proves a technique with: scenes to run it on, laws that its state obeys,
// and small changes of the model that a comparison of images must notice. Data, one a technique.
#ifndef RG_CORE_TECHNIQUES_PROOF_H
#define RG_CORE_TECHNIQUES_PROOF_H

#include <stdbool.h>
#include <stddef.h>

struct rg_instance;

enum { RG_POSE_LEFT_OUT = -1 };

// A scene of verify. It takes so many steps with --full and with --quick; 0: as many as verify
// takes of its own, RG_POSE_LEFT_OUT: it is not run. With neither it takes a part of the full ones.
struct rg_pose {
    const char *set; // "panes=mirror"
    int full_steps, quick_steps;
};

// A law that the state obeys on every device, whatever happened before.
struct rg_law {
    const char *name; // "conservation"
    // Whether it holds now; else `detail` says in one line what is wrong.
    bool (*holds)(const struct rg_instance *instance, char *detail, size_t size);
};

// A model that is a little off: a numeric parameter becomes value * factor + offset, which is
// within its range and not the value itself.
struct rg_mutant {
    const char *about; // "one drop fewer"
    const char *param;
    double factor, offset;
};

// A mutant in a scene of its own, or one that no factor makes: `truth` is assigned over the
// defaults, and the mutant has `mutant` over both.
struct rg_contrast {
    const char *about;  // "culling turned round"
    const char *truth;  // "scene=mesh"
    const char *mutant; // "cull=front"
};

// Assignments are "key=value key=value", "" for none; they go over what the user sets.
struct rg_proof {
    const struct rg_pose *poses;     // the last has no assignments, which is NULL
    const char *dry;                 // takes all rain away: the background of the rain mask
    const char *mutant_scene;        // over the defaults, where the mutants are drawn; NULL: none
    const struct rg_law *laws;       // the last has no name
    const struct rg_mutant *mutants; // likewise, no about
    const struct rg_contrast *contrasts; // likewise; NULL: none
};

#endif
