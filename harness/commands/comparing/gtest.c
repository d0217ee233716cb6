#include "harness/commands/comparing/gtest.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "core/base/log.h"

#define AT(field) offsetof(struct rg_gtest_asked, field)
#define NOTHING   "accepted because runners pass it; has no effect"

const struct rg_option rg_gtest_options[] = {
    RG_GROUP("googletest's protocol"),
    {RG_OPTION_FLAG, "gtest_list_tests",
     .about = "prints the names of the cases, instead of running them", .offset = AT(list),
     .excludes = "json github"},
    {RG_OPTION_TEXT, "gtest_filter", .argument = "FILTER",
     .about = "runs only these cases, and prints in googletest's format", .offset = AT(filter),
     .excludes = "json github"},
    {RG_OPTION_TEXT, "gtest_output", .argument = "xml:FILE",
     .about = "writes JUnit XML, and prints in googletest's format", .offset = AT(output),
     .excludes = "json github junit"},
    {RG_OPTION_INT, "gtest_repeat", .argument = "N",
     .about = "must be 1: the gate itself decides how often it measures a case",
     .offset = AT(repeat), .least = 1, .most = 1},
    {RG_OPTION_TEXT, "gtest_color", .argument = "WHEN", .about = NOTHING, .offset = AT(color)},
    {RG_OPTION_TEXT, "gtest_random_seed", .argument = "N", .about = NOTHING, .offset = AT(seed)},
    {RG_OPTION_TEXT, "gtest_death_test_style", .argument = "STYLE", .about = NOTHING,
     .offset = AT(death_style)},
    {RG_OPTION_FLAG, "gtest_also_run_disabled_tests", .about = NOTHING, .offset = AT(disabled)},
    {RG_OPTION_FLAG, "gtest_shuffle", .about = NOTHING, .offset = AT(shuffle)},
    {RG_OPTION_FLAG, "gtest_brief", .about = NOTHING, .offset = AT(brief)},
    {RG_OPTION_FLAG, "gtest_print_time", .about = NOTHING, .offset = AT(print_time)},
    {RG_OPTION_FLAG, "gtest_print_utf8", .about = NOTHING, .offset = AT(utf8)},
    {RG_OPTION_FLAG, "gtest_catch_exceptions", .about = NOTHING, .offset = AT(catches)},
    {RG_OPTION_FLAG, "gtest_break_on_failure", .about = NOTHING, .offset = AT(breaks)},
    {RG_OPTION_FLAG, "gtest_throw_on_failure", .about = NOTHING, .offset = AT(throws)},
    {RG_OPTION_FLAG, "gtest_fail_fast", .about = NOTHING, .offset = AT(fails_fast)},
    {RG_OPTION_TEXT, "gtest_stack_trace_depth", .argument = "N", .about = NOTHING,
     .offset = AT(trace_depth)},
    {RG_OPTION_FLAG, "gtest_recreate_environments_when_repeating", .about = NOTHING,
     .offset = AT(recreates)},
    {RG_OPTION_END},
};

static void inherit(const char *variable, char **text)
{
    char *value = *text ? NULL : getenv(variable);
    if (value && *value)
        *text = value;
}

void rg_gtest_inherit(struct rg_gtest_asked *asked)
{
    inherit("GTEST_FILTER", &asked->filter);
    inherit("GTEST_OUTPUT", &asked->output);
}

// Makes the folders of a path that ends in a slash. Failures are reported by writing the report
// there.
static void make_folders(const char *path)
{
    char part[PATH_MAX];
    for (const char *slash = strchr(path, '/'); slash; slash = strchr(slash + 1, '/')) {
        snprintf(part, sizeof(part), "%.*s", (int)(slash - path), path);
        if (*part)
            mkdir(part, 0777);
    }
}

bool rg_gtest_output(const struct rg_gtest_asked *asked, char path[PATH_MAX])
{
    const char *asks = asked->output ? asked->output : "";
    const char *file = !strncmp(asks, "xml:", 4) ? asks + 4 : "";
    const bool is_folder = *file && file[strlen(file) - 1] == '/';
    *path = 0;
    if (!*asks)
        return true;
    if (strcmp(asks, "xml") && !*file)
        return rg_error("--gtest_output %s: write it as xml:FILE; --json prints JSON", asks);
    if (snprintf(path, PATH_MAX, "%s%s", *file ? file : "test_detail.xml",
                 is_folder ? "raingauge.xml" : "") >= PATH_MAX)
        return rg_error("--gtest_output: its path is too long");
    if (is_folder)
        make_folders(file);
    return true;
}
