#include "harness/devices/frames/messages.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"

// --- settings, by name: another build may have more, and at other offsets ---

enum { VALUE_SIZE = RG_PATH_SIZE + 1 };

static double *number_at(const struct rg_param *param, const void *settings)
{
    return (double *)((char *)(uintptr_t)settings + param->offset);
}

static bool is_initial(const struct rg_param *param, const void *settings, const void *initial)
{
    char value[VALUE_SIZE], usual[VALUE_SIZE];
    if (param->kind == RG_PARAM_FLOAT)
        return *number_at(param, settings) == param->initial;
    rg_params_text(param, settings, value, sizeof(value));
    rg_params_text(param, initial, usual, sizeof(usual));
    return !strcmp(value, usual);
}

// A fractional number is sent as its bits, because text would round it.
static void put_param(struct rg_message *message, const struct rg_param *param,
                      const void *settings, const void *initial)
{
    char value[VALUE_SIZE];
    const bool is_number = param->kind == RG_PARAM_FLOAT;
    rg_put_text(message, param->name);
    rg_put_int(message, is_initial(param, settings, initial));
    rg_put_int(message, is_number);
    if (is_number) {
        RG_PUT(message, *number_at(param, settings));
        return;
    }
    rg_params_text(param, settings, value, sizeof(value));
    rg_put_text(message, value);
}

void rg_put_subject(struct rg_message *message, const struct rg_subject *subject)
{
    const struct rg_param_table *params = subject->technique->params;
    void *initial = rg_settings_create(subject->technique);
    message->failed = message->failed || !initial;
    rg_put_text(message, subject->technique->name);
    rg_put_int(message, params->count);
    for (int i = 0; initial && i < params->count; i++)
        put_param(message, &params->rows[i], subject->settings, initial);
    rg_put_int(message, subject->width);
    rg_put_int(message, subject->height);
    free(initial);
}

static bool take_number(struct rg_message *message, const struct rg_param *param, void *settings)
{
    double value;
    if (!RG_TAKE(message, value) || !param)
        return !message->failed;
    if (param->kind != RG_PARAM_FLOAT || !(value >= param->min && value <= param->max))
        return rg_error("a message between processes has no value for '%s'", param->name);
    *number_at(param, settings) = value;
    return true;
}

static bool take_text(struct rg_message *message, const struct rg_param *param, void *settings)
{
    const char *value = rg_take_text(message);
    if (message->failed || !param)
        return !message->failed;
    if (param->kind == RG_PARAM_FLOAT)
        return rg_error("a message between processes has no value for '%s'", param->name);
    return rg_params_set_one(param, settings, value);
}

// Ignores an unknown parameter if it has its default.
static bool take_param(struct rg_message *message, const struct rg_param_table *params,
                       void *settings)
{
    const char *name = rg_take_text(message);
    const struct rg_param *param = rg_params_find(params, name);
    const bool is_usual = rg_take_index(message, 2);
    if (!message->failed && !param && !is_usual)
        return rg_error("parameter '%.80s': this build's %s has none of that name, and the other "
                        "build gives it a value that is not usual",
                        name, params->technique);
    return rg_take_index(message, 2) ? take_number(message, param, settings)
                                     : take_text(message, param, settings);
}

bool rg_take_subject(struct rg_message *message, struct rg_subject *subject)
{
    *subject = (struct rg_subject){.technique = rg_technique_find(rg_take_text(message))};
    const int count = rg_take_index(message, INT32_MAX);
    if (!subject->technique)
        return rg_error("a message between processes names no technique");
    void *settings = rg_settings_create(subject->technique);
    if (!settings)
        return false;
    bool ok = true;
    for (int i = 0; ok && i < count && !message->failed; i++)
        ok = take_param(message, subject->technique->params, settings);
    subject->settings = settings;
    subject->width = rg_take_index(message, INT32_MAX);
    subject->height = rg_take_index(message, INT32_MAX);
    if (ok && !message->failed)
        return true;
    free(settings);
    subject->settings = NULL;
    return ok ? rg_error("a message between processes names no subject") : false;
}

static void put_subject(struct rg_message *message, const void *entry)
{
    rg_put_subject(message, entry);
}

static bool take_subject(struct rg_message *message, void *entry)
{
    return rg_take_subject(message, entry);
}

