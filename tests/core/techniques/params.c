// Parameters by name, in a made-up table: accepted and refused values, the reasons, and how a value
// prints. Also the ranges of all techniques' parameters.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "core/techniques/params.h"
#include "core/techniques/technique.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/logged.h"

struct settings {
    int drops, look, size;
    double slope;
    char model[RG_PATH_SIZE];
    int behind; // nothing may write it
};

#define AT(field) offsetof(struct settings, field)

static const struct rg_param rows[] = {
    {"drops", RG_PARAM_INT, AT(drops), 40, 1, 100, "1", "how many", NULL},
    {"slope", RG_PARAM_FLOAT, AT(slope), 0.625, -2, 2, "deg", "how steep", NULL},
    {"size", RG_PARAM_CHOICE, AT(size), 1, 0, 0, "1", "how large", "small smaller large"},
    {"look", RG_PARAM_CHOICE, AT(look), 0, 0, 0, "1", "stands for others", "plain steep"},
    {"model", RG_PARAM_FILE, AT(model), 0, 0, 0, "1", "what stands there", "bunny"},
};
static const char *const presets[] = {"slope=0.5 drops=7", "slope=1.5"};
static const struct rg_param_table table = {"fake", rows,   5, sizeof(struct settings),
                                            "look", presets};

static int setup(void **state)
{
    (void)state;
    rg_log_listen(log_last, NULL);
    return 0;
}

static int teardown(void **state)
{
    (void)state;
    rg_log_listen(NULL, NULL);
    return 0;
}

static struct settings defaults(void)
{
    struct settings settings;
    memset(&settings, 0x55, sizeof(settings));
    rg_params_reset(&table, &settings);
    return settings;
}

static void assert_takes(struct settings *settings, const char *assignment)
{
    if (!rg_params_set(&table, settings, assignment))
        fail_msg("%s: %s", assignment, rg_last_error());
}

// The assignment is refused for a reason that contains `words`, and changes nothing.
static void assert_refuses(const char *assignment, const char *words)
{
    struct settings settings = defaults(), before = settings;
    if (rg_params_set(&table, &settings, assignment))
        fail_msg("%s is taken", assignment);
    if (!strstr(rg_last_error(), words))
        fail_msg("%s: '%s' does not say '%s'", assignment, rg_last_error(), words);
    assert_memory_equal(&settings, &before, sizeof(settings));
}

static void test_defaults(void **state)
{
    (void)state;
    const struct settings settings = defaults();
    assert_int_equal(settings.drops, 40);
    assert_equals(settings.slope, 0.625);
    assert_int_equal(settings.size, 1);
    assert_string_equal(settings.model, "bunny");
    assert_int_equal(settings.behind, 0);
}

static void test_numbers(void **state)
{
    (void)state;
    struct settings settings = defaults();
    assert_takes(&settings, "drops=1");
    assert_int_equal(settings.drops, 1);
    assert_takes(&settings, "drops=1e2");
    assert_int_equal(settings.drops, 100);
    assert_takes(&settings, "slope=-2");
    assert_equals(settings.slope, -2);
    assert_takes(&settings, "slope=0.1");
    assert_equals(settings.slope, 0.1);
    assert_refuses("drops=2.5", "is no whole number");
    assert_refuses("drops=", "is no whole number");
    assert_refuses("drops=3 4", "is no whole number");
    assert_refuses("slope=1x", "is no number");
    assert_refuses("slope=nan", "is no number");
    assert_refuses("slope=inf", "is no number");
    assert_refuses("drops=0", "out of range; 1 to 100");
    assert_refuses("drops=101", "out of range; 1 to 100");
    assert_refuses("slope=-2.01", "out of range; -2 to 2 deg");
    assert_refuses("slope=2.01", "out of range; -2 to 2 deg");
}

// Assigns a number, printed with so many digits, to a parameter.
static bool takes_number(const struct rg_param_table *params, void *settings, const char *name,
                         double value, int digits)
{
    char assignment[128];
    snprintf(assignment, sizeof(assignment), "%s=%.*g", name, digits, value);
    return rg_params_set(params, settings, assignment);
}

static void assert_range_holds(const struct rg_param_table *params, const struct rg_param *param,
                               void *settings)
{
    enum { PRINTED = 10, EXACT = 17 }; // digits
    const bool is_int = param->kind == RG_PARAM_INT;
    const double below = is_int ? param->min - 1 : nextafter(param->min, -INFINITY);
    const double above = is_int ? param->max + 1 : nextafter(param->max, INFINITY);
    const bool ends = takes_number(params, settings, param->name, param->min, PRINTED) &&
                      takes_number(params, settings, param->name, param->max, PRINTED);
    if (!ends)
        fail_msg("%s: %s", params->technique, rg_last_error());
    if (takes_number(params, settings, param->name, below, EXACT) ||
        takes_number(params, settings, param->name, above, EXACT))
        fail_msg("%s: %s is taken beyond its range, %.10g to %.10g", params->technique, param->name,
                 param->min, param->max);
}

