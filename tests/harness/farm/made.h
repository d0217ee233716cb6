// A farm that no machine belongs to: tables of any size, their plan, and records that nobody
// measured.
#ifndef RG_TESTS_HARNESS_FARM_MADE_H
#define RG_TESTS_HARNESS_FARM_MADE_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "harness/tables/farm/make.h"
#include "harness/tables/farm/record.h"
#include "harness/tables/table.h"

enum { FARM_MACHINES = 2 };

struct farm {
    int table_count;
    struct rg_table *tables;
    const struct rg_table **all; // each of them
    struct rg_device cpu, other;
    struct rg_devices devices;
    struct rg_farm_plan plan;
    struct rg_result *heads;          // of each table, without rows
    json_t *passports[FARM_MACHINES]; // of machines with different comparison keys
};

// Tables "farm-0" and so on, of so many rows and variants, on two devices. Each row is a group, and
// each cell takes a second. The caller calls unmake_farm.
void make_farm(struct farm *farm, int tables, int rows, int variants);
void unmake_farm(struct farm *farm);

// The result of a group on a machine, whose numbers follow from the cell alone. The caller frees
// it.
struct rg_result measure_group(const struct farm *farm, int64_t group, int machine);
// The same as the record that a shard leaves in a folder, which is made.
void leave_record(const struct farm *farm, int64_t group, int machine, const char *folder);
// The path of a group's record in a folder; valid until the next call.
const char *record_path(const struct farm *farm, int64_t group, const char *folder);

#endif
