// A job: the live side of a cell, a technique with parameters open on a device. It is first
// checked, then timed; results go into its record (harness/record/record.h).
#ifndef RG_HARNESS_DEVICES_MEASURE_JOB_H
#define RG_HARNESS_DEVICES_MEASURE_JOB_H

#include "harness/devices/frames/session.h"
#include "harness/devices/measure/expected.h"
#include "harness/devices/measure/others.h"
#include "harness/record/record.h"

struct rg_job {
    // Inputs:
    struct rg_subject subject;
    struct rg_device *device;
    int check_frames; // simulated before the image is compared, at least 1
    // Frames after the check frames that are timed, repeatedly from sessions opened anew; 0: any
    // later frames. So a technique whose frames change over time, as water gathers, is timed at one
    // age.
    int window_frames;
    const char *const *counted; // counters whose growth in a frame is recorded; NULL: none
    struct rg_record *record;   // not owned; its outcome tells whether the job can go on
    // Results:
    struct rg_session *session;
    double warm_frame_ms; // time of the warm-up's last frame
};

struct rg_measure_options {
    int most_samples, least_samples; // samples of a job; at most RG_MAX_SAMPLES
    double sample_ms;                // least duration of a sample
    double job_ms;                   // limit for all samples of a job
    double warm_up_ms;               // limit for its warm-up
    int warm_up_frames;              // and its least number of frames
    double passes_ms;                // limit for the run that times passes
    // Takes samples up to this share of all, so that the job can be visited again; 0: all.
    double share;
    void (*load)(void); // timed between rounds, to show drift of the machine; NULL: none
    // Reads how much others take of the machine (harness/devices/measure/others.h); NULL: unknown.
    rg_watch *watch;
    double end_ms; // deadline by rg_now_ms for taking disturbed samples again; 0: no limit
    // Called with the share of the expected time of a call that has passed; NULL: not called.
    void (*progress)(double share, void *user);
    void *user;
};

// A job is prepared by these four functions in order. Each returns false when the job cannot go on,
// and then has ended its record.
//
// Opens the session, simulates its check frames, and draws the first and the last.
bool rg_job_open(struct rg_job *job);
// Compares the image, which must meet the device's tier; uses the rain mask if `expected` has the
// background.
bool rg_job_check(struct rg_job *job, const struct rg_expected *expected);
// Counts the work of the next frame, and the growth of counters in it.
bool rg_job_count(struct rg_job *job);
bool rg_job_warm_up(struct rg_job *job, const struct rg_measure_options *options);

// Reopens a job's session up to its check frames in three cases: it is closed, its worker has
// crashed in another job's call, or this many more frames would exceed the window. Ends the record
// on failure.
bool rg_job_be_ready(struct rg_job *job, int frames);
// The wall time of each of some frames, between full syncs. Ends the record on failure.
double rg_job_time(struct rg_job *job, int frames);

// Closes its session.
void rg_job_close(struct rg_job *job);

#endif
