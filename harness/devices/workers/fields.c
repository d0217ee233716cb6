#include "harness/devices/workers/fields.h"

#include <stdlib.h>
#include <string.h>

#include "core/base/array.h"

// The address of a field's entry in its struct, or of a counter that belongs to it.
static void *at(const void *all, size_t offset)
{
    return (char *)(uintptr_t)all + offset;
}

static int count_of(const struct rg_field *field, const void *all)
{
    return *(const int *)at(all, field->count);
}

// --- putting ---

static void put_text(struct rg_message *message, const char *text, size_t size)
{
    const size_t length = strnlen(text, size);
    rg_put_block(message, text, (int64_t)(length < size ? length + 1 : size));
}

static void put_rows(struct rg_message *message, const struct rg_field *field, const void *rows,
                     int count)
{
    rg_put_int(message, count);
    for (int i = 0; i < count; i++)
        rg_put_fields(message, field->of, at(rows, (size_t)i * field->size));
}

static void put_entry(struct rg_message *message, const struct rg_field *field, const void *all,
                      const void *entry)
{
    const char *name = field->kind == RG_KIND_NAME ? *(const char *const *)entry : NULL;
    switch (field->kind) {
    case RG_KIND_INTEGER:
    case RG_KIND_NUMBER:
    case RG_KIND_BYTES:
        rg_put(message, entry, (int64_t)field->size);
        break;
    case RG_KIND_TEXT:
        put_text(message, entry, field->size);
        break;
    case RG_KIND_NAME:
        rg_put_text(message, name ? name : "");
        break;
    case RG_KIND_STRUCT:
        rg_put_fields(message, field->of, entry);
        break;
    case RG_KIND_BLOCK:
        rg_put_block(message, *(void *const *)entry,
                     (int64_t) * (const size_t *)at(all, field->count));
        break;
    case RG_KIND_LIST:
        put_rows(message, field, *(void *const *)entry, count_of(field, all));
        break;
    case RG_KIND_OWN:
        field->way->put(message, entry);
        break;
    case RG_KIND_CHECK:
    case RG_KIND_END:
        break;
    }
}

void rg_put_fields(struct rg_message *message, const struct rg_field *fields, const void *all)
{
    for (const struct rg_field *field = fields; field->kind != RG_KIND_END; field++) {
        if (field->is_counted)
            put_rows(message, field, at(all, field->offset), count_of(field, all));
        for (size_t i = 0; i < field->entries && !field->is_counted; i++)
            put_entry(message, field, all, at(all, field->offset + i * field->size));
    }
}

// --- taking ---

// The integer as stored in the message; it is unsigned if its range has no negative number.
static int64_t integer_of(const void *value, const struct rg_field *field)
{
    uint8_t byte;
    int32_t word;
    int64_t whole = 0;
    if (field->size == sizeof(byte))
        return memcpy(&byte, value, sizeof(byte)), byte;
    if (field->size == sizeof(whole))
        return memcpy(&whole, value, sizeof(whole)), whole;
    memcpy(&word, value, sizeof(word));
    return field->least < 0 ? (int64_t)word : (int64_t)(uint32_t)word;
}

static bool is_within(const void *value, const struct rg_field *field)
{
    double number;
    if (field->kind == RG_KIND_BYTES)
        return true;
    if (field->kind == RG_KIND_INTEGER)
        return integer_of(value, field) >= field->least && integer_of(value, field) <= field->most;
    memcpy(&number, value, sizeof(number));
    return number >= (double)field->least && number <= (double)field->most;
}

static bool take_value(struct rg_message *message, const struct rg_field *field, void *entry)
{
    if (message->failed || (int64_t)field->size > message->size - message->at ||
        !is_within(message->bytes + message->at, field))
        return rg_message_fail(message);
    return rg_take(message, entry, (int64_t)field->size);
}

static bool take_text(struct rg_message *message, char *text, size_t size)
{
    const char *taken = rg_take_text(message);
    if (message->failed || strlen(taken) >= size)
        return rg_message_fail(message);
    strcpy(text, taken);
    return true;
}

