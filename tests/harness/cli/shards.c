// Which shard a command does, by --shard and by the variables of those that start jobs, and how it
// ends if records are missing.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/commands/cli/shard.h"
#include "harness/commands/tables/plan_shard.h"
#include "harness/console/exit.h"
#include "tests/tools/expect.h"

static char logged[1024];
static int errors, warnings;

static void hear(enum rg_log_level level, const char *line, void *user)
{
    (void)user;
    errors += level == RG_LOG_ERROR;
    warnings += level == RG_LOG_WARNING;
    snprintf(logged, sizeof(logged), "%s", line);
}

static const char *const names[] = {
    "SLURM_ARRAY_TASK_ID", "SLURM_ARRAY_TASK_MIN", "SLURM_ARRAY_TASK_MAX", "SLURM_ARRAY_TASK_COUNT",
    "CI_NODE_INDEX",       "CI_NODE_TOTAL",        "GTEST_SHARD_INDEX",    "GTEST_TOTAL_SHARDS"};
enum { NAMES = sizeof(names) / sizeof(names[0]) };

static int begin(void **state)
{
    (void)state;
    for (int i = 0; i < NAMES; i++)
        unsetenv(names[i]);
    rg_log_listen(hear, NULL);
    errors = warnings = *logged = 0;
    return 0;
}

static int end(void **state)
{
    (void)state;
    rg_log_listen(NULL, NULL);
    return 0;
}

// Variables are set by their place above; NULL: not set.
struct asked {
    const char *shard, *values[NAMES];
    int count;      // of the whole's shards; 0: not settled
    int number, of; // the shard; of 0: it is refused
    const char *says;
};

static void expect(const struct asked *row)
{
    struct rg_shard shard;
    for (int i = 0; i < NAMES; i++) {
        if (row->values[i])
            setenv(names[i], row->values[i], 1);
        else
            unsetenv(names[i]);
    }
    errors = *logged = 0;
    const bool ok = rg_shard_read(row->shard, row->count, &shard);
    if (ok != (row->of > 0) || (ok && (shard.number != row->number || shard.count != row->of)))
        fail_msg("%s, '%s': %d/%d, '%s'", row->shard, row->says ? row->says : "", shard.number,
                 shard.count, logged);
    if (errors != !ok || (row->says && !strstr(logged, row->says)))
        fail_msg("%s: '%s' instead of '%s'", row->shard, logged, row->says);
}

static void a_shard_is_named(void **state)
{
    (void)state;
    static const struct asked rows[] = {
        {"1/4", {0}, 0, 1, 4, NULL},
        {"4/4", {0}, 4, 4, 4, NULL},
        {"1/1", {0}, 0, 1, 1, NULL},
        {"5/4", {0}, 0, 0, 0, "--shard 5/4: shard 5 is none of 1 to 4"},
        {"0/4", {0}, 0, 0, 0, "--shard 0/4: shard 0 is none of 1 to 4"},
        {"1/0", {0}, 0, 0, 0, "shard 1 is none of 1 to 0"},
        {"2/3", {0}, 4, 0, 0, "--shard 2/3: there are 3, and the plan is cut into 4; use as many"},
        {"2/3/4", {0}, 0, 0, 0, "--shard 2/3/4: write it as 1/4, the first of four, or as auto"},
        {"2", {0}, 0, 0, 0, "write it as 1/4"},
        {"2/", {0}, 0, 0, 0, "write it as 1/4"},
        {"/2", {0}, 0, 0, 0, "write it as 1/4"},
        {"autos", {0}, 0, 0, 0, "write it as 1/4"},
    };
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++)
        expect(&rows[i]);
}

