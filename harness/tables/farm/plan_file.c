// A plan as a document, and as a file. One table of fields writes and reads each of its structs.
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/record/disk/document.h"
#include "harness/record/disk/seal.h"
#include "harness/record/output.h"
#include "harness/record/schema/fields.h"
#include "harness/tables/farm/plan.h"

static const char mend[] = "name a file as `raingauge plan -o` writes it";

// --- fields ---

enum kind { END, TEXT, WHOLE, NUMBER, FLAG };

struct field {
    const char *name;
    enum kind kind;
    size_t offset, size;
    int least; // of a whole number
};

#define FIELD(kind, S, field, least)                                                               \
    {                                                                                              \
#field, kind, offsetof(S, field), sizeof(((S *)0)->field), least                           \
    }
#define NAMED(name, kind, S, field)                                                                \
    {                                                                                              \
        name, kind, offsetof(S, field), sizeof(((S *)0)->field), 0                                 \
    }

static const struct field of_plan[] = {FIELD(TEXT, struct rg_farm_plan, commit, 0),
                                       FIELD(FLAG, struct rg_farm_plan, full, 0),
                                       FIELD(WHOLE, struct rg_farm_plan, shards, 0),
                                       {.kind = END}};
static const struct field of_device[] = {FIELD(TEXT, struct rg_farm_device, name, 0),
                                         FIELD(TEXT, struct rg_farm_device, asked, 0),
                                         {.kind = END}};
static const struct field of_group[] = {FIELD(TEXT, struct rg_farm_group, id, 0),
                                        FIELD(TEXT, struct rg_farm_group, table, 0),
                                        {.kind = END}};
static const struct field of_cell[] = {FIELD(WHOLE, struct rg_farm_cell, row, 1),
                                       FIELD(TEXT, struct rg_farm_cell, work, 0),
                                       FIELD(TEXT, struct rg_farm_cell, variant, 0),
                                       FIELD(NUMBER, struct rg_farm_cell, seconds, 0),
                                       NAMED("known", FLAG, struct rg_farm_cell, is_known),
                                       {.kind = END}};

static json_t *value_json(const struct field *field, const char *at)
{
    switch (field->kind) {
    case TEXT:
        return rg_json_text(at);
    case WHOLE:
        return json_integer(*(const int *)at);
    case NUMBER:
        return rg_number_json(rg_number_kept(*(const double *)at));
    default:
        return json_boolean(*(const bool *)at);
    }
}

// Sets the fields of a struct in an object; false when memory runs out.
static bool put(json_t *json, const struct field *fields, const void *all)
{
    bool ok = json != NULL;
    for (; ok && fields->kind; fields++)
        ok = !json_object_set_new(json, fields->name,
                                  value_json(fields, (const char *)all + fields->offset));
    return ok;
}

static bool take(struct rg_reader *r, const json_t *json, const struct field *fields, void *all)
{
    bool ok = true;
    for (; ok && fields->kind; fields++) {
        char *at = (char *)all + fields->offset;
        ok = fields->kind == TEXT ? rg_field_text(r, json, fields->name, at, fields->size)
             : fields->kind == WHOLE
                 ? rg_field_int(r, json, fields->name, fields->least, INT_MAX, (int *)at)
             : fields->kind == NUMBER ? rg_field_number(r, json, fields->name, (double *)at)
                                      : rg_field_bool(r, json, fields->name, (bool *)at);
    }
    return ok;
}

// --- writing ---

static bool put_cell(json_t *cells, const struct rg_farm_plan *plan,
                     const struct rg_farm_group *group, const struct rg_farm_cell *cell)
{
    char id[RG_FARM_ID + RG_FARM_ASKED];
    json_t *json = json_object();
    rg_farm_cell_id(plan, group, cell, id, sizeof(id));
    const bool ok =
        json && !json_object_set_new(json, "id", rg_json_text(id)) && put(json, of_cell, cell) &&
        !json_object_set_new(json, "device", rg_json_text(plan->devices[cell->device].name));
    return json_array_append_new(cells, json) == 0 && ok;
}

static bool put_groups(json_t *groups, const struct rg_farm_plan *plan)
{
    bool ok = true;
    for (int64_t g = 0; ok && g < plan->group_count; g++) {
        const struct rg_farm_group *group = &plan->groups[g];
        json_t *json = json_object(), *cells = json_array();
        ok = json && put(json, of_group, group);
        for (int i = 0; ok && i < group->cell_count; i++)
            ok = put_cell(cells, plan, group, &plan->cells[group->first_cell + i]);
        ok = !json_object_set_new(json, "cells", cells) && ok;
        ok = !json_array_append_new(groups, json) && ok;
    }
    return ok;
}

