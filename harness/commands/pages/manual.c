#include <signal.h>
#include <stdio.h>
#include <string.h>

#include "core/techniques/technique.h"
#include "harness/commands/commands.h"
#include "harness/commands/pages/pages.h"
#include "harness/record/passport/build_info.h"
#include "harness/tables/papers/papers.h"

// Text for roff: words in backquotes become bold, and dashes ones that can be copied into a shell.
static void print_text(const char *text)
{
    bool is_bold = false;
    if (*text == '.' || *text == '\'')
        printf("\\&");
    for (; *text; text++) {
        if (*text == '`')
            printf((is_bold = !is_bold) ? "\\fB" : "\\fR");
        else if (*text == '\\')
            printf("\\e");
        else if (*text == '-')
            printf("\\-");
        else
            putchar(*text);
    }
}

// One line: a text between roff commands.
static void print_line(const char *before, const char *text, const char *after)
{
    printf("%s", before);
    print_text(text);
    printf("%s\n", after);
}

// The name in bold, and the value's placeholder in italics.
static void print_row(const struct rg_option *row)
{
    char argument[RG_ARGUMENT_SIZE], about[RG_ABOUT_SIZE];
    const char *value = rg_option_argument(row, argument);
    if (row->kind == RG_OPTION_GROUP) {
        print_line(".PP\n\\fB", row->about, "\\fR");
        return;
    }
    printf(".TP\n");
    if (row->letter)
        printf("\\fB\\-%c\\fR, ", row->letter);
    if (row->name) {
        printf("\\fB\\-\\-");
        print_text(row->name);
        printf("\\fR%s", *value ? " " : "");
    }
    print_line(*value ? "\\fI" : "", value, *value ? "\\fR" : "");
    print_line("", rg_option_about(row, about), "");
}

static const char description[] =
    "A technique is the rain of a paper. It is written once and runs on interchangeable devices: "
    "the CPU, OpenGL, Vulkan and OpenCL. The commands draw it, check that all devices compute the "
    "same, and measure it beside the numbers that the papers printed.";

static void print_command(const struct rg_command *command)
{
    struct rg_option rows[RG_MAX_OPTION_ROWS];
    const int count = rg_option_rows(command->options, rows);
    printf(".SS raingauge %s\n", command->name);
    printf("\\fBraingauge %s\\fR ", command->name);
    print_line("", command->usage, "\n.PP");
    print_line("", command->about, ".");
    for (int i = 0; i < count; i++)
        print_row(&rows[i]);
}

static void print_entry(const char *name, const char *about)
{
    print_line(".TP\n\\fB", name, "\\fR");
    print_line("", about, "");
}

static void print_statuses(void)
{
    static const struct {
        int status;
        const char *meaning;
    } rows[] = {
        {RG_EXIT_PASS, "pass"},
        {RG_EXIT_FAIL, "fail: devices differ, a law is broken, a driver that is present fails"},
        {RG_EXIT_USAGE, "bad usage or input"},
        {RG_EXIT_INCONCLUSIVE, "inconclusive: the samples neither prove nor exclude a change"},
        {RG_EXIT_NOTHING, "nothing was compared or measured"},
        {RG_EXIT_HARNESS,
         "raingauge itself lacked something: memory, a process, open files, room on the disk"},
        {RG_EXIT_LATER,
         "not now: the machine is busy, throttled or not healthy (`doctor --prologue`)"},
        {RG_EXIT_UNSUPPORTED, "not supported on this machine"},
        {RG_EXIT_GIT_SKIP, "for git: `bisect` inside `git bisect run` skips this commit"},
        {RG_EXIT_SIGNALLED, "for git: `bisect` inside `git bisect run` ends the search"},
        {RG_EXIT_SIGNALLED + SIGHUP, "interrupted by SIGHUP; `table` goes on where it was"},
        {RG_EXIT_SIGNALLED + SIGINT, "interrupted by SIGINT; `table` goes on where it was"},
        {RG_EXIT_SIGNALLED + SIGTERM, "interrupted by SIGTERM; `table` goes on where it was"},
    };
    printf(".SH EXIT STATUS\n");
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        char status[16];
        snprintf(status, sizeof(status), "%d", rows[i].status);
        print_entry(status, rows[i].meaning);
    }
}

static void print_examples(void)
{
    static const struct {
        const char *command, *about;
    } rows[] = {
        {"raingauge doctor", "Examines the machine and its drivers."},
        {"raingauge diff flow --device gl,vulkan", "Compares a picture on two devices."},
        {"raingauge verify flow --quick", "Checks states, pictures, laws and mutants."},
        {"raingauge gate vulkan new=vulkan@DRIVER=/opt/mesa-25",
         "Judges a driver that was unpacked into a folder against the installed one."},
        {"raingauge table creus-5.4 --device cpu", "Measures a paper's table on the processor."},
        {"raingauge table --claims --from " RG_DATA "/tables",
         "Prints what the papers claim, and what kept records say of it."},
        {"raingauge render streaks -o rain.png", "Draws rain in a city."},
    };
    printf(".SH EXAMPLES\n");
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++)
        print_entry(rows[i].command, rows[i].about);
}

void rg_print_manual(void)
{
    printf(".TH RAINGAUGE 1 \"\" \"raingauge %s\" \"User Commands\"\n", rg_build_version);
    print_line(".SH NAME\nraingauge \\- ", rg_program_about, "");
    printf(".SH SYNOPSIS\n\\fBraingauge\\fR \\fICOMMAND\\fR [\\fIOPTION\\fR]...\n");
    print_line(".SH DESCRIPTION\n", description, "\n.SH COMMANDS");
    for (int i = 0; rg_commands[i]; i++)
        print_command(rg_commands[i]);
    printf(".SH TECHNIQUES\n");
    for (int i = 0; rg_techniques[i]; i++)
        print_entry(rg_techniques[i]->name, rg_techniques[i]->about);
    printf(".SH TABLES\n");
    for (int i = 0; rg_tables[i]; i++)
        print_entry(rg_tables[i]->id, rg_tables[i]->about);
    print_examples();
    print_statuses();
}