// Every number of every technique accepts both ends of its range as printed, and nothing beyond.
static void test_ranges(void **state)
{
    (void)state;
    for (int t = 0; rg_techniques[t]; t++) {
        const struct rg_param_table *params = rg_techniques[t]->params;
        void *settings = calloc(1, params->settings_size);
        assert_non_null(settings);
        rg_params_reset(params, settings);
        for (int i = 0; i < params->count; i++)
            if (params->rows[i].kind == RG_PARAM_INT || params->rows[i].kind == RG_PARAM_FLOAT)
                assert_range_holds(params, &params->rows[i], settings);
        free(settings);
    }
}

static void test_choices(void **state)
{
    (void)state;
    static const char *const names[] = {"small", "smaller", "large"};
    struct settings settings = defaults();
    for (int i = 0; i < 3; i++) {
        char assignment[32] = "size=";
        assert_takes(&settings, strcat(assignment, names[i]));
        assert_int_equal(settings.size, i);
    }
    assert_refuses("size=larg", "is none of: small smaller large");
    assert_refuses("size=largest", "is none of");
    assert_refuses("size=", "is none of");
    assert_refuses("size=small smaller", "is none of");
}

// An assignment after a preset overrides it.
static void test_presets(void **state)
{
    (void)state;
    struct settings settings = defaults();
    assert_takes(&settings, "look=plain");
    assert_equals(settings.slope, 0.5);
    assert_equals(settings.drops, 7);
    assert_equals(settings.look, 0);
    assert_true(rg_params_set_all(&table, &settings, "look=steep drops=9"));
    assert_equals(settings.slope, 1.5);
    assert_equals(settings.drops, 9);
    assert_equals(settings.look, 1);
    assert_true(rg_params_set_all(&table, &settings, " drops=3  look=plain "));
    assert_int_equal(settings.drops, 7);
    assert_false(rg_params_set_all(&table, &settings, "drops=4 nonsense=1 drops=5"));
    assert_int_equal(settings.drops, 4);
}

static void test_paths(void **state)
{
    (void)state;
    struct settings settings = defaults();
    char assignment[RG_PATH_SIZE + 16] = "model=";
    memset(assignment + 6, 'a', RG_PATH_SIZE - 1);
    assert_takes(&settings, assignment);
    assert_memory_equal(settings.model, assignment + 6, RG_PATH_SIZE);
    assert_int_equal(settings.behind, 0);
    assignment[6 + RG_PATH_SIZE - 1] = 'a';
    assert_refuses(assignment, "at most 1023");
    assert_takes(&settings, "model=");
    assert_string_equal(settings.model, "");
    assert_takes(&settings, "model=a=b");
    assert_string_equal(settings.model, "a=b");
}

static void test_names(void **state)
{
    (void)state;
    assert_refuses("slop=1", "the nearest is 'slope'");
    assert_refuses("modle=1", "the nearest is 'model'");
    assert_refuses("dorps=1", "the nearest is 'drops'");
    assert_refuses("drops", "KEY=VALUE");
    assert_refuses("=1", "KEY=VALUE");
}

// A printed value can be assigned again.
static void test_texts(void **state)
{
    (void)state;
    static const char *const texts[] = {"40", "1.23456789", "smaller", "plain", "a/b.ply"};
    struct settings settings = defaults(), again = defaults();
    settings.slope = 1.23456789;
    strcpy(settings.model, "a/b.ply");
    for (int i = 0; i < table.count; i++) {
        char text[RG_PATH_SIZE], assignment[RG_PATH_SIZE + 64];
        rg_params_text(&rows[i], &settings, text, sizeof(text));
        assert_string_equal(text, texts[i]);
        if (!strcmp(rows[i].name, "look"))
            continue;
        strcpy(assignment, rows[i].name);
        assert_takes(&again, strcat(strcat(assignment, "="), text));
    }
    assert_memory_equal(&again, &settings, sizeof(again));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_defaults), cmocka_unit_test(test_numbers),
        cmocka_unit_test(test_ranges),   cmocka_unit_test(test_choices),
        cmocka_unit_test(test_presets),  cmocka_unit_test(test_paths),
        cmocka_unit_test(test_names),    cmocka_unit_test(test_texts),
    };
    return cmocka_run_group_tests(tests, setup, teardown);
}