static void free_subject(void *entry)
{
    free((void *)(uintptr_t)((struct rg_subject *)entry)->settings);
}

static const struct rg_field_way subject_way = {put_subject, take_subject, free_subject};

// --- what calls are asked with ---

const struct rg_field rg_asked_fields[] = {
    RG_FIELD_NAME_OR_NONE(struct rg_asked, name),
    RG_FIELD_INTEGER(struct rg_asked, number, 0, INT32_MAX - 1),
    RG_FIELDS_END,
};

// The subject comes first in the message.
const struct rg_field rg_asked_run_fields[] = {
    RG_FIELD_OWN(struct rg_subject, &subject_way),
    RG_FIELD_INTEGER(struct rg_asked_run, run.frames, 0, INT32_MAX - 1),
    RG_FIELD_INTEGER(struct rg_asked_run, row, 0, INT32_MAX - 1),
    RG_FIELDS_END,
};

_Static_assert(offsetof(struct rg_asked_run, run.subject) == 0, "a subject that is taken first");

// --- what a session tells ---

// Larger than any time, yet far from infinity; more than any frame's stages.
#define MOST_MS INT64_C(1000000000000000000)
enum { MOST_STAGES = 1 << 16 };

static const struct rg_field counter_fields[] = {
    RG_FIELD_NAME(struct rg_counter, name),
    RG_FIELD_BYTES(struct rg_counter, value),
    RG_FIELDS_END,
};

static const struct rg_field fact_fields[] = {
    RG_FIELD_NAME(struct rg_fact, name),
    RG_FIELD_TEXT(struct rg_fact, text),
    RG_FIELD_BYTES(struct rg_fact, number),
    RG_FIELDS_END,
};

const struct rg_field rg_told_account_fields[] = {
    RG_FIELD_BYTES(struct rg_account, frame),
    RG_FIELD_SOME(struct rg_account, counters, counter_count, counter_fields),
    RG_FIELD_SOME(struct rg_account, facts, fact_count, fact_fields),
    RG_FIELDS_END,
};

// Counts; -1 means unknown.
const struct rg_field rg_told_tally_fields[] = {
    {RG_KIND_INTEGER, 0, sizeof(int64_t), -1, INT64_MAX,
     .entries = sizeof(struct rg_tally) / sizeof(int64_t)},
    RG_FIELDS_END,
};

const struct rg_field rg_told_code_fields[] = {
    RG_FIELD_TEXT(struct rg_session_code, program),
    RG_FIELD_BYTES(struct rg_session_code, libraries),
    RG_FIELD_BYTES(struct rg_session_code, passes.hash),
    RG_FIELD_INTEGER(struct rg_session_code, passes.bytes, 0, INT64_MAX),
    RG_FIELDS_END,
};

const struct rg_field rg_told_session_fields[] = {
    RG_FIELD_INTEGER(struct rg_told_session, number, 0, INT32_MAX),
    RG_FIELD_INTEGER(struct rg_told_session, state_count, 0, RG_MAX_STATE),
    RG_FIELDS_END,
};

static const struct rg_field stage_fields[] = {
    RG_FIELD_NAME(struct rg_told_stage, kernel),
    RG_FIELD_NUMBER(struct rg_told_stage, ms, 0, MOST_MS),
    RG_FIELDS_END,
};

const struct rg_field rg_told_stages_fields[] = {
    RG_FIELD_LIST(struct rg_told_stages, rows, stage_fields, MOST_STAGES),
    RG_FIELDS_END,
};

const struct rg_field rg_told_law_fields[] = {
    RG_FIELD_FLAG(struct rg_told_law, holds),
    RG_FIELD_TEXT(struct rg_told_law, detail),
    RG_FIELDS_END,
};

const struct rg_field rg_ms_fields[] = {
    {RG_KIND_NUMBER, 0, sizeof(double), 0, MOST_MS, .entries = 1},
    RG_FIELDS_END,
};

const struct rg_field rg_time_fields[] = {
    {RG_KIND_BYTES, 0, sizeof(int64_t), .entries = 1},
    RG_FIELDS_END,
};

// Elements are of one word at least.
static bool knows_words(const void *all)
{
    static const char letters[] = {RG_WORD_FLOAT, RG_WORD_INT, RG_WORD_UINT, 0};
    const char *words = ((const struct rg_state *)all)->words;
    return !words || (*words && !words[strspn(words, letters)]);
}

