// Cells of a table, opened for a moment.
#ifndef RG_HARNESS_TABLES_RUNS_LOOK_H
#define RG_HARNESS_TABLES_RUNS_LOOK_H

#include "harness/devices/kept.h"
#include "harness/record/result.h"
#include "harness/tables/measuring/cell.h"
#include "harness/tables/runs/plan.h"
#include "harness/tables/table.h"

// The frames of a table on a device by size; or both by what they are elsewhere.
struct rg_frames {
    double open_ms, step_ms, frame_ms[RG_BUDGET_SIZES];
};

// What a technique takes on a device, by what it takes on cpu: found with its first table, for its
// tables are alike in that. Zeroed before.
struct rg_budget_kind {
    struct rg_frames by_cpu[RG_MAX_DEVICES + 1]; // the last is of cpu:reference, which checks
    bool is_known;                               // what follows, which is found on cpu
    double larger[RG_BUDGET_SIZES];     // so many times as long a frame takes as the smallest one
    double dry_share;                   // and one without rain
    bool has_truth;                     // what follows is known, too
    struct rg_cell_frames shown, truth; // an image with all that it shows, and its truth
    // Works beside the first of a table, by their settings: what they take by what that takes.
    struct rg_work_frames {
        const char *set, *first_set;
        bool is_there[RG_MAX_DEVICES]; // what a device cannot do takes nothing
        struct rg_frames by_first[RG_MAX_DEVICES];
    } works[RG_RESULT_WORKS];
    int work_count;
};

// A table, while its cells are probed.
struct rg_looking {
    const struct rg_table *table;
    struct rg_kept *kept;
    struct rg_result result;
    enum rg_budget_size smallest;
    bool rows[RG_TABLE_ROWS]; // that are looked at, on cpu
    int first, last;          // of them
    int work;                 // of the result, that is looked at
    int steps;                // that a row is simulated on (rg_cell_look)
    struct rg_budget_kind *kind;
    struct rg_device *cpu;
    struct rg_frames of_row[RG_TABLE_ROWS]; // on cpu, of the first frames
    // The same of frames like those that are timed, behind which rain has built up, and of an
    // opening that makes nothing of what instances share.
    struct rg_frames settled[RG_TABLE_ROWS];
};

// Begins looking at these rows of a table; NULL: at the first and the last of those that its curves
// and claims need. What it holds is freed with its result.
void rg_look_begin(struct rg_looking *looking, const struct rg_table *table, struct rg_kept *kept,
                   const struct rg_table_part *part, const bool *rows, struct rg_budget_kind *kind);
// The smallest pictures that a table can be measured on.
enum rg_budget_size rg_look_smallest(const struct rg_table *table);

// From so late on, an opening is taken for one in which drivers compiled what they keep, so that a
// second one tells what those of cells will take.
enum { RG_LOOK_LATE_MS = 1000 };

// The settings of a row at a size, with some over them; the caller frees them. NULL, and one logged
// line, on failure.
void *rg_look_settings(const struct rg_looking *looking, int row, enum rg_budget_size size,
                       const char *over);
// Opens a row with these, and keeps its instance. False, and one logged line, on failure.
bool rg_look_row(struct rg_looking *looking, struct rg_device *device, int row,
                 enum rg_budget_size size, const char *over, struct rg_cell_frames *frames);
// The last row at the smallest size, and at the next, from which others follow by their pixels.
bool rg_look_device(struct rg_looking *looking, struct rg_device *device, struct rg_frames *frames);
// Fills in what frames of all sizes take: so many times as long as the smallest.
void rg_look_extend(struct rg_frames *frames, enum rg_budget_size smallest, const double larger[]);
// Opens a row on cpu once more, of which the first frames are known, and fills in `settled`. Where
// the first frames are like those that are timed, only the last row is opened, which came first.
// False, and one logged line, on failure.
bool rg_look_settled(struct rg_looking *looking, int row);
// How many times as long frames take on a device as on cpu: what is known of its technique, or
// found now, by the last row.
bool rg_look_ratio(struct rg_looking *looking, struct rg_device *device, struct rg_frames *ratio);
struct rg_frames rg_look_scaled(const struct rg_frames *cpu, const struct rg_frames *ratio);
// What a work of the result that is not its first takes by what the first does, which is `of` on
// each device: what is known of its technique, or found now, by the last row. It holds until
// another work is asked for.
const struct rg_work_frames *rg_look_work(struct rg_looking *looking, int work,
                                          const struct rg_frames of[RG_MAX_DEVICES],
                                          const bool is_there[RG_MAX_DEVICES]);

#endif
