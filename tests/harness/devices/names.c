// Names of devices with an environment; devices that are asked for by name, and those that are
// missing.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/console/exit.h"
#include "harness/console/threads.h"
#include "harness/devices/devices.h"
#include "harness/devices/names.h"
#include "harness/devices/workers/worker.h"

static char logged[1024];
static int lines;
static const char *self;

static void keep(enum rg_log_level level, const char *line, void *user)
{
    (void)user;
    lines++;
    snprintf(logged, sizeof(logged), "%s%.1000s", level == RG_LOG_WARNING ? "warning: " : "", line);
}

static int begin(void **state)
{
    (void)state;
    *logged = 0;
    lines = 0;
    return 0;
}

// The variables of a name, each with a bar after it.
static const char *variables(const struct rg_device_name *name)
{
    static char text[2 * RG_DEVICE_NAME_SIZE];
    *text = 0;
    for (const char *v = name->environment; *v; v += strlen(v) + 1)
        snprintf(text + strlen(text), sizeof(text) - strlen(text), "%s|", v);
    return text;
}

static void check(const char *names, int count, const char *const expected[][2])
{
    struct rg_device_name name;
    const char *rest = names;
    assert_true(rg_device_names_check("--device", names));
    for (int i = 0; i < count; i++) {
        assert_true(rg_device_name_read(&rest, &name));
        assert_string_equal(name.name, expected[i][0]);
        assert_string_equal(variables(&name), expected[i][1]);
    }
    assert_string_equal(rest, "");
}

static void names_are_read_one_after_the_other(void **state)
{
    (void)state;
    check("cpu", 1, (const char *const[][2]){{"cpu", ""}});
    check("cpu:reference,gl,vulkan:1", 3,
          (const char *const[][2]){{"cpu:reference", ""}, {"gl", ""}, {"vulkan:1", ""}});
    check(
        "vulkan,vulkan@LP_NUM_THREADS=1", 2,
        (const char *const[][2]){{"vulkan", ""}, {"vulkan@LP_NUM_THREADS=1", "LP_NUM_THREADS=1|"}});
    check("gl@AB=A=1;A=2;B=3", 1,
          (const char *const[][2]){{"gl@AB=A=1;A=2;B=3", "AB=A=1|A=2|B=3|"}});
    check("gl@A=1;B_2=x y;C=,vulkan@D=a=b", 2,
          (const char *const[][2]){{"gl@A=1;B_2=x y;C=", "A=1|B_2=x y|C=|"},
                                   {"vulkan@D=a=b", "D=a=b|"}});
}

static void quotes_hold_commas_semicolons_and_quotes(void **state)
{
    (void)state;
    check("gl@A=\"1,2;3\";B=\"say \"\"so\"\"\",cpu", 2,
          (const char *const[][2]){{"gl@A=\"1,2;3\";B=\"say \"\"so\"\"\"", "A=1,2;3|B=say \"so\"|"},
                                   {"cpu", ""}});
    check("gl@A=x\",\"y;B=\"\"", 1, (const char *const[][2]){{"gl@A=x\",\"y;B=\"\"", "A=x,y|B=|"}});
}

static void a_short_name_stands_for_a_device_from_then_on(void **state)
{
    (void)state;
    struct rg_device_name name;
    const char *rest = "new=vulkan@DRIVER=/opt/mesa;A=b=c,old.1-a_b=gl:1,cpu";
    assert_true(rg_device_name_read(&rest, &name));
    assert_string_equal(name.name, "new");
    assert_string_equal(name.full, "vulkan@DRIVER=/opt/mesa;A=b=c");
    assert_string_equal(variables(&name), "DRIVER=/opt/mesa|A=b=c|");
    assert_true(rg_device_name_read(&rest, &name));
    assert_string_equal(name.name, "old.1-a_b");
    assert_string_equal(name.full, "gl:1");
    assert_string_equal(variables(&name), "");
    assert_true(rg_device_name_read(&rest, &name));
    assert_string_equal(name.name, "cpu");
    assert_string_equal(name.full, "cpu");
    rest = "new";
    assert_true(rg_device_name_read(&rest, &name));
    assert_string_equal(name.name, "new");
    assert_string_equal(name.full, "vulkan@DRIVER=/opt/mesa;A=b=c");
    rest = "ne"; // its beginning is another name
    assert_true(rg_device_name_read(&rest, &name));
    assert_string_equal(name.full, "ne");
    rest = "new=vulkan@DRIVER=/opt/mesa;A=b=c"; // the same name for the same device again
    assert_true(rg_device_name_read(&rest, &name));
    char with[RG_DEVICE_NAME_SIZE];
    assert_true(rg_device_name_with("new", "B", "1,2", with));
    assert_string_equal(with, "vulkan@DRIVER=/opt/mesa;A=b=c;B=\"1,2\"");
}

