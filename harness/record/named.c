#include "harness/record/named.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "core/base/text/plain.h"

// Whether a text is UTF-8; jansson accepts nothing else.
static bool is_utf8(const char *text)
{
    json_t *json = json_string(text);
    json_decref(json);
    return json != NULL;
}

static void mark_foreign_bytes(char *text)
{
    for (; *text; text++)
        *text = *text & 0x80 ? '?' : *text;
}

void rg_text_copy(char *to, size_t size, const char *from)
{
    size_t length = strnlen(from, size - 1);
    // Drops the first bytes of a character that was cut.
    while (from[length] && length > 0 && (from[length] & 0xc0) == 0x80)
        length--;
    memcpy(to, from, length);
    to[length] = 0;
    if (!is_utf8(to))
        mark_foreign_bytes(to);
    rg_plain(to);
}

void rg_outcome_set(json_t *json, enum rg_outcome outcome)
{
    json_object_set_new(json, "status", json_string(rg_outcome_name(outcome)));
    if (outcome == RG_LACKING || outcome == RG_SETUP)
        json_object_set_new(
            json, "fault",
            json_string(rg_fault_name(outcome == RG_SETUP ? RG_FAULT_SETUP : RG_FAULT_HARNESS)));
}

json_t *rg_json_text(const char *text)
{
    json_t *json = json_string(text);
    char *ascii = json ? NULL : strdup(text);
    if (ascii)
        mark_foreign_bytes(ascii);
    if (ascii)
        json = json_string(ascii);
    free(ascii);
    return json;
}

// Whether a number is whole, and small enough to be written exactly as an integer.
static bool is_whole(double number)
{
    return number == floor(number) && fabs(number) < 9007199254740992.0;
}

double rg_number_kept(double number)
{
    char text[32];
    if (!isfinite(number))
        return NAN;
    if (is_whole(number))
        return number;
    snprintf(text, sizeof(text), "%.*g", RG_NUMBER_DIGITS, number);
    return strtod(text, NULL);
}

void rg_named_set_text(struct rg_named *named, const char *name, const char *text)
{
    *named = (struct rg_named){.number = NAN};
    rg_text_copy(named->name, sizeof(named->name), name);
    rg_text_copy(named->text, sizeof(named->text), text);
}

void rg_named_set_number(struct rg_named *named, const char *name, double number)
{
    *named = (struct rg_named){.number = rg_number_kept(number)};
    rg_text_copy(named->name, sizeof(named->name), name);
}

void rg_facts_copy(struct rg_named *named, const struct rg_fact *facts, int count)
{
    for (int i = 0; i < count; i++)
        if (*facts[i].text)
            rg_named_set_text(&named[i], facts[i].name, facts[i].text);
        else
            rg_named_set_number(&named[i], facts[i].name, facts[i].number);
}

void rg_counters_copy(struct rg_count *counts, const struct rg_counter *counters, int count)
{
    for (int i = 0; i < count; i++) {
        counts[i] = (struct rg_count){.value = counters[i].value};
        rg_text_copy(counts[i].name, sizeof(counts[i].name), counters[i].name);
    }
}

static bool is_among(const char *name, const char *const *names)
{
    for (int i = 0; names && names[i]; i++)
        if (!strcmp(names[i], name))
            return true;
    return false;
}

void rg_named_text(const struct rg_named *named, int count, const char *const *except, char *text,
                   size_t size)
{
    size_t used = 0;
    *text = 0;
    for (int i = 0; i < count && used < size; i++) {
        if (is_among(named[i].name, except))
            continue;
        const char *comma = used ? ", " : "";
        const int added = *named[i].text ? snprintf(text + used, size - used, "%s%s %s", comma,
                                                    named[i].name, named[i].text)
                                         : snprintf(text + used, size - used, "%s%s %.15g", comma,
                                                    named[i].name, named[i].number);
        used += (size_t)added;
    }
}

const double *rg_named_number(const struct rg_named *named, int count, const char *name)
{
    for (int i = 0; i < count; i++)
        if (!*named[i].text && !strcmp(named[i].name, name))
            return &named[i].number;
    return NULL;
}

json_t *rg_named_json(const struct rg_named *named, int count)
{
    json_t *json = json_object();
    for (int i = 0; i < count; i++)
        json_object_set_new(json, named[i].name,
                            *named[i].text ? rg_json_text(named[i].text)
                                           : rg_number_json(named[i].number));
    return json;
}

json_t *rg_counts_json(const struct rg_count *counts, int count)
{
    json_t *json = json_object();
    for (int i = 0; i < count; i++)
        json_object_set_new(json, counts[i].name, json_integer(counts[i].value));
    return json;
}

json_t *rg_number_json(double number)
{
    if (!isfinite(number))
        return json_null();
    if (is_whole(number))
        return json_integer((json_int_t)number);
    return json_real(number);
}

const char *rg_json_text_of(const json_t *object, const char *name)
{
    const char *text = json_string_value(json_object_get(object, name));
    return text ? text : "";
}

double rg_json_number_of(const json_t *object, const char *name)
{
    const json_t *number = json_object_get(object, name);
    return json_is_number(number) ? json_number_value(number) : NAN;
}
