#include "harness/record/schema/fields.h"

#include <limits.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "core/base/text/plain.h"

void rg_reader_enter(struct rg_reader *reader, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    vsnprintf(reader->place, sizeof(reader->place), format, args);
    va_end(args);
}

bool rg_reader_refuse(struct rg_reader *reader, const char *field, const char *format, ...)
{
    char what[128];
    va_list args;
    va_start(args, format);
    vsnprintf(what, sizeof(what), format, args);
    va_end(args);
    const char *dot = *reader->place && *field ? "." : "";
    const char *space = *reader->place || *field ? " " : "";
    snprintf(reader->why, reader->why_size, "%.200s: %s%s%.48s%s%s; %s", reader->file,
             reader->place, dot, field, space, what, reader->mend);
    return false;
}

static const char *kind_of(json_type type)
{
    static const char *const kinds[] = {
        [JSON_OBJECT] = "object",        [JSON_ARRAY] = "array", [JSON_STRING] = "text",
        [JSON_INTEGER] = "whole number", [JSON_REAL] = "number", [JSON_TRUE] = "true or false",
        [JSON_FALSE] = "true or false"};
    return kinds[type];
}

static json_t *find(struct rg_reader *reader, const json_t *object, const char *name)
{
    json_t *value = json_object_get(object, name);
    if (!value)
        rg_reader_refuse(reader, name, "is missing");
    return value;
}

json_t *rg_field(struct rg_reader *reader, const json_t *object, const char *name, json_type type)
{
    json_t *value = find(reader, object, name);
    if (value && json_typeof(value) == type)
        return value;
    if (value)
        rg_reader_refuse(reader, name, "is no %s", kind_of(type));
    return NULL;
}

json_t *rg_field_array(struct rg_reader *reader, const json_t *object, const char *name, int most,
                       int *count)
{
    json_t *array = rg_field(reader, object, name, JSON_ARRAY);
    const size_t size = json_array_size(array);
    const bool fits = size > 0 && size <= (size_t)most;
    if (array && !fits)
        rg_reader_refuse(reader, name, "has not 1 to %d elements", most);
    *count = fits ? (int)size : 0;
    return fits ? array : NULL;
}

static bool take_text(struct rg_reader *reader, const json_t *value, const char *name, char *text,
                      size_t size)
{
    if (!json_is_string(value))
        return rg_reader_refuse(reader, name, "is no text");
    const size_t length = json_string_length(value); // jansson takes no zero byte within
    if (length >= size)
        return rg_reader_refuse(reader, name, "is no text of less than %zu bytes", size);
    memcpy(text, json_string_value(value), length + 1);
    rg_plain(text);
    return true;
}

bool rg_field_text(struct rg_reader *reader, const json_t *object, const char *name, char *text,
                   size_t size)
{
    const json_t *value = find(reader, object, name);
    return value && take_text(reader, value, name, text, size);
}

bool rg_field_text_or_null(struct rg_reader *reader, const json_t *object, const char *name,
                           char *text, size_t size)
{
    const json_t *value = find(reader, object, name);
    *text = 0;
    return value && (json_is_null(value) || take_text(reader, value, name, text, size));
}

bool rg_field_bool(struct rg_reader *reader, const json_t *object, const char *name, bool *value)
{
    const json_t *found = find(reader, object, name);
    if (found && !json_is_boolean(found))
        return rg_reader_refuse(reader, name, "is neither true nor false");
    *value = json_is_true(found);
    return found != NULL;
}

bool rg_field_int(struct rg_reader *reader, const json_t *object, const char *name, int least,
                  int most, int *value)
{
    const json_t *found = find(reader, object, name);
    if (!found)
        return false;
    const json_int_t number = json_integer_value(found);
    if (!json_is_integer(found) || number < least || number > most)
        return most == INT_MAX
                   ? rg_reader_refuse(reader, name, "is no whole number from %d on", least)
                   : rg_reader_refuse(reader, name, "is no whole number from %d to %d", least,
                                      most);
    *value = (int)number;
    return true;
}

