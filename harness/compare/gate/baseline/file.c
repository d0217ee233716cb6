// A baseline as a document, and as a file.
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/compare/gate/baseline/baseline.h"
#include "harness/record/disk/document.h"
#include "harness/record/disk/seal.h"
#include "harness/record/output.h"
#include "harness/record/passport/key.h"
#include "harness/record/schema/fields.h"

static const char mend[] = "name a file as `raingauge baseline -o` writes it";

// --- writing ---

static json_t *launches_json(const struct rg_launches *launches)
{
    json_t *json = json_array();
    for (int i = 0; i < launches->count; i++)
        json_array_append_new(json, json_real(launches->ms[i]));
    return json;
}

static json_t *states_json(const struct rg_baseline_row *row)
{
    json_t *json = json_object();
    for (int i = 0; i < row->state_count; i++)
        json_object_set_new(json, row->states[i].name, json_string(row->states[i].digest));
    return json;
}

static json_t *row_json(const struct rg_baseline_row *row)
{
    json_t *json = json_pack(
        "{sssssssosssssosososisisososo}", "cell", row->cell, "technique", row->technique,
        "settings", row->settings, "device", rg_json_text(row->device), "outcome",
        rg_outcome_name(row->outcome), "picture", row->picture, "states", states_json(row),
        "counters", rg_counts_json(row->counters.counters, row->counters.count), "work",
        rg_tally_json(&row->work), "frames", row->slot.frames, "timings", row->slot.timings,
        "launches_ms", launches_json(&row->launches), "seconds", rg_number_json(row->seconds),
        "why", rg_json_text(row->why));
    return json;
}

static json_t *devices_json(const struct rg_baseline *baseline)
{
    json_t *json = json_array();
    for (int i = 0; i < baseline->device_count; i++) {
        const struct rg_baseline_device *device = &baseline->devices[i];
        char key[RG_KEY_SIZE];
        rg_key_hash(device->parts, key);
        json_array_append_new(json, json_pack("{sosssO}", "name", rg_json_text(device->name), "key",
                                              key, "of", device->parts));
    }
    return json;
}

static json_t *yardsticks_json(const struct rg_baseline *baseline)
{
    json_t *json = json_object();
    for (int i = 0; i < RG_YARDSTICKS; i++)
        json_object_set_new(json, rg_yardstick_name((enum rg_yardstick)i),
                            launches_json(&baseline->yardsticks[i]));
    return json;
}

static json_t *baseline_json(const struct rg_baseline *baseline)
{
    json_t *rows = json_array();
    bool is_whole = rows != NULL;
    for (int64_t i = 0; is_whole && i < baseline->count; i++)
        is_whole = !json_array_append_new(rows, row_json(&baseline->rows[i]));
    json_t *json = json_pack("{sisosOsoso}", "format", RG_BASELINE_FORMAT, "devices",
                             devices_json(baseline), "passport", baseline->passport,
                             "yardsticks_ms", yardsticks_json(baseline), "baseline", rows);
    if (json && is_whole && rg_seal(json))
        return json;
    json_decref(json);
    return NULL;
}

bool rg_baseline_write(const struct rg_baseline *baseline, const char *path)
{
    json_t *json = baseline_json(baseline);
    char *text = json ? json_dumps(json, JSON_INDENT(1) | RG_JSON_FLAGS) : NULL;
    const bool ok =
        text ? rg_output_write_file(path, text)
             : rg_harness_error("%s: no memory to write it; what was there is unchanged", path);
    free(text);
    json_decref(json);
    return ok;
}

// --- reading ---

static bool read_digest(struct rg_reader *r, const json_t *object, const char *name,
                        char digest[RG_DIGEST_SIZE])
{
    if (!rg_field_text(r, object, name, digest, RG_DIGEST_SIZE))
        return false;
    const size_t length = strspn(digest, "0123456789abcdef");
    return !digest[length] && (length == RG_DIGEST_SIZE - 1 || length == 0)
               ? true
               : rg_reader_refuse(r, name, "is no digest of %d digits", RG_DIGEST_SIZE - 1);
}

static bool read_launches(struct rg_reader *r, const json_t *object, const char *name,
                          struct rg_launches *launches)
{
    const json_t *json = rg_field(r, object, name, JSON_ARRAY);
    const size_t count = json_array_size(json);
    if (count > RG_BASELINE_LAUNCHES)
        return rg_reader_refuse(r, name, "has more than %d elements", RG_BASELINE_LAUNCHES);
    for (size_t i = 0; i < count; i++) {
        const double ms = json_number_value(json_array_get(json, i));
        if (!(ms > 0))
            return rg_reader_refuse(r, name, "has an element that is no time");
        launches->ms[launches->count++] = ms;
    }
    return json != NULL;
}

static bool read_states(struct rg_reader *r, const json_t *object, struct rg_baseline_row *row)
{
    json_t *states = rg_field(r, object, "states", JSON_OBJECT), *value;
    const char *name;
    if (json_object_size(states) > RG_MAX_STATE)
        return rg_reader_refuse(r, "states", "has more than %d fields", RG_MAX_STATE);
    json_object_foreach(states, name, value)
    {
        struct rg_baseline_state *state = &row->states[row->state_count++];
        if (strlen(name) >= sizeof(state->name))
            return rg_reader_refuse(r, "states", "has a name of more than %zu bytes",
                                    sizeof(state->name) - 1);
        rg_text_copy(state->name, sizeof(state->name), name);
        if (!read_digest(r, states, name, state->digest))
            return false;
    }
    return states != NULL;
}

