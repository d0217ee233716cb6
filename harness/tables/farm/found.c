#include "harness/tables/farm/found.h"

#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/base/array.h"
#include "core/base/log.h"
#include "harness/tables/farm/record.h"

// Lines that tell of groups or files, one each; then only their number is told.
enum { MOST_LINES = 10 };

// The file of a group, to find the group of a file.
struct named {
    char file[RG_FARM_FILE];
    int64_t group;
};

struct finding {
    struct rg_farm_records *found;
    const struct rg_farm_plan *plan;
    struct named *named; // of all groups, by their names
};

static int by_name(const void *a, const void *b)
{
    return strcmp(((const struct named *)a)->file, ((const struct named *)b)->file);
}

static bool name_groups(struct finding *f)
{
    const int64_t count = f->plan->group_count;
    f->named = rg_alloc((size_t)count, sizeof(*f->named), "groups of a plan");
    f->found->first_of = rg_alloc((size_t)count, sizeof(*f->found->first_of), "groups of a plan");
    if (!f->named || !f->found->first_of)
        return false;
    for (int64_t g = 0; g < count; g++) {
        rg_farm_file(&f->plan->groups[g], f->named[g].file);
        f->named[g].group = g;
        f->found->first_of[g] = -1;
    }
    qsort(f->named, (size_t)count, sizeof(*f->named), by_name);
    return true;
}

// --- machines ---

// The index of a machine, which is added if it is new; -1, with one logged line, without memory.
static int machine_of(struct rg_farm_records *found, const json_t *passport)
{
    struct rg_farm_machine machine;
    rg_origin_key(passport, machine.key);
    rg_origin_text(passport, machine.text);
    for (int64_t i = 0; i < found->machine_count; i++)
        if (!strcmp(found->machines[i].key, machine.key))
            return (int)i;
    if (!rg_array_fit(&found->machines, &found->machine_room, found->machine_count + 1,
                      sizeof(*found->machines), "machines"))
        return -1;
    found->machines[found->machine_count] = machine;
    return (int)found->machine_count++;
}

// --- records ---

const struct rg_farm_record *rg_farm_record_of(const struct rg_farm_records *found, int64_t group,
                                               int machine)
{
    for (int64_t i = found->first_of[group]; i >= 0; i = found->records[i].next)
        if (found->records[i].machine == machine)
            return &found->records[i];
    return NULL;
}

// Keeps a record, unless its group was there before with the same key.
static bool keep(struct finding *f, int64_t group, int machine, const char *path)
{
    struct rg_farm_records *found = f->found;
    const struct rg_farm_record *before = rg_farm_record_of(found, group, machine);
    if (before) {
        if (found->twice++ < MOST_LINES)
            rg_info("%s: is there twice; %s is kept, and %s is not", f->plan->groups[group].id,
                    before->path, path);
        return true;
    }
    if (!rg_array_fit(&found->records, &found->room, found->count + 1, sizeof(*found->records),
                      "records"))
        return false;
    struct rg_farm_record *kept = &found->records[found->count];
    *kept = (struct rg_farm_record){group, machine, strdup(path), found->first_of[group]};
    if (!kept->path)
        return rg_harness_error("%s: no memory for its name; close other programs", path);
    found->first_of[group] = found->count++;
    return true;
}

static bool take_file(struct finding *f, const char *folder, const char *name)
{
    char path[2048], why[RG_WHY_SIZE];
    struct named wanted = {.group = 0};
    struct rg_result result = {0};
    if (snprintf(path, sizeof(path), "%s/%s", folder, name) >= (int)sizeof(path))
        return rg_error("%.80s...: its name is too long; move it", path);
    snprintf(wanted.file, sizeof(wanted.file), "%.*s", RG_FARM_FILE - 1, name);
    const struct named *named =
        bsearch(&wanted, f->named, (size_t)f->plan->group_count, sizeof(wanted), by_name);
    if (!named)
        return rg_error("%s: is no record of a group of this plan; name folders that `raingauge "
                        "table --plan` wrote to, and no others",
                        path);
    const enum rg_farm_found is =
        rg_farm_record_read(f->plan, &f->plan->groups[named->group], path, false, &result, why);
    if (is == RG_FARM_FOREIGN)
        return rg_error("%s", why);
    if (is == RG_FARM_DAMAGED && f->found->damaged++ < MOST_LINES)
        rg_warning("%s", why);
    if (is != RG_FARM_WHOLE)
        return true;
    const int machine = machine_of(f->found, result.passport);
    rg_result_free(&result);
    return machine >= 0 && keep(f, named->group, machine, path);
}

// Copies under way have other names, or begin with a point.
static int is_record(const struct dirent *entry)
{
    const size_t length = strlen(entry->d_name);
    return *entry->d_name != '.' && length > 5 && !strcmp(entry->d_name + length - 5, ".json");
}

static bool take_folder(struct finding *f, const char *folder)
{
    struct dirent **entries;
    const int count = scandir(folder, &entries, is_record, alphasort);
    bool ok = count >= 0 ||
              rg_system_error(errno, "%s: %s; name a folder of records", folder, strerror(errno));
    for (int i = 0; i < count; i++) {
        ok = ok && take_file(f, folder, entries[i]->d_name);
        free(entries[i]);
    }
    if (count >= 0)
        free(entries);
    return ok;
}

bool rg_farm_records_find(struct rg_farm_records *found, const struct rg_farm_plan *plan,
                          const char *const *folders, int count)
{
    struct finding f = {.found = found, .plan = plan};
    bool ok = name_groups(&f);
    for (int i = 0; ok && i < count; i++)
        ok = take_folder(&f, folders[i]);
    if (ok && found->twice > MOST_LINES)
        rg_info("%lld records more are there twice", (long long)found->twice - MOST_LINES);
    if (ok && found->damaged > MOST_LINES)
        rg_warning("%lld records more are damaged", (long long)found->damaged - MOST_LINES);
    free(f.named);
    return ok;
}

int64_t rg_farm_missing(const struct rg_farm_records *found, const struct rg_farm_plan *plan)
{
    int64_t cells = 0, groups = 0;
    for (int64_t g = 0; g < plan->group_count; g++) {
        const struct rg_farm_group *group = &plan->groups[g];
        if (found->first_of[g] >= 0)
            continue;
        cells += group->cell_count;
        if (groups++ < MOST_LINES)
            rg_info("%s: missing, %d cell%s", group->id, group->cell_count,
                    group->cell_count == 1 ? "" : "s");
    }
    if (groups > MOST_LINES)
        rg_info("%lld groups more are missing", (long long)groups - MOST_LINES);
    return cells;
}

void rg_farm_found_free(struct rg_farm_records *found)
{
    for (int64_t i = 0; i < found->count; i++)
        free(found->records[i].path);
    free(found->records);
    free(found->machines);
    free(found->first_of);
    *found = (struct rg_farm_records){0};
}
