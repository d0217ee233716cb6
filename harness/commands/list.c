// raingauge list: lists techniques, tables, figures, devices and parameters, by the names used on
// the command line.
#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "core/base/memory.h"
#include "core/base/text/words.h"
#include "harness/commands/cli/command.h"
#include "harness/commands/cli/shared.h"
#include "harness/commands/cli/subject.h"
#include "harness/devices/devices.h"
#include "harness/tables/figures/figures.h"
#include "harness/record/named.h"
#include "harness/tables/papers/papers.h"
#include "harness/devices/workers/worker.h"

struct list_options {
    int timeout_s;
    int64_t memory_bytes;
    bool json;
};

#define AT(field) offsetof(struct list_options, field)

static const char *const lists[] = {"techniques", "tables", "figures", "devices", "params", NULL};

static const struct rg_option options[] = {
    RG_GROUP("What to list"),
    {RG_OPTION_OPERAND,
     .about = "what to list: techniques, the papers' tables or figures, this machine's "
              "devices, or parameters",
     .choices = lists, .first = 1, .last = 1},
    {RG_OPTION_OPERAND, .argument = "TECHNIQUE", .about = "the technique whose parameters to list",
     .names = RG_NAMES_TECHNIQUE, .first = 2, .last = 2},
    RG_GROUP("Devices"),
    RG_INCLUDE(rg_timeout_option, AT(timeout_s), NULL),
    RG_INCLUDE(rg_memory_option, AT(memory_bytes), NULL),
    RG_GROUP("Output"),
    RG_INCLUDE(rg_json_option, AT(json), NULL),
    {RG_OPTION_END},
};

// Prints a text, which may be a driver's, without control characters.
static void print_plain(int width, const char *text, const char *end)
{
    char plain[1024];
    rg_text_copy(plain, sizeof(plain), text);
    printf("%-*s%s", width, plain, end);
}

// Every listing is an array of objects, whose fields are columns unless --json is given.
static void print_text(const json_t *rows, const char *const *fields)
{
    int widths[8] = {0};
    size_t i;
    json_t *row;
    json_array_foreach(rows, i, row)
    {
        for (int f = 0; fields[f]; f++) {
            int width = (int)strlen(json_string_value(json_object_get(row, fields[f])));
            widths[f] = width > widths[f] ? width : widths[f];
        }
    }
    json_array_foreach(rows, i, row)
    {
        for (int f = 0; fields[f]; f++)
            print_plain(fields[f + 1] ? widths[f] : 0,
                        json_string_value(json_object_get(row, fields[f])),
                        fields[f + 1] ? "  " : "\n");
    }
}

static json_t *list_techniques(void)
{
    json_t *rows = json_array();
    for (int i = 0; rg_techniques[i]; i++)
        json_array_append_new(rows,
                              json_pack("{ssssss}", "name", rg_techniques[i]->name, "paper",
                                        rg_techniques[i]->paper, "about", rg_techniques[i]->about));
    return rows;
}

static json_t *list_tables(void)
{
    json_t *rows = json_array();
    for (int i = 0; rg_tables[i]; i++)
        json_array_append_new(rows,
                              json_pack("{ssssss}", "name", rg_tables[i]->id, "technique",
                                        rg_tables[i]->technique, "about", rg_tables[i]->about));
    return rows;
}

static json_t *list_figures(void)
{
    json_t *rows = json_array();
    const struct rg_figure *figure;
    for (int i = 0; (figure = rg_figure_at(i)); i++)
        json_array_append_new(rows, json_pack("{ssssss}", "name", figure->id, "technique",
                                              figure->technique, "about", figure->caption));
    return rows;
}

// *exit becomes fail if a driver failed.
static json_t *list_devices(int *exit)
{
    json_t *rows = json_array();
    struct rg_device_list *list = rg_alloc(1, sizeof(*list), "list of devices");
    if (!list) {
        *exit = rg_exit_of_error();
        return rows;
    }
    rg_devices_list(list);
    for (int i = 0; i < list->count; i++)
        json_array_append_new(rows,
                              json_pack("{sosososo}", "name", rg_json_text(list->infos[i].name),
                                        "api", rg_json_text(list->infos[i].api), "device",
                                        rg_json_text(list->infos[i].device), "driver",
                                        rg_json_text(list->infos[i].driver)));
    *exit = rg_devices_complain(list);
    free(list);
    return rows;
}

