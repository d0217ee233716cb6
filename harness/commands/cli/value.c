// Parses the values of options.
#include <errno.h>
#include <limits.h>
#include <popt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "core/base/text/pair.h"
#include "harness/devices/names.h"
#include "harness/commands/cli/option.h"

static void *at(const struct rg_option *row, void *values)
{
    return (char *)values + row->offset;
}

// --- numbers ---

static bool refuse_number(const struct rg_option *row, const char *text, int code,
                          const char *command)
{
    return rg_error("--%s %s: %s; `raingauge %s --help` prints the options", row->name, text,
                    poptStrerror(code), command);
}

static bool set_int(const struct rg_option *row, int *number, const char *text, const char *command)
{
    char *end;
    errno = 0;
    const long value = strtol(text, &end, 0);
    if (end == text || *end)
        return refuse_number(row, text, POPT_ERROR_BADNUMBER, command);
    if (errno || value < INT_MIN || value > INT_MAX)
        return refuse_number(row, text, POPT_ERROR_OVERFLOW, command);
    *number = (int)value;
    if (row->least == row->most && value != row->least)
        return rg_error("--%s %s: must be %.10g", row->name, text, row->least);
    if (value < row->least || value > row->most)
        return rg_error("--%s %s: must be %.10g to %.10g", row->name, text, row->least, row->most);
    return true;
}

static bool set_factor(const struct rg_option *row, double *number, const char *text,
                       const char *command)
{
    char *end;
    *number = strtod(text, &end);
    if (end == text || *end)
        return refuse_number(row, text, POPT_ERROR_BADNUMBER, command);
    if (!(*number > 0 && *number <= row->most))
        return rg_error("--%s %s: must be above 0, at most %.10g", row->name, text, row->most);
    return true;
}

// A number with an optional unit; each unit is 1024 of the one before.
static bool set_bytes(const struct rg_option *row, int64_t *bytes, const char *text)
{
    static const char units[] = "KMGT";
    char *end;
    double value = strtod(text, &end);
    const char *unit = end == text || !*end ? NULL : strchr(units, *end);
    if (!unit || (strcmp(end + 1, "") != 0 && strcmp(end + 1, "iB") != 0))
        return rg_error("--%s %s: is no size; write it as 512M, 4G or 1.5G", row->name, text);
    for (const char *u = units; u <= unit; u++)
        value *= 1024;
    if (!(value >= 1 && value <= 0x1p50))
        return rg_error("--%s %s: must be above 0, at most 1024T", row->name, text);
    *bytes = (int64_t)value;
    return true;
}

// --- pairs of numbers ---

static bool set_size(const struct rg_option *row, struct rg_size *size, const char *text)
{
    if (!rg_pair_read(text, 'x', &size->width, &size->height))
        return rg_error("--%s %s: write it as WIDTHxHEIGHT, as in 1280x720", row->name, text);
    return rg_size_read(text, &size->width, &size->height) ||
           rg_error("--%s %s: each side must be 1 to %d pixels", row->name, text, RG_MOST_PX);
}

static bool set_range(const struct rg_option *row, struct rg_range *range, const char *text)
{
    if (!rg_range_read(text, &range->first, &range->last))
        return rg_error("--%s %s: write it as FIRST-LAST, as in 2-4", row->name, text);
    if (range->first < row->least || range->last < range->first)
        return rg_error("--%s %s: %s count from %.10g, the first not after the last", row->name,
                        text, row->name, row->least);
    if (range->last > row->most)
        return rg_error("--%s %s: must be %.10g to %.10g", row->name, text, row->least, row->most);
    return true;
}

// --- words ---

// "md, csv, json or tex"
static void list_choices(const char *const *choices, char *text, size_t size)
{
    size_t used = 0;
    text[0] = 0;
    for (int i = 0; choices[i] && used < size; i++)
        used += (size_t)snprintf(text + used, size - used, "%s%s",
                                 !i               ? ""
                                 : choices[i + 1] ? ", "
                                                  : " or ",
                                 choices[i]);
}

static bool set_choice(const struct rg_option *row, int *choice, const char *text)
{
    for (*choice = 0; row->choices[*choice]; (*choice)++)
        if (!strcmp(row->choices[*choice], text))
            return true;
    char all[128];
    list_choices(row->choices, all, sizeof(all));
    return rg_error("--%s %s: choose %s", row->name, text, all);
}

static bool set_text(const struct rg_option *row, char **copy, const char *text)
{
    if (!*text)
        return rg_error("--%s '': is empty; write a value after it, or leave it out", row->name);
    char option[64];
    snprintf(option, sizeof(option), "--%s", row->name);
    if (row->names == RG_NAMES_DEVICES && !rg_device_names_check(option, text))
        return false;
    free(*copy);
    return (*copy = strdup(text)) || rg_harness_error("--%s %s: no memory for it", row->name, text);
}

static bool add_text(const struct rg_option *row, struct rg_words *words, const char *text)
{
    if (words->count == RG_MAX_WORDS)
        return rg_error("--%s %s: more than %d of them", row->name, text, RG_MAX_WORDS);
    char *copy = NULL;
    return set_text(row, &copy, text) && (words->items[words->count++] = copy);
}

// --- a value of any kind ---

void rg_option_clear(const struct rg_option *row, void *values)
{
    if (row->kind == RG_OPTION_INT)
        *(int *)at(row, values) = (int)row->least - 1;
    if (row->kind == RG_OPTION_CHOICE)
        *(int *)at(row, values) = -1;
    if (row->kind == RG_OPTION_RANGE) {
        const int none = (int)row->least - 1;
        *(struct rg_range *)at(row, values) = (struct rg_range){none, none};
    }
}

bool rg_option_set(const struct rg_option *row, void *values, const char *text, const char *command)
{
    switch (row->kind) {
    case RG_OPTION_FLAG:
        return *(bool *)at(row, values) = true;
    case RG_OPTION_INT:
        return set_int(row, at(row, values), text, command);
    case RG_OPTION_FACTOR:
        return set_factor(row, at(row, values), text, command);
    case RG_OPTION_CHOICE:
        return set_choice(row, at(row, values), text);
    case RG_OPTION_SIZE:
        return set_size(row, at(row, values), text);
    case RG_OPTION_BYTES:
        return set_bytes(row, at(row, values), text);
    case RG_OPTION_RANGE:
        return set_range(row, at(row, values), text);
    case RG_OPTION_TEXT:
        return set_text(row, at(row, values), text);
    case RG_OPTION_TEXTS:
        return add_text(row, at(row, values), text);
    default:
        return true;
    }
}

void rg_option_free(const struct rg_option *row, void *values)
{
    if (row->kind == RG_OPTION_TEXT)
        free(*(char **)at(row, values));
    struct rg_words *words = row->kind == RG_OPTION_TEXTS ? at(row, values) : NULL;
    for (int i = 0; words && i < words->count; i++)
        free((char *)words->items[i]);
}