static void what_is_no_such_form_is_refused(void **state)
{
    (void)state;
    char long_name[700];
    memset(long_name, 'x', sizeof(long_name) - 1);
    long_name[sizeof(long_name) - 1] = 0;
    const char *const refused[][2] = {
        {"", "at all"},
        {",cpu", "beside a comma"},
        {"cpu,", "beside a comma"},
        {"cpu,,gl", "beside"},
        {"gl@", "no KEY=value"},
        {"gl@A", "'A' does not set a variable"},
        {"gl@=1", "'=1' does not"},
        {"gl@1A=2", "'1A=2' does not"},
        {"gl@A B=2", "does not set a variable"},
        {"gl@A=1;B", "'B' does not"},
        {"gl@A=\"1", "is not closed"},
        {long_name, "at most 511"},
        {"gl@A=1;;B=2", "does not set a variable"},
        {"cpu@OMP_NUM_THREADS=0", "OMP_NUM_THREADS is no number from 1"},
        {"cpu@A=1;OMP_NUM_THREADS=abc", "OMP_NUM_THREADS is no number from 1"},
        {"cpu@OMP_NUM_THREADS=2x", "OMP_NUM_THREADS is no number from 1"},
        {"cpu@OMP_NUM_THREADS=100000", "OMP_NUM_THREADS is no number from 1"},
        {"gl@A=1;A=2", "device 'gl@A=1;A=2': sets A twice"},
        {"gl@AB=1;A=2;B=3;AB=1", "sets AB twice"},
        {"new=vulkan@DRIVER=/opt/mesa", "'new' is short for 'vulkan@DRIVER=/opt/mesa;A=b=c'"},
        {"cpu=vulkan", "is no API's"},
        {"all=vulkan", "is no API's"},
        {".x=vulkan", "begins with a letter or a digit"},
        {"x=", "stands before the name of a device"},
        {"x=y=vulkan", "stands before the name of a device"},
        {"x=new", "stands before the name of a device"},
        {"x y=vulkan@A", "'A' does not set a variable"},
        {"abcdefghijklmnopqrstuvwxyzabcdefghijklmnopqrstuvwxyz0123456789--=gl", "at most 63"},
        {"cpu,,", "--require 'cpu,,': names no device beside a comma"},
    };
    for (size_t i = 0; i < sizeof(refused) / sizeof(refused[0]); i++) {
        *logged = 0;
        assert_false(rg_device_names_check("--require", refused[i][0]));
        if (!strstr(logged, refused[i][1]))
            fail_msg("%s: %s", refused[i][0], logged);
    }
}

// --- lengths and numbers at their bounds ---

static bool is_read(const char *text)
{
    struct rg_device_name name;
    return rg_device_name_read(&text, &name) && !*text;
}

static void names_may_be_as_long_as_is_said(void **state)
{
    (void)state;
    char name[RG_DEVICE_NAME_SIZE + 1] = "gl@A=";
    memset(name + 5, 'x', RG_DEVICE_NAME_SIZE - 5);
    assert_false(is_read(name)); // of 512 characters
    name[RG_DEVICE_NAME_SIZE - 1] = 0;
    assert_true(is_read(name));
    // 63 characters of a short name
    assert_true(is_read("abcdefghijklmnopqrstuvwxyzabcdefghijklmnopqrstuvwxyz0123456789-=gl"));
}

