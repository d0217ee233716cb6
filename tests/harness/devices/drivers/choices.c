// The driver that a device's name chooses: the files that it names, the variables that it sets, and
// whether that driver runs.
#include "harness/devices/drivers/choice.h"

#include <unistd.h>

#include "tests/harness/devices/drivers/place.h"

// Chooses by the name `full` with these variables, for the device that is called "new".
static struct rg_choice *choose(const char *full, const char *environment)
{
    return rg_choice_read(&(struct rg_asked){"new", full, environment});
}

// The variables of a name: "KEY=value" once, ended by two zeros.
static const char *one(const char *key, const char *value)
{
    static char text[4 * PATH_MAX];
    memset(text, 0, sizeof(text));
    strcat(strcat(strcat(text, key), "="), value);
    return text;
}

// --- manifests ---

static void the_first_variable_of_the_api_counts(void **state)
{
    (void)state;
    const char *file = put_manifest("a.json", "liba.so");
    static const struct {
        const char *full, *variable;
        bool counts;
    } rows[] = {
        {"vulkan", "VK_DRIVER_FILES", true},
        {"vulkan:1", "VK_ICD_FILENAMES", true},
        {"vulkan@x", "VK_ADD_DRIVER_FILES", true},
        {"gl", "__EGL_VENDOR_LIBRARY_FILENAMES", true},
        {"gl", "__EGL_VENDOR_LIBRARY_DIRS", true},
        {"opencl", "OCL_ICD_VENDORS", true},
        {"gl", "VK_DRIVER_FILES", false},
        {"opencl", "__EGL_VENDOR_LIBRARY_DIRS", false},
        {"vulkan", "LP_PERF", false},
    };
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        struct rg_choice *choice = choose(rows[i].full, one(rows[i].variable, file));
        assert_non_null(choice);
        assert_string_equal(choice->name, "new");
        assert_memory_equal(choice->api, rows[i].full, strlen(choice->api));
        assert_int_equal(choice->count, rows[i].counts);
        if (rows[i].counts)
            assert_string_equal(choice->variable, rows[i].variable);
        else
            assert_null(choice->variable);
        rg_choice_free(choice);
    }
    struct rg_choice *choice =
        choose("vulkan", "VK_ICD_FILENAMES=/none/b.json\0VK_DRIVER_FILES=\0");
    assert_non_null(choice);
    assert_string_equal(choice->variable, "VK_DRIVER_FILES");
    assert_int_equal(choice->count, 0);
    rg_choice_free(choice);
}

// As the loaders do, it takes files and folders of them; one good file is enough.
static void files_and_folders_are_read_in_order(void **state)
{
    (void)state;
    const char *libraries[RG_CHOICE_MANIFESTS];
    const char *last = put_manifest("z.json", "libz.so");
    put_manifest("folder/b.json", "libb.so");
    put_manifest("folder/a.json", "liba.so");
    put_manifest("folder/c.icd", "libc.so");
    const char *none = in_place("none.json"), *folder = in_place("folder");
    const char *list = text_of("%s::%s:%s:%s", none, folder, last, none);
    struct rg_choice *choice = choose("vulkan", one("VK_DRIVER_FILES", list));
    assert_non_null(choice);
    assert_int_equal(choice->count, 5);
    assert_int_equal(choice->manifests[0].fault, RG_MANIFEST_ABSENT);
    assert_int_equal(rg_choice_libraries(choice, libraries, RG_CHOICE_MANIFESTS), 3);
    assert_string_equal(libraries[0], "liba.so");
    assert_string_equal(libraries[1], "libb.so");
    assert_string_equal(libraries[2], "libz.so");
    assert_int_equal(rg_choice_libraries(choice, libraries, 2), 2);
    rg_choice_free(choice);
    choice = choose("opencl", one("OCL_ICD_VENDORS", folder));
    assert_non_null(choice);
    assert_int_equal(choice->count, 1);
    assert_string_equal(choice->manifests[0].library, "libc.so");
    rg_choice_free(choice);
    assert_int_equal(lines, 0);
}

static void refuse(const char *full, const char *environment, enum rg_fault fault, const char *says)
{
    assert_null(choose(full, environment));
    assert_refused(fault, says);
}

