#include "harness/commands/command.h"

#include <limits.h>
#include <popt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/base/log.h"

enum { MAX_SIZE_PX = 16384 };

// What popt hands back for options that need more than a store.
enum { VALUE_SET = 1000, VALUE_SIZE, VALUE_ROWS, VALUE_HELP };

struct row {
    unsigned bit;
    struct poptOption option;
};

// The options of one command as popt wants them, pointing into `options`.
static int build(const struct rg_command *command, struct rg_options *o, int *flags,
                 struct poptOption *table)
{
    const struct row rows[] = {
        {RG_OPT_DEVICE,
         {"device", 0, POPT_ARG_STRING, &o->device, 0,
          "devices to use; `raingauge list devices` prints the names", "D,...|all"}},
        {RG_OPT_SET,
         {"set", 0, POPT_ARG_STRING, NULL, VALUE_SET,
          "sets a parameter; `raingauge list params TECHNIQUE` prints them", "KEY=VALUE"}},
        {RG_OPT_SIZE,
         {"size", 0, POPT_ARG_STRING, NULL, VALUE_SIZE, "size of the image in pixels", "WxH"}},
        {RG_OPT_FRAME,
         {"frame", 0, POPT_ARG_INT, &o->frame, 0, "frames to simulate before drawing", "N"}},
        {RG_OPT_OUTPUT, {"output", 'o', POPT_ARG_STRING, &o->output, 0, "where to write", "PATH"}},
        {RG_OPT_FORMAT,
         {"format", 0, POPT_ARG_STRING, &o->format, 0, "what to print", "md|csv|json|tex"}},
        {RG_OPT_ROWS,
         {"rows", 0, POPT_ARG_STRING, NULL, VALUE_ROWS, "only these rows, counted from 1", "A-B"}},
        {RG_OPT_EXPOSURE,
         {"exposure", 0, POPT_ARG_DOUBLE, &o->exposure, 0, "brightness of 8-bit images, a factor",
          "X"}},
        {RG_OPT_BACKGROUND,
         {"background", 0, POPT_ARG_STRING, &o->background, 0,
          "the picture without rain: differences are gated where it rains", "FILE"}},
        {RG_OPT_FROM,
         {"from", 0, POPT_ARG_STRING, &o->from, 0, "the folder to read instead of making it",
          "DIR"}},
        {RG_OPT_LENGTH, {"quick", 0, POPT_ARG_NONE, &flags[0], 0, "few samples or steps", NULL}},
        {RG_OPT_LENGTH, {"full", 0, POPT_ARG_NONE, &flags[1], 0, "many samples or steps", NULL}},
        {RG_OPT_FRESH,
         {"fresh", 0, POPT_ARG_NONE, &flags[3], 0, "takes nothing from a run that was interrupted",
          NULL}},
        {RG_OPT_JSON,
         {"json", 0, POPT_ARG_NONE, &flags[2], 0, "results in machine form (docs/records.md)",
          NULL}},
        {~0u, {"help", 'h', POPT_ARG_NONE, NULL, VALUE_HELP, "prints this", NULL}},
    };
    int count = 0;
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++)
        if ((rows[i].bit & command->options) || rows[i].bit == ~0u)
            table[count++] = rows[i].option;
    table[count] = (struct poptOption)POPT_TABLEEND;
    return count;
}

// A whole number at *text, which moves behind it; what does not fit becomes the nearest int.
static bool take_int(const char **text, int *number)
{
    char *end;
    long value = strtol(*text, &end, 10);
    if (end == *text)
        return false;
    *number = value > INT_MAX ? INT_MAX : value < INT_MIN ? INT_MIN : (int)value;
    *text = end;
    return true;
}

// Two numbers with a sign between them, and nothing else.
static bool take_pair(const char *text, char sign, int *first, int *second)
{
    return take_int(&text, first) && *text++ == sign && take_int(&text, second) && !*text;
}

static bool parse_size(const char *text, struct rg_options *o)
{
    if (!take_pair(text, 'x', &o->width, &o->height))
        return rg_error("--size %s: write it as WIDTHxHEIGHT, as in 1280x720", text);
    if (o->width < 1 || o->height < 1 || o->width > MAX_SIZE_PX || o->height > MAX_SIZE_PX)
        return rg_error("--size %s: each side must be 1 to %d pixels", text, MAX_SIZE_PX);
    return true;
}

static bool parse_rows(const char *text, struct rg_options *o)
{
    const char *rest = text;
    if (!take_pair(text, '-', &o->first_row, &o->last_row)) {
        if (!take_int(&rest, &o->first_row) || *rest)
            return rg_error("--rows %s: write it as FIRST-LAST, as in 2-4", text);
        o->last_row = o->first_row;
    }
    if (o->first_row < 1 || o->last_row < o->first_row)
        return rg_error("--rows %s: rows count from 1, the first not after the last", text);
    return true;
}

