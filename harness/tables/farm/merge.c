#include "harness/tables/farm/merge.h"

#include <stdio.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/console/exit.h"
#include "harness/record/output.h"
#include "harness/tables/farm/record.h"
#include "harness/tables/print.h"

struct merging {
    const struct rg_farm_plan *plan;
    const struct rg_farm_records *found;
    int machine;
    int64_t first, end; // the groups of the table
    const char *folder;
    int tables;
    int64_t cells;
};

// The first and last row of the table's groups, from 0.
static void find_rows(const struct merging *m, int *first, int *last)
{
    *first = RG_RESULT_ROWS;
    *last = -1;
    for (int64_t g = m->first; g < m->end; g++) {
        const struct rg_farm_group *group = &m->plan->groups[g];
        for (int i = 0; i < group->cell_count; i++) {
            const int row = m->plan->cells[group->first_cell + i].row - 1;
            *first = row < *first ? row : *first;
            *last = row > *last ? row : *last;
        }
    }
}

// Begins a table with what a record of it says before its rows. Rows that are not planned, or that
// another machine measured, are left out.
static void begin(const struct merging *m, const struct rg_result *from, struct rg_result *table)
{
    *table = *from;
    json_incref(table->passport);
    memset(table->rows, 0, sizeof(table->rows));
    memset(table->left_out, 0, sizeof(table->left_out));
    find_rows(m, &table->first_row, &table->last_row);
    for (int row = table->first_row; row <= table->last_row; row++)
        table->left_out[row - table->first_row] = !rg_farm_has_row(m->plan, m->first, m->end, row);
    for (int64_t g = m->first; g < m->end; g++)
        for (int row = table->first_row; row <= table->last_row; row++)
            if (m->found->first_of[g] >= 0 && !rg_farm_record_of(m->found, g, m->machine) &&
                rg_farm_has_row(m->plan, g, g + 1, row))
                table->left_out[row - table->first_row] = true;
}

// Whether two results have the same cells in a row.
static bool have_same_cells(const struct rg_result *a, const struct rg_result *b)
{
    bool same = !strcmp(a->technique, b->technique) && a->work_count == b->work_count &&
                a->variant_count == b->variant_count && a->device_count == b->device_count &&
                a->width == b->width && a->height == b->height;
    for (int i = 0; same && i < a->work_count; i++)
        same = !strcmp(a->works[i].name, b->works[i].name);
    for (int i = 0; same && i < a->variant_count; i++)
        same = !strcmp(a->variants[i], b->variants[i]);
    for (int i = 0; same && i < a->device_count; i++)
        same = !strcmp(a->devices[i].name, b->devices[i].name);
    return same;
}

// Moves the rows of a record to the table.
static void move_rows(struct rg_result *from, struct rg_result *table)
{
    for (int row = from->first_row; row <= from->last_row; row++) {
        struct rg_record **to = &table->rows[row - table->first_row];
        if (!rg_result_has(from, row) || row < table->first_row || row > table->last_row || *to)
            continue;
        *to = from->rows[row - from->first_row];
        from->rows[row - from->first_row] = NULL;
    }
}

static bool add_record(struct merging *m, const struct rg_farm_record *record,
                       struct rg_result *table)
{
    char why[RG_WHY_SIZE];
    struct rg_result result = {0};
    const struct rg_farm_group *group = &m->plan->groups[record->group];
    if (rg_farm_record_read(m->plan, group, record->path, true, &result, why) != RG_FARM_WHOLE)
        return rg_error("%s: was changed meanwhile; merge again", record->path);
    if (!*table->table)
        begin(m, &result, table);
    const bool same = have_same_cells(&result, table);
    if (same) {
        move_rows(&result, table);
        m->cells += group->cell_count;
    }
    rg_result_free(&result);
    return same || rg_error("%s: has other works, variants or devices than the table's other "
                            "records; measure its group again",
                            record->path);
}

// Merges and writes one table of a machine. A table without a record is not written.
static int merge_table(struct merging *m)
{
    struct rg_result table = {0};
    bool ok = true;
    for (int64_t g = m->first; ok && g < m->end; g++) {
        const struct rg_farm_record *record = rg_farm_record_of(m->found, g, m->machine);
        ok = !record || add_record(m, record, &table);
    }
    ok = ok && (!*table.table || rg_result_write(&table, m->folder));
    const int exit = !ok            ? rg_exit_of_error()
                     : *table.table ? rg_result_exit(&table)
                                    : RG_EXIT_PASS;
    m->tables += *table.table != 0;
    rg_result_free(&table);
    return exit;
}

static int merge_machine(struct merging *m)
{
    const struct rg_farm_machine *machine = &m->found->machines[m->machine];
    int exit = RG_EXIT_PASS;
    for (m->first = 0; m->first < m->plan->group_count; m->first = m->end) {
        m->end = rg_farm_table_end(m->plan, m->first);
        exit = rg_exit_worse(exit, merge_table(m));
    }
    printf("%s: %d table%s, %lld cell%s of %lld, key %s (%s)\n", m->folder, m->tables,
           m->tables == 1 ? "" : "s", (long long)m->cells, m->cells == 1 ? "" : "s",
           (long long)m->plan->cell_count, machine->key, machine->text);
    return exit;
}

int rg_farm_merge(const struct rg_farm_plan *plan, const struct rg_farm_records *found,
                  const char *folder)
{
    int exit = RG_EXIT_PASS;
    if (!rg_output_folder(folder))
        return rg_exit_of_error();
    for (int i = 0; i < found->machine_count; i++) {
        char own[2048];
        const int length = found->machine_count == 1 ? snprintf(own, sizeof(own), "%s", folder)
                                                     : snprintf(own, sizeof(own), "%s/%s", folder,
                                                                found->machines[i].key);
        if (length >= (int)sizeof(own)) {
            rg_error("%.80s...: its name is too long", folder);
            return rg_exit_of_error();
        }
        struct merging m = {.plan = plan, .found = found, .machine = i, .folder = own};
        exit = rg_exit_worse(exit, merge_machine(&m));
    }
    if (fflush(stdout) || ferror(stdout)) {
        rg_stdout_error();
        exit = rg_exit_worse(exit, rg_exit_of_error());
    }
    return exit;
}