static const struct rg_field layout_fields[] = {
    RG_FIELD_NAME_OR_NONE(struct rg_state, name),
    RG_FIELD_NAME_OR_NONE(struct rg_state, words),
    RG_FIELD_INTEGER(struct rg_state, row, 0, INT32_MAX),
    RG_FIELD_INTEGER(struct rg_state, margin, 0, INT32_MAX),
    RG_FIELD_CHECK(knows_words),
    RG_FIELDS_END,
};

// --- images and bytes ---

// A buffer's description is all zeroes.
static bool is_desc(const void *all)
{
    static const struct rg_image_desc none;
    const struct rg_image_desc *d = all;
    return d->levels ? d->format != RG_FORMAT_NONE && d->width && d->height && d->layers
                     : !memcmp(d, &none, sizeof(none));
}

static const struct rg_field desc_fields[] = {
    RG_FIELD_INTEGER(struct rg_image_desc, format, 0, RG_FORMAT_COUNT - 1),
    RG_FIELD_INTEGER(struct rg_image_desc, width, 0, INT32_MAX),
    RG_FIELD_INTEGER(struct rg_image_desc, height, 0, INT32_MAX),
    RG_FIELD_INTEGER(struct rg_image_desc, layers, 0, INT32_MAX),
    RG_FIELD_INTEGER(struct rg_image_desc, levels, 0, RG_MAX_LEVELS),
    RG_FIELD_CHECK(is_desc),
    RG_FIELDS_END,
};

// Computes the size without overflow, since the product of the sides may exceed an int64_t.
static bool is_of_size(const void *all)
{
    const struct rg_contents *c = all;
    const struct rg_image_desc *d = &c->desc;
    return !d->levels || ((double)d->width * d->height * d->layers <= (double)c->size &&
                          rg_contents_size(d) == c->size);
}

static const struct rg_field contents_fields[] = {
    RG_FIELD_STRUCT(struct rg_contents, desc, desc_fields),
    RG_FIELD_BLOCK(struct rg_contents, bytes, size),
    RG_FIELD_CHECK(is_of_size),
    RG_FIELDS_END,
};

const struct rg_field rg_told_texture_fields[] = {
    RG_FIELD_FLAG(struct rg_told_texture, is_found),
    RG_FIELD_STRUCT(struct rg_told_texture, desc, desc_fields),
    RG_FIELD_INTEGER(struct rg_told_texture, first_level, 0, RG_MAX_LEVELS - 1),
    RG_FIELDS_END,
};

const struct rg_field rg_told_bytes_fields[] = {
    RG_FIELD_STRUCT(struct rg_told_bytes, layout, layout_fields),
    RG_FIELD_BLOCK(struct rg_told_bytes, bytes, size),
    RG_FIELDS_END,
};

const struct rg_field rg_told_contents_fields[] = {
    RG_FIELD_STRUCT(struct rg_told_contents, contents, contents_fields),
    RG_FIELD_STRUCT(struct rg_told_contents, state, layout_fields),
    RG_FIELDS_END,
};

static const struct rg_field digest_fields[] = {
    RG_FIELD_INTEGER(struct rg_digest, frame, 0, INT64_MAX),
    RG_FIELD_INTEGER(struct rg_digest, stages_run, 0, INT32_MAX),
    RG_FIELD_TEXT(struct rg_digest, stage),
    RG_FIELD_TEXT(struct rg_digest, asset),
    RG_FIELD_BYTES(struct rg_digest, hash),
    RG_FIELD_INTEGER(struct rg_digest, weight, 0, INT64_MAX),
    RG_FIELDS_END,
};

const struct rg_field rg_told_digests_fields[] = {
    RG_FIELD_LIST(struct rg_digests, rows, digest_fields, INT32_MAX),
    RG_FIELDS_END,
};

// --- dispatches, whose slots their kernels say ---

static const struct rg_field extent_fields[] = {
    RG_FIELD_INTEGER(struct rg_extent, width, 0, INT32_MAX),
    RG_FIELD_INTEGER(struct rg_extent, height, 0, INT32_MAX),
    RG_FIELD_INTEGER(struct rg_extent, depth, 0, INT32_MAX),
    RG_FIELDS_END,
};