static void threads_are_as_many_as_are_allowed(void **state)
{
    (void)state;
    char name[64];
    for (int more = 0; more < 2; more++) {
        snprintf(name, sizeof(name), "cpu@OMP_NUM_THREADS=%ld", rg_threads_most() + more);
        assert_int_equal(is_read(name), !more);
    }
    assert_true(is_read("cpu@OMP_NUM_THREADS=1"));
    assert_true(is_read("cpu@OMP_NUM_THREADS=\"1,2\""));
    assert_false(is_read("cpu@OMP_NUM_THREADS=-1"));
}

static void a_variable_is_added_to_a_name(void **state)
{
    (void)state;
    static const char *const rows[][4] = {
        {"gl", "A", "1", "gl@A=1"},         {"gl:1@A=1", "B", "x y", "gl:1@A=1;B=x y"},
        {"gl", "A", "", "gl@A="},           {"gl", "A", "1,2", "gl@A=\"1,2\""},
        {"gl", "A", "1;2", "gl@A=\"1;2\""}, {"gl", "A", "say \"so\"", "gl@A=\"say \"\"so\"\"\""},
    };
    char with[RG_DEVICE_NAME_SIZE], value[RG_DEVICE_NAME_SIZE] = "";
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        assert_true(rg_device_name_with(rows[i][0], rows[i][1], rows[i][2], with));
        assert_string_equal(with, rows[i][3]);
    }
    memset(value, 'x', RG_DEVICE_NAME_SIZE - 1 - strlen("gl@A="));
    assert_true(rg_device_name_with("gl", "A", value, with));
    assert_int_equal(strlen(with), RG_DEVICE_NAME_SIZE - 1);
    assert_int_equal(lines, 0);
    strcat(value, "x");
    assert_false(rg_device_name_with("gl", "A", value, with));
    assert_non_null(strstr(logged, "device 'gl': with A=xxx"));
    assert_non_null(strstr(logged, "its name has more than 511 characters"));
}

static void a_command_that_draws_takes_one_name(void **state)
{
    (void)state;
    static const char *const refused[] = {"cpu,gl", "all"};
    assert_true(rg_device_names_one("cpu", "render"));
    assert_true(rg_device_names_one("gl@A=\"1,2\"", "render"));
    assert_int_equal(lines, 0);
    for (int i = 0; i < 2; i++) {
        char due[100];
        assert_false(rg_device_names_one(refused[i], "render"));
        snprintf(due, sizeof(due), "--device %s: render draws on one device; ", refused[i]);
        assert_memory_equal(logged, due, strlen(due));
    }
    assert_false(rg_device_names_one("cpu,", "render"));
    assert_non_null(strstr(logged, "--device 'cpu,': names no device beside a comma"));
}

// --- devices that are required ---

static void a_name_means_a_device_or_those_of_its_api(void **state)
{
    (void)state;
    static const struct {
        const char *device, *name;
        bool is_of;
    } rows[] = {
        {"vulkan:1", "vulkan", true},   {"vulkan", "vulkan", true},
        {"vulkan:1", "vulkan:1", true}, {"vulkan:1", "vulkan:2", false},
        {"vulkan", "vulkan:1", false},  {"vulkan@A=1", "vulkan", true},
        {"glx", "gl", false},           {"gl", "glx", false},
        {"mine", "mine", true},         {"mine", "gl", true},
        {"mine", "gl:1", false},        {"gl:1", "mine", false},
    };
    assert_true(is_read("mine=gl:1"));
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++)
        if (rg_device_is_of(rows[i].device, rows[i].name) != rows[i].is_of)
            fail_msg("%s and %s", rows[i].device, rows[i].name);
}

static struct rg_device opened[2] = {{.info.name = "gl:1"}, {.info.name = "cpu"}};
static const struct rg_devices some = {.count = 2,
                                       .devices = {&opened[0], &opened[1]},
                                       .absent_count = 4,
                                       .absent = {{"vulkan", RG_CRASH, "vulkan: it crashed"},
                                                  {"opencl", RG_UNSUPPORTED, "opencl: no driver"},
                                                  {"lacking", RG_LACKING, "lacking: no memory"},
                                                  {"broken", RG_SETUP, "broken: no library"}}};

