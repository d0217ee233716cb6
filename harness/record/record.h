// A record: the plain data of one cell of a table. Without pointers or open devices, it outlives
// the job that made it (harness/devices/measure/job.h), and may come from a file or another
// process.
#ifndef RG_HARNESS_RECORD_RECORD_H
#define RG_HARNESS_RECORD_RECORD_H

#include "backends/backend.h"
#include "core/base/outcome.h"
#include "core/base/stats.h"
#include "core/device/work.h"
#include "harness/record/named.h"

enum {
    // Passes with their own entry; the time of all others is summed as "other".
    RG_MAX_PASS_TIMES = 64,
    RG_MAX_SAMPLES = 256,
    RG_MAX_LAUNCHES = 256,
    RG_MAX_COUNTED = 4,
    RG_MAX_VALUES = 10, // a row's keys, or printed values
    RG_SET_SIZE = 1024,
    RG_DETAIL_SIZE = 200,
};

// The largest share of the processors that others may take from an undisturbed sample.
#define RG_MOST_TAKEN 0.05
// Ratio of an interval's ends from which on a number is marked.
#define RG_WIDE_INTERVAL 1.1

struct rg_pass_time {
    char name[RG_NAME_SIZE];
    double ms; // of a frame, in a separate run that syncs after every pass
};

// The error of a row's image against the table's truth: 8-bit encoded, over the rain mask and the
// whole.
struct rg_truth_error {
    enum rg_outcome outcome;
    double flip_mask_mean, flip_mean; // 0 means equal, 1 as different as possible
    int max_codes;                    // largest difference, in codes of 255
    char detail[RG_DETAIL_SIZE];      // why the outcome is not OK
};

// A launch: a new process in which the cell was timed, among the cells that it is compared with.
struct rg_launch {
    int number;     // from 1; cells with the same number were timed together
    double ms;      // of a frame
    double stolen;  // share of the processors' time that the machine gave to other machines
    double others;  // and share that other processes took
    double seconds; // that the cell took, opening included
};
// Whether others took so much of the machine that the launch does not count. The measured time
// says nothing here.
bool rg_launch_is_disturbed(const struct rg_launch *launch);

struct rg_record {
    // Identification
    char technique[RG_NAME_SIZE];
    char variant[RG_NAME_SIZE];   // the measured variant: "full"
    char work[RG_NAME_SIZE];      // "paper", "ours" or "queries"; "" in tables without works
    char set[RG_SET_SIZE];        // assignments, each as for --set
    struct rg_device_info device; // a copy; when read from a file, without limits
    int row_count;
    struct rg_named row[RG_MAX_VALUES]; // keys that identify its row: names, then numbers
    int published_count;
    struct rg_named published[RG_MAX_VALUES]; // printed values: "fps" and others
    // Outcome
    enum rg_outcome outcome;
    char detail[RG_DETAIL_SIZE];       // why the outcome is not OK
    struct rg_truth_error truth_error; // if the table has a truth; the same on every device
    // Measurements
    double create_ms;      // opening: buffers, inputs, and compiling done then
    double first_frame_ms; // first step and drawing, including compiling done then
    int frames_a_sample, sample_count;
    int wanted_samples;                // target number; with fewer the cell is incomplete
    double samples_ms[RG_MAX_SAMPLES]; // time of a frame, in the order of sampling
    bool is_watched;                   // the share that others took is known
    double taken[RG_MAX_SAMPLES];      // share of the processors that others took in each sample
    int retaken;                       // samples that were taken again because others took more
    // From launches, if at least two were undisturbed; else from the samples.
    struct rg_interval frame_ms;
    double api_over_wall; // ratio of the API's clock to the wall clock; trusted from 0.8 to 1.05
    // Times of the calibration load when sampling began and ended; 0: unknown.
    double calibration_begin_ms, calibration_end_ms;
    int launch_count;
    struct rg_launch launches[RG_MAX_LAUNCHES]; // by rising number
    int pass_frames;                            // frames of the run that times passes
    int pass_count;
    struct rg_pass_time passes[RG_MAX_PASS_TIMES]; // each name once, in the frame's order
    // The instance's facts and counters, after the check frames
    int counter_count;
    struct rg_count counters[RG_MAX_COUNTERS];
    int fact_count;
    struct rg_named facts[RG_MAX_FACTS];
    bool has_tally;
    struct rg_tally tally; // exact counts of the next frame
    int counted_count;
    // Growth of counters in that frame, for counters with a column in the table.
    struct rg_count counted[RG_MAX_COUNTED];
};

// The counts of a tally, with their names in documents.
struct rg_tally_field {
    const char *name;
    size_t offset; // of an int64_t in struct rg_tally
};
enum { RG_TALLY_FIELDS = 10 };
extern const struct rg_tally_field rg_tally_fields[RG_TALLY_FIELDS];
int64_t rg_tally_count(const struct rg_tally *tally, int field);
// A JSON object of the counts, null for unknown ones. The caller owns it.
json_t *rg_tally_json(const struct rg_tally *tally);

// Ends the record with an outcome other than OK and its reason. Returns false, for use in a return
// statement.
bool rg_record_end(struct rg_record *record, enum rg_outcome outcome, const char *detail);
// The same with the failure that was just met (rg_failure_take).
bool rg_record_end_by_error(struct rg_record *record);

// Rounds the record's numbers to the digits of documents, and computes frame_ms. So a record prints
// the same before writing and after reading.
void rg_record_settle(struct rg_record *record);

// Whether the record is complete: it ended, or all samples were taken and the passes timed.
bool rg_record_is_whole(const struct rg_record *record);
// The number of launches in which others took no more than RG_MOST_TAKEN.
int rg_record_calm_launches(const struct rg_record *record);
// The number of samples in which others took more; 0 if frame_ms is from launches.
int rg_record_disturbed(const struct rg_record *record);
// The relative uncertainty of its frame rate: half the width of the 95 % interval, by its
// logarithm. 0 if the interval is no wider than RG_WIDE_INTERVAL times.
double rg_record_noise(const struct rg_record *record);
// The mark of its number: "+-22%", "+-22% busy", "busy"; "": none.
enum { RG_MARK_SIZE = 24 };
void rg_record_mark(const struct rg_record *record, char mark[RG_MARK_SIZE]);
// Frames a second: 1000 over the median of frame_ms.
double rg_record_fps(const struct rg_record *record);
// The mean time of the calibration load during its measurement; 0: unknown.
double rg_record_load_ms(const struct rg_record *record);
// The ratio of the machine's speeds during the two measurements, from their calibration loads: at
// least 1; 1 if unknown.
double rg_record_drift(const struct rg_record *a, const struct rg_record *b);
// The sum of its passes' times, from the run that syncs after every pass.
double rg_record_passes_ms(const struct rg_record *record);
// The printed frame rate; NAN if there is none.
double rg_record_published_fps(const struct rg_record *record);
// The lowest and highest printed frame rate, if times from `ms_per_frame_min` to `ms_per_frame_max`
// are printed; else both are the one above.
void rg_record_published_range(const struct rg_record *record, double *low, double *high);
// Whether its number of particles differs from the printed one by more than a factor of 1.2, so
// that it does not measure the printed work; `*apart` (may be NULL) gets the ratio, at least 1.
bool rg_record_is_other_work(const struct rg_record *record, double *apart);
// The name of its row: "glass with bunny", "texture_px 128", "local_height_m 5, camera 1", "all,
// merge on". A name comes first, without its column's name.
void rg_record_row_name(const struct rg_record *record, char *text, size_t size);

#endif
