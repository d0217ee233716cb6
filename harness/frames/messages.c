#include "harness/frames/messages.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"

// --- settings, by name: another build may have them elsewhere, and others beside them ---

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

// A number with a fraction goes as its bits, for a text rounds it.
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

// What this build does not know may be left alone where it is as it usually is.
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
    bool ok = settings;
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

// --- what a session tells ---

void rg_put_account(struct rg_message *message, const struct rg_account *account)
{
    rg_put_int(message, account->frame);
    rg_put_int(message, account->counter_count);
    for (int i = 0; i < account->counter_count; i++) {
        rg_put_text(message, account->counters[i].name);
        rg_put_int(message, account->counters[i].value);
    }
    rg_put_int(message, account->fact_count);
    for (int i = 0; i < account->fact_count; i++) {
        rg_put_text(message, account->facts[i].name);
        rg_put_text(message, account->facts[i].text);
        RG_PUT(message, account->facts[i].number);
    }
}

bool rg_take_account(struct rg_message *message, struct rg_account *account)
{
    *account = (struct rg_account){.frame = rg_take_int(message)};
    account->counter_count = rg_take_index(message, RG_MAX_COUNTERS + 1);
    for (int i = 0; i < account->counter_count; i++) {
        account->counters[i].name = rg_take_name(message);
        account->counters[i].value = rg_take_int(message);
    }
    account->fact_count = rg_take_index(message, RG_MAX_FACTS + 1);
    for (int i = 0; i < account->fact_count; i++) {
        struct rg_fact *fact = &account->facts[i];
        fact->name = rg_take_name(message);
        snprintf(fact->text, sizeof(fact->text), "%s", rg_take_text(message));
        RG_TAKE(message, fact->number);
    }
    return !message->failed;
}

enum { COUNTS = sizeof(struct rg_tally) / sizeof(int64_t) };

void rg_put_tally(struct rg_message *message, const struct rg_tally *tally)
{
    RG_PUT(message, *tally);
}

bool rg_take_tally(struct rg_message *message, struct rg_tally *tally)
{
    int64_t counts[COUNTS];
    _Static_assert(sizeof(counts) == sizeof(*tally), "a tally has counts alone");
    if (!RG_TAKE(message, counts))
        return false;
    for (int i = 0; i < COUNTS; i++)
        if (counts[i] < -1)
            return rg_message_fail(message);
    memcpy(tally, counts, sizeof(counts));
    return true;
}

void rg_put_layout(struct rg_message *message, const struct rg_state *layout)
{
    rg_put_text(message, layout->name ? layout->name : "");
    rg_put_int(message, layout->is_float);
    rg_put_int(message, layout->row);
    rg_put_int(message, layout->margin);
}

bool rg_take_layout(struct rg_message *message, struct rg_state *layout)
{
    const char *name = rg_take_name(message);
    *layout = (struct rg_state){.name = *name ? name : NULL};
    layout->is_float = rg_take_index(message, 2);
    layout->row = rg_take_index(message, INT32_MAX);
    layout->margin = rg_take_index(message, INT32_MAX);
    return !message->failed;
}

// --- dispatches ---

static void put_contents(struct rg_message *message, const struct rg_contents *contents)
{
    RG_PUT(message, contents->desc);
    rg_put_block(message, contents->bytes, (int64_t)contents->size);
}

static bool is_image(const struct rg_image_desc *d)
{
    return (unsigned)d->format < RG_FORMAT_COUNT && d->format != RG_FORMAT_NONE && d->levels > 0 &&
           d->levels <= RG_MAX_LEVELS && d->width > 0 && d->height > 0 && d->layers > 0;
}

bool rg_take_image_desc(struct rg_message *message, struct rg_image_desc *desc)
{
    if (!RG_TAKE(message, *desc) || (desc->levels && !is_image(desc)))
        return rg_message_fail(message);
    if (!desc->levels)
        *desc = (struct rg_image_desc){0};
    return true;
}

// Its sides may be such that an int64_t does not hold their product.
static bool is_of_size(const struct rg_image_desc *desc, int64_t size)
{
    return (double)desc->width * desc->height * desc->layers <= (double)size &&
           rg_contents_size(desc) == (size_t)size;
}

bool rg_take_contents_bytes(struct rg_message *message, struct rg_contents *contents)
{
    int64_t size = 0;
    contents->bytes = rg_take_block(message, &size);
    contents->size = (size_t)size;
    return contents->bytes && (!contents->desc.levels || is_of_size(&contents->desc, size) ||
                               rg_message_fail(message));
}

static bool take_contents(struct rg_message *message, struct rg_contents *contents)
{
    rg_contents_free(contents);
    return rg_take_image_desc(message, &contents->desc) &&
           rg_take_contents_bytes(message, contents);
}

void rg_put_dispatched(struct rg_message *message, const struct rg_dispatched *d)
{
    rg_put_text(message, d->kernel->name);
    rg_put_int(message, d->was_kept);
    RG_PUT(message, d->params);
    RG_PUT(message, d->origin);
    RG_PUT(message, d->extent);
    for (int i = 0; d->was_kept && i < d->kernel->slot_count; i++)
        put_contents(message, &d->before[d->kernel->slots[i].slot]);
}

void rg_put_dispatched_after(struct rg_message *message, const struct rg_dispatched *d)
{
    for (int i = 0; d->was_kept && i < d->kernel->slot_count; i++)
        if (rg_slot_is_written(d->kernel->slots[i].kind))
            put_contents(message, &d->after[d->kernel->slots[i].slot]);
}

bool rg_take_dispatched(struct rg_message *message, struct rg_dispatched *d)
{
    const char *name = rg_take_text(message);
    d->kernel = message->failed ? NULL : rg_kernel_find(name);
    d->was_kept = rg_take_index(message, 2);
    bool ok = d->kernel && RG_TAKE(message, d->params) && RG_TAKE(message, d->origin) &&
              RG_TAKE(message, d->extent);
    for (int i = 0; ok && d->was_kept && i < d->kernel->slot_count; i++)
        ok = take_contents(message, &d->before[d->kernel->slots[i].slot]);
    return ok || (!message->failed &&
                  rg_error("a message between processes names no dispatch of a kernel"));
}

bool rg_take_dispatched_after(struct rg_message *message, struct rg_dispatched *d)
{
    bool ok = !message->failed;
    for (int i = 0; ok && d->was_kept && i < d->kernel->slot_count; i++)
        if (rg_slot_is_written(d->kernel->slots[i].kind))
            ok = take_contents(message, &d->after[d->kernel->slots[i].slot]);
    return ok;
}