static bool take_block(struct rg_message *message, const struct rg_field *field, void *all)
{
    int64_t size;
    void *bytes = rg_take_block(message, &size);
    *(void **)at(all, field->offset) = bytes;
    *(size_t *)at(all, field->count) = (size_t)size;
    return bytes;
}

// Allocates memory as rows arrive, because the announced number may be false.
static bool take_list(struct rg_message *message, const struct rg_field *field, void *all)
{
    void **rows = at(all, field->offset);
    int *count = at(all, field->count);
    int64_t *room = at(all, field->room);
    const int64_t due = rg_take_int(message);
    bool ok = (due >= 0 && due <= field->most) || rg_message_fail(message);
    for (int64_t i = 0; ok && i < due; i++) {
        ok = rg_array_fit(rows, room, i + 1, (int)field->size, "rows of a message");
        if (!ok)
            return false;
        void *row = at(*rows, (size_t)i * field->size);
        memset(row, 0, field->size);
        *count = (int)i + 1;
        ok = rg_take_fields(message, field->of, row);
    }
    return ok && !message->failed;
}

static bool take_some(struct rg_message *message, const struct rg_field *field, void *all)
{
    int *count = at(all, field->count);
    *count = rg_take_index(message, (int)field->entries + 1);
    for (int i = 0; i < *count && !message->failed; i++)
        rg_take_fields(message, field->of, at(all, field->offset + (size_t)i * field->size));
    return !message->failed;
}

static bool take_entry(struct rg_message *message, const struct rg_field *field, void *all,
                       void *entry)
{
    const char *name = field->kind == RG_KIND_NAME ? rg_take_name(message) : NULL;
    switch (field->kind) {
    case RG_KIND_INTEGER:
    case RG_KIND_NUMBER:
    case RG_KIND_BYTES:
        return take_value(message, field, entry);
    case RG_KIND_TEXT:
        return take_text(message, entry, field->size);
    case RG_KIND_NAME:
        *(const char **)entry = *name ? name : NULL;
        return *name || !field->least ? !message->failed : rg_message_fail(message);
    case RG_KIND_STRUCT:
        return rg_take_fields(message, field->of, entry);
    case RG_KIND_BLOCK:
        return take_block(message, field, all);
    case RG_KIND_LIST:
        return take_list(message, field, all);
    case RG_KIND_OWN:
        return field->way->take(message, entry);
    case RG_KIND_CHECK:
        return field->holds(all) || rg_message_fail(message);
    case RG_KIND_END:
        break;
    }
    return true;
}

bool rg_take_fields(struct rg_message *message, const struct rg_field *fields, void *all)
{
    bool ok = !message->failed;
    for (const struct rg_field *field = fields; ok && field->kind != RG_KIND_END; field++) {
        if (field->is_counted)
            ok = take_some(message, field, all);
        for (size_t i = 0; ok && i < field->entries && !field->is_counted; i++)
            ok = take_entry(message, field, all, at(all, field->offset + i * field->size));
    }
    return ok;
}

// --- giving back ---

static void free_rows(const struct rg_field *field, void *all)
{
    void **rows = at(all, field->offset);
    for (int i = 0; i < count_of(field, all); i++)
        rg_free_fields(field->of, at(*rows, (size_t)i * field->size));
    free(*rows);
}

void rg_free_fields(const struct rg_field *fields, void *all)
{
    for (const struct rg_field *field = fields; field->kind != RG_KIND_END; field++) {
        void *entry = at(all, field->offset);
        if (field->kind == RG_KIND_STRUCT && !field->is_counted)
            rg_free_fields(field->of, entry);
        else if (field->kind == RG_KIND_BLOCK)
            free(*(void **)entry);
        else if (field->kind == RG_KIND_LIST)
            free_rows(field, all);
        else if (field->kind == RG_KIND_OWN && field->way->free)
            field->way->free(entry);
    }
}
