// The passport of a process, and its drivers as people read them.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <dlfcn.h>
#include <gnu/libc-version.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "harness/record/passport/build_info.h"
#include "harness/record/passport/driver.h"
#include "harness/record/passport/key.h"
#include "harness/record/passport/machine.h"
#include "harness/record/passport/passport.h"
#include "harness/record/passport/program.h"
#include "harness/record/passport/variables.h"
#include "tests/tools/expect.h"

static const struct rg_device_info gl = {
    .name = "new",
    .full = "gl@X=1",
    .api = "OpenGL 4.5 core",
    .device = "llvmpipe",
    .driver = "Mesa 22.3.6",
    .libraries = {{.path = "/lib/gl.so", .build = "4c1f"}, {.path = "/lib/zink.so", .build = "77"}},
    .software = true,
};

static struct rg_device_info cpu_of(const char *path)
{
    struct rg_device_info info = {.name = "cpu", .full = "cpu", .driver = "gcc 12"};
    snprintf(info.libraries[0].path, sizeof(info.libraries[0].path), "%s", path);
    snprintf(info.libraries[0].build, sizeof(info.libraries[0].build), "ab");
    return info;
}

// --- lines ---

static void drivers_are_lines(void **state)
{
    (void)state;
    char line[RG_DRIVER_LINE];
    rg_driver_line(&gl, line);
    assert_string_equal(line, "new (gl@X=1): Mesa 22.3.6, /lib/gl.so, build id 4c1f, with "
                              "/lib/zink.so, build id 77");
    struct rg_device_info info = gl;
    *info.full = *info.libraries[0].path = 0;
    rg_driver_line(&info, line);
    assert_string_equal(line, "new: Mesa 22.3.6");
    // A line steers neither a terminal nor GitHub's logs.
    snprintf(info.full, sizeof(info.full), "new");
    snprintf(info.driver, sizeof(info.driver), "a\x1b[2Jb ##[error]##[c");
    rg_driver_line(&info, line);
    assert_string_equal(line, "new: a?[2Jb ##(error]##(c");
}

// The paths of files below this folder begin there; a folder of which this one's name is the
// beginning is another.
static void paths_begin_here(void **state)
{
    (void)state;
    char here[400], path[420], line[RG_DRIVER_LINE];
    assert_non_null(getcwd(here, sizeof(here)));
    snprintf(path, sizeof(path), "%.399s/build/a.so", here);
    struct rg_device_info info = cpu_of(path);
    rg_driver_line(&info, line);
    assert_string_equal(line, "cpu: gcc 12, build/a.so, build id ab");
    snprintf(path, sizeof(path), "%.399sx/a.so", here);
    info = cpu_of(path);
    rg_driver_line(&info, line);
    assert_non_null(strstr(line, path));
}

static void each_driver_has_a_line(void **state)
{
    (void)state;
    char *text = NULL;
    size_t size;
    const struct rg_device_info cpu = cpu_of("");
    const struct rg_device_info *const infos[] = {&cpu, &gl};
    FILE *out = open_memstream(&text, &size);
    rg_drivers_print(infos, 2, out);
    assert_int_equal(fclose(out), 0);
    assert_string_equal(text, "cpu: gcc 12\nnew (gl@X=1): Mesa 22.3.6, /lib/gl.so, build id 4c1f, "
                              "with /lib/zink.so, build id 77\n");
    free(text);
}

// --- JSON ---

// Compares a document, which it releases, with a text.
static void expect_json(json_t *found, const char *due)
{
    json_error_t error;
    json_t *wanted = json_loads(due, 0, &error);
    if (!wanted)
        fail_msg("%s: %s", due, error.text);
    if (!json_equal(found, wanted))
        fail_msg("%s instead of %s", json_dumps(found, 0), due);
    json_decref(wanted);
    json_decref(found);
}

// Of the program only its file's name is kept, for its folder names a user.
static void devices_are_described(void **state)
{
    (void)state;
    const struct rg_device_info cpu = cpu_of("a/folder/raingauge");
    const struct rg_device_info *const infos[] = {&gl, &cpu};
    expect_json(rg_passport_devices(infos, 2),
                "[{\"name\": \"new\", \"api\": \"OpenGL 4.5 core\", \"device\": \"llvmpipe\", "
                "\"driver\": \"Mesa 22.3.6\", \"software\": true, \"full\": \"gl@X=1\", "
                "\"libraries\": [{\"path\": \"/lib/gl.so\", \"build\": \"4c1f\"}, "
                "{\"path\": \"/lib/zink.so\", \"build\": \"77\"}]}, "
                "{\"name\": \"cpu\", \"api\": \"\", \"device\": \"\", \"driver\": \"gcc 12\", "
                "\"software\": false, \"libraries\": [{\"path\": \"raingauge\", \"build\": "
                "\"ab\"}]}]");
}

static const char *text_in(const json_t *object, const char *group, const char *name)
{
    const char *text = json_string_value(json_object_get(json_object_get(object, group), name));
    return text ? text : "none";
}

static json_int_t number_in(const json_t *object, const char *group, const char *name)
{
    return json_integer_value(json_object_get(json_object_get(object, group), name));
}