bool rg_field_number(struct rg_reader *reader, const json_t *object, const char *name,
                     double *value)
{
    const json_t *found = find(reader, object, name);
    *value = json_number_value(found);
    if (found && (!json_is_number(found) || *value < 0))
        return rg_reader_refuse(reader, name, "is no number from 0 on");
    return found != NULL;
}

bool rg_field_count(struct rg_reader *reader, const json_t *object, const char *name,
                    int64_t *value)
{
    const json_t *found = find(reader, object, name);
    *value = json_is_integer(found) ? json_integer_value(found) : -1;
    if (found && !json_is_null(found) && *value < 0)
        return rg_reader_refuse(reader, name, "is no whole number from 0 on");
    return found != NULL;
}

// Reads the fields of an object one by one, each by `take`, into elements of this size.
static bool read_list(struct rg_reader *reader, const json_t *object, const char *name, void *list,
                      size_t size, int most, int *count,
                      bool (*take)(struct rg_reader *, const char *, const json_t *, void *))
{
    json_t *fields = rg_field(reader, object, name, JSON_OBJECT), *value;
    const char *key;
    *count = 0;
    if (!fields)
        return false;
    if (json_object_size(fields) > (size_t)most)
        return rg_reader_refuse(reader, name, "has more than %d fields", most);
    json_object_foreach(fields, key, value)
    {
        if (!*key || strlen(key) >= RG_NAME_SIZE)
            return rg_reader_refuse(reader, name, "has a field whose name has not 1 to %d bytes",
                                    RG_NAME_SIZE - 1);
        if (!take(reader, key, value, (char *)list + (size_t)*count * size))
            return rg_reader_refuse(reader, name, "has '%s', which is of another kind", key);
        ++*count;
    }
    return true;
}

static bool take_named(struct rg_reader *reader, const char *key, const json_t *value, void *to)
{
    struct rg_named *named = to;
    *named = (struct rg_named){.number = NAN};
    memcpy(named->name, key, strlen(key) + 1);
    rg_plain(named->name);
    if (json_is_number(value))
        named->number = json_number_value(value);
    if (json_is_string(value))
        return json_string_length(value) &&
               take_text(reader, value, key, named->text, sizeof(named->text));
    return json_is_number(value) || json_is_null(value);
}

bool rg_field_named(struct rg_reader *reader, const json_t *object, const char *name,
                    struct rg_named *named, int most, int *count)
{
    return read_list(reader, object, name, named, sizeof(*named), most, count, take_named);
}

static bool take_count(struct rg_reader *reader, const char *key, const json_t *value, void *to)
{
    struct rg_count *count = to;
    (void)reader;
    *count = (struct rg_count){.value = json_integer_value(value)};
    memcpy(count->name, key, strlen(key) + 1);
    rg_plain(count->name);
    return json_is_integer(value);
}

bool rg_field_counts(struct rg_reader *reader, const json_t *object, const char *name,
                     struct rg_count *counts, int most, int *count)
{
    return read_list(reader, object, name, counts, sizeof(*counts), most, count, take_count);
}

bool rg_field_tally(struct rg_reader *reader, const json_t *object, const char *name,
                    struct rg_tally *tally)
{
    char outer[sizeof(reader->place)];
    const json_t *json = rg_field(reader, object, name, JSON_OBJECT);
    bool ok = json != NULL;
    memcpy(outer, reader->place, sizeof(outer));
    rg_reader_enter(reader, "%.60s.%s", outer, name);
    for (int i = 0; ok && i < RG_TALLY_FIELDS; i++) {
        const struct rg_tally_field *field = &rg_tally_fields[i];
        int64_t count;
        ok = rg_field_count(reader, json, field->name, &count);
        memcpy((char *)tally + field->offset, &count, sizeof(count));
    }
    memcpy(reader->place, outer, sizeof(outer));
    return ok;
}
