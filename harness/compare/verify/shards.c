#include "harness/compare/verify/shards.h"

#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/base/array.h"
#include "harness/console/exit.h"
#include "harness/record/named.h"
#include "harness/record/passport/build_info.h"

// --- units ---

bool rg_units_add(struct rg_verify_units *units, const char *technique, const char *name,
                  int64_t steps)
{
    if (!rg_array_fit(&units->all, &units->room, units->count + 1, sizeof(*units->all), "units"))
        return false;
    units->all[units->count++] =
        (struct rg_verify_unit){.technique = technique, .name = name, .steps = (double)steps};
    return true;
}

// A missing device is listed behind the others, so that machines list them in different orders.
static int by_name(const void *a, const void *b)
{
    const struct rg_verify_unit *x = a, *y = b;
    const int order = strcmp(x->technique, y->technique);
    return order ? order : strcmp(x->name, y->name);
}

bool rg_units_cut(struct rg_verify_units *units, const struct rg_shard *shard)
{
    double *steps = rg_alloc((size_t)units->count, sizeof(*steps), "units");
    int *shard_of = rg_alloc((size_t)units->count, sizeof(*shard_of), "units");
    if (units->count)
        qsort(units->all, (size_t)units->count, sizeof(*units->all), by_name);
    for (int i = 0; steps && i < units->count; i++)
        steps[i] = units->all[i].steps;
    const bool ok =
        steps && shard_of && rg_shard_cut(steps, units->count, shard->count, shard_of, NULL);
    for (int i = 0; ok && i < units->count; i++)
        units->all[i].is_here = shard_of[i] == shard->number;
    free(steps);
    free(shard_of);
    return ok;
}

bool rg_units_have(const struct rg_verify_units *units, const char *technique, const char *name)
{
    for (int i = 0; i < units->count; i++)
        if (!strcmp(units->all[i].technique, technique) && !strcmp(units->all[i].name, name))
            return units->all[i].is_here;
    return false;
}

bool rg_units_have_any(const struct rg_verify_units *units)
{
    bool any = false;
    for (int i = 0; i < units->count; i++)
        any = any || units->all[i].is_here;
    return any;
}

json_t *rg_units_whole(const struct rg_verify_units *units, json_t *how)
{
    json_t *names = json_array();
    for (int i = 0; i < units->count; i++)
        json_array_append_new(names,
                              json_pack("[ss]", units->all[i].technique, units->all[i].name));
    return json_pack("{ss so so}", "commit", rg_build_commit, "options", how, "units", names);
}

// --- all shards together ---

static bool is_same(const struct rg_check *a, const struct rg_check *b)
{
    return a->status == b->status && !strcmp(a->technique, b->technique) &&
           !strcmp(a->check, b->check) && !strcmp(a->device, b->device) &&
           !strcmp(a->detail, b->detail);
}

// cpu:reference is run in each shard of a technique, and says the same in each.
static void drop_again(struct rg_checks *checks, int first)
{
    int kept = first;
    for (int i = first; i < checks->count; i++) {
        bool is_new = true;
        for (int k = 0; k < first; k++)
            is_new = is_new && !is_same(&checks->rows[i], &checks->rows[k]);
        if (is_new)
            checks->rows[kept++] = checks->rows[i];
    }
    checks->count = kept;
}

// The place of a check among those of its technique: a missing device, state, image, laws, mutants.
static int place_of(const struct rg_check *row)
{
    static const char *const names[] = {"device", "state", "image", "stages"};
    for (int i = 0; i < 4; i++)
        if (!strcmp(row->check, names[i]))
            return i;
    return strcmp(row->check, RG_UNIT_MUTANTS) ? 4 : 5;
}

// Whether a row stands before one that was read before it.
static bool is_before(const struct rg_check *row, const struct rg_check *other)
{
    const int technique = strcmp(row->technique, other->technique);
    const int place = place_of(row), other_place = place_of(other);
    if (technique || place != other_place)
        return technique ? technique < 0 : place < other_place;
    return strcmp(row->check, other->check) < 0;
}

// Inserts each row behind those that do not follow it, so that rows of one check keep their order.
static void sort(struct rg_checks *checks)
{
    for (int i = 1; i < checks->count; i++) {
        const struct rg_check row = checks->rows[i];
        int at = i;
        for (; at && is_before(&row, &checks->rows[at - 1]); at--)
            checks->rows[at] = checks->rows[at - 1];
        checks->rows[at] = row;
    }
}

bool rg_checks_merge(const struct rg_parts *parts, struct rg_checks *checks)
{
    bool ok = true;
    for (int i = 0; ok && i < parts->count; i++) {
        const json_t *rows = json_object_get(parts->documents[i], "checks"), *row;
        const int exit = rg_exit_of_record(json_object_get(parts->documents[i], "exit"));
        const int first = checks->count;
        size_t k;
        json_array_foreach(rows, k, row)
        {
            ok = ok && rg_checks_read(checks, row);
        }
        drop_again(checks, first);
        checks->exit = rg_exit_worse(checks->exit, exit);
    }
    sort(checks);
    return ok;
}

json_t *rg_checks_merge_devices(const struct rg_parts *parts)
{
    json_t *all = json_array(), *device, *other;
    for (int i = 0; i < parts->count; i++) {
        json_t *devices = json_object_get(parts->documents[i], "devices");
        size_t k, j;
        json_array_foreach(devices, k, device)
        {
            bool is_new = true;
            json_array_foreach(all, j, other)
            {
                is_new = is_new && strcmp(rg_json_text_of(other, "name"),
                                          rg_json_text_of(device, "name")) != 0;
            }
            if (is_new)
                json_array_append(all, device);
        }
    }
    return all;
}
