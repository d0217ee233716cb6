// A plan: the cells of tables that several machines measure together. It is plain data, made from
// tables (make.h), cut into shards (cut.h), and held against the records that shards left
// (found.h). docs/farm.md tells its use.
//
// Cells whose comparison is a result are a group, which stays on one machine: the rows of a claim,
// and of each row all works, variants and devices.
#ifndef RG_HARNESS_TABLES_FARM_PLAN_H
#define RG_HARNESS_TABLES_FARM_PLAN_H

#include "core/device/device.h"
#include "harness/record/schema/schema.h"

enum {
    RG_FARM_FORMAT = 1,
    RG_FARM_ID = 256,
    RG_FARM_DIGEST = 17,
    RG_FARM_COMMIT = 64,
    RG_FARM_ASKED = RG_DEVICE_NAME_SIZE + RG_NAME_SIZE,
};

struct rg_farm_device {
    char name[RG_DEVICE_NAME_SIZE]; // as records call it
    char asked[RG_FARM_ASKED];      // as --device has it: with its settings, and its short name
};

struct rg_farm_cell {
    int row;                 // of its table, from 1
    char work[RG_NAME_SIZE]; // "" in tables without works
    char variant[RG_NAME_SIZE];
    int device;     // index
    double seconds; // expected
    bool is_known;  // from a record of the cell; else from others, or from a calibration
};

struct rg_farm_group {
    char id[RG_FARM_ID]; // "creus-5.4/1-8": its table and rows
    char table[RG_NAME_SIZE];
    int64_t first_cell;
    int cell_count;
    double seconds; // of its cells
};

// Zeroed: without cells. The owner calls rg_farm_plan_free.
struct rg_farm_plan {
    char digest[RG_FARM_DIGEST]; // of its document, by which records name it; "": not written yet
    char commit[RG_FARM_COMMIT]; // of the raingauge that made it
    bool full;                   // else quick
    int shards;                  // 0: not settled
    int device_count;
    struct rg_farm_device devices[RG_MAX_DEVICES];
    int64_t cell_count, cell_room;
    struct rg_farm_cell *cells; // by group, then row, work, variant and device; owned
    int64_t group_count, group_room;
    struct rg_farm_group *groups; // a table's follow each other, by their first rows; owned
};

// Adds an empty group of a table, or a cell to the last group. False, with one logged line, when
// memory runs out.
bool rg_farm_add_group(struct rg_farm_plan *plan, const char *table, const char *id);
bool rg_farm_add_cell(struct rg_farm_plan *plan, const struct rg_farm_cell *cell);
// Makes the groups' seconds anew from those of their cells; returns their sum.
double rg_farm_sum(struct rg_farm_plan *plan);
// "creus-5.4/3/paper/full/cpu": the cell's id, which stays the same from plan to plan.
void rg_farm_cell_id(const struct rg_farm_plan *plan, const struct rg_farm_group *group,
                     const struct rg_farm_cell *cell, char *text, size_t size);
// The index of the first group behind this one that is of another table.
int64_t rg_farm_table_end(const struct rg_farm_plan *plan, int64_t group);
// Whether a row of a table, from 0, has cells in the groups from `first` to before `end`.
bool rg_farm_has_row(const struct rg_farm_plan *plan, int64_t first, int64_t end, int row);
void rg_farm_plan_free(struct rg_farm_plan *plan);

// Writes a plan's document, and sets its digest. False, with one logged line, on failure.
bool rg_farm_plan_write(struct rg_farm_plan *plan, const char *path);
// Reads a plan into a zeroed one. False, with one logged line that names the file and the mend,
// where it is none, was changed, or is of another format. The caller frees the plan in either case.
bool rg_farm_plan_read(struct rg_farm_plan *plan, const char *path);

#endif
