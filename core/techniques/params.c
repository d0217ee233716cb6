#include "core/techniques/params.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "core/base/text/words.h"

static int *int_at(const struct rg_param *param, const void *settings)
{
    return (int *)((char *)settings + param->offset);
}

static double *double_at(const struct rg_param *param, const void *settings)
{
    return (double *)((char *)settings + param->offset);
}

static char *text_at(const struct rg_param *param, const void *settings)
{
    return (char *)settings + param->offset;
}

void rg_params_reset(const struct rg_param_table *table, void *settings)
{
    memset(settings, 0, table->settings_size);
    for (int i = 0; i < table->count; i++) {
        const struct rg_param *param = &table->rows[i];
        if (param->kind == RG_PARAM_FILE)
            snprintf(text_at(param, settings), RG_PATH_SIZE, "%s", param->text);
        else if (param->kind == RG_PARAM_FLOAT)
            *double_at(param, settings) = param->initial;
        else
            *int_at(param, settings) = (int)param->initial;
    }
}

const struct rg_param *rg_params_find(const struct rg_param_table *table, const char *name)
{
    for (int i = 0; i < table->count; i++)
        if (!strcmp(table->rows[i].name, name))
            return &table->rows[i];
    return NULL;
}

static bool unknown_name(const struct rg_param_table *table, const char *name)
{
    struct rg_nearest nearest = {0};
    for (int i = 0; i < table->count; i++)
        rg_nearest_try(&nearest, name, table->rows[i].name);
    return rg_error("parameter '%s': %s has none of that name; the nearest is '%s', and "
                    "`raingauge list params %s` prints all",
                    name, table->technique, nearest.name, table->technique);
}

static bool set_number(const struct rg_param *param, void *settings, const char *text)
{
    char *end;
    double value = strtod(text, &end);
    bool whole = param->kind == RG_PARAM_FLOAT || value == floor(value);
    if (end == text || *end || !isfinite(value) || !whole)
        return rg_error("parameter '%s': '%s' is no %s", param->name, text,
                        param->kind == RG_PARAM_INT ? "whole number" : "number");
    const char *unit = strcmp(param->unit, "1") ? param->unit : "";
    if (value < param->min || value > param->max)
        return rg_error("parameter '%s': %s is out of range; %.10g to %.10g%s%s", param->name, text,
                        param->min, param->max, *unit ? " " : "", unit);
    if (param->kind == RG_PARAM_INT)
        *int_at(param, settings) = (int)value;
    else
        *double_at(param, settings) = value;
    return true;
}

// The n-th word of `choices`, and its length; NULL when there are fewer.
static const char *choice_at(const char *choices, int n, size_t *length)
{
    for (; n > 0 && choices; n--) {
        choices = strchr(choices, ' ');
        choices = choices ? choices + 1 : NULL;
    }
    *length = choices ? strcspn(choices, " ") : 0;
    return choices;
}

static bool set_choice(const struct rg_param *param, void *settings, const char *text)
{
    size_t length;
    const char *choice;
    for (int i = 0; (choice = choice_at(param->text, i, &length)); i++) {
        if (strlen(text) == length && !memcmp(choice, text, length)) {
            *int_at(param, settings) = i;
            return true;
        }
    }
    return rg_error("parameter '%s': '%s' is none of: %s", param->name, text, param->text);
}

static bool set_path(const struct rg_param *param, void *settings, const char *text)
{
    if (strlen(text) >= RG_PATH_SIZE)
        return rg_error("parameter '%s': a path of %zu bytes; at most %d", param->name,
                        strlen(text), RG_PATH_SIZE - 1);
    memcpy(text_at(param, settings), text, strlen(text) + 1);
    return true;
}

// Assigns the parameters that a preset stands for.
static bool follow_preset(const struct rg_param_table *table, const struct rg_param *param,
                          void *settings)
{
    return !table->preset || strcmp(param->name, table->preset) ||
           rg_params_set_all(table, settings, table->presets[*int_at(param, settings)]);
}

bool rg_params_set_one(const struct rg_param *param, void *settings, const char *value)
{
    switch (param->kind) {
    case RG_PARAM_CHOICE:
        return set_choice(param, settings, value);
    case RG_PARAM_FILE:
        return set_path(param, settings, value);
    default:
        return set_number(param, settings, value);
    }
}

bool rg_params_set(const struct rg_param_table *table, void *settings, const char *assignment)
{
    const char *equals = strchr(assignment, '=');
    char name[64];
    if (!equals || equals == assignment || equals - assignment >= (long)sizeof(name))
        return rg_error("parameter '%.80s': write it as KEY=VALUE", assignment);
    snprintf(name, sizeof(name), "%.*s", (int)(equals - assignment), assignment);
    const struct rg_param *param = rg_params_find(table, name);
    if (!param)
        return unknown_name(table, name);
    return rg_params_set_one(param, settings, equals + 1) && follow_preset(table, param, settings);
}

bool rg_params_set_all(const struct rg_param_table *table, void *settings, const char *assignments)
{
    const size_t length = strlen(assignments) + 1;
    char *words = rg_alloc(1, length, table->technique), *rest = NULL;
    bool ok = words;
    if (ok)
        memcpy(words, assignments, length);
    for (char *one = ok ? strtok_r(words, " ", &rest) : NULL; one && ok;
         one = strtok_r(NULL, " ", &rest))
        ok = rg_params_set(table, settings, one);
    free(words);
    return ok;
}

void rg_params_text(const struct rg_param *param, const void *settings, char *text, size_t size)
{
    size_t length;
    const char *choice;
    switch (param->kind) {
    case RG_PARAM_INT:
        snprintf(text, size, "%d", *int_at(param, settings));
        break;
    case RG_PARAM_FLOAT:
        snprintf(text, size, "%.10g", *double_at(param, settings));
        break;
    case RG_PARAM_CHOICE:
        choice = choice_at(param->text, *int_at(param, settings), &length);
        snprintf(text, size, "%.*s", (int)length, choice);
        break;
    case RG_PARAM_FILE:
        snprintf(text, size, "%s", text_at(param, settings));
        break;
    }
}