static bool take(int value, char *text, struct rg_options *o)
{
    if (value == VALUE_SIZE)
        return parse_size(text, o);
    if (value == VALUE_ROWS)
        return parse_rows(text, o);
    if (o->set_count == RG_MAX_SETS)
        return rg_error("--set %s: more than %d of them", text, RG_MAX_SETS);
    o->sets[o->set_count] = strdup(text);
    return o->sets[o->set_count++] || rg_error("--set %s: no memory for it", text);
}

static bool check(const struct rg_options *o, bool frame_given)
{
    static const char *const formats[] = {"md", "csv", "json", "tex"};
    if (frame_given && (o->frame < 0 || o->frame > 10000000))
        return rg_error("--frame %d: must be 0 to 10000000", o->frame);
    if (o->exposure < 0 || o->exposure > 1e6 || o->exposure != o->exposure)
        return rg_error("--exposure %g: must be above 0, at most 1000000", o->exposure);
    if (o->quick && o->full)
        return rg_error("--quick and --full: choose one");
    bool known = !o->format;
    for (int i = 0; i < 4 && !known; i++)
        known = !strcmp(o->format, formats[i]);
    if (!known)
        return rg_error("--format %s: choose md, csv, json or tex", o->format);
    return true;
}

static bool take_arguments(poptContext context, struct rg_options *o)
{
    const char *arg;
    while ((arg = poptGetArg(context))) {
        if (o->arg_count == RG_MAX_ARGS)
            return rg_error("'%s': more than %d arguments", arg, RG_MAX_ARGS);
        o->args[o->arg_count++] = arg;
    }
    return true;
}

static void print_help(const struct rg_command *command, poptContext context)
{
    // popt prints its own usage line first, which names neither the program nor the arguments.
    char *text = NULL;
    size_t size;
    FILE *help = open_memstream(&text, &size);
    if (!help)
        return;
    poptPrintHelp(context, help, 0);
    fclose(help);
    const char *options = strchr(text, '\n');
    printf("raingauge %s %s\n%s\n%s", command->name, command->usage, command->about,
           options ? options : "\n");
    free(text);
}

// popt names the value that it refuses; say whose value it is.
static void report_refusal(const struct rg_command *command, int argc, const char **argv,
                           poptContext context, int code)
{
    const char *refused = poptBadOption(context, POPT_BADOPTION_NOALIAS);
    const char *option = "";
    for (int i = 1; i < argc; i++)
        if (code != POPT_ERROR_BADOPT && !strcmp(argv[i], refused) && strncmp(refused, "--", 2))
            option = argv[i - 1];
    rg_error("%s%s%s: %s; `raingauge %s --help` prints the options", option, *option ? " " : "",
             refused, poptStrerror(code), command->name);
}

int rg_options_parse(const struct rg_command *command, int argc, const char **argv,
                     struct rg_options *o)
{
    struct poptOption table[32];
    int flags[4] = {0};
    const int unset = INT_MIN;
    *o = (struct rg_options){.frame = unset};
    build(command, o, flags, table);
    poptContext context = poptGetContext("raingauge", argc, argv, table, 0);
    o->context = context;
    int value;
    while ((value = poptGetNextOpt(context)) > 0) {
        if (value == VALUE_HELP) {
            print_help(command, context);
            return -1;
        }
        char *text = poptGetOptArg(context);
        bool good = take(value, text, o);
        free(text);
        if (!good)
            return RG_EXIT_USAGE;
    }
    if (value < -1) {
        report_refusal(command, argc, argv, context, value);
        return RG_EXIT_USAGE;
    }
    o->quick = flags[0];
    o->full = flags[1];
    o->json = flags[2];
    o->fresh = flags[3];
    bool good = check(o, o->frame != unset) && take_arguments(context, o);
    if (o->frame == unset)
        o->frame = -1;
    return good ? RG_EXIT_PASS : RG_EXIT_USAGE;
}

void rg_options_free(struct rg_options *o)
{
    for (int i = 0; i < o->set_count; i++)
        free(o->sets[i]);
    free(o->device);
    free(o->output);
    free(o->format);
    free(o->background);
    free(o->from);
    poptFreeContext(o->context);
}

bool rg_options_at_most(const struct rg_options *o, const char *command, int arguments)
{
    if (o->arg_count <= arguments)
        return true;
    return rg_error("%s: '%s' is one argument too many; `raingauge %s --help` prints the usage",
                    command, o->args[arguments], command);
}

void *rg_options_settings(const struct rg_options *o, const struct rg_technique *technique)
{
    void *settings = rg_settings_create(technique);
    for (int i = 0; settings && i < o->set_count; i++) {
        if (!rg_params_set(technique->params, settings, o->sets[i])) {
            free(settings);
            return NULL;
        }
    }
    return settings;
}

const struct rg_technique *rg_options_technique(const struct rg_options *o, void **settings)
{
    if (o->arg_count < 1)
        return rg_error_null("no technique named; `raingauge list techniques` prints them");
    const struct rg_technique *technique = rg_technique_find(o->args[0]);
    if (!technique)
        return rg_error_null("technique '%s': unknown; `raingauge list techniques` prints them",
                             o->args[0]);
    *settings = rg_options_settings(o, technique);
    return *settings ? technique : NULL;
}
