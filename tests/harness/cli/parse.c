// A command runs with the values of its line, of each kind, or one line refuses it and says why.
#include <limits.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>

#include "core/base/log.h"
#include "harness/commands/cli/command.h"
#include "harness/commands/cli/shared.h"
#include "tests/tools/process/logged.h"

struct sample_options {
    struct rg_words sets;
    struct rg_size size;
    struct rg_range rows, things;
    int frames, steps, format, form;
    int64_t memory_bytes;
    double factor, exposure;
    char *devices, *output;
    struct rg_length length;
    int depth;
    bool is_swapped, has_more;
};

#define AT(field) offsetof(struct sample_options, field)

static const char *const formats[] = {"md", "csv", "tex", NULL};

static const struct rg_option depth_option[] = {
    {RG_OPTION_INT, "depth", .argument = "N", .about = "of a pair", .most = 9, .initial = "1"},
    {RG_OPTION_END},
};

static const struct rg_option options[] = {
    RG_GROUP("Things"),
    {RG_OPTION_OPERAND, .argument = "THING", .about = "a thing", .first = 1, .last = 2},
    RG_INCLUDE(rg_settings_option, AT(sets), NULL),
    RG_INCLUDE(rg_size_option, AT(size), "512x512"),
    {RG_OPTION_RANGE, "rows", .argument = "A-B", .about = "rows", .offset = AT(rows), .least = 1,
     .most = INT_MAX},
    {RG_OPTION_RANGE, "things", .argument = "A-B", .about = "things", .offset = AT(things),
     .least = 0, .most = 9},
    RG_INCLUDE(rg_memory_option, AT(memory_bytes), NULL),
    RG_INCLUDE(rg_frame_option, AT(frames), "60"),
    {RG_OPTION_INT, "steps", .argument = "N", .about = "steps", .offset = AT(steps), .least = 2,
     .most = 9},
    {RG_OPTION_CHOICE, "format", .about = "form", .offset = AT(format), .choices = formats,
     .initial = "csv"},
    {RG_OPTION_CHOICE, "form", .about = "form", .offset = AT(form), .choices = formats},
    {RG_OPTION_FACTOR, "factor", .argument = "X", .about = "a factor", .offset = AT(factor),
     .most = 10},
    RG_INCLUDE(rg_exposure_option, AT(exposure), "1"),
    RG_INCLUDE(rg_devices_option, AT(devices), "cpu"),
    {RG_OPTION_TEXT, "output", .argument = "FILE", .about = "a file", .offset = AT(output),
     .letter = 'o'},
    RG_INCLUDE(rg_length_options, AT(length), NULL),
    RG_GROUP_OF(2, "Pairs"),
    {RG_OPTION_OPERAND, .argument = "THIS THAT", .about = "a pair", .first = 1, .last = 2},
    {RG_OPTION_FLAG, "swap", .about = "swaps a pair", .offset = AT(is_swapped)},
    RG_INCLUDE(depth_option, AT(depth), NULL),
    RG_GROUP("More"),
    {RG_OPTION_FLAG, "more", .about = "more", .offset = AT(has_more)},
    {RG_OPTION_END},
};

// The values that the command last ran with, as text.
static char seen[1024];

static int see(const void *values, const struct rg_words *arguments)
{
    const struct sample_options *o = values;
    int used =
        snprintf(seen, sizeof(seen), "%dx%d %d-%d %d-%d %d %d %d %d %g %g %s %s %d%d",
                 o->size.width, o->size.height, o->rows.first, o->rows.last, o->things.first,
                 o->things.last, o->frames, o->steps, o->format, o->form, o->factor, o->exposure,
                 o->devices, o->output ? o->output : "none", o->length.quick, o->length.full);
    if (o->memory_bytes)
        used += snprintf(seen + used, sizeof(seen) - (size_t)used, " memory %lld",
                         (long long)o->memory_bytes);
    for (int i = 0; i < o->sets.count; i++)
        used += snprintf(seen + used, sizeof(seen) - (size_t)used, " %s", o->sets.items[i]);
    for (int i = 0; i < arguments->count; i++)
        used += snprintf(seen + used, sizeof(seen) - (size_t)used, " '%s'", arguments->items[i]);
    return RG_EXIT_INCONCLUSIVE;
}

static const struct rg_command sample = {
    .name = "sample",
    .usage = "THING",
    .about = "sees",
    .options = options,
    .options_size = sizeof(struct sample_options),
    .run = see,
};

