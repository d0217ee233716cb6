#include "harness/tables/farm/record.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/base/log.h"
#include "harness/record/disk/cells.h"
#include "harness/record/disk/document.h"

static const char mend[] = "measure its group again";

void rg_farm_file(const struct rg_farm_group *group, char name[RG_FARM_FILE])
{
    char part[RG_OUTPUT_PART];
    rg_output_part(group->id, part);
    snprintf(name, RG_FARM_FILE, "%s.json", part);
}

// --- writing ---

json_t *rg_farm_record_json(const struct rg_farm_plan *plan, const struct rg_farm_group *group,
                            const struct rg_result *result, double seconds)
{
    json_t *json = rg_result_json(result);
    json_t *of = json_pack("{sssosf}", "plan", plan->digest, "id", rg_json_text(group->id),
                           "seconds", rg_number_kept(seconds));
    if (!json_object_set_new(json, "group", of) && rg_cells_seal(json))
        return json;
    json_decref(json);
    return rg_harness_error_null("%s: no memory for its record; close other programs", group->id);
}

bool rg_farm_record_write(const struct rg_farm_plan *plan, const struct rg_farm_group *group,
                          const struct rg_result *result, double seconds, const char *folder)
{
    char name[RG_FARM_FILE];
    json_t *json = rg_farm_record_json(plan, group, result, seconds);
    char *text = json ? json_dumps(json, JSON_COMPACT | RG_JSON_FLAGS) : NULL;
    rg_farm_file(group, name);
    const bool ok = text ? rg_output_write(folder, name, text)
                         : json && rg_harness_error("%s/%s: no memory to write it", folder, name);
    free(text);
    json_decref(json);
    return ok;
}

// --- reading ---

static bool refuse(char why[RG_WHY_SIZE], const char *path, const char *what, const char *is,
                   const char *due)
{
    snprintf(why, RG_WHY_SIZE,
             "%.200s: is of %s %.70s, and the plan is of %.70s; merge it with its own plan, or "
             "remove it and measure its group again",
             path, what, is, due);
    return false;
}

// Whether a document is of this plan's commit, and of this plan.
static bool is_of_plan(const struct rg_farm_plan *plan, const json_t *document, const char *path,
                       char why[RG_WHY_SIZE])
{
    const json_t *of = json_object_get(document, "group");
    const json_t *build = json_object_get(json_object_get(document, "passport"), "raingauge");
    const json_int_t format = json_integer_value(json_object_get(document, "format"));
    if (format > RG_FORMAT_VERSION) {
        snprintf(why, RG_WHY_SIZE,
                 "%.200s: format is %d, and this raingauge reads %d; merge it with a raingauge of "
                 "its commit",
                 path, (int)format, RG_FORMAT_VERSION);
        return false;
    }
    if (!of) {
        snprintf(why, RG_WHY_SIZE,
                 "%.200s: is no record of a shard; name folders that `raingauge table --plan` "
                 "wrote to, and no others",
                 path);
        return false;
    }
    if (strcmp(rg_json_text_of(build, "commit"), plan->commit) != 0)
        return refuse(why, path, "commit", rg_json_text_of(build, "commit"), plan->commit);
    return !strcmp(rg_json_text_of(of, "plan"), plan->digest) ||
           refuse(why, path, "plan", rg_json_text_of(of, "plan"), plan->digest);
}

// Whether a result has a cell of the plan.
static bool has_cell(const struct rg_result *result, const struct rg_farm_cell *cell,
                     const char *device)
{
    struct rg_place at = rg_result_start_row(cell->row - 1);
    while (rg_result_has(result, cell->row - 1) && rg_result_next_in_row(result, &at)) {
        const struct rg_record *record = rg_result_at(result, at);
        if (!strcmp(record->device.name, device) && !strcmp(record->variant, cell->variant) &&
            !strcmp(record->work, cell->work))
            return true;
    }
    return false;
}

// Whether a result has all cells of a group.
static bool has_group(const struct rg_farm_plan *plan, const struct rg_farm_group *group,
                      const struct rg_result *result, const char *path, char why[RG_WHY_SIZE])
{
    if (strcmp(result->table, group->table) != 0)
        return refuse(why, path, "table", result->table, group->table);
    if (result->full != plan->full)
        return refuse(why, path, "length", result->full ? "full" : "quick",
                      plan->full ? "full" : "quick");
    for (int i = 0; i < group->cell_count; i++) {
        const struct rg_farm_cell *cell = &plan->cells[group->first_cell + i];
        char id[RG_FARM_ID];
        if (has_cell(result, cell, plan->devices[cell->device].name))
            continue;
        rg_farm_cell_id(plan, group, cell, id, sizeof(id));
        snprintf(why, RG_WHY_SIZE, "%.200s: lacks the cell %.200s; %s", path, id, mend);
        return false;
    }
    return true;
}

static enum rg_farm_found read_document(const struct rg_farm_plan *plan,
                                        const struct rg_farm_group *group, json_t *document,
                                        const char *path, bool is_checked, struct rg_result *result,
                                        char why[RG_WHY_SIZE])
{
    if (!is_of_plan(plan, document, path, why))
        return RG_FARM_FOREIGN;
    if (!rg_result_from_json(document, path, result, why) ||
        (!is_checked && !rg_cells_are_whole(path, document, why)) ||
        strcmp(rg_json_text_of(json_object_get(document, "group"), "id"), group->id) != 0 ||
        !has_group(plan, group, result, path, why)) {
        if (!*why)
            refuse(why, path, "group", rg_json_text_of(json_object_get(document, "group"), "id"),
                   group->id);
        return RG_FARM_DAMAGED;
    }
    return RG_FARM_WHOLE;
}

enum rg_farm_found rg_farm_record_read(const struct rg_farm_plan *plan,
                                       const struct rg_farm_group *group, const char *path,
                                       bool is_checked, struct rg_result *result,
                                       char why[RG_WHY_SIZE])
{
    enum rg_farm_found found = RG_FARM_DAMAGED;
    bool is_alone;
    *why = 0;
    if (access(path, F_OK))
        return RG_FARM_ABSENT;
    json_t *document = rg_document_first(path, &is_alone, mend, why);
    if (document)
        found = read_document(plan, group, document, path, is_checked, result, why);
    if (found == RG_FARM_WHOLE && !is_alone) {
        snprintf(why, RG_WHY_SIZE, "%.200s: has more after its end; %s", path, mend);
        found = RG_FARM_DAMAGED;
    }
    if (found != RG_FARM_WHOLE)
        rg_result_free(result);
    json_decref(document);
    return found;
}
