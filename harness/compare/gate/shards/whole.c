// The report of a gate from the records of its shards.
#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "harness/compare/gate/shards/shards.h"
#include "harness/console/exit.h"

// --- what shards say once ---

// The driver of a device in a shard's passport; "" if it has none.
static const char *driver_of(const json_t *passport, const char *name)
{
    const json_t *devices = json_object_get(passport, "devices"), *device;
    size_t i;
    json_array_foreach(devices, i, device)
    {
        if (!strcmp(rg_json_text_of(device, "name"), name))
            return rg_json_text_of(device, "driver");
    }
    return "";
}

// Whether a shard ran each device with the driver with which an earlier one did. False, and one
// logged line, if not: their cases would be of two drivers under one name.
static bool have_one_driver(const json_t *then, int before, const json_t *now, int number)
{
    const json_t *devices = json_object_get(now, "devices"), *device;
    size_t i;
    json_array_foreach(devices, i, device)
    {
        const char *name = rg_json_text_of(device, "name"),
                   *driver = rg_json_text_of(device, "driver");
        const char *was = driver_of(then, name);
        if (*was && strcmp(was, driver) != 0)
            return rg_error(
                "gate: shard %d ran '%s' with driver %s, and shard %d with %s; run them "
                "with one driver",
                number, name, driver, before, was);
    }
    return true;
}

static bool have_one_driver_each(const struct rg_parts *parts)
{
    json_t *passports = json_array();
    bool ok = true;
    for (int i = 0; ok && i < parts->count; i++) {
        json_t *now = json_loads(rg_json_text_of(parts->documents[i], "passport_text"), 0, NULL);
        for (int k = 0; ok && k < i; k++)
            ok = have_one_driver(json_array_get(passports, (size_t)k), k + 1, now, i + 1);
        json_array_append_new(passports, now ? now : json_null());
    }
    json_decref(passports);
    return ok;
}

// --- cases ---

// Adds the cases of cells, in the order of a gate without shards.
static bool add_cells(const struct rg_parts *parts, struct rg_report *report)
{
    const size_t count = json_array_size(json_object_get(parts->of, "names"));
    const json_t **at = rg_alloc(count, sizeof(const json_t *), "gate");
    bool ok = at;
    for (int i = 0; ok && i < parts->count; i++) {
        const json_t *places = json_object_get(parts->documents[i], "places"), *place;
        const json_t *cases = json_object_get(parts->documents[i], "gated");
        size_t k;
        json_array_foreach(places, k, place)
        {
            const json_int_t number = json_integer_value(place);
            if (number >= 0 && (size_t)number < count)
                at[number] = json_array_get(cases, k);
        }
    }
    for (size_t i = 0; ok && i < count; i++)
        ok = !at[i] || rg_report_read(report, at[i]);
    free(at);
    return ok;
}

// Adds the other cases of a device: "" for devices that are required and not there, each once; else
// its fixed functions.
static bool add_others(const struct rg_parts *parts, const char *device, struct rg_report *report)
{
    bool ok = true;
    for (int i = 0; i < parts->count; i++) {
        const json_t *cases = json_object_get(parts->documents[i], "gated");
        for (size_t k = json_array_size(json_object_get(parts->documents[i], "places"));
             ok && k < json_array_size(cases); k++) {
            const json_t *found = json_array_get(cases, k);
            const bool is_required = !*rg_json_text_of(found, "technique");
            const char *own =
                json_string_value(json_array_get(json_object_get(found, "devices"), 0));
            if (*device ? !is_required && own && !strcmp(own, device)
                        : is_required && !rg_report_has(report, rg_json_text_of(found, "name")))
                ok = rg_report_read(report, found);
        }
    }
    return ok;
}

