// A command's help, to the last blank: options and arguments in their groups, with their meaning.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/commands/cli/command.h"
#include "harness/commands/cli/shared.h"
#include "harness/commands/cli/subject.h"
#include "harness/commands/commands.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/logged.h"
#include "tests/tools/process/printed.h"

struct values {
    int format, count;
    char *output;
    bool is_quick;
};

static const char *const formats[] = {"md", "csv", NULL};

static const struct rg_option shared[] = {
    {RG_OPTION_INT, "a-very-long-name-of-an-option", .argument = "N", .about = "counts", .most = 9},
    {RG_OPTION_END},
};

static const struct rg_option options[] = {
    RG_GROUP("Things"),
    {RG_OPTION_OPERAND, .argument = "THING", .about = "a thing", .first = 1},
    {RG_OPTION_TEXT, "output", .argument = "FILE", .about = "a file",
     .offset = offsetof(struct values, output), .letter = 'o'},
    {RG_OPTION_FLAG, "quick", .about = "is quick", .offset = offsetof(struct values, is_quick)},
    RG_GROUP("Other things"),
    RG_INCLUDE(shared, offsetof(struct values, count), "3"),
    {RG_OPTION_CHOICE, "format",
     .about = "the form of what is printed, of which there are two, so a text of this length takes "
              "more than one line, and more than two of them as well",
     .offset = offsetof(struct values, format), .choices = formats, .initial = "md"},
    {RG_OPTION_END},
};

static int run(const void *values, const struct rg_words *arguments)
{
    (void)values;
    (void)arguments;
    return RG_EXIT_FAIL;
}

static const struct rg_command sample = {
    .name = "sample",
    .usage = "THING [--quick]",
    .about = "does something",
    .options = options,
    .options_size = sizeof(struct values),
    .run = run,
};

static const char help[] =
    "raingauge sample THING [--quick]\n"
    "does something\n"
    "\n"
    "Things\n"
    "  THING                a thing\n"
    "  -o, --output FILE    a file\n"
    "      --quick          is quick\n"
    "\n"
    "Other things\n"
    "      --a-very-long-name-of-an-option N\n"
    "                       counts (default 3)\n"
    "      --format md|csv  the form of what is printed, of which there are two, so\n"
    "                       a text of this length takes more than one line, and more\n"
    "                       than two of them as well (default md)\n"
    "\n"
    "Help\n"
    "  -h, --help           prints this help\n";

static void help_has_each_option(void **state)
{
    (void)state;
    printed_begin();
    rg_command_print_help(&sample);
    assert_string_equal(printed_end(), help);
    printed_begin();
    assert_int_equal(rg_command_run(&sample, 2, (const char *[]){"sample", "-h"}), RG_EXIT_PASS);
    assert_string_equal(printed_end(), help);
}

// An option of up to 28 columns sets the column of all; a longer one stands on a line of its own.
static void long_options_stand_alone(void **state)
{
    (void)state;
    static const struct rg_option long_options[] = {
        {RG_OPTION_FLAG, "a-name-of-20-letters", .about = "sets it"},
        {RG_OPTION_FLAG, "the-name-of-21-letter", .offset = 1, .about = "stands alone"},
        {RG_OPTION_END},
    };
    struct rg_command command = sample;
    command.options = long_options;
    printed_begin();
    rg_command_print_help(&command);
    assert_string_equal(printed_end(), "raingauge sample THING [--quick]\n"
                                       "does something\n"
                                       "      --a-name-of-20-letters  sets it\n"
                                       "      --the-name-of-21-letter\n"
                                       "                              stands alone\n"
                                       "\nHelp\n"
                                       "  -h, --help                  prints this help\n");
}

// The rows as they are expanded: offsets and defaults of an include are its rows' own.
static void includes_are_expanded(void **state)
{
    (void)state;
    struct rg_option rows[RG_MAX_OPTION_ROWS];
    assert_int_equal(rg_option_rows(options, rows), 9);
    assert_string_equal(rows[5].name, "a-very-long-name-of-an-option");
    assert_string_equal(rows[5].initial, "3");
    assert_int_equal(rows[5].offset, offsetof(struct values, count));
    assert_int_equal(rows[6].offset, offsetof(struct values, format));
    assert_string_equal(rows[7].about, "Help");
    assert_int_equal(rows[8].kind, RG_OPTION_HELP);
}

