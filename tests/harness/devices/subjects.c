// Subjects go from one process to another, which may be another build. Every parameter comes out as
// it was put in. A build may ignore a parameter that it does not know only at its usual value.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/devices/frames/messages.h"

static char logged[2048];

static void keep(enum rg_log_level level, const char *line, void *user)
{
    (void)level;
    (void)user;
    const size_t used = strlen(logged);
    snprintf(logged + used, sizeof(logged) - used, "%s\n", line);
}

static int begin(void **state)
{
    (void)state;
    *logged = 0;
    return 0;
}

// Sets another value than the usual one; a fraction gets more digits than a short text holds.
static void change(const struct rg_param *param, void *settings)
{
    char *at = (char *)settings + param->offset;
    const double middle = param->min + (param->max - param->min) / 3;
    const double number = param->initial == middle ? param->min : middle;
    if (param->kind == RG_PARAM_FLOAT)
        memcpy(at, &number, sizeof(number));
    else if (param->kind == RG_PARAM_FILE)
        snprintf(at, RG_PATH_SIZE, "a \"name\"=%s", param->name);
    else if (param->kind == RG_PARAM_CHOICE)
        *(int *)at = !(int)param->initial;
    else
        *(int *)at = (int)number;
}

static void every_parameter_comes_out_as_it_was_put(void **state)
{
    (void)state;
    for (int t = 0; rg_techniques[t]; t++) {
        const struct rg_technique *technique = rg_techniques[t];
        void *settings = rg_settings_create(technique);
        for (int i = 0; i < technique->params->count; i++)
            change(&technique->params->rows[i], settings);
        struct rg_message message = {0};
        struct rg_subject taken;
        rg_put_subject(&message, &(struct rg_subject){technique, settings, 48, 32});
        assert_true(rg_take_subject(&message, &taken));
        assert_int_equal(message.at, message.size);
        assert_ptr_equal(taken.technique, technique);
        assert_int_equal(taken.width, 48);
        assert_int_equal(taken.height, 32);
        assert_memory_equal(taken.settings, settings, technique->params->settings_size);
        free((void *)(uintptr_t)taken.settings);
        free(settings);
        rg_message_free(&message);
    }
    assert_string_equal(logged, "");
}

// Takes a subject of one parameter, as a build that knows it would put it.
static bool take_one(const char *name, bool is_usual, bool is_number, double number,
                     const char *text, struct rg_subject *taken)
{
    struct rg_message message = {0};
    rg_put_text(&message, "raster");
    rg_put_int(&message, 1);
    rg_put_text(&message, name);
    rg_put_int(&message, is_usual);
    rg_put_int(&message, is_number);
    if (is_number)
        RG_PUT(&message, number);
    else
        rg_put_text(&message, text);
    rg_put_int(&message, 48);
    rg_put_int(&message, 32);
    const bool ok = rg_take_subject(&message, taken);
    assert_true(!ok || (message.at == message.size && taken->height == 32));
    rg_message_free(&message);
    free((void *)(uintptr_t)taken->settings);
    return ok;
}

static void what_a_build_does_not_know_is_refused_unless_it_is_as_usual(void **state)
{
    (void)state;
    struct rg_subject taken;
    assert_true(take_one("of_tomorrow", true, true, 0.5, NULL, &taken));
    assert_true(take_one("of_tomorrow", true, false, 0, "many", &taken));
    assert_string_equal(logged, "");
    assert_false(take_one("of_tomorrow", false, true, 0.5, NULL, &taken));
    assert_non_null(strstr(logged, "'of_tomorrow': this build's raster has none of that name"));
}

static void values_that_a_build_does_not_take_are_refused(void **state)
{
    (void)state;
    struct rg_subject taken;
    assert_true(take_one("opacity", false, true, 0.25, NULL, &taken));
    assert_true(take_one("scene", false, false, 0, "quads", &taken));
    assert_string_equal(logged, "");
    assert_false(take_one("opacity", false, true, 1.25, NULL, &taken));      // out of range
    assert_false(take_one("opacity", false, true, 0.0 / 0.0, NULL, &taken)); // no number
    assert_false(take_one("opacity", false, false, 0, "0.25", &taken));      // in another kind
    assert_false(take_one("quads", false, true, 100, NULL, &taken));
    assert_false(take_one("scene", false, false, 0, "tomorrow", &taken));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(every_parameter_comes_out_as_it_was_put, begin),
        cmocka_unit_test_setup(what_a_build_does_not_know_is_refused_unless_it_is_as_usual, begin),
        cmocka_unit_test_setup(values_that_a_build_does_not_take_are_refused, begin),
    };
    rg_log_listen(keep, NULL);
    return cmocka_run_group_tests_name("subjects between processes", tests, NULL, NULL);
}
