// Reads the head of a result's document: the table, before its cells.
#include <limits.h>
#include <stdio.h>
#include <string.h>

#include "harness/record/schema/read.h"
#include "harness/record/schema/schema.h"

// --- the table ---

static bool read_format(struct rg_reader *r, const json_t *document)
{
    int format;
    if (!json_is_object(document) || !json_object_get(document, "table"))
        return rg_reader_refuse(r, "", "is no table's result");
    if (!rg_field_int(r, document, "format", 1, INT_MAX, &format))
        return false;
    return format == RG_FORMAT_VERSION ||
           rg_reader_refuse(r, "format", "is %d, and this raingauge reads %d", format,
                            RG_FORMAT_VERSION);
}

static bool read_length(struct rg_reader *r, const json_t *document, struct rg_result *result)
{
    char length[8];
    if (!rg_field_text(r, document, "length", length, sizeof(length)))
        return false;
    result->full = !strcmp(length, "full");
    return result->full || !strcmp(length, "quick") ||
           rg_reader_refuse(r, "length", "is neither quick nor full");
}

// Files are named after the table, so its name has only safe characters.
static bool read_table(struct rg_reader *r, const json_t *document, struct rg_result *result)
{
    if (!rg_field_text(r, document, "table", result->table, sizeof(result->table)))
        return false;
    const size_t length = strspn(result->table, "abcdefghijklmnopqrstuvwxyz0123456789-.");
    return (length && !result->table[length] && *result->table != '.') ||
           rg_reader_refuse(r, "table", "is no name of small letters, digits, '-' and '.'");
}

static bool read_names(struct rg_reader *r, const json_t *document, struct rg_result *result)
{
    return read_table(r, document, result) &&
           rg_field_text(r, document, "technique", result->technique, sizeof(result->technique)) &&
           rg_field_text_or_null(r, document, "hardware", result->hardware,
                                 sizeof(result->hardware)) &&
           rg_field_text_or_null(r, document, "truth", result->truth, sizeof(result->truth)) &&
           rg_field_text_or_null(r, document, "quick", result->quick, sizeof(result->quick)) &&
           rg_field_text(r, document, "note", result->note, sizeof(result->note)) &&
           read_length(r, document, result);
}

// Two whole numbers of at least 1.
static bool read_pair(struct rg_reader *r, const json_t *document, const char *name, int most,
                      int *first, int *second)
{
    const json_t *pair = rg_field(r, document, name, JSON_ARRAY);
    json_int_t a = 0, b = 0;
    if (!pair)
        return false;
    if (json_unpack((json_t *)pair, "[II!]", &a, &b) || a < 1 || b < 1 || a > most || b > most)
        return rg_reader_refuse(r, name, "is no pair of whole numbers from 1 to %d", most);
    *first = (int)a;
    *second = (int)b;
    return true;
}

static bool read_numbers(struct rg_reader *r, const json_t *document, struct rg_result *result)
{
    enum { MOST_ROWS = 1 << 20, MOST_PX = 1 << 20 };
    bool is_timed;
    if (!read_pair(r, document, "size_px", MOST_PX, &result->width, &result->height) ||
        !read_pair(r, document, "rows", MOST_ROWS, &result->first_row, &result->last_row) ||
        !rg_field_int(r, document, "check_frames", 1, INT_MAX, &result->check_frames) ||
        !rg_field_int(r, document, "resumed_rows", 0, RG_RESULT_ROWS, &result->resumed_rows) ||
        !rg_field_bool(r, document, "timed", &is_timed))
        return false;
    result->is_of_textures = !is_timed;
    result->first_row--;
    result->last_row--;
    const int rows = result->last_row - result->first_row + 1;
    return (rows >= 1 && rows <= RG_RESULT_ROWS) ||
           rg_reader_refuse(r, "rows", "is no range of 1 to %d rows", RG_RESULT_ROWS);
}

// --- works, variants and devices ---

static bool read_variants(struct rg_reader *r, const json_t *document, struct rg_result *result)
{
    int count;
    const json_t *array = rg_field_array(r, document, "variants", RG_RESULT_VARIANTS, &count);
    for (int i = 0; i < count; i++) {
        const char *name = json_string_value(json_array_get(array, (size_t)i));
        if (!name || !*name || strlen(name) >= RG_NAME_SIZE)
            return rg_reader_refuse(r, "variants", "has an element that is no short name");
        rg_text_copy(result->variants[result->variant_count++], RG_NAME_SIZE, name);
    }
    return count > 0;
}

static bool read_works(struct rg_reader *r, const json_t *document, struct rg_result *result)
{
    if (!json_object_get(document, "works"))
        return true;
    int count;
    const json_t *array = rg_field_array(r, document, "works", RG_RESULT_WORKS, &count);
    for (int i = 0; i < count; i++) {
        struct rg_result_work *work = &result->works[result->work_count++];
        const json_t *json = json_array_get(array, (size_t)i);
        rg_reader_enter(r, "works[%d]", i);
        if (!rg_field_text(r, json, "name", work->name, sizeof(work->name)) ||
            !rg_field_text(r, json, "saves", work->saves, sizeof(work->saves)) ||
            (json_object_get(json, "reading") &&
             !rg_field_text(r, json, "reading", work->reading, sizeof(work->reading))))
            return false;
    }
    rg_reader_enter(r, "%s", "");
    return count > 0;
}

