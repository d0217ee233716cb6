// The parts of `raingauge verify`, for one technique.
#ifndef RG_HARNESS_COMPARE_VERIFY_VERIFY_H
#define RG_HARNESS_COMPARE_VERIFY_VERIFY_H

#include "harness/compare/verify/checks.h"
#include "harness/console/progress.h"
#include "harness/devices/devices.h"
#include "harness/frames/session.h"

enum { RG_VERIFY_SEEDS = 3 };

// How much of a proof is run. Its mutants are drawn alike in each.
enum rg_verify_length {
    RG_VERIFY_USUAL, // every pose, for a part of its steps, and the seeds in turn
    RG_VERIFY_QUICK, // the poses that are not left out of it, for their quick steps; seeds in turn
    RG_VERIFY_FULL,  // every pose, for all its steps, with every seed
};

struct rg_verify {
    const struct rg_technique *technique;
    const void *settings; // the user's
    int width, height;    // of the image
    enum rg_verify_length length;
    int steps;                        // of every pose; -1: as many as a pose says
    struct rg_device *reference;      // what the others are compared with
    const struct rg_devices *devices; // may hold the reference: it is not compared with itself
    struct rg_device *mutant_device;
    struct rg_checks *checks;
    struct rg_progress *progress;
};

// Steps of a pose before it is drawn; RG_POSE_LEFT_OUT where it is not run.
int rg_verify_steps(const struct rg_verify *verify, const struct rg_pose *pose);
// Whether a pose runs with a seed of RG_VERIFY_SEEDS. But for RG_VERIFY_FULL the first pose runs
// with all of them, and each other one with one, in turn: a device that errs does so in some pose,
// and three seeds of each cost three times as much.
bool rg_verify_has_seed(const struct rg_verify *verify, const struct rg_pose *pose, int seed);
// How many poses are run.
int rg_verify_poses(const struct rg_verify *verify);

// Steps that each of the parts below runs, for the progress bar.
int64_t rg_verify_device_work(const struct rg_verify *verify);
int64_t rg_verify_mutant_work(const struct rg_verify *verify);
int64_t rg_verify_stage_work(const struct rg_verify *verify);

// State, image and laws on every device, over seeds and poses.
void rg_verify_devices(struct rg_verify *verify);
// Whether the comparison of images notices a model that is a little off.
void rg_verify_mutants(struct rg_verify *verify);

// The same for those who ask which models that are a little off a tier would accept.
enum { RG_MUTANTS_TOLD = 64 };
struct rg_mutants_told {
    enum rg_tier tier;
    int run, alive_count;
    const char *alive[RG_MUTANTS_TOLD]; // what the tier accepts, in words of the technique's proof
};
// Draws all on the mutant device. False, and one logged line, on failure.
bool rg_verify_mutants_at(const struct rg_verify *verify, enum rg_tier tier,
                          struct rg_mutants_told *told);
// Those that live, in a line with commas; "" where none does.
void rg_mutants_text(const struct rg_mutants_told *told, char *text, size_t size);

// Which stage first leaves other bits in an asset than the reference, over poses, with one seed.
void rg_verify_stages(struct rg_verify *verify);

// Opens the technique on a device and simulates `steps`; the caller closes it. NULL, with one
// logged line, on failure.
struct rg_session *rg_verify_run(struct rg_verify *verify, struct rg_device *device,
                                 const void *settings, int steps);

#endif
