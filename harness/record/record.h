// A record: what running one cell of a table leaves behind, as plain data. It holds no pointer and
// no open device, so that it outlives the job that made it (harness/measure/job.h), and can come
// from a file or another process.
#ifndef RG_HARNESS_RECORD_RECORD_H
#define RG_HARNESS_RECORD_RECORD_H

#include "backends/backend.h"
#include "core/base/outcome.h"
#include "core/device/work.h"
#include "harness/record/named.h"
#include "harness/record/stats.h"

enum {
    // Passes of so many names are told apart; what all others take is summed as "other".
    RG_MAX_PASS_TIMES = 64,
    RG_MAX_SAMPLES = 256,
    RG_MAX_COUNTED = 4,
    RG_MAX_VALUES = 10, // what tells a row from others, and what the paper printed of it
    RG_SET_SIZE = 1024,
    RG_DETAIL_SIZE = 200,
};

struct rg_pass_time {
    char name[RG_NAME_SIZE];
    double ms; // a frame, in a run of its own that syncs after every pass
};

// How far a row's image is from the table's truth: 8-bit encoded, over the rain mask and the whole.
struct rg_truth_error {
    enum rg_outcome outcome;
    double flip_mask_mean, flip_mean; // 0 the same, 1 as different as can be
    int max_codes;                    // largest difference, of 255
    char detail[RG_DETAIL_SIZE];      // why the outcome is not OK
};

struct rg_record {
    // What it is of
    char technique[RG_NAME_SIZE];
    char variant[RG_NAME_SIZE]; // what is timed: "full"
    char work[RG_NAME_SIZE];    // "paper", "ours" or "queries"; "" in tables that do not tell them
                                // apart
    char set[RG_SET_SIZE];      // the parameters that are set, as --set takes each
    struct rg_device_info device; // a copy; read back, it has no limits
    int row_count;
    struct rg_named row[RG_MAX_VALUES]; // what tells its row from others: names, then numbers
    int published_count;
    struct rg_named published[RG_MAX_VALUES]; // what the paper printed: "fps" and others
    // How it ended
    enum rg_outcome outcome;
    char detail[RG_DETAIL_SIZE];       // why the outcome is not OK
    struct rg_truth_error truth_error; // where the table has a truth; the same on every device
    // What was measured
    double create_ms;      // opening: buffers, inputs, and what the driver compiles then
    double first_frame_ms; // the first step and drawing, with what the driver compiles then
    int frames_a_sample, sample_count;
    int wanted_samples;                // so many are to be taken; until then the cell is not whole
    double samples_ms[RG_MAX_SAMPLES]; // a frame, in the order in which they were taken
    struct rg_interval frame_ms;       // of the samples
    double api_over_wall; // the API's own clock by wall clock; trusted from 0.8 to 1.05
    // What the calibration's load took when the samples were begun and ended; 0: unknown.
    double calibration_begin_ms, calibration_end_ms;
    int pass_frames; // of the run in which passes are told apart
    int pass_count;
    struct rg_pass_time passes[RG_MAX_PASS_TIMES]; // each name once, in the order of the frame
    // What its instance told, after the frames before the image is compared
    int counter_count;
    struct rg_count counters[RG_MAX_COUNTERS];
    int fact_count;
    struct rg_named facts[RG_MAX_FACTS];
    bool has_tally;
    struct rg_tally tally; // of one frame, the one behind those
    int counted_count;
    // What counters grew by in that frame: those that the table has columns for.
    struct rg_count counted[RG_MAX_COUNTED];
};

// The counts of a tally, by the names that documents have for them.
struct rg_tally_field {
    const char *name;
    size_t offset; // of an int64_t in struct rg_tally
};
enum { RG_TALLY_FIELDS = 10 };
extern const struct rg_tally_field rg_tally_fields[RG_TALLY_FIELDS];
// An object of them; what a device cannot count is null. The caller owns it.
json_t *rg_tally_json(const struct rg_tally *tally);

// Ends the record with an outcome other than OK, for the reason `detail`. Returns false, so that a
// caller can end with it.
bool rg_record_end(struct rg_record *record, enum rg_outcome outcome, const char *detail);
// The same with the failure that was just met (rg_failure_take).
bool rg_record_end_by_error(struct rg_record *record);

// Rounds the record's numbers to the digits that a document keeps, and makes frame_ms of its
// samples. So a record prints the same before it is written as after it is read back.
void rg_record_settle(struct rg_record *record);

// Whether nothing of it is left to measure: it ended, or all its samples are taken, and its passes
// were told apart.
bool rg_record_is_whole(const struct rg_record *record);
// Frames a second: 1000 over the median of its frame_ms.
double rg_record_fps(const struct rg_record *record);
// What the calibration's load took while it was measured, on average; 0: unknown.
double rg_record_load_ms(const struct rg_record *record);
// By how much the machine was slower, or faster, while one was measured than while the other was,
// as their calibration tells: at least 1; 1 where that is unknown.
double rg_record_drift(const struct rg_record *a, const struct rg_record *b);
// What all its passes take together, in the run that syncs after every pass.
double rg_record_passes_ms(const struct rg_record *record);
// The frame rate in print; NAN where none is.
double rg_record_published_fps(const struct rg_record *record);
// The lowest and the highest frame rate in print, where that printed times from `ms_per_frame_min`
// to `ms_per_frame_max`; else both are the one above.
void rg_record_published_range(const struct rg_record *record, double *low, double *high);
// Whether it drew so many more or fewer particles than the paper printed, 1.2 times, that it is no
// measure of what was printed; `*apart` (NULL: not wanted) gets the ratio, at least 1.
bool rg_record_is_other_work(const struct rg_record *record, double *apart);
// What its row is called: "glass with bunny", "texture_px 128", "local_height_m 5, camera 1", "all,
// merge on". A name comes first, and without the name of its column.
void rg_record_row_name(const struct rg_record *record, char *text, size_t size);

#endif