static void each_command_is_found_by_its_name(void **state)
{
    (void)state;
    int count = 0;
    for (; rg_commands[count]; count++) {
        assert_ptr_equal(rg_command_find(rg_commands[count]->name), rg_commands[count]);
        for (int i = 0; i < count; i++)
            assert_string_not_equal(rg_commands[i]->name, rg_commands[count]->name);
    }
    assert_at_least(count, 18);
    assert_null(rg_command_find("doc"));
    assert_null(rg_command_find("doctors"));
    assert_null(rg_command_find(""));
}

// --- subjects ---

static int listen(void **state)
{
    (void)state;
    rg_log_listen(log_last, NULL);
    return logged_lines = *logged = 0;
}

static int listen_no_more(void **state)
{
    (void)state;
    rg_log_listen(NULL, NULL);
    return 0;
}

// Each technique is found, and is the nearest to its name with a letter too many.
static void techniques_are_found_by_their_names(void **state)
{
    (void)state;
    for (int i = 0; rg_techniques[i]; i++) {
        char name[64], due[256];
        assert_ptr_equal(rg_subject_technique(rg_techniques[i]->name), rg_techniques[i]);
        snprintf(name, sizeof(name), "%sq", rg_techniques[i]->name);
        assert_null(rg_subject_technique(name));
        snprintf(due, sizeof(due),
                 "technique '%s': unknown; the nearest is '%s', and `raingauge "
                 "list techniques` prints them",
                 name, rg_techniques[i]->name);
        assert_string_equal(logged, due);
    }
}

// The text of a setting.
static const char *value_of(const struct rg_technique *technique, const void *settings,
                            const char *name)
{
    static char text[RG_PATH_SIZE];
    *text = 0;
    for (int i = 0; i < technique->params->count; i++)
        if (!strcmp(technique->params->rows[i].name, name))
            rg_params_text(&technique->params->rows[i], settings, text, sizeof(text));
    return text;
}

// All that --set names is set, the later over the earlier.
static void settings_are_those_of_set(void **state)
{
    (void)state;
    const struct rg_words words = {2, {"flow", "more"}}, none = {0};
    struct rg_words sets = {3, {"drops=7", "view=pane", "drops=9"}};
    void *settings = NULL;
    const struct rg_technique *technique = rg_subject_find(&words, &sets, &settings);
    assert_ptr_equal(technique, rg_technique_find("flow"));
    assert_string_equal(value_of(technique, settings, "drops"), "9");
    assert_string_equal(value_of(technique, settings, "view"), "pane");
    free(settings);
    assert_int_equal(logged_lines, 0);
    sets.items[2] = "drops=many";
    assert_null(rg_subject_find(&words, &sets, &settings));
    assert_null(settings);
    assert_non_null(strstr(logged, "parameter 'drops': "));
    assert_null(rg_subject_find(&none, &none, &settings));
    assert_string_equal(logged, "no technique named; `raingauge list techniques` prints them");
    assert_int_equal(logged_lines, 2);
}

// Tables by name, a length or a budget: one of them is enough.
static void lengths_are_asked_for(void **state)
{
    (void)state;
    static const struct {
        int tables;
        bool quick, full;
        const char *budget;
        bool is_asked;
    } rows[] = {{0, false, false, NULL, false}, {1, false, false, NULL, true},
                {0, true, false, NULL, true},   {0, false, true, NULL, true},
                {0, false, false, "4m", true},  {2, true, false, "4m", true}};
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        const struct rg_words tables = {rows[i].tables, {"a", "b"}};
        const struct rg_length length = {rows[i].quick, rows[i].full};
        assert_int_equal(rg_length_is_asked("claims", &tables, &length, rows[i].budget),
                         rows[i].is_asked);
    }
    assert_string_equal(logged, "claims: all tables take hours; name some, as `raingauge list "
                                "tables` prints them, or add --budget 4m, --quick or --full");
    assert_int_equal(logged_lines, 1);
}

static void words_are_found(void **state)
{
    (void)state;
    const struct rg_words none = {0}, two = {2, {"a", "bc"}};
    assert_true(rg_words_name(&none, "a"));
    assert_true(rg_words_name(&two, "a") && rg_words_name(&two, "bc"));
    assert_false(rg_words_name(&two, "b") || rg_words_name(&two, ""));
}

#define LISTENING(test) cmocka_unit_test_setup_teardown(test, listen, listen_no_more)

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(help_has_each_option),
        cmocka_unit_test(long_options_stand_alone),
        cmocka_unit_test(includes_are_expanded),
        cmocka_unit_test(each_command_is_found_by_its_name),
        LISTENING(techniques_are_found_by_their_names),
        LISTENING(settings_are_those_of_set),
        LISTENING(lengths_are_asked_for),
        cmocka_unit_test(words_are_found),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