// Reads a device's full name, by which it can be opened again, and the files that its driver was
// loaded from. Records of older raingauges lack them.
static bool read_driver(struct rg_reader *r, const json_t *json, struct rg_device_info *info)
{
    const json_t *array = json_object_get(json, "libraries");
    const size_t count = json_array_size(array);
    memcpy(info->full, info->name, sizeof(info->full));
    bool ok = !json_object_get(json, "full") ||
              rg_field_text(r, json, "full", info->full, sizeof(info->full));
    if (ok && count > RG_DRIVER_LIBRARIES)
        return rg_reader_refuse(r, "libraries", "has more than %d elements", RG_DRIVER_LIBRARIES);
    for (size_t i = 0; ok && i < count; i++) {
        struct rg_library *library = &info->libraries[i];
        const json_t *of = json_array_get(array, i);
        ok = rg_field_text(r, of, "path", library->path, sizeof(library->path)) &&
             rg_field_text(r, of, "build", library->build, sizeof(library->build));
    }
    return ok;
}

static bool read_devices(struct rg_reader *r, const json_t *document, struct rg_result *result)
{
    int count;
    json_t *passport = rg_field(r, document, "passport", JSON_OBJECT);
    if (!passport)
        return false;
    rg_reader_enter(r, "passport");
    const json_t *array = rg_field_array(r, passport, "devices", RG_MAX_DEVICES, &count);
    for (int i = 0; i < count; i++) {
        struct rg_device_info *info = &result->devices[result->device_count++];
        const json_t *json = json_array_get(array, (size_t)i);
        rg_reader_enter(r, "passport.devices[%d]", i);
        if (!rg_field_text(r, json, "name", info->name, sizeof(info->name)) ||
            !rg_field_text(r, json, "api", info->api, sizeof(info->api)) ||
            !rg_field_text(r, json, "device", info->device, sizeof(info->device)) ||
            !rg_field_text(r, json, "driver", info->driver, sizeof(info->driver)) ||
            !rg_field_bool(r, json, "software", &info->software) || !read_driver(r, json, info))
            return false;
    }
    rg_reader_enter(r, "%s", "");
    result->passport = json_incref(passport);
    return count > 0;
}

static bool read_missing(struct rg_reader *r, const json_t *document, struct rg_result *result)
{
    const json_t *array = rg_field(r, document, "missing", JSON_ARRAY);
    const size_t count = json_array_size(array);
    if (count > RG_RESULT_MISSING)
        return rg_reader_refuse(r, "missing", "has more than %d elements", RG_RESULT_MISSING);
    for (size_t i = 0; i < count; i++) {
        const char *text = json_string_value(json_array_get(array, i));
        if (!text || strlen(text) >= sizeof(result->missing[0]))
            return rg_reader_refuse(r, "missing", "has an element that is no line of text");
        rg_text_copy(result->missing[result->missing_count++], sizeof(result->missing[0]), text);
    }
    return array != NULL;
}

static bool read_changed(struct rg_reader *r, const json_t *document, struct rg_result *result)
{
    return !json_object_get(document, "changed") ||
           rg_field_text(r, document, "changed", result->changed, sizeof(result->changed));
}

// The rows that a budget or quick mode left out, counted from 1.
static bool read_left_out(struct rg_reader *r, const json_t *of, struct rg_result *result)
{
    const json_t *rows = rg_field(r, of, "left_out", JSON_ARRAY);
    for (size_t i = 0; i < json_array_size(rows); i++) {
        const json_int_t row = json_integer_value(json_array_get(rows, i)) - 1;
        if (row < result->first_row || row > result->last_row)
            return rg_reader_refuse(r, "left_out", "has a row that is none of the table's");
        result->left_out[row - result->first_row] = true;
    }
    return rows != NULL;
}

// Reads the choices of a budget or of quick mode. Older records of quick mode lack them.
static bool read_choice(struct rg_reader *r, const json_t *document, struct rg_result *result)
{
    if (!json_object_get(document, "budget"))
        return !json_object_get(document, "left_out") || read_left_out(r, document, result);
    const json_t *budget = rg_field(r, document, "budget", JSON_OBJECT);
    rg_reader_enter(r, "budget");
    const bool ok = budget && rg_field_number(r, budget, "seconds", &result->budget_s) &&
                    rg_field_int(r, budget, "size_divisor", 1, 4, &result->size_divisor) &&
                    rg_field_bool(r, budget, "few_samples", &result->few_samples) &&
                    read_left_out(r, budget, result);
    rg_reader_enter(r, "%s", "");
    return ok;
}

bool rg_read_head(struct rg_reader *r, const json_t *document, struct rg_result *result)
{
    return read_format(r, document) && read_names(r, document, result) &&
           read_changed(r, document, result) && read_numbers(r, document, result) &&
           read_choice(r, document, result) && read_variants(r, document, result) &&
           read_works(r, document, result) && read_devices(r, document, result) &&
           read_missing(r, document, result);
}