static bool add_all(const struct rg_parts *parts, struct rg_report *report)
{
    const json_t *pairs = json_object_get(parts->of, "pairs"), *pair;
    bool ok = add_cells(parts, report) &&
              rg_gate_hold_required(rg_json_text_of(parts->of, "require"), report) &&
              add_others(parts, "", report);
    size_t i;
    json_array_foreach(pairs, i, pair)
    {
        const char *b = json_string_value(json_array_get(pair, RG_SIDE_B));
        ok = ok && (!b || add_others(parts, b, report));
    }
    return ok;
}

// --- results, for files of expectations ---

// Where a result stands in a gate without shards: first cells that were left out, then cells in
// their order, then fixed functions, device by device.
static size_t place_of(const struct rg_parts *parts, const struct rg_known_result *result)
{
    const json_t *names = json_object_get(parts->of, "names"), *name;
    const size_t count = json_array_size(names);
    const bool is_fixed = !strncmp(result->cell, RG_GATE_FIXED "/", strlen(RG_GATE_FIXED "/"));
    char *own = rg_gate_case_name(is_fixed ? RG_GATE_FIXED : result->cell, result->device);
    size_t place = 0, i;
    json_array_foreach(names, i, name)
    {
        if (own && !strcmp(json_string_value(name), own))
            place = 1 + i + (is_fixed ? count : 0);
    }
    free(own);
    return place;
}

struct placed {
    size_t place, order;
    struct rg_known_result result;
};

static int compare(const void *a, const void *b)
{
    const struct placed *x = a, *y = b;
    return x->place != y->place ? (x->place > y->place) - (x->place < y->place)
                                : (x->order > y->order) - (x->order < y->order);
}

// The results of all shards, in their order. Returns how many.
static size_t read_results(const struct rg_parts *parts, struct placed *all)
{
    size_t count = 0, k;
    json_t *found;
    for (int i = 0; i < parts->count; i++) {
        json_array_foreach(json_object_get(parts->documents[i], "results"), k, found)
        {
            struct rg_known_result result = {
                .cell = rg_json_text_of(found, "cell"),
                .device = rg_json_text_of(found, "device"),
                .driver = json_string_value(json_object_get(found, "driver")),
                .pixels = rg_json_number_of(found, "pixels"),
                .difference = rg_json_number_of(found, "difference"),
                .is_foreign = json_is_true(json_object_get(found, "foreign"))};
            if (!rg_outcome_find(rg_json_text_of(found, "outcome"), &result.outcome))
                continue;
            all[count] = (struct placed){place_of(parts, &result), count, result};
            count++;
        }
    }
    return count;
}

static bool add_results(const struct rg_parts *parts, struct rg_gate *gate)
{
    size_t room = 0;
    for (int i = 0; i < parts->count; i++)
        room += json_array_size(json_object_get(parts->documents[i], "results"));
    struct placed *all = rg_alloc(room, sizeof(*all), "gate");
    gate->results = rg_alloc(room, sizeof(*gate->results), "gate");
    const size_t count = all && gate->results ? read_results(parts, all) : 0;
    if (count)
        qsort(all, count, sizeof(*all), compare);
    for (size_t i = 0; i < count; i++)
        gate->results[gate->result_count++] = all[i].result;
    const bool ok = all && gate->results;
    free(all);
    return ok;
}

// --- all ---

bool rg_gate_merge(const struct rg_parts *parts, struct rg_gate *gate)
{
    char *passport = rg_parts_texts(parts, "passport_text", false);
    for (int i = 0; i < parts->count; i++) {
        const json_t *exit = json_object_get(parts->documents[i], "exit");
        gate->beyond = rg_exit_worse(gate->beyond, rg_exit_of_record(exit));
    }
    gate->note = rg_parts_texts(parts, "note", true);
    gate->chosen = (int)json_array_size(json_object_get(parts->of, "names"));
    if (passport && *passport)
        passport[strlen(passport) - 1] = 0; // its last line's end
    gate->is_told = passport && gate->note && have_one_driver_each(parts) &&
                    rg_report_set_passport(&gate->report, passport) &&
                    add_all(parts, &gate->report) && add_results(parts, gate);
    free(passport);
    return gate->is_told;
}
