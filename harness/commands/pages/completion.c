// The words are one associative array of bash. Its keys are
//
//     commands, @techniques, @tables, @figures
//     render options      the options of a command
//     render --set        what an option's value can be; an option that takes none has no key
//     list 1, verify +    what an argument can be at its place, or at any without a key
//     flow parameters     the parameters of a technique
//     flow view           what a parameter's value can be
//
// and its values are words, or lists of words, whose names begin with "@" (completion.bash).
#include <stdio.h>
#include <string.h>

#include "core/techniques/technique.h"
#include "harness/commands/commands.h"
#include "harness/commands/pages/pages.h"
#include "harness/tables/figures/figures.h"
#include "harness/tables/papers/papers.h"

// The name of the list with the possible values.
static const char *const lists[] = {
    [RG_NAMES_TECHNIQUE] = "@techniques", [RG_NAMES_TABLE] = "@tables",
    [RG_NAMES_DEVICE] = "@device",        [RG_NAMES_DEVICES] = "@devices",
    [RG_NAMES_PARAMETER] = "@parameters", [RG_NAMES_FILE] = "@files",
    [RG_NAMES_FOLDER] = "@folders",       [RG_NAMES_FIGURE] = "@figures",
};

// --- entries ---

// Begins an entry; print_word fills and end_entry ends it. `what` may be "".
static void begin_entry(const char *subject, const char *what)
{
    printf("  ['%s%s%s']='", subject, *what ? " " : "", what);
}

static void print_word(const char *word)
{
    printf(" %s", word);
}

static void end_entry(void)
{
    printf("'\n");
}

static void print_values(const struct rg_option *row)
{
    if (row->names != RG_NAMES_NOTHING)
        print_word(lists[row->names]);
    for (int i = 0; row->choices && row->choices[i]; i++)
        print_word(row->choices[i]);
}

// --- commands ---

static void print_option(const char *command, const struct rg_option *row)
{
    char text[RG_ARGUMENT_SIZE], name[64], letter[] = {'-', row->letter, 0};
    if (!*rg_option_argument(row, text))
        return;
    snprintf(name, sizeof(name), "--%s", row->name);
    const char *const names[] = {name, row->letter ? letter : NULL};
    for (int i = 0; i < 2 && names[i]; i++) {
        begin_entry(command, names[i]);
        print_values(row);
        end_entry();
    }
}

static bool may_stand_at(const struct rg_option *row, int place)
{
    return row->kind == RG_OPTION_OPERAND && row->first <= place &&
           (!row->last || place <= row->last);
}

// Prints the words for each numbered place, and for those after the last.
static void print_places(const char *command, const struct rg_option *rows, int count)
{
    int places = 0;
    for (int i = 0; i < count; i++)
        if (rows[i].kind == RG_OPTION_OPERAND && rows[i].last > places)
            places = rows[i].last;
    for (int place = 1; place <= places + 1; place++) {
        char key[16] = "+";
        if (place <= places)
            snprintf(key, sizeof(key), "%d", place);
        begin_entry(command, key);
        for (int i = 0; i < count; i++)
            if (may_stand_at(&rows[i], place))
                print_values(&rows[i]);
        end_entry();
    }
}

static void print_command(const struct rg_command *command)
{
    struct rg_option rows[RG_MAX_OPTION_ROWS];
    const int count = rg_option_rows(command->options, rows);
    begin_entry(command->name, "options");
    for (int i = 0; i < count; i++)
        if (rows[i].name)
            printf(" --%s", rows[i].name);
    end_entry();
    for (int i = 0; i < count; i++)
        if (rows[i].name)
            print_option(command->name, &rows[i]);
    print_places(command->name, rows, count);
}

// --- techniques ---

static void print_parameters(const struct rg_technique *technique)
{
    const struct rg_param_table *table = technique->params;
    begin_entry(technique->name, "parameters");
    for (int i = 0; i < table->count; i++)
        print_word(table->rows[i].name);
    end_entry();
    for (int i = 0; i < table->count; i++) {
        const struct rg_param *param = &table->rows[i];
        if (param->kind != RG_PARAM_CHOICE && param->kind != RG_PARAM_FILE)
            continue;
        begin_entry(technique->name, param->name);
        print_word(param->kind == RG_PARAM_CHOICE ? param->text : lists[RG_NAMES_FILE]);
        end_entry();
    }
}

void rg_print_completion(void)
{
    printf(
        "# Completion of raingauge's command line, made by the build from the program's tables.\n"
        "declare -gA _raingauge_words=(\n");
    begin_entry("commands", "");
    for (int i = 0; rg_commands[i]; i++)
        print_word(rg_commands[i]->name);
    end_entry();
    begin_entry(lists[RG_NAMES_TECHNIQUE], "");
    for (int i = 0; rg_techniques[i]; i++)
        print_word(rg_techniques[i]->name);
    end_entry();
    begin_entry(lists[RG_NAMES_TABLE], "");
    for (int i = 0; rg_tables[i]; i++)
        print_word(rg_tables[i]->id);
    end_entry();
    begin_entry(lists[RG_NAMES_FIGURE], "");
    for (int i = 0; rg_figure_at(i); i++)
        print_word(rg_figure_at(i)->id);
    end_entry();
    for (int i = 0; rg_commands[i]; i++)
        print_command(rg_commands[i]);
    for (int i = 0; rg_techniques[i]; i++)
        print_parameters(rg_techniques[i]);
    printf(")\n\n");
}
