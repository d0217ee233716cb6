// The parts of `raingauge verify`, for one technique.
#ifndef RG_HARNESS_COMPARE_VERIFY_VERIFY_H
#define RG_HARNESS_COMPARE_VERIFY_VERIFY_H

#include "harness/compare/verify/checks.h"
#include "harness/console/progress.h"
#include "harness/devices/devices.h"
#include "harness/devices/frames/session.h"

enum { RG_VERIFY_SEEDS = 3 };

// How much of a proof is run. Mutants are the same in each.
enum rg_verify_length {
    RG_VERIFY_USUAL, // every pose, for a part of its steps; seeds in turn
    RG_VERIFY_QUICK, // poses not left out of quick runs, for their quick steps; seeds in turn
    RG_VERIFY_FULL,  // every pose, for all its steps, with every seed
};

// Cases on all devices, or mutants: each phase has a pace of its own, for the time left. Units are
// those of the progress bar.
struct rg_verify_phase {
    int64_t left, done;       // `done` without the first case, during which drivers compile
    int64_t bar;              // the bar's units after the latest case
    double first_ms, last_ms; // when the first and the latest case ended; 0: none has
};

struct rg_verify {
    const struct rg_technique *technique;
    const void *settings; // the user's
    int width, height;    // of the image
    enum rg_verify_length length;
    int steps;                        // of every pose; -1: each pose's own
    struct rg_device *reference;      // with which the others are compared
    const struct rg_devices *devices; // may include the reference, which is then skipped
    struct rg_device *mutant_device;
    struct rg_checks *checks;
    struct rg_progress *progress;
    struct rg_verify_phase *phase; // NULL: no time left is told
};

// Begins a phase of so many units, and says that some of them are done.
void rg_verify_begin(const struct rg_verify *verify, int64_t units);
void rg_verify_advance(const struct rg_verify *verify, int64_t units);

// A pose's number of steps before drawing; RG_POSE_LEFT_OUT if it is not run.
int rg_verify_steps(const struct rg_verify *verify, const struct rg_pose *pose);
// Whether a pose runs with a seed of RG_VERIFY_SEEDS. The first pose, and every pose in
// RG_VERIFY_FULL, runs with all seeds. Each other pose runs with one, in turn: a faulty device
// fails in some pose, and three seeds for each would cost three times as much.
bool rg_verify_has_seed(const struct rg_verify *verify, const struct rg_pose *pose, int seed);
// The number of poses that run.
int rg_verify_poses(const struct rg_verify *verify);

// The number of steps in each of the parts below, for the progress bar.
int64_t rg_verify_device_work(const struct rg_verify *verify);
int64_t rg_verify_mutant_work(const struct rg_verify *verify);
int64_t rg_verify_stage_work(const struct rg_verify *verify);

// Checks state, image and laws on every device, over seeds and poses.
void rg_verify_devices(struct rg_verify *verify);
// Checks that comparing images notices a slightly wrong model.
void rg_verify_mutants(struct rg_verify *verify);

// The mutants that a tier would accept.
enum { RG_MUTANTS_TOLD = 64 };
struct rg_mutants_told {
    enum rg_tier tier;
    int run, alive_count;
    const char *alive[RG_MUTANTS_TOLD]; // accepted mutants, in the words of the technique's proof
};
// Draws all mutants on the mutant device. False, and one logged line, on failure.
bool rg_verify_mutants_at(const struct rg_verify *verify, enum rg_tier tier,
                          struct rg_mutants_told *told);
// Lists the accepted mutants, separated by commas; "" if there are none.
void rg_mutants_text(const struct rg_mutants_told *told, char *text, size_t size);

// Finds the first stage after which an asset's bits differ from the reference's, over poses, with
// one seed.
void rg_verify_stages(struct rg_verify *verify);

// Opens the technique on a device and simulates `steps`; the caller closes the session. NULL, with
// one logged line, on failure.
struct rg_session *rg_verify_run(struct rg_verify *verify, struct rg_device *device,
                                 const void *settings, int steps);

#endif
