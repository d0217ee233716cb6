// Names of devices with an environment.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/devices/names.h"

static char logged[1024];

static void keep(enum rg_log_level level, const char *line, void *user)
{
    (void)level;
    (void)user;
    snprintf(logged, sizeof(logged), "%s", line);
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(names_are_read_one_after_the_other),
        cmocka_unit_test(quotes_hold_commas_semicolons_and_quotes),
        cmocka_unit_test(a_short_name_stands_for_a_device_from_then_on),
        cmocka_unit_test(what_is_no_such_form_is_refused),
    };
    rg_log_listen(keep, NULL);
    return cmocka_run_group_tests_name("names of devices", tests, NULL, NULL);
}
