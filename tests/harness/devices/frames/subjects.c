// Subjects go from one process to another, which may be another build. Every parameter comes out as
// it was put in. A build may ignore a parameter that it does not know only at its usual value.
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/base/log.h"
#include "harness/devices/frames/messages.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/folder.h"
#include "tests/tools/process/logged.h"

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
    assert_false(take_one("opacity", false, true, -0.25, NULL, &taken));     // likewise
    assert_false(take_one("opacity", false, true, 0.0 / 0.0, NULL, &taken)); // no number
    assert_false(take_one("opacity", false, false, 0, "0.25", &taken));      // in another kind
    assert_false(take_one("quads", false, true, 100, NULL, &taken));
    assert_false(take_one("scene", false, false, 0, "tomorrow", &taken));
}

// What a build puts of a parameter: its name, whether it is as usual, whether it is a number with a
// fraction, and its value.
static void each_parameter_says_whether_it_is_as_usual(void **state)
{
    (void)state;
    const struct rg_technique *technique = rg_technique_find("raster");
    const struct rg_param_table *params = technique->params;
    void *usual = rg_settings_create(technique);
    int tried = 0;
    for (int changed = -1; changed < params->count; changed++) {
        void *settings = rg_settings_create(technique);
        struct rg_message message = {0};
        if (changed >= 0)
            change(&params->rows[changed], settings);
        const bool is_usual = !memcmp(settings, usual, params->settings_size);
        rg_put_subject(&message, &(struct rg_subject){technique, settings, 48, 32});
        assert_string_equal(rg_take_text(&message), "raster");
        assert_int_equal(rg_take_int(&message), params->count);
        for (int i = 0; i < params->count; i++) {
            double number;
            assert_string_equal(rg_take_text(&message), params->rows[i].name);
            if (rg_take_int(&message) != (i != changed || is_usual))
                fail_msg("%s: %d is changed", params->rows[i].name, changed);
            const bool is_number = rg_take_int(&message);
            assert_int_equal(is_number, params->rows[i].kind == RG_PARAM_FLOAT);
            if (is_number)
                RG_TAKE(&message, number);
            else
                rg_take_text(&message);
        }
        assert_int_equal(rg_take_int(&message), 48);
        assert_int_equal(rg_take_int(&message), 32);
        assert_false(message.failed);
        rg_message_free(&message);
        free(settings);
        tried += !is_usual;
    }
    assert_between(tried, params->count / 2, params->count);
    free(usual);
}

// --- files of the user's own ---

struct filed {
    char model[RG_PATH_SIZE];
    double number;
    char map[RG_PATH_SIZE];
};

static const struct rg_param filed_rows[] = {
    {"model", RG_PARAM_FILE, offsetof(struct filed, model), 0, 0, 0, "", "a model", ""},
    {"number", RG_PARAM_FLOAT, offsetof(struct filed, number), 0, 0, 9, "1", "a number", NULL},
    {"map", RG_PARAM_FILE, offsetof(struct filed, map), 0, 0, 0, "", "a map", ""}};
static const struct rg_param_table filed_params = {
    .technique = "filed", .rows = filed_rows, .count = 3, .settings_size = sizeof(struct filed)};
static const struct rg_technique filed = {.name = "filed", .params = &filed_params};

// A folder with files, one of them named as a number, and a folder "b.d", in which this process
// works.
static int enter_folder(void **state)
{
    static const char *const names[] = {"bunny", "a.obj", "c.obj", "0.5"};
    if (make_folder(state) || chdir(folder) || mkdir("b.d", 0700))
        return -1;
    for (int i = 0; i < 4; i++) {
        FILE *file = fopen(names[i], "w");
        if (!file || fclose(file))
            return -1;
    }
    return begin(state);
}

static int leave_folder(void **state)
{
    return chdir("/") || remove_whole_folder(state);
}

static void a_file_is_the_user_s_if_it_is_there(void **state)
{
    (void)state;
    static const struct {
        const char *value;
        bool is_own;
    } rows[] = {{"a.obj", true}, {"./bunny", true}, {"bunny", false}, {"none.obj", false},
                {"b.d", false},  {"./b.d", false},  {"", false}};
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++)
        if (rg_file_is_own(rows[i].value) != rows[i].is_own)
            fail_msg("'%s'", rows[i].value);
}

static void own_files_are_found_in_the_table_s_order(void **state)
{
    (void)state;
    struct filed settings = {.model = "a.obj", .number = 0.5, .map = "./bunny"};
    const struct rg_subject subject = {&filed, &settings, 8, 8};
    char value[RG_PATH_SIZE];
    int at = 0;
    assert_ptr_equal(rg_file_own_next(&subject, &at, value), &filed_rows[0]);
    assert_string_equal(value, "a.obj");
    assert_ptr_equal(rg_file_own_next(&subject, &at, value), &filed_rows[2]);
    assert_string_equal(value, "./bunny");
    assert_null(rg_file_own_next(&subject, &at, value));
    assert_null(rg_file_own_next(&subject, &at, value));
    strcpy(settings.model, "bunny"); // a model of a package
    at = 0;
    assert_ptr_equal(rg_file_own_next(&subject, &at, value), &filed_rows[2]);
}

static void no_own_file_is_written_over(void **state)
{
    (void)state;
    const struct filed settings = {.model = "a.obj", .map = "./c.obj"};
    const struct rg_subject subject = {&filed, &settings, 8, 8};
    assert_true(rg_files_spared_by(&subject, "out.png"));
    assert_true(rg_files_spared_by(&subject, "bunny"));
    assert_string_equal(logged, "");
    assert_false(rg_files_spared_by(&subject, "b.d/../a.obj"));
    assert_non_null(strstr(logged, "a.obj"));
    assert_false(rg_files_spared_by(&subject, "c.obj"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(every_parameter_comes_out_as_it_was_put, begin),
        cmocka_unit_test_setup(what_a_build_does_not_know_is_refused_unless_it_is_as_usual, begin),
        cmocka_unit_test_setup(values_that_a_build_does_not_take_are_refused, begin),
        cmocka_unit_test_setup(each_parameter_says_whether_it_is_as_usual, begin),
        cmocka_unit_test_setup_teardown(a_file_is_the_user_s_if_it_is_there, enter_folder,
                                        leave_folder),
        cmocka_unit_test_setup_teardown(own_files_are_found_in_the_table_s_order, enter_folder,
                                        leave_folder),
        cmocka_unit_test_setup_teardown(no_own_file_is_written_over, enter_folder, leave_folder),
    };
    rg_log_listen(log_all, NULL);
    return cmocka_run_group_tests_name("subjects between processes", tests, NULL, NULL);
}