// Runs the command with the words of a line.
static int run(const char *line)
{
    char copy[4096], *rest = copy;
    const char *argv[200] = {"sample"};
    int argc = 1;
    snprintf(copy, sizeof(copy), "%s", line);
    for (char *word; (word = strtok_r(rest, " ", &rest));)
        argv[argc++] = word;
    seen[0] = logged[0] = 0;
    logged_lines = 0;
    rg_log_listen(log_last, NULL);
    const int exit = rg_command_run(&sample, argc, argv);
    rg_log_listen(NULL, NULL);
    return exit;
}

static void expect_run(const char *line, const char *values)
{
    assert_int_equal(run(line), RG_EXIT_INCONCLUSIVE);
    assert_string_equal(seen, values);
    assert_int_equal(logged_lines, 0);
}

static void expect_refusal(const char *line, const char *message)
{
    assert_int_equal(run(line), RG_EXIT_USAGE);
    assert_string_equal(logged, message);
    assert_int_equal(logged_lines, 1);
    assert_string_equal(seen, "");
}

static void what_is_not_given_has_its_default_or_none(void **state)
{
    (void)state;
    expect_run("", "512x512 0-0 -1--1 60 1 1 -1 0 1 cpu none 00");
}

static void values_are_of_their_kinds(void **state)
{
    (void)state;
    expect_run("--size 3x4 --rows 5-6 --things 3-9 --frame 7 --steps 0x8 --format tex --form md "
               "--factor 9.5 "
               "--exposure 1e-3 --device gl,vulkan --output a --quick --set k=1 --set l=2 one two",
               "3x4 5-6 3-9 7 8 2 0 9.5 0.001 gl,vulkan a 10 k=1 l=2 'one' 'two'");
    expect_run("--rows 5 --things 0 --full -o b", "512x512 5-5 0-0 60 1 1 -1 0 1 cpu b 01");
    expect_run("--memory 1.5GiB", "512x512 0-0 -1--1 60 1 1 -1 0 1 cpu none 00 memory 1610612736");
    expect_run("--memory 2K", "512x512 0-0 -1--1 60 1 1 -1 0 1 cpu none 00 memory 2048");
    expect_run("--memory 3T", "512x512 0-0 -1--1 60 1 1 -1 0 1 cpu none 00 memory 3298534883328");
}

static void arguments_stand_anywhere_and_the_last_value_counts(void **state)
{
    (void)state;
    expect_run("one -oa --size=3x4 -- --two", "3x4 0-0 -1--1 60 1 1 -1 0 1 cpu a 00 'one' '--two'");
    expect_run("-o a -o b --frame 1 --frame 2 --device x --device y",
               "512x512 0-0 -1--1 2 1 1 -1 0 1 y b 00");
}

// Help is printed whatever else stands on the line.
static void asking_for_help_is_no_error(void **state)
{
    (void)state;
    assert_int_equal(run("--quick --help one"), RG_EXIT_PASS);
    assert_int_equal(run("-h"), RG_EXIT_PASS);
    assert_string_equal(seen, "");
    assert_int_equal(logged_lines, 0);
}

static void what_is_wrong_is_refused_in_one_line(void **state)
{
    (void)state;
    expect_refusal("--size 0x4", "--size 0x4: each side must be 1 to 16384 pixels");
    expect_refusal("--size 4x16385", "--size 4x16385: each side must be 1 to 16384 pixels");
    expect_refusal("--size 4", "--size 4: write it as WIDTHxHEIGHT, as in 1280x720");
    expect_refusal("--size 4x3x2", "--size 4x3x2: write it as WIDTHxHEIGHT, as in 1280x720");
    expect_refusal("--rows 2-1", "--rows 2-1: rows count from 1, the first not after the last");
    expect_refusal("--rows 2-", "--rows 2-: write it as FIRST-LAST, as in 2-4");
    expect_refusal("--rows 0", "--rows 0: rows count from 1, the first not after the last");
    expect_refusal("--things 4-3",
                   "--things 4-3: things count from 0, the first not after the last");
    expect_refusal("--things -1-3",
                   "--things -1-3: things count from 0, the first not after the last");
    expect_refusal("--things 9-10", "--things 9-10: must be 0 to 9");
    expect_refusal("--steps 1", "--steps 1: must be 2 to 9");
    expect_refusal("--steps 10", "--steps 10: must be 2 to 9");
    expect_refusal("--frame 3x", "--frame 3x: invalid numeric value; `raingauge sample --help` "
                                 "prints the options");
    expect_refusal("--frame 3000000000", "--frame 3000000000: number too large or too small; "
                                         "`raingauge sample --help` prints the options");
    expect_refusal("--format html", "--format html: choose md, csv or tex");
    expect_refusal("--factor 0", "--factor 0: must be above 0, at most 10");
    expect_refusal("--factor 11", "--factor 11: must be above 0, at most 10");
    expect_refusal("--factor nan", "--factor nan: must be above 0, at most 10");
    expect_refusal("--factor 1m", "--factor 1m: invalid numeric value; `raingauge sample --help` "
                                  "prints the options");
    for (int i = 0; i < 6; i++) {
        static const char *const wrong[] = {"4", "G", "4GB", "4g", "nanG", "4Gx"};
        char line[64], message[128];
        snprintf(line, sizeof(line), "--memory %s", wrong[i]);
        snprintf(message, sizeof(message),
                 i == 4 ? "%s: must be above 0, at most 1024T"
                        : "%s: is no size; write it as 512M, 4G or 1.5G",
                 line);
        expect_refusal(line, message);
    }
    expect_refusal("--memory 0G", "--memory 0G: must be above 0, at most 1024T");
    expect_refusal("--memory -1G", "--memory -1G: must be above 0, at most 1024T");
    expect_refusal("--memory 1025T", "--memory 1025T: must be above 0, at most 1024T");
    expect_refusal("--full --quick", "--quick and --full: choose one");
    expect_refusal("--none",
                   "--none: unknown option; `raingauge sample --help` prints the options");
    expect_refusal("--output",
                   "--output: missing argument; `raingauge sample --help` prints the options");
    expect_refusal("one two three", "sample: 'three' is one argument too many; `raingauge sample "
                                    "--help` prints the usage");
}