// Slurm's array counts from any number; CI's index from 1, and googletest's from 0. The first of
// them that is set counts.
static void a_shard_is_found_by_variables(void **state)
{
    (void)state;
    static const struct asked rows[] = {
        {"auto", {"5", "3", "6", "4"}, 0, 3, 4, NULL},
        {"auto", {"3", "3", "6", "4"}, 0, 1, 4, NULL},
        {"auto", {"0", "0", "3", "4"}, 0, 1, 4, NULL},
        {"auto", {"6", "3", "6", "4"}, 0, 4, 4, NULL},
        {"auto",
         {"5", "3", "7", "4"},
         0,
         0,
         0,
         "--shard auto: Slurm's array has gaps, so that it does not say how many shards there are; "
         "write --shard 1/4, or make a plan with `raingauge plan --shards N`"},
        {"auto", {"7", "5", "9", "2"}, 8, 7, 8, NULL}, // some shards of a settled number
        {"auto", {"9", "5", "9", "2"}, 8, 0, 0, "shard 9 is none of 1 to 8"},
        {"auto",
         {"5", "3", "6", NULL},
         0,
         0,
         0,
         "SLURM_ARRAY_TASK_COUNT '' is no whole number from 0 on; write --shard 1/4"},
        {"auto", {"5", "x", "6", "4"}, 0, 0, 0, "SLURM_ARRAY_TASK_MIN 'x' is no whole number"},
        {"auto", {"5", "3", "-6", "4"}, 0, 0, 0, "SLURM_ARRAY_TASK_MAX '-6' is no whole number"},
        {"auto", {"5k", "3", "6", "4"}, 0, 0, 0, "SLURM_ARRAY_TASK_ID '5k' is no whole number"},
        {"auto", {"", "3", "6", "4"}, 0, 0, 0, "SLURM_ARRAY_TASK_ID '' is no whole number"},
        {"auto", {"99999999999", "3", "6", "4"}, 0, 0, 0, "is no whole number"},
        {"auto", {NULL, NULL, NULL, NULL, "2", "5"}, 0, 2, 5, NULL},
        {"auto", {NULL, NULL, NULL, NULL, "2", NULL}, 0, 0, 0, "CI_NODE_TOTAL '' is no"},
        {"auto", {NULL, NULL, NULL, NULL, NULL, "5"}, 0, 0, 0, "CI_NODE_INDEX '' is no"},
        {"auto", {NULL, NULL, NULL, NULL, NULL, NULL, "2", "5"}, 0, 3, 5, NULL},
        {"auto", {NULL, NULL, NULL, NULL, NULL, NULL, "2", "5"}, 5, 3, 5, NULL},
        {"auto", {NULL, NULL, NULL, NULL, NULL, NULL, "x", "5"}, 0, 0, 0, "GTEST_"},
        {"auto", {NULL, NULL, NULL, NULL, NULL, NULL, "5", "5"}, 0, 0, 0, "GTEST_"},
        {"auto", {"1", "1", "2", "2", "2", "5", "2", "6"}, 0, 1, 2, NULL},
        {"auto", {NULL, NULL, NULL, NULL, "2", "5", "2", "6"}, 0, 2, 5, NULL},
        {"auto",
         {0},
         0,
         0,
         0,
         "--shard auto: neither SLURM_ARRAY_TASK_ID, CI_NODE_INDEX nor GTEST_SHARD_INDEX is set"},
    };
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++)
        expect(&rows[i]);
}

// A plan that is cut needs to know which; without --shard, one that is not is measured whole.
static void a_plans_shard_is_found(void **state)
{
    (void)state;
    struct rg_shard shard = {7, 7};
    struct rg_farm_plan plan = {.shards = 0};
    assert_true(rg_shard_find(&plan, NULL, &shard));
    assert_true(shard.number == 1 && shard.count == 1);
    assert_true(rg_shard_find(&plan, "2/3", &shard));
    assert_true(shard.number == 2 && shard.count == 3);
    plan.shards = 1;
    assert_true(rg_shard_find(&plan, NULL, &shard));
    plan.shards = 4;
    assert_false(rg_shard_find(&plan, "2/3", &shard));
    assert_true(rg_shard_find(&plan, "2/4", &shard));
    assert_false(rg_shard_find(&plan, NULL, &shard));
    assert_string_equal(logged, "--plan: the plan is cut into 4 shards; name one, as --shard 1/4, "
                                "or --shard auto");
    assert_int_equal(errors, 2);
}

// --- records that are missing ---

static int exit_of(int count, int missing, bool partial)
{
    json_t *documents[4];
    struct rg_parts parts = {.count = count, .documents = documents, .missing = missing};
    for (int i = 0; i < count; i++)
        documents[i] = i < missing ? NULL : json_object();
    errors = warnings = *logged = 0;
    const int exit = rg_shards_exit(&parts, "gate", "the/path", partial);
    for (int i = 0; i < count; i++)
        json_decref(documents[i]);
    return exit;
}

static void shards_that_are_missing_are_named(void **state)
{
    (void)state;
    assert_int_equal(exit_of(4, 0, false), RG_EXIT_PASS);
    assert_int_equal(exit_of(4, 0, true), RG_EXIT_PASS);
    assert_int_equal(errors + warnings, 0);
    assert_int_equal(exit_of(4, 2, false), RG_EXIT_INCONCLUSIVE);
    assert_string_equal(logged, "the/path: of 4 shards are missing: 1-2; nothing is reported, so "
                                "run these, or add --partial");
    assert_true(errors == 1 && !warnings);
    assert_int_equal(exit_of(4, 1, true), RG_EXIT_PASS);
    assert_string_equal(logged, "the/path: of 4 shards are missing: 1");
    assert_true(!errors && warnings == 1);
    for (int partial = 0; partial < 2; partial++) {
        assert_int_equal(exit_of(0, 0, partial), RG_EXIT_NOTHING);
        assert_string_equal(logged, "the/path: holds no record of a shard; name the folder of "
                                    "`raingauge gate --shard -o`");
    }
}

#define LISTENING(test) cmocka_unit_test_setup_teardown(test, begin, end)

int main(void)
{
    const struct CMUnitTest tests[] = {
        LISTENING(a_shard_is_named),
        LISTENING(a_shard_is_found_by_variables),
        LISTENING(a_plans_shard_is_found),
        LISTENING(shards_that_are_missing_are_named),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