static bool read_row(struct rg_reader *r, const json_t *object, struct rg_baseline *baseline)
{
    char outcome[16];
    struct rg_baseline_row *row = rg_baseline_add(baseline);
    if (!row || !rg_field_text(r, object, "cell", row->cell, sizeof(row->cell)) ||
        !rg_field_text(r, object, "technique", row->technique, sizeof(row->technique)) ||
        !read_digest(r, object, "settings", row->settings) ||
        !rg_field_text(r, object, "device", row->device, sizeof(row->device)) ||
        !rg_field_text(r, object, "outcome", outcome, sizeof(outcome)) ||
        !rg_field_text(r, object, "why", row->why, sizeof(row->why)) ||
        !read_digest(r, object, "picture", row->picture) || !read_states(r, object, row) ||
        !rg_field_counts(r, object, "counters", row->counters.counters, RG_MAX_COUNTERS,
                         &row->counters.count) ||
        !rg_field_tally(r, object, "work", &row->work) ||
        !rg_field_int(r, object, "frames", 0, RG_SLOT_FRAMES, &row->slot.frames) ||
        !rg_field_int(r, object, "timings", row->slot.frames > 0, RG_SLOT_TIMINGS,
                      &row->slot.timings) ||
        !read_launches(r, object, "launches_ms", &row->launches))
        return false;
    row->seconds = json_number_value(json_object_get(object, "seconds")); // older files have none
    if (!rg_outcome_find(outcome, &row->outcome))
        return rg_reader_refuse(r, "outcome", "is no outcome");
    if (!rg_baseline_device(baseline, row->device))
        return rg_reader_refuse(r, "device", "is none of its devices");
    return rg_baseline_find(baseline, row->cell, row->device) == row ||
           rg_reader_refuse(r, "", "stands there twice");
}

static bool read_rows(struct rg_reader *r, const json_t *document, struct rg_baseline *baseline)
{
    const json_t *rows = rg_field(r, document, "baseline", JSON_ARRAY), *row;
    size_t i;
    if (json_array_size(rows) > (size_t)RG_GATE_CELLS * RG_MAX_DEVICES)
        return rg_reader_refuse(r, "baseline", "has more elements than cells and devices make");
    json_array_foreach(rows, i, row)
    {
        rg_reader_enter(r, "baseline[%zu]", i);
        if (!read_row(r, row, baseline))
            return false;
    }
    return rows != NULL;
}

static bool are_texts(struct rg_reader *r, json_t *parts)
{
    const char *name;
    json_t *value;
    json_object_foreach(parts, name, value)
    {
        if (!json_is_string(value))
            return rg_reader_refuse(r, "of", "has '%.40s', which is no text", name);
    }
    return true;
}

static bool read_devices(struct rg_reader *r, const json_t *document, struct rg_baseline *baseline)
{
    int count;
    const json_t *devices = rg_field_array(r, document, "devices", RG_MAX_DEVICES, &count);
    for (int i = 0; i < count; i++) {
        struct rg_baseline_device *device = &baseline->devices[baseline->device_count++];
        const json_t *json = json_array_get(devices, (size_t)i);
        rg_reader_enter(r, "devices[%d]", i);
        device->parts = json_incref(rg_field(r, json, "of", JSON_OBJECT));
        if (!device->parts || !are_texts(r, device->parts) ||
            !rg_field_text(r, json, "name", device->name, sizeof(device->name)))
            return false;
    }
    rg_reader_enter(r, "%s", "");
    return count > 0;
}

static bool read_yardsticks(struct rg_reader *r, const json_t *document,
                            struct rg_baseline *baseline)
{
    const json_t *json = rg_field(r, document, "yardsticks_ms", JSON_OBJECT);
    bool ok = json != NULL;
    rg_reader_enter(r, "yardsticks_ms");
    for (int i = 0; ok && i < RG_YARDSTICKS; i++)
        ok = read_launches(r, json, rg_yardstick_name((enum rg_yardstick)i),
                           &baseline->yardsticks[i]);
    rg_reader_enter(r, "%s", "");
    return ok;
}

// Checks the version before the checksum, which another version may compute differently.
static bool read_format(struct rg_reader *r, const json_t *document)
{
    int format;
    if (!json_is_object(document) || !json_object_get(document, "baseline"))
        return rg_reader_refuse(r, "", "is no baseline");
    if (!rg_field_int(r, document, "format", 1, INT_MAX, &format))
        return false;
    return format == RG_BASELINE_FORMAT ||
           rg_reader_refuse(r, "format", "is %d, and this raingauge reads %d", format,
                            RG_BASELINE_FORMAT);
}

static bool read_document(const char *path, json_t *document, struct rg_baseline *baseline,
                          char why[RG_WHY_SIZE])
{
    struct rg_reader r = {.file = path, .mend = mend, .why = why, .why_size = RG_WHY_SIZE};
    if (!read_format(&r, document) || !rg_document_unseal(path, document, true, why))
        return false;
    baseline->passport = json_incref(rg_field(&r, document, "passport", JSON_OBJECT));
    return baseline->passport && read_devices(&r, document, baseline) &&
           read_yardsticks(&r, document, baseline) && read_rows(&r, document, baseline);
}

bool rg_baseline_read(struct rg_baseline *baseline, const char *path)
{
    char why[RG_WHY_SIZE] = "";
    bool is_alone;
    json_t *document = rg_document_first(path, &is_alone, mend, why);
    bool ok = document != NULL;
    if (ok && !is_alone) {
        snprintf(why, sizeof(why), "%.200s: goes on after its end; %s", path, mend);
        ok = false;
    }
    ok = ok && read_document(path, document, baseline, why);
    if (!ok && *why)
        rg_error("%s", why);
    json_decref(document);
    return ok;
}
