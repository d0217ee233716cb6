#include "tests/harness/farm/made.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "harness/record/passport/build_info.h"

enum { SAMPLES = 15, ID_SIZE = 32 };

static void make_table(struct rg_table *table, int number, int rows, int variants)
{
    static const char *const names[] = {"v0", "v1", "v2", "v3", "v4", "v5", "v6", "v7", "v8", "v9"};
    char *id = malloc(ID_SIZE);
    struct rg_table_row *own = calloc((size_t)rows, sizeof(*own));
    assert_true(id && own);
    snprintf(id, ID_SIZE, "farm-%d", number);
    for (int i = 0; i < rows; i++)
        own[i] = (struct rg_table_row){"drops=1", {i + 1}, NULL};
    *table = (struct rg_table){.id = id,
                               .technique = "flow",
                               .about = "a test",
                               .columns = {"drops"},
                               .key_count = 1,
                               .width = 64,
                               .height = 64,
                               .row_count = rows,
                               .rows = own,
                               .note = "a note"};
    for (int v = 0; v < variants; v++)
        table->variants[v] = (struct rg_table_variant){names[v], "", NULL};
}

// Begins each table once, as measuring it would, and gives it the passport of another machine.
static void begin_tables(struct farm *farm)
{
    for (int t = 0; t < farm->table_count; t++) {
        const struct rg_table_part all = {.last_row = farm->tables[t].row_count - 1};
        rg_table_begin(&farm->heads[t], &farm->tables[t], &all, &farm->devices);
    }
    farm->passports[0] = json_incref(farm->heads[0].passport);
    farm->passports[1] = json_deep_copy(farm->passports[0]);
    json_object_set_new(json_object_get(farm->passports[1], "machine"), "cpu",
                        json_string("another processor"));
}

void make_farm(struct farm *farm, int tables, int rows, int variants)
{
    *farm = (struct farm){
        .table_count = tables, .cpu.info.name = "cpu", .other.info.name = "cpu:reference"};
    farm->tables = calloc((size_t)tables, sizeof(*farm->tables));
    farm->all = calloc((size_t)tables, sizeof(*farm->all));
    farm->heads = calloc((size_t)tables, sizeof(*farm->heads));
    assert_true(farm->tables && farm->all && farm->heads);
    farm->devices = (struct rg_devices){.count = 2, .devices = {&farm->cpu, &farm->other}};
    for (int t = 0; t < tables; t++) {
        make_table(&farm->tables[t], t, rows, variants);
        farm->all[t] = &farm->tables[t];
    }
    begin_tables(farm);
    farm->plan.full = false;
    rg_text_copy(farm->plan.commit, sizeof(farm->plan.commit), rg_build_commit);
    assert_true(rg_farm_name_devices(&farm->plan, "cpu,cpu:reference"));
    assert_true(rg_farm_make(&farm->plan, farm->all, tables));
    for (int64_t i = 0; i < farm->plan.cell_count; i++)
        farm->plan.cells[i].seconds = 1;
    rg_farm_sum(&farm->plan);
}

void unmake_farm(struct farm *farm)
{
    for (int t = 0; t < farm->table_count; t++) {
        free((char *)farm->tables[t].id);
        free((void *)farm->tables[t].rows);
        rg_result_free(&farm->heads[t]);
    }
    for (int i = 0; i < FARM_MACHINES; i++)
        json_decref(farm->passports[i]);
    rg_farm_plan_free(&farm->plan);
    free(farm->tables);
    free(farm->all);
    free(farm->heads);
}

static void fill(struct rg_record *record, struct rg_place at)
{
    record->create_ms = 100 + at.row;
    record->first_frame_ms = 28;
    record->api_over_wall = 1;
    record->frames_a_sample = 3;
    record->wanted_samples = record->sample_count = SAMPLES;
    record->is_watched = true;
    record->calibration_begin_ms = record->calibration_end_ms = 2;
    for (int i = 0; i < SAMPLES; i++)
        record->samples_ms[i] = 20 + at.row + 0.1 * at.variant + 0.01 * at.device + 0.001 * i;
    record->pass_frames = record->pass_count = 2;
    for (int i = 0; i < record->pass_count; i++) {
        rg_text_copy(record->passes[i].name, RG_NAME_SIZE, i ? "flow_light" : "flow_move");
        record->passes[i].ms = 3 + i;
    }
    record->counter_count = 1;
    rg_text_copy(record->counters[0].name, RG_NAME_SIZE, "drops");
    record->counters[0].value = 1000 * at.row + at.variant;
    rg_named_set_number(&record->facts[record->fact_count++], "particles", 40 + at.row);
    record->has_tally = true;
    rg_record_settle(record);
}

struct rg_result measure_group(const struct farm *farm, int64_t group, int machine)
{
    const struct rg_farm_group *g = &farm->plan.groups[group];
    const int t = atoi(g->table + strlen("farm-"));
    const struct rg_farm_cell *cells = &farm->plan.cells[g->first_cell];
    struct rg_result result = farm->heads[t];
    result.passport = json_incref(farm->passports[machine]);
    result.first_row = cells[0].row - 1;
    result.last_row = cells[g->cell_count - 1].row - 1;
    for (int row = result.first_row; row <= result.last_row; row++) {
        result.left_out[row - result.first_row] =
            !rg_farm_has_row(&farm->plan, group, group + 1, row);
        if (!result.left_out[row - result.first_row])
            assert_true(rg_table_add_row(&result, &farm->tables[t], row));
    }
    for (struct rg_place at = rg_result_start(&result); rg_result_next(&result, &at);)
        fill(rg_result_at(&result, at), at);
    return result;
}

void leave_record(const struct farm *farm, int64_t group, int machine, const char *folder)
{
    struct rg_result result = measure_group(farm, group, machine);
    mkdir(folder, 0777);
    assert_true(rg_farm_record_write(&farm->plan, &farm->plan.groups[group], &result, 1.5, folder));
    rg_result_free(&result);
}

const char *record_path(const struct farm *farm, int64_t group, const char *folder)
{
    static char path[512];
    char name[RG_FARM_FILE];
    rg_farm_file(&farm->plan.groups[group], name);
    snprintf(path, sizeof(path), "%s/%s", folder, name);
    return path;
}