static json_t *list_params(const struct rg_technique *technique)
{
    json_t *rows = json_array();
    void *settings = rg_settings_create(technique);
    for (int i = 0; settings && i < technique->params->count; i++) {
        const struct rg_param *p = &technique->params->rows[i];
        char value[RG_PATH_SIZE], range[128];
        rg_params_text(p, settings, value, sizeof(value));
        if (p->kind == RG_PARAM_CHOICE)
            snprintf(range, sizeof(range), "%s", p->text);
        else if (p->kind == RG_PARAM_FILE)
            snprintf(range, sizeof(range), "path or name");
        else
            snprintf(range, sizeof(range), "%.10g to %.10g", p->min, p->max);
        json_array_append_new(rows, json_pack("{ssssssssss}", "name", p->name, "default", value,
                                              "unit", p->unit, "range", range, "about", p->about));
    }
    free(settings);
    return rows;
}

static int print(json_t *rows, const char *what, const char *const *fields, bool json)
{
    if (json) {
        json_t *root = json_pack("{siso}", "format", 1, what, rows);
        json_dumpf(root, stdout, JSON_INDENT(2));
        printf("\n");
        json_decref(root);
    } else {
        print_text(rows, fields);
        json_decref(rows);
    }
    return RG_EXIT_PASS;
}

static int list_params_of(const struct rg_words *arguments, bool json)
{
    static const char *const fields[] = {"name", "default", "unit", "range", "about", NULL};
    if (arguments->count < 2) {
        rg_error("list params: name a technique; `raingauge list techniques` prints them");
        return rg_exit_of_error();
    }
    const struct rg_technique *technique = rg_subject_technique(arguments->items[1]);
    return technique ? print(list_params(technique), "params", fields, json) : rg_exit_of_error();
}

static int refuse(const char *what)
{
    struct rg_nearest nearest = {0};
    for (int i = 0; lists[i]; i++)
        rg_nearest_try(&nearest, what, lists[i]);
    if (*what)
        rg_error("list '%s': unknown; the nearest is '%s', and there are techniques, tables, "
                 "figures, devices and params TECHNIQUE",
                 what, nearest.name);
    else
        rg_error("list: name what to list: techniques, tables, figures, devices, or params "
                 "TECHNIQUE");
    return rg_exit_of_error();
}

static int list(const void *values, const struct rg_words *arguments)
{
    const struct list_options *o = values;
    static const char *const about_fields[] = {"name", "about", NULL};
    static const char *const device_fields[] = {"name", "api", "device", "driver", NULL};
    const char *what = arguments->count ? arguments->items[0] : "";
    if (!strcmp(what, "params"))
        return list_params_of(arguments, o->json);
    if (arguments->count > 1) {
        rg_error("list: '%s' is one argument too many; `raingauge list --help` prints the usage",
                 arguments->items[1]);
        return rg_exit_of_error();
    }
    if (!strcmp(what, "techniques"))
        return print(list_techniques(), what, about_fields, o->json);
    if (!strcmp(what, "tables"))
        return print(list_tables(), what, about_fields, o->json);
    if (!strcmp(what, "figures"))
        return print(list_figures(), what, about_fields, o->json);
    if (!strcmp(what, "devices")) {
        rg_memory_allow(o->memory_bytes);
        rg_workers.timeout_s = o->timeout_s;
        int exit;
        print(list_devices(&exit), what, device_fields, o->json);
        return exit;
    }
    return refuse(what);
}

const struct rg_command rg_command_list = {
    .name = "list",
    .reader = RG_FOR_ALL,
    .usage = "techniques|tables|figures|devices|params TECHNIQUE [--json]",
    .about = "lists techniques, tables, figures, devices or parameters",
    .options = options,
    .options_size = sizeof(struct list_options),
    .run = list,
};