static void what_is_required_is_there_or_told(void **state)
{
    (void)state;
    static const struct {
        const char *require, *line;
        int lines;
        enum rg_fault fault;
    } rows[] = {
        {"gl,vulkan", "--require vulkan: vulkan: it crashed", 1, RG_FAULT_DRIVER},
        {"opencl,cpu", "--require opencl: opencl: no driver", 1, RG_FAULT_DRIVER},
        {"lacking", "--require lacking: lacking: no memory", 1, RG_FAULT_HARNESS},
        {"broken", "--require broken: broken: no library", 1, RG_FAULT_SETUP},
        {"gl:2", "--require gl:2: it is not among --device", 1, RG_FAULT_DRIVER},
        {"vulkan,gl,other", "--require other: it is not among --device", 2, RG_FAULT_DRIVER},
    };
    assert_true(rg_devices_have(&some, NULL));
    assert_true(rg_devices_have(&some, ""));
    assert_true(rg_devices_have(&some, "gl,cpu,gl:1"));
    assert_int_equal(lines, 0);
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        begin(NULL);
        assert_false(rg_devices_have(&some, rows[i].require));
        assert_int_equal(rg_failure_take().fault, rows[i].fault);
        assert_string_equal(logged, rows[i].line);
        assert_int_equal(lines, rows[i].lines);
    }
}

static void what_was_left_out_decides_the_status(void **state)
{
    (void)state;
    static const struct {
        int first, count, exit;
    } rows[] = {{0, 0, RG_EXIT_PASS}, {1, 1, RG_EXIT_PASS},    {0, 1, RG_EXIT_FAIL},
                {0, 2, RG_EXIT_FAIL}, {2, 1, RG_EXIT_HARNESS}, {1, 3, RG_EXIT_FAIL}};
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        struct rg_devices devices = {.absent_count = rows[i].count};
        for (int k = 0; k < rows[i].count; k++)
            devices.absent[k] = some.absent[rows[i].first + k];
        assert_int_equal(rg_devices_exit(&devices), rows[i].exit);
    }
}

// Backends without a device are warned of where no driver is installed, else an error.
static void missing_backends_are_told(void **state)
{
    (void)state;
    static const struct {
        enum rg_outcome outcome;
        int exit, exit_without; // with a device of another backend, and without any
        const char *line;
    } rows[] = {
        {RG_UNSUPPORTED, RG_EXIT_PASS, RG_EXIT_UNSUPPORTED, "warning: unsupported here: gl: why"},
        {RG_CRASH, RG_EXIT_FAIL, RG_EXIT_FAIL, "gl: why"},
        {RG_TIMEOUT, RG_EXIT_FAIL, RG_EXIT_FAIL, "gl: why"},
        {RG_SETUP, RG_EXIT_FAIL, RG_EXIT_FAIL, "gl: why"},
        {RG_LACKING, RG_EXIT_HARNESS, RG_EXIT_HARNESS, "gl: why"},
    };
    static struct rg_device_list list;
    assert_int_equal(rg_devices_complain(&list), RG_EXIT_UNSUPPORTED);
    list.count = 1;
    assert_int_equal(rg_devices_complain(&list), RG_EXIT_PASS);
    list.missing_count = 1;
    strcpy(list.missing[0].why, "gl: why");
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        list.missing[0].outcome = rows[i].outcome;
        for (list.count = 0; list.count < 2; list.count++) {
            begin(NULL);
            assert_int_equal(rg_devices_complain(&list),
                             list.count ? rows[i].exit : rows[i].exit_without);
            assert_string_equal(logged, rows[i].line);
            assert_int_equal(lines, 1);
        }
    }
}

// --- devices that are opened, in this process ---

static void devices_are_opened_in_the_order_of_their_names(void **state)
{
    (void)state;
    struct rg_devices devices;
    assert_int_equal(rg_devices_open("cpu:reference,cpu", &devices), RG_EXIT_PASS);
    assert_int_equal(devices.count, 2);
    assert_int_equal(devices.absent_count, 0);
    assert_string_equal(devices.devices[0]->info.name, "cpu:reference");
    assert_string_equal(devices.devices[1]->info.name, "cpu");
    assert_int_equal(rg_devices_end(&devices, RG_EXIT_INCONCLUSIVE), RG_EXIT_INCONCLUSIVE);
    assert_int_equal(devices.count, 0);
    assert_int_equal(lines, 0);
    assert_null(rg_devices_open_one("cpu,cpu:reference"));
    assert_string_equal(logged, "--device: one is wanted");
}