// The first of the named files says what is wrong.
static void what_leads_nowhere_is_refused(void **state)
{
    (void)state;
    const char *none = in_place("none.json"), *lost = put_manifest("lost.json", "/none/liba.so");
    const char *empty = put_text("empty.json", "{}");
    refuse("vulkan", one("VK_DRIVER_FILES", text_of("%s:%s", none, empty)), RG_FAULT_NONE,
           text_of("device 'new': VK_DRIVER_FILES names %s, which is not there; name a driver's "
                   "file, or write 'vulkan@DRIVER=PREFIX'",
                   none));
    refuse("vulkan:1", one("VK_DRIVER_FILES", text_of("%s:%s", lost, none)), RG_FAULT_SETUP,
           text_of("device 'new': %s names the library /none/liba.so, which is not there; mend its "
                   "library_path, or write 'vulkan@",
                   lost));
    refuse("gl", one("__EGL_VENDOR_LIBRARY_FILENAMES", empty), RG_FAULT_SETUP,
           text_of("device 'new': %s is no driver's file, which has a library_path; name another "
                   "one, or write 'gl@",
                   empty));
}

// --- a prefix ---

static void a_prefix_stands_alone(void **state)
{
    (void)state;
    const char *file = put_manifest("a.json", "liba.so");
    static char both[4 * PATH_MAX];
    snprintf(both, sizeof(both), "DRIVER=/opt%cVK_ICD_FILENAMES=%s%c", 0, file, 0);
    refuse("vulkan", both, RG_FAULT_INPUT,
           "device 'new': both DRIVER and VK_ICD_FILENAMES name a driver");
    refuse("cpu:reference", "DRIVER=/opt\0", RG_FAULT_INPUT, "device 'new': cpu has no driver");
    refuse("vulkan", one("DRIVER", in_place("none")), RG_FAULT_INPUT, "is no folder");
    refuse("vulkan", one("DRIVER", place), RG_FAULT_NONE, "has no driver of vulkan");
}

// A folder with drivers of two APIs.
static struct rg_choice *choose_prefix(const char *api)
{
    put_manifest("mesa/share/vulkan/icd.d/a.json", "liba.so");
    put_manifest("mesa/etc/OpenCL/vendors/c.icd", "libc.so");
    put_text("mesa/lib/liba.so", "code");
    put_text("mesa/lib/libc.so", "code");
    struct rg_choice *choice = choose(api, one("DRIVER", in_place("mesa")));
    assert_non_null(choice);
    return choice;
}

static void a_prefix_s_libraries_are_of_the_api(void **state)
{
    (void)state;
    static const char *const rows[][2] = {{"vulkan", "mesa/lib/liba.so"},
                                          {"opencl", "mesa/lib/libc.so"}};
    for (int i = 0; i < 2; i++) {
        const char *libraries[RG_CHOICE_MANIFESTS];
        struct rg_choice *choice = choose_prefix(rows[i][0]);
        assert_int_equal(rg_choice_libraries(choice, libraries, RG_CHOICE_MANIFESTS), 1);
        assert_string_equal(libraries[0], in_place(rows[i][1]));
        assert_false(rg_choice_refuse(choice, "libX.so is missing"));
        assert_refused(RG_FAULT_SETUP,
                       text_of("device 'new': %s cannot be loaded: libX.so is missing; install the "
                               "package that has what is missing, or unpack it into %s",
                               in_place(rows[i][1]), in_place("mesa")));
        rg_choice_free(choice);
    }
    const char *file = put_manifest("a.json", "liba.so");
    struct rg_choice *choice = choose("vulkan", one("VK_DRIVER_FILES", file));
    assert_false(rg_choice_refuse(choice, "libX.so is missing"));
    assert_refused(RG_FAULT_SETUP, text_of("the library that %s names cannot be loaded: libX.so is "
                                           "missing; add the folder of what is missing by",
                                           file));
    rg_choice_free(choice);
}

// --- variables for the worker ---

static void a_worker_gets_the_name_s_variables(void **state)
{
    (void)state;
    struct rg_worker_variables variables = {.text = NULL};
    struct rg_choice *choice = choose("cpu", "A=1\0B=x=y\0C=\0");
    assert_true(rg_choice_set(choice, "", &variables));
    assert_int_equal(variables.size, strlen("A=1") + strlen("B=x=y") + strlen("C=") + 3);
    assert_memory_equal(variables.text, "A=1\0B=x=y\0C=\0", variables.size + 1);
    rg_choice_free(choice);
    rg_variables_free(&variables);
    put_text("copies/empty", "");
    choice = choose_prefix("vulkan");
    assert_true(rg_choice_set(choice, in_place("copies"), &variables));
    assert_null(rg_variables_find(&variables, "DRIVER"));
    assert_string_equal(rg_variables_find(&variables, "VK_DRIVER_FILES"),
                        in_place("copies/vulkan-00-a.json"));
    rg_choice_free(choice);
    rg_variables_free(&variables);
}