// The fields after the kernel's name; the slots follow, whose number depends on the kernel.
static const struct rg_field dispatched_fields[] = {
    RG_FIELD_FLAG(struct rg_dispatched, was_kept),
    RG_FIELD_BYTES(struct rg_dispatched, params),
    RG_FIELD_STRUCT(struct rg_dispatched, origin, extent_fields),
    RG_FIELD_STRUCT(struct rg_dispatched, extent, extent_fields),
    RG_FIELD_FLAG(struct rg_dispatched, has_colour),
    RG_FIELD_FLAG(struct rg_dispatched, has_depth),
    RG_FIELD_INTEGER(struct rg_dispatched, layer, 0, INT32_MAX),
    RG_FIELD_INTEGER(struct rg_dispatched, level, 0, RG_MAX_LEVELS - 1),
    RG_FIELDS_END,
};

static void put_before(struct rg_message *message, const void *entry)
{
    const struct rg_dispatched *d = entry;
    rg_put_text(message, d->kernel->name);
    rg_put_fields(message, dispatched_fields, d);
    struct rg_slot_info slots[RG_MAX_SLOTS];
    const int count = d->was_kept ? rg_dispatched_slots(d, slots) : 0;
    for (int i = 0; i < count; i++)
        rg_put_fields(message, contents_fields, &d->before[slots[i].slot]);
}

static void put_after(struct rg_message *message, const void *entry)
{
    const struct rg_dispatched *d = entry;
    struct rg_slot_info slots[RG_MAX_SLOTS];
    const int count = d->was_kept ? rg_dispatched_slots(d, slots) : 0;
    for (int i = 0; i < count; i++)
        if (rg_slot_is_written(slots[i].kind))
            rg_put_fields(message, contents_fields, &d->after[slots[i].slot]);
}

static bool take_contents(struct rg_message *message, struct rg_contents *contents)
{
    rg_contents_free(contents);
    *contents = (struct rg_contents){0};
    return rg_take_fields(message, contents_fields, contents);
}

static bool take_before(struct rg_message *message, void *entry)
{
    struct rg_dispatched *d = entry;
    const char *name = rg_take_text(message);
    d->kernel = message->failed ? NULL : rg_kernel_find(name);
    bool ok =
        (d->kernel || rg_message_fail(message)) && rg_take_fields(message, dispatched_fields, d);
    struct rg_slot_info slots[RG_MAX_SLOTS];
    const int count = ok && d->was_kept ? rg_dispatched_slots(d, slots) : 0;
    for (int i = 0; ok && i < count; i++)
        ok = take_contents(message, &d->before[slots[i].slot]);
    return ok;
}

static bool take_after(struct rg_message *message, void *entry)
{
    struct rg_dispatched *d = entry;
    bool ok = !message->failed;
    struct rg_slot_info slots[RG_MAX_SLOTS];
    const int count = ok && d->was_kept ? rg_dispatched_slots(d, slots) : 0;
    for (int i = 0; ok && i < count; i++)
        if (rg_slot_is_written(slots[i].kind))
            ok = take_contents(message, &d->after[slots[i].slot]);
    return ok;
}

static void free_before(void *entry)
{
    struct rg_dispatched *d = entry;
    for (int i = 0; i < RG_MAX_SLOTS; i++)
        rg_contents_free(&d->before[i]);
}

static void free_after(void *entry)
{
    struct rg_dispatched *d = entry;
    for (int i = 0; i < RG_MAX_SLOTS; i++)
        rg_contents_free(&d->after[i]);
}

static const struct rg_field_way before_way = {put_before, take_before, free_before};
static const struct rg_field_way after_way = {put_after, take_after, free_after};

const struct rg_field rg_asked_dispatched_fields[] = {
    RG_FIELD_OWN(struct rg_dispatched, &before_way),
    RG_FIELDS_END,
};

const struct rg_field rg_told_dispatched_fields[] = {
    RG_FIELD_OWN(struct rg_dispatched, &after_way),
    RG_FIELDS_END,
};

static const struct rg_field both_fields[] = {
    RG_FIELD_OWN(struct rg_dispatched, &before_way),
    RG_FIELD_OWN(struct rg_dispatched, &after_way),
    RG_FIELDS_END,
};

const struct rg_field rg_told_dispatches_fields[] = {
    RG_FIELD_LIST(struct rg_dispatches, rows, both_fields, INT32_MAX),
    RG_FIELDS_END,
};