// The passport has the machine's parts as rg_machine_read reads them, and those of the build.
static void passports_describe_this_process(void **state)
{
    (void)state;
    struct rg_machine machine;
    char id[RG_BUILD_ID_SIZE];
    json_t *passport = rg_passport_json(&gl, 1);
    rg_machine_read(&machine, "");
    rg_program_id(id);
    assert_string_equal(text_in(passport, "machine", "cpu"), machine.cpu);
    assert_int_equal(number_in(passport, "machine", "cores_online"), machine.cores_online);
    assert_int_equal(number_in(passport, "machine", "cores_allowed"), machine.cores_allowed);
    assert_string_equal(text_in(passport, "machine", "cores_list"), machine.cores_list);
    assert_string_equal(text_in(passport, "machine", "kernel"), machine.kernel);
    assert_string_equal(text_in(passport, "machine", "distribution"), machine.distribution);
    assert_string_equal(text_in(passport, "machine", "clocks"), machine.clocks);
    assert_int_equal(number_in(passport, "machine", "memory_bytes"), machine.memory_bytes);
    assert_string_equal(text_in(passport, "raingauge", "version"), rg_build_version);
    assert_string_equal(text_in(passport, "raingauge", "commit"), rg_build_commit);
    assert_string_equal(text_in(passport, "raingauge", "compiler"), rg_build_compiler);
    assert_string_equal(text_in(passport, "raingauge", "type"), rg_build_type);
    assert_string_equal(text_in(passport, "raingauge", "program"), id);
    assert_string_not_equal(id, "unknown");
    const json_t *libraries = json_object_get(json_object_get(passport, "raingauge"), "libraries");
    assert_string_equal(json_string_value(json_object_get(libraries, "glibc")),
                        gnu_get_libc_version());
    for (int i = 0; rg_build_libraries[i].name; i++)
        assert_string_equal(
            json_string_value(json_object_get(libraries, rg_build_libraries[i].name)),
            rg_build_libraries[i].version);
    json_decref(passport);
}

// Each instruction set is an element.
static void features_are_words(void **state)
{
    (void)state;
    struct rg_machine machine;
    char joined[sizeof(machine.features)] = "";
    size_t i;
    const json_t *word;
    json_t *passport = rg_passport_json(NULL, 0);
    rg_machine_read(&machine, "");
    json_array_foreach(json_object_get(json_object_get(passport, "machine"), "features"), i, word)
    {
        assert_null(strchr(json_string_value(word), ' '));
        snprintf(joined + strlen(joined), sizeof(joined) - strlen(joined), "%s%s", i ? " " : "",
                 json_string_value(word));
    }
    assert_string_equal(joined, machine.features);
    json_decref(passport);
}

// Every variable that decides about code or threads is kept, and no other.
static void variables_are_kept(void **state)
{
    (void)state;
    char due[512];
    for (int i = 0; rg_variables[i].name; i++)
        unsetenv(rg_variables[i].name);
    setenv("OMP_NUM_THREADS", "3", 1);
    setenv("VK_DRIVER_FILES", "", 1);
    setenv("RG_KERNEL_DIR", "/kernels", 1);
    setenv("RG_SOMETHING", "else", 1);
    json_t *passport = rg_passport_json(NULL, 0);
    assert_string_equal(text_in(passport, "raingauge", "kernel_dir"), "/kernels");
    snprintf(due, sizeof(due),
             "{\"OMP_NUM_THREADS\": \"3\", \"VK_DRIVER_FILES\": \"\", \"RG_KERNEL_DIR\": "
             "\"/kernels\"}");
    expect_json(json_incref(json_object_get(passport, "environment")), due);
    json_decref(passport);
    unsetenv("RG_KERNEL_DIR");
    passport = rg_passport_json(NULL, 0);
    const json_t *build = json_object_get(passport, "raingauge");
    assert_true(json_is_null(json_object_get(build, "kernel_dir")));
    json_decref(passport);
}

// A device's key is that of its own parts; the other device has another.
static void devices_have_keys(void **state)
{
    (void)state;
    const struct rg_device_info infos[] = {cpu_of("raingauge"), gl};
    json_t *passport = rg_passport_json(infos, 2);
    char keys[2][RG_KEY_SIZE];
    for (size_t i = 0; i < 2; i++) {
        const json_t *device = json_array_get(json_object_get(passport, "devices"), i);
        json_t *parts = rg_key_parts(passport, device);
        rg_key_hash(parts, keys[i]);
        assert_string_equal(json_string_value(json_object_get(device, "key")), keys[i]);
        json_decref(parts);
    }
    assert_string_not_equal(keys[0], keys[1]);
    json_decref(passport);
}

// A library that is loaded, as drivers are, alters the hash by its build. These are libc's, and
// none of ours uses them.
static void libraries_have_a_hash(void **state)
{
    (void)state;
    static const char *const names[] = {"libanl.so.1", "libBrokenLocale.so.1"};
    const uint64_t hash = rg_libraries_hash();
    uint64_t with[2];
    for (int i = 0; i < 2; i++) {
        void *library = dlopen(names[i], RTLD_NOW);
        assert_non_null(library);
        with[i] = rg_libraries_hash();
        assert_int_equal(dlclose(library), 0);
        assert_true(rg_libraries_hash() == hash && with[i] != hash);
    }
    assert_true(with[0] != with[1]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(drivers_are_lines),
        cmocka_unit_test(paths_begin_here),
        cmocka_unit_test(each_driver_has_a_line),
        cmocka_unit_test(devices_are_described),
        cmocka_unit_test(passports_describe_this_process),
        cmocka_unit_test(features_are_words),
        cmocka_unit_test(variables_are_kept),
        cmocka_unit_test(devices_have_keys),
        cmocka_unit_test(libraries_have_a_hash),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
