#include "harness/tables/farm/make.h"

#include <stdio.h>
#include <string.h>

#include "core/base/log.h"
#include "core/base/text/add.h"
#include "harness/devices/names.h"
#include "harness/tables/claims/claim.h"
#include "harness/tables/runs/needed.h"

bool rg_farm_name_devices(struct rg_farm_plan *plan, const char *names)
{
    while (*names) {
        const char *begin = names;
        struct rg_device_name name;
        if (!rg_device_name_read(&names, &name))
            return false;
        const size_t length = (size_t)(names - begin) - (names[-1] == ',');
        if (!strcmp(name.name, "all"))
            return rg_error("--device all: which devices there are is known only where cells are "
                            "measured; name them, as cpu,vulkan");
        if (!rg_backend_of(name.full))
            return rg_error("device '%.80s': unknown; `raingauge list devices` prints the names",
                            name.name);
        if (plan->device_count == RG_MAX_DEVICES || length >= RG_FARM_ASKED)
            return rg_error("--device: more than %d devices, or a name of more than %d bytes",
                            RG_MAX_DEVICES, RG_FARM_ASKED - 1);
        struct rg_farm_device *device = &plan->devices[plan->device_count++];
        memcpy(device->name, name.name, sizeof(device->name));
        memcpy(device->asked, begin, length);
        for (int d = 0; d < plan->device_count - 1; d++)
            if (!strcmp(plan->devices[d].name, device->name))
                return rg_error("--device: names '%.80s' twice; name it once", device->name);
    }
    return true;
}

// --- the rows of a table ---

// Groups of rows: each row has the number of the first row of its group; -1: it is not measured.
struct rows {
    int count;
    int group[RG_TABLE_ROWS];
};

static void choose_rows(const struct rg_table *table, bool full, struct rows *rows)
{
    bool chosen[RG_TABLE_ROWS];
    rg_quick_rows(table, chosen);
    rows->count = table->row_count;
    for (int row = 0; row < rows->count; row++)
        rows->group[row] = full || !table->quick_rows || chosen[row] ? row : -1;
}

static void join(struct rows *rows, int a, int b)
{
    const int from = rows->group[a] > rows->group[b] ? rows->group[a] : rows->group[b];
    const int to = rows->group[a] > rows->group[b] ? rows->group[b] : rows->group[a];
    for (int row = 0; row < rows->count; row++)
        if (rows->group[row] == from)
            rows->group[row] = to;
}

static bool ties(const struct rg_claim *claim, const struct rg_table *table, int row)
{
    return !strcmp(claim->table, table->id) && !rg_claim_is_of_each_row(claim) &&
           rg_claim_needs(claim, row + 1, claim->variant);
}

// Joins the rows of each claim. A claim about each row by itself joins none; the rows of a table of
// textures take no time of their own.
static void join_rows(const struct rg_table *table, struct rows *rows)
{
    for (const struct rg_claim *claim = rg_claims; claim->table; claim++)
        for (int row = 0, first = -1; row < rows->count; row++) {
            if (rows->group[row] < 0 || !ties(claim, table, row))
                continue;
            first = first < 0 ? row : first;
            join(rows, first, row);
        }
    for (int row = 1; table->is_of_textures && row < rows->count; row++)
        if (rows->group[row] >= 0)
            join(rows, 0, row);
}

// "creus-5.4/1-3,8": the table and the rows of a group.
static void name_group(const struct rg_table *table, const struct rows *rows, int group,
                       char id[RG_FARM_ID])
{
    int from = -1;
    *id = 0;
    for (int row = 0; row <= rows->count; row++) {
        const bool in = row < rows->count && rows->group[row] == group;
        if (in && from < 0)
            from = row;
        if (in || from < 0)
            continue;
        rg_text_add(id, RG_FARM_ID, ",", "%d", from + 1);
        if (row - from > 1)
            rg_text_add(id, RG_FARM_ID, "", "-%d", row);
        from = -1;
    }
    char named[RG_FARM_ID];
    memcpy(named, id, RG_FARM_ID);
    snprintf(id, RG_FARM_ID, "%.47s/%.200s", table->id, named);
}

// --- cells ---

static bool add_devices(struct rg_farm_plan *plan, struct rg_farm_cell *cell)
{
    bool ok = true;
    for (cell->device = 0; ok && cell->device < plan->device_count; cell->device++)
        ok = rg_farm_add_cell(plan, cell);
    return ok;
}

// Works that need more than a device has everywhere are left out, for whether one has it is known
// only where it is open.
static bool add_row(struct rg_farm_plan *plan, const struct rg_table *table, int row)
{
    bool ok = true;
    for (const struct rg_table_work *work = table->works; ok; work++) {
        struct rg_farm_cell cell = {.row = row + 1};
        if (work->name && work->elsewhere)
            continue;
        if (!work->name && table->works[0].name)
            break;
        rg_text_copy(cell.work, sizeof(cell.work), work->name ? work->name : "");
        for (const struct rg_table_variant *v = table->variants; ok && v->name; v++) {
            rg_text_copy(cell.variant, sizeof(cell.variant), v->name);
            ok = add_devices(plan, &cell);
        }
        if (!work->name)
            break;
    }
    return ok;
}

static bool add_table(struct rg_farm_plan *plan, const struct rg_table *table)
{
    struct rows rows;
    bool ok = true;
    choose_rows(table, plan->full, &rows);
    join_rows(table, &rows);
    for (int group = 0; ok && group < rows.count; group++) {
        char id[RG_FARM_ID];
        if (rows.group[group] != group)
            continue;
        name_group(table, &rows, group, id);
        ok = rg_farm_add_group(plan, table->id, id);
        for (int row = group; ok && row < rows.count; row++)
            if (rows.group[row] == group)
                ok = add_row(plan, table, row);
    }
    return ok;
}

bool rg_farm_make(struct rg_farm_plan *plan, const struct rg_table *const tables[], int count)
{
    bool ok = true;
    for (int i = 0; ok && i < count; i++)
        ok = add_table(plan, tables[i]);
    return ok;
}
