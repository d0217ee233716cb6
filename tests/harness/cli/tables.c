// The tables of all commands are sound, and an option means the same in each that has it.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "harness/commands/commands.h"
#include "tests/tools/expect.h"

static const size_t value_sizes[] = {
    [RG_OPTION_FLAG] = sizeof(bool),           [RG_OPTION_INT] = sizeof(int),
    [RG_OPTION_FACTOR] = sizeof(double),       [RG_OPTION_CHOICE] = sizeof(int),
    [RG_OPTION_SIZE] = sizeof(struct rg_size), [RG_OPTION_RANGE] = sizeof(struct rg_range),
    [RG_OPTION_TEXT] = sizeof(char *),         [RG_OPTION_TEXTS] = sizeof(struct rg_words),
    [RG_OPTION_BYTES] = sizeof(int64_t),
};

// The row of this name, or NULL.
static const struct rg_option *named(const struct rg_option *rows, int count, const char *name)
{
    for (int i = 0; i < count; i++)
        if (rows[i].name && !strcmp(rows[i].name, name))
            return &rows[i];
    return NULL;
}

// A row excludes only other rows of the same command.
static void check_excluded(const struct rg_option *rows, int count, const struct rg_option *row)
{
    char words[256], *rest = NULL;
    snprintf(words, sizeof(words), "%s", row->excludes ? row->excludes : "");
    for (char *word = strtok_r(words, " ", &rest); word; word = strtok_r(NULL, " ", &rest)) {
        assert_non_null(named(rows, count, word));
        assert_string_not_equal(word, row->name);
    }
}

static void check_row(const struct rg_command *command, const struct rg_option *rows, int count,
                      const struct rg_option *row)
{
    char text[RG_ARGUMENT_SIZE];
    const char *argument = rg_option_argument(row, text);
    assert_non_null(row->about);
    assert_null(strchr(row->about, '\n'));
    assert_below(strlen(argument), RG_ARGUMENT_SIZE - 1);
    if (row->kind == RG_OPTION_OPERAND) {
        assert_at_least(row->first, 1);
        assert_true((!row->last || row->last >= row->first));
        assert_true(*argument);
        return;
    }
    if (!row->name)
        return;
    assert_ptr_equal(named(rows, count, row->name), row);
    assert_int_equal(*argument == 0, row->kind == RG_OPTION_FLAG || row->kind == RG_OPTION_HELP);
    assert_int_equal(row->choices != NULL, row->kind == RG_OPTION_CHOICE);
    check_excluded(rows, count, row);
    if (row->kind != RG_OPTION_HELP)
        assert_at_most(row->offset + value_sizes[row->kind], command->options_size);
}

static bool overlap(const struct rg_option *a, const struct rg_option *b)
{
    if (!a->name || !b->name || a->kind == RG_OPTION_HELP || b->kind == RG_OPTION_HELP)
        return false;
    return a->offset < b->offset + value_sizes[b->kind] &&
           b->offset < a->offset + value_sizes[a->kind];
}

static void rows_are_sound(void **state)
{
    (void)state;
    for (int c = 0; rg_commands[c]; c++) {
        struct rg_option rows[RG_MAX_OPTION_ROWS];
        const int count = rg_option_rows(rg_commands[c]->options, rows);
        assert_int_equal(rows[0].kind, RG_OPTION_GROUP);
        for (int i = 0; i < count; i++) {
            check_row(rg_commands[c], rows, count, &rows[i]);
            for (int j = 0; j < i; j++) {
                assert_false(overlap(&rows[i], &rows[j]));
                assert_false(rows[i].letter && rows[i].letter == rows[j].letter);
            }
        }
    }
}

static void defaults_are_what_a_user_could_write(void **state)
{
    (void)state;
    int defaults = 0;
    for (int c = 0; rg_commands[c]; c++) {
        struct rg_option rows[RG_MAX_OPTION_ROWS];
        const int count = rg_option_rows(rg_commands[c]->options, rows);
        char *values = calloc(1, rg_commands[c]->options_size);
        for (int i = 0; i < count; i++) {
            if (!rows[i].initial)
                continue;
            assert_true(rg_option_set(&rows[i], values, rows[i].initial, rg_commands[c]->name));
            rg_option_free(&rows[i], values);
            defaults++;
        }
        free(values);
    }
    assert_at_least(defaults, 10);
}

// Counts the rows of earlier commands' tables that share this one's name. Excluded options may
// differ, since they depend on which others a command has.
static int compare_with_others(int command, const struct rg_option *row)
{
    struct rg_option rows[RG_MAX_OPTION_ROWS];
    int shared = 0;
    for (int c = 0; c < command; c++) {
        const int count = rg_option_rows(rg_commands[c]->options, rows);
        const struct rg_option *other = named(rows, count, row->name);
        if (!other)
            continue;
        assert_int_equal(row->kind, other->kind);
        assert_int_equal(row->letter, other->letter);
        shared++;
    }
    return shared;
}

static void an_option_means_the_same_in_every_command(void **state)
{
    (void)state;
    int shared = 0;
    for (int c = 0; rg_commands[c]; c++) {
        struct rg_option rows[RG_MAX_OPTION_ROWS];
        const int count = rg_option_rows(rg_commands[c]->options, rows);
        for (int i = 0; i < count; i++)
            shared += rows[i].name ? compare_with_others(c, &rows[i]) : 0;
    }
    assert_at_least(shared, 30);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_are_sound),
        cmocka_unit_test(defaults_are_what_a_user_could_write),
        cmocka_unit_test(an_option_means_the_same_in_every_command),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
