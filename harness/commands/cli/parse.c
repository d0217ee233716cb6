// Parses a command line by the command's table.
#include <popt.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "core/base/text/words.h"
#include "harness/commands/cli/command.h"

struct line {
    const struct rg_command *command;
    int count;
    struct rg_option rows[RG_MAX_OPTION_ROWS];
    bool given[RG_MAX_OPTION_ROWS];
    void *values;              // owned
    struct rg_words arguments; // valid as long as `context`
    poptContext context;
};

enum parsed { RUN, HELP, REFUSED };

// --- flags with values ---

// Programs that start tests write flags as --NAME=1, or --NAME=0 for an unset one. Finds the flag
// of such a word; NULL: it is none.
static const struct rg_option *flag_of(const struct line *line, const char *word, bool *holds)
{
    static const char yes[] = "1 true yes on", no[] = "0 false no off";
    const char *equals = strncmp(word, "--", 2) ? NULL : strchr(word, '=');
    *holds = equals && equals[1] && rg_has_word(yes, equals + 1);
    if (!*holds && !(equals && equals[1] && rg_has_word(no, equals + 1)))
        return NULL;
    for (int i = 0; i < line->count; i++)
        if (line->rows[i].kind == RG_OPTION_FLAG && line->rows[i].name &&
            strlen(line->rows[i].name) == (size_t)(equals - word - 2) &&
            !strncmp(line->rows[i].name, word + 2, strlen(line->rows[i].name)))
            return &line->rows[i];
    return NULL;
}

static void free_words(const char **words)
{
    for (int i = 0; words && words[i]; i++)
        free((char *)words[i]);
    free(words);
}

// The words with such flags written as --NAME, or left out; a NULL follows. The caller frees them
// with free_words. NULL without memory.
static const char **settle_flags(const struct line *line, int argc, const char **argv, int *count)
{
    const char **words = rg_alloc((size_t)argc + 1, sizeof(*words), "options");
    bool goes_on = words != NULL; // up to "--", after which nothing is an option
    for (int i = *count = 0; words && i < argc; i++) {
        bool holds;
        goes_on = goes_on && strcmp(argv[i], "--");
        const struct rg_option *flag = goes_on ? flag_of(line, argv[i], &holds) : NULL;
        if (!flag || holds)
            words[(*count)++] = flag ? strndup(argv[i], strlen(flag->name) + 2) : strdup(argv[i]);
        if (*count && !words[*count - 1]) {
            free_words(words);
            return rg_harness_error_null("options: no memory for them; close other programs");
        }
    }
    return words;
}

// --- the line ---

// Sets every value to that of an option that is not given.
static bool set_defaults(struct line *line)
{
    bool ok = true;
    for (int i = 0; ok && i < line->count; i++) {
        const struct rg_option *row = &line->rows[i];
        rg_option_clear(row, line->values);
        ok = !row->initial || rg_option_set(row, line->values, row->initial, line->command->name);
    }
    return ok;
}

// Converts the options for popt, which splits the line and returns the row's number, from 1.
static void make_table(const struct line *line, struct poptOption *table)
{
    char text[RG_ARGUMENT_SIZE];
    for (int i = 0; i < line->count; i++) {
        const struct rg_option *row = &line->rows[i];
        if (!row->name)
            continue;
        const bool takes_value = *rg_option_argument(row, text);
        *table++ = (struct poptOption){.longName = row->name,
                                       .shortName = row->letter,
                                       .argInfo = takes_value ? POPT_ARG_STRING : POPT_ARG_NONE,
                                       .val = i + 1};
    }
    *table = (struct poptOption)POPT_TABLEEND;
}

static bool take_option(struct line *line, int number)
{
    char *text = poptGetOptArg(line->context);
    line->given[number] = true;
    const bool ok = rg_option_set(&line->rows[number], line->values, text, line->command->name);
    free(text);
    return ok;
}

// Whether a file can list what the arguments name.
static bool has_list(const struct line *line)
{
    for (int i = 0; i < line->count; i++)
        if (line->rows[i].name && !strcmp(line->rows[i].name, "list"))
            return true;
    return false;
}