// An option under such a heading belongs to its number of arguments, included or not, up to the
// next heading.
static void what_a_number_of_arguments_leaves_unused_is_refused(void **state)
{
    (void)state;
    const char *const values = "512x512 0-0 -1--1 60 1 1 -1 0 1 cpu none 00";
    char pair[128], one[128];
    snprintf(pair, sizeof(pair), "%s 'a' 'b'", values);
    snprintf(one, sizeof(one), "%s 'a'", values);
    expect_run("a b --swap --depth 3 --more", pair);
    expect_run("a --more", one);
    expect_run("a --swap=0", one);
    expect_refusal("--swap", "--swap: belongs to `sample THIS THAT`, and 0 arguments are given; "
                             "leave it out, or write that");
    expect_refusal("a --depth 3", "--depth: belongs to `sample THIS THAT`, and 1 argument is "
                                  "given; leave it out, or write that");
}

// Programs that start tests give flags a value; after "--" nothing is one.
static void flags_can_have_values(void **state)
{
    (void)state;
    static const char *const yes[] = {"1", "true", "yes", "on"}, *const no[] = {"0", "false", "no",
                                                                                "off"};
    static const char *const wrong[] = {"2", "", "y", "onn"};
    for (int i = 0; i < 4; i++) {
        char line[64];
        snprintf(line, sizeof(line), "--quick=%s a", yes[i]);
        expect_run(line, "512x512 0-0 -1--1 60 1 1 -1 0 1 cpu none 10 'a'");
        snprintf(line, sizeof(line), "--full --quick=%s", no[i]);
        expect_run(line, "512x512 0-0 -1--1 60 1 1 -1 0 1 cpu none 01");
        snprintf(line, sizeof(line), "--quick=%s", wrong[i]);
        assert_int_equal(run(line), RG_EXIT_USAGE);
        assert_int_equal(logged_lines, 1);
    }
    expect_run("-- --quick=1", "512x512 0-0 -1--1 60 1 1 -1 0 1 cpu none 00 '--quick=1'");
    expect_run("--rows=1", "512x512 1-1 -1--1 60 1 1 -1 0 1 cpu none 00");
    expect_run("--output=1", "512x512 0-0 -1--1 60 1 1 -1 0 1 cpu 1 00"); // no flag
    assert_int_equal(run("--quic=1"), RG_EXIT_USAGE);
    assert_int_equal(run("--quick=1 --full"), RG_EXIT_USAGE);
}

static void there_is_room_for_so_many_words(void **state)
{
    (void)state;
    char line[2048] = "";
    for (int i = 0; i < RG_MAX_WORDS; i++)
        strcat(line, "--set a=1 ");
    assert_int_equal(run(line), RG_EXIT_INCONCLUSIVE);
    strcat(line, "--set b=1");
    expect_refusal(line, "--set b=1: more than 64 of them");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_not_given_has_its_default_or_none),
        cmocka_unit_test(values_are_of_their_kinds),
        cmocka_unit_test(arguments_stand_anywhere_and_the_last_value_counts),
        cmocka_unit_test(asking_for_help_is_no_error),
        cmocka_unit_test(what_is_wrong_is_refused_in_one_line),
        cmocka_unit_test(what_a_number_of_arguments_leaves_unused_is_refused),
        cmocka_unit_test(flags_can_have_values),
        cmocka_unit_test(there_is_room_for_so_many_words),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