// --- the driver that runs ---

static struct rg_device_info running(const char *first, const char *last)
{
    struct rg_device_info info = {.name = "new"};
    snprintf(info.libraries[0].path, RG_LIBRARY_PATH, "%s", first);
    snprintf(info.libraries[RG_DRIVER_LIBRARIES - 1].path, RG_LIBRARY_PATH, "%s", last);
    return info;
}

static void the_driver_of_a_prefix_runs(void **state)
{
    (void)state;
    struct rg_choice *choice = choose_prefix("vulkan");
    const char *outside = put_text("outside/liba.so", "code");
    const struct rg_device_info inside = running(in_place("mesa/lib/libz.so"), "");
    const struct rg_device_info strayed = running("/usr/lib/libz.so", "");
    const struct rg_device_info layered = running("/usr/lib/libz.so", in_place("mesa/lib/liba.so"));
    const struct rg_device_info unknown = running("", "");
    assert_true(rg_choice_is_met(choice, &inside));
    assert_true(rg_choice_is_met(choice, &layered));
    assert_true(rg_choice_is_met(choice, &unknown));
    assert_false(rg_choice_is_met(choice, &strayed));
    assert_refused(RG_FAULT_INPUT,
                   text_of("device 'new': its driver is /usr/lib/libz.so, and not one of %s",
                           in_place("mesa")));
    // A library may be a link to a file elsewhere.
    assert_int_equal(remove(in_place("mesa/lib/liba.so")), 0);
    assert_int_equal(symlink(outside, in_place("mesa/lib/liba.so")), 0);
    const struct rg_device_info linked = running(outside, "");
    assert_true(rg_choice_is_met(choice, &linked));
    assert_false(rg_choice_is_met(choice, &layered));
    assert_refused(RG_FAULT_INPUT, "its driver is /usr/lib/libz.so");
    rg_choice_free(choice);
}

static void the_driver_of_a_manifest_runs(void **state)
{
    (void)state;
    const char *bare = put_manifest("one/share/vulkan/icd.d/a.json", "liba.so");
    put_text("two/lib/libb.so", "code");
    const char *path = put_manifest("two/share/vulkan/icd.d/b.json", in_place("two/lib/libb.so"));
    const struct rg_device_info inside = running(in_place("two/lib/libb.so"), "");
    const struct rg_device_info strayed = running("/usr/lib/liba.so", "");
    const struct rg_device_info unknown = running("", "");
    struct rg_choice *choice =
        choose("vulkan", one("VK_DRIVER_FILES", text_of("%s:%s", bare, path)));
    assert_true(rg_choice_is_met(choice, &inside));
    assert_true(rg_choice_is_met(choice, &unknown));
    assert_false(rg_choice_is_met(choice, &strayed));
    assert_refused(RG_FAULT_INPUT,
                   text_of("device 'new': %s is of %s, and the driver that runs is "
                           "/usr/lib/liba.so: its library_path liba.so is a bare name, which is "
                           "looked for in the system's folders; write 'vulkan@DRIVER=%s'",
                           bare, in_place("one"), in_place("one")));
    rg_choice_free(choice);
    choice = choose("vulkan", one("VK_DRIVER_FILES", path));
    assert_false(rg_choice_is_met(choice, &strayed));
    assert_refused(RG_FAULT_INPUT,
                   text_of("its library_path %s leads there; write 'vulkan@DRIVER=%s'",
                           in_place("two/lib/libb.so"), in_place("two")));
    rg_choice_free(choice);
    // A file that is nobody's installation may name any library.
    choice = choose("vulkan", one("VK_DRIVER_FILES", put_manifest("mine.json", "liba.so")));
    assert_true(rg_choice_is_met(choice, &strayed));
    rg_choice_free(choice);
    assert_int_equal(lines, 0);
}

int main(void)
{
    unsetenv("LD_LIBRARY_PATH");
    unsetenv("DRIVER");
    const struct CMUnitTest tests[] = {
        IN_A_PLACE(the_first_variable_of_the_api_counts),
        IN_A_PLACE(files_and_folders_are_read_in_order),
        IN_A_PLACE(what_leads_nowhere_is_refused),
        IN_A_PLACE(a_prefix_stands_alone),
        IN_A_PLACE(a_prefix_s_libraries_are_of_the_api),
        IN_A_PLACE(a_worker_gets_the_name_s_variables),
        IN_A_PLACE(the_driver_of_a_prefix_runs),
        IN_A_PLACE(the_driver_of_a_manifest_runs),
    };
    return cmocka_run_group_tests_name("choices of drivers", tests, NULL, NULL);
}