static bool take_arguments(struct line *line)
{
    int places = 0;
    for (int i = 0; i < line->count; i++) {
        const struct rg_option *row = &line->rows[i];
        const int last = row->last ? row->last : RG_MAX_WORDS;
        if (row->kind == RG_OPTION_OPERAND && last > places)
            places = last;
    }
    const char *word;
    while ((word = poptGetArg(line->context))) {
        if (line->arguments.count == RG_MAX_WORDS)
            return rg_error("'%s': more than %d arguments; name fewer%s", word, RG_MAX_WORDS,
                            has_list(line) ? ", or a file of them by --list" : "");
        if (line->arguments.count == places)
            return rg_error("%s: '%s' is one argument too many; `raingauge %s --help` prints the "
                            "usage",
                            line->command->name, word, line->command->name);
        line->arguments.items[line->arguments.count++] = word;
    }
    return true;
}

static bool check_exclusions(const struct line *line)
{
    for (int i = 0; i < line->count; i++)
        for (int j = 0; line->given[i] && line->rows[i].excludes && j < line->count; j++)
            if (line->given[j] && rg_has_word(line->rows[i].excludes, line->rows[j].name))
                return rg_error("--%s and --%s: choose one", line->rows[i].name,
                                line->rows[j].name);
    return true;
}

// Names the arguments that an option requires.
static const char *arguments_of(const struct line *line, const struct rg_option *option)
{
    for (int i = 0; i < line->count; i++)
        if (line->rows[i].kind == RG_OPTION_OPERAND && line->rows[i].arguments == option->arguments)
            return line->rows[i].argument;
    return "";
}

// Refuses options that require another number of arguments, since they would be ignored.
static bool check_belonging(const struct line *line)
{
    const int count = line->arguments.count;
    for (int i = 0; i < line->count; i++) {
        const struct rg_option *row = &line->rows[i];
        if (line->given[i] && row->arguments && row->arguments != count)
            return rg_error("--%s: belongs to `%s %s`, and %d argument%s given; leave it out, or "
                            "write that",
                            row->name, line->command->name, arguments_of(line, row), count,
                            count == 1 ? " is" : "s are");
    }
    return true;
}

static bool refuse(const struct line *line, int code)
{
    return rg_error("%s: %s; `raingauge %s --help` prints the options",
                    poptBadOption(line->context, POPT_BADOPTION_NOALIAS), poptStrerror(code),
                    line->command->name);
}

static enum parsed parse(struct line *line)
{
    int value;
    while ((value = poptGetNextOpt(line->context)) > 0) {
        if (line->rows[value - 1].kind == RG_OPTION_HELP)
            return HELP;
        if (!take_option(line, value - 1))
            return REFUSED;
    }
    if (value < -1 && !refuse(line, value))
        return REFUSED;
    return check_exclusions(line) && take_arguments(line) && check_belonging(line) ? RUN : REFUSED;
}

static int run(struct line *line)
{
    const enum parsed parsed = parse(line);
    if (parsed == RUN)
        return line->command->run(line->values, &line->arguments);
    if (parsed == REFUSED)
        return line->command->refused ? line->command->refused() : rg_exit_of_error();
    rg_command_print_help(line->command);
    return RG_EXIT_PASS;
}

int rg_command_run(const struct rg_command *command, int argc, const char **argv)
{
    struct poptOption table[RG_MAX_OPTION_ROWS + 1];
    struct line line = {.command = command};
    line.count = rg_option_rows(command->options, line.rows);
    line.values = rg_alloc(1, command->options_size, "options");
    int count = 0;
    const char **words = line.values ? settle_flags(&line, argc, argv, &count) : NULL;
    if (!words) {
        free(line.values);
        return rg_exit_of_error();
    }
    make_table(&line, table);
    line.context = poptGetContext("raingauge", count, words, table, 0);
    const int exit = set_defaults(&line) ? run(&line) : rg_exit_of_error();
    poptFreeContext(line.context);
    for (int i = 0; i < line.count; i++)
        rg_option_free(&line.rows[i], line.values);
    free(line.values);
    free_words(words);
    return exit;
}