static void what_is_asked_for_is_opened_or_told(void **state)
{
    (void)state;
    char require[] = "gl", one[] = "cpu";
    struct rg_devices_asked asked = {.names = one, .timeout_s = 7};
    struct rg_devices devices;
    assert_int_equal(rg_devices_open_asked(&asked, &devices), RG_EXIT_PASS);
    assert_int_equal(rg_workers.timeout_s, 7);
    assert_true(rg_devices_close(&devices));
    asked.require = require;
    asked.timeout_s = 120;
    assert_int_equal(rg_devices_open_asked(&asked, &devices), RG_EXIT_FAIL);
    assert_string_equal(logged, "--require gl: it is not among --device");
    assert_int_equal(devices.count, 0);
    assert_int_equal(rg_workers.timeout_s, 120);
    assert_int_equal(rg_devices_open("nothing", &devices), RG_EXIT_USAGE);
    assert_int_equal(rg_devices_open("cpu,nothing", &devices), RG_EXIT_USAGE);
    assert_int_equal(devices.count, 0);
}

static void devices_are_no_more_than_fit(void **state)
{
    (void)state;
    char names[RG_MAX_DEVICES * 5 + 8] = "cpu";
    struct rg_devices devices;
    for (int i = 1; i < RG_MAX_DEVICES; i++)
        strcat(names, ",cpu");
    assert_int_equal(rg_devices_open(names, &devices), RG_EXIT_PASS);
    assert_int_equal(devices.count, RG_MAX_DEVICES);
    assert_true(rg_devices_close(&devices));
    strcat(names, ",cpu");
    assert_int_equal(rg_devices_open(names, &devices), RG_EXIT_USAGE);
    assert_string_equal(logged, "--device: more than 32 names");
    assert_int_equal(devices.count, 0);
}

// Names stay, so this fills a process of its own, which prints how many fit and why no more do.
static int fill(void)
{
    int taken = 0;
    char name[20];
    do
        snprintf(name, sizeof(name), "s%d=gl:%d", taken, taken);
    while (is_read(name) && ++taken < 100);
    return printf("%d %s %s\n", taken, is_read("s63") ? "kept" : "lost", logged) < 0;
}

static void short_names_are_no_more_than_fit(void **state)
{
    (void)state;
    char command[512], said[256] = "";
    snprintf(command, sizeof(command), "'%s' fill", self);
    FILE *filled = popen(command, "r");
    assert_non_null(filled);
    assert_non_null(fgets(said, sizeof(said), filled));
    assert_int_equal(pclose(filled), 0);
    assert_string_equal(said, "64 kept device 's64=gl:64': more than 64 short names\n");
}

int main(int argc, char **argv)
{
    rg_log_listen(keep, NULL);
    if (argc > 1 && !strcmp(argv[1], "fill"))
        return fill();
    self = argv[0];
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(names_are_read_one_after_the_other),
        cmocka_unit_test(quotes_hold_commas_semicolons_and_quotes),
        cmocka_unit_test(a_short_name_stands_for_a_device_from_then_on),
        cmocka_unit_test(what_is_no_such_form_is_refused),
        cmocka_unit_test_setup(names_may_be_as_long_as_is_said, begin),
        cmocka_unit_test_setup(threads_are_as_many_as_are_allowed, begin),
        cmocka_unit_test_setup(a_variable_is_added_to_a_name, begin),
        cmocka_unit_test_setup(a_command_that_draws_takes_one_name, begin),
        cmocka_unit_test_setup(a_name_means_a_device_or_those_of_its_api, begin),
        cmocka_unit_test_setup(what_is_required_is_there_or_told, begin),
        cmocka_unit_test_setup(what_was_left_out_decides_the_status, begin),
        cmocka_unit_test_setup(missing_backends_are_told, begin),
        cmocka_unit_test_setup(devices_are_opened_in_the_order_of_their_names, begin),
        cmocka_unit_test_setup(what_is_asked_for_is_opened_or_told, begin),
        cmocka_unit_test_setup(devices_are_no_more_than_fit, begin),
        cmocka_unit_test_setup(short_names_are_no_more_than_fit, begin),
    };
    return cmocka_run_group_tests_name("names of devices", tests, NULL, NULL);
}