// The sealed document; NULL when memory runs out.
static json_t *plan_json(const struct rg_farm_plan *plan)
{
    json_t *json = json_pack("{si}", "format", RG_FARM_FORMAT), *devices = json_array();
    json_t *groups = json_array();
    bool ok = put(json, of_plan, plan) && devices;
    for (int d = 0; ok && d < plan->device_count; d++) {
        json_t *device = json_object();
        ok = put(device, of_device, &plan->devices[d]);
        json_array_append_new(devices, device);
    }
    ok = groups && put_groups(groups, plan) && ok;
    ok = !json_object_set_new(json, "devices", devices) && ok;
    ok = !json_object_set_new(json, "groups", groups) && ok;
    if (ok && rg_seal(json))
        return json;
    json_decref(json);
    return NULL;
}

static void take_digest(struct rg_farm_plan *plan, const json_t *document)
{
    const char *checksum = json_string_value(json_object_get(document, "checksum"));
    rg_text_copy(plan->digest, sizeof(plan->digest), checksum ? checksum : "");
}

bool rg_farm_plan_write(struct rg_farm_plan *plan, const char *path)
{
    json_t *json = plan_json(plan);
    char *text = json ? json_dumps(json, JSON_INDENT(1) | RG_JSON_FLAGS) : NULL;
    const bool ok =
        text ? rg_output_write_file(path, text)
             : rg_harness_error("%s: no memory to write it; what was there is unchanged", path);
    take_digest(plan, json);
    free(text);
    json_decref(json);
    return ok;
}

// --- reading ---

static bool take_devices(struct rg_reader *r, const json_t *document, struct rg_farm_plan *plan)
{
    int count;
    const json_t *array = rg_field_array(r, document, "devices", RG_MAX_DEVICES, &count);
    for (int d = 0; d < count; d++) {
        rg_reader_enter(r, "devices[%d]", d);
        if (!take(r, json_array_get(array, (size_t)d), of_device, &plan->devices[d]))
            return false;
        plan->device_count++;
    }
    rg_reader_enter(r, "%s", "");
    return count > 0;
}

static bool take_cell(struct rg_reader *r, const json_t *json, struct rg_farm_plan *plan)
{
    struct rg_farm_cell cell = {0};
    char device[RG_DEVICE_NAME_SIZE];
    if (!take(r, json, of_cell, &cell) || !rg_field_text(r, json, "device", device, sizeof(device)))
        return false;
    while (cell.device < plan->device_count && strcmp(plan->devices[cell.device].name, device) != 0)
        cell.device++;
    if (cell.device == plan->device_count)
        return rg_reader_refuse(r, "device", "is '%.40s', which 'devices' does not name", device);
    return rg_farm_add_cell(plan, &cell);
}

static bool take_groups(struct rg_reader *r, const json_t *document, struct rg_farm_plan *plan)
{
    const json_t *groups = rg_field(r, document, "groups", JSON_ARRAY), *group, *cell;
    size_t i, k;
    json_array_foreach(groups, i, group)
    {
        struct rg_farm_group named = {0};
        rg_reader_enter(r, "groups[%zu]", i);
        if (!take(r, group, of_group, &named) || !rg_farm_add_group(plan, named.table, named.id))
            return false;
        const json_t *cells = rg_field(r, group, "cells", JSON_ARRAY);
        if (!json_array_size(cells))
            return cells ? rg_reader_refuse(r, "cells", "is empty") : false;
        json_array_foreach(cells, k, cell)
        {
            rg_reader_enter(r, "groups[%zu].cells[%zu]", i, k);
            if (!take_cell(r, cell, plan))
                return false;
        }
    }
    return groups != NULL;
}

static bool take_plan(struct rg_reader *r, json_t *document, struct rg_farm_plan *plan)
{
    int format;
    if (!json_is_object(document) || !json_object_get(document, "groups"))
        return rg_reader_refuse(r, "", "is no plan");
    if (!rg_field_int(r, document, "format", 1, INT_MAX, &format))
        return false;
    if (format != RG_FARM_FORMAT)
        return rg_reader_refuse(r, "format", "is %d, and this raingauge reads %d", format,
                                RG_FARM_FORMAT);
    take_digest(plan, document);
    if (rg_unseal(document) != RG_SEAL_WHOLE) {
        snprintf(r->why, r->why_size,
                 "%.200s: was changed or cut since it was made; make it anew by `raingauge plan`",
                 r->file);
        return false;
    }
    return take(r, document, of_plan, plan) && take_devices(r, document, plan) &&
           take_groups(r, document, plan);
}

bool rg_farm_plan_read(struct rg_farm_plan *plan, const char *path)
{
    char why[RG_WHY_SIZE] = "";
    struct rg_reader reader = {.file = path, .mend = mend, .why = why, .why_size = sizeof(why)};
    bool is_alone;
    json_t *document = rg_document_first(path, &is_alone, mend, why);
    bool ok = document && take_plan(&reader, document, plan);
    if (ok && !is_alone)
        ok = rg_reader_refuse(&reader, "", "has more after its end");
    json_decref(document);
    if (ok)
        rg_farm_sum(plan);
    return ok || (*why && rg_error("%s", why));
}
