// A job: the live side of a cell, a technique with parameters open on a device. It is checked first
// and then timed, and what comes of it goes into its record (harness/record/record.h).
#ifndef RG_HARNESS_MEASURE_JOB_H
#define RG_HARNESS_MEASURE_JOB_H

#include "harness/frames/session.h"
#include "harness/measure/expected.h"
#include "harness/record/record.h"

struct rg_job {
    // Given:
    struct rg_subject subject;
    struct rg_device *device;
    int check_frames; // simulated and drawn before the image is compared, at least 1
    // Timed are so many frames behind the check frames, over and over from a session opened anew;
    // 0: whatever follows. A technique whose frames differ from what they were when it began, as
    // water gathers, is timed at one age.
    int window_frames;
    const char *const *counted; // counters whose growth in a frame is kept; NULL: none
    struct rg_record *record;   // not owned; its outcome says whether the job goes on
    // Found:
    struct rg_session *session;
    double warm_frame_ms; // the last frame of the warm-up
};

struct rg_measure_options {
    int most_samples, least_samples; // a job; at most RG_MAX_SAMPLES
    double sample_ms;                // least duration of a sample
    double job_ms;                   // what a job's samples may take together
    double warm_up_ms;               // likewise its warm-up
    int warm_up_frames;              // of which it has at least so many
    double passes_ms;                // likewise the run in which passes are told apart
    // The samples are taken up to this share of all, so that a job can be visited again; 0: all.
    double share;
    void (*load)(void); // timed between rounds, to tell how the machine drifts; NULL: nothing is
    // Told the share of what a call takes that is done, by what it is expected to take; NULL:
    // nobody asks.
    void (*progress)(double share, void *user);
    void *user;
};

// Preparing a job is these four in turn. Each returns false when it cannot go on, and has ended
// its record.
//
// Opens it, simulates its check frames, and draws the first and the last.
bool rg_job_open(struct rg_job *job);
// Compares its image, which must hold the tier that its device owes; by the rain mask where
// `expected` has the background.
bool rg_job_check(struct rg_job *job, const struct rg_expected *expected);
// Counts the work of the next frame, and what counters grow by in it.
bool rg_job_count(struct rg_job *job);
bool rg_job_warm_up(struct rg_job *job, const struct rg_measure_options *options);

// Opens a job's session anew, up to its check frames, where it is closed, where another job's call
// has brought its worker down, or where so many more frames would leave its window. Ends the record
// on failure.
bool rg_job_be_ready(struct rg_job *job, int frames);
// The time that each of some frames takes by wall clock, between full syncs. Ends the record on
// failure.
double rg_job_time(struct rg_job *job, int frames);

// Closes its session.
void rg_job_close(struct rg_job *job);

#endif
