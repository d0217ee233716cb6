// Two devices to be compared run different drivers if their names choose two.
#include "harness/devices/drivers/apart.h"

#include "tests/harness/devices/drivers/place.h"

static void names_choose_two_drivers_of_one_api(void **state)
{
    (void)state;
    static const struct {
        const char *a, *settings_a, *b, *settings_b;
        bool apart;
    } rows[] = {
        {"vulkan", "", "vulkan", "DRIVER=/opt/mesa\0", true},
        {"vulkan", "DRIVER=/opt/mesa\0", "vulkan", "", true},
        {"vulkan", "DRIVER=/opt/a\0", "vulkan:1", "DRIVER=/opt/b\0", true},
        {"vulkan:1@DRIVER=/opt/a", "DRIVER=/opt/a\0", "vulkan", "", true},
        {"vulkan", "DRIVER=/opt/a\0", "vulkan", "DRIVER=/opt/a\0", false},
        {"vulkan", "", "vulkan", "LP_NUM_THREADS=1\0", false},
        {"vulkan", "A=1\0VK_DRIVER_FILES=a.json\0", "vulkan", "A=1\0", true},
        {"vulkan", "VK_ICD_FILENAMES=a.json\0", "vulkan", "", true},
        {"vulkan", "VK_ADD_DRIVER_FILES=a.json\0", "vulkan", "", true},
        {"gl", "__EGL_VENDOR_LIBRARY_FILENAMES=a.json\0", "gl", "", true},
        {"gl", "__EGL_VENDOR_LIBRARY_DIRS=a\0", "gl", "", true},
        {"gl", "LIBGL_DRIVERS_PATH=a\0", "gl", "", true},
        {"opencl", "OCL_ICD_VENDORS=a\0", "opencl", "", true},
        {"opencl", "OCL_ICD_FILENAMES=a\0", "opencl", "", true},
        {"gl", "LD_LIBRARY_PATH=a\0", "gl", "", true},
        {"gl", "", "gl", "LD_LIBRARY_PATH=/ours\0", false}, // as raingauge's own
        {"gl", "LD_LIBRARY_PATH=\0", "gl", "", true},
        {"gl", "DRIVER=/opt/mesa\0", "vulkan", "", false},
        {"gl", "DRIVER=/opt/mesa\0", "glx", "", false},
        {"opencl", "DRIVER=/opt/mesa\0", "vulkan", "", false},
        {"cpu", "DRIVER=/opt/mesa\0", "cpu", "", false},
        {"cpu:reference", "LD_LIBRARY_PATH=a\0", "cpu", "", false},
    };
    setenv("LD_LIBRARY_PATH", "/ours", 1);
    setenv("DRIVER", "/opt/mesa", 1); // names alone give this one
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++)
        if (rg_drivers_are_chosen_apart(rows[i].a, rows[i].settings_a, rows[i].b,
                                        rows[i].settings_b) != rows[i].apart)
            fail_msg("row %d: %s and %s", (int)i, rows[i].a, rows[i].b);
    unsetenv("LD_LIBRARY_PATH");
    unsetenv("DRIVER");
}

static void settings_besides_the_driver_are_told(void **state)
{
    (void)state;
    static const struct {
        const char *now, *then, *text;
    } rows[] = {
        {"", "", ""},
        {"LP_PERF=no_blend\0", "", "LP_PERF no_blend and not unset"},
        {"", "LP_PERF=no_blend\0", "LP_PERF unset and not no_blend"},
        {"LP_PERF=a\0", "LP_PERF=b\0", "LP_PERF a and not b"},
        {"LP_PERF=a\0", "LP_PERF=a\0", ""},
        {"A=1\0B=2\0", "B=2\0C=3\0", "A 1 and not unset; C unset and not 3"},
        {"DRIVER=/a\0VK_DRIVER_FILES=x\0A=1\0", "LD_LIBRARY_PATH=/b\0", "A 1 and not unset"},
        {"DRIVERS=1\0DRIVE=2\0", "", "DRIVERS 1 and not unset; DRIVE 2 and not unset"},
        {"LINEAR=1\0", "", "LINEAR 1 and not unset"},
        {"OURS=here\0", "", ""}, // as raingauge's own
    };
    setenv("OURS", "here", 1);
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        char text[200] = "before";
        rg_drivers_settings(rows[i].now, rows[i].then, text, sizeof(text));
        assert_string_equal(text, rows[i].text);
    }
    unsetenv("OURS");
}

// --- opened devices ---

static struct rg_device_info device(const char *name, const char *full, const char *path,
                                    const char *build, uint64_t inode)
{
    struct rg_device_info info = {.libraries = {{.device = inode ? 1 : 0, .inode = inode}}};
    snprintf(info.name, sizeof(info.name), "%s", name);
    snprintf(info.full, sizeof(info.full), "%s", full);
    snprintf(info.libraries[0].path, sizeof(info.libraries[0].path), "%s", path);
    snprintf(info.libraries[0].build, sizeof(info.libraries[0].build), "%s", build);
    return info;
}

static void one_file_under_two_names_is_an_error(void **state)
{
    (void)state;
    const struct rg_device_info old = device("old", "vulkan", "/lib/a.so", "b1", 7);
    const struct rg_device_info new = device("new", "vulkan@D=1", "/lib/a.so", "b1", 7);
    assert_true(rg_drivers_are_apart(&old, "", &new, "LP_PERF=1\0"));
    assert_int_equal(lines, 0);
    assert_false(rg_drivers_are_apart(&old, "", &new, "VK_DRIVER_FILES=/x/a.json\0"));
    assert_refused(RG_FAULT_INPUT,
                   "devices 'old' and 'new' run one driver, /lib/a.so, though they name it "
                   "differently by VK_DRIVER_FILES; name the other one, or write "
                   "'vulkan@DRIVER=PREFIX'");
    // A folder of libraries alone chooses none; whichever device names it tells the prefix.
    assert_false(rg_drivers_are_apart(&old, "", &new, "LD_LIBRARY_PATH=/opt/m/usr/lib/x\0"));
    assert_refused(RG_FAULT_INPUT, "LD_LIBRARY_PATH alone chooses none, for the system's own files "
                                   "name it; write 'vulkan@DRIVER=/opt/m'");
    assert_false(rg_drivers_are_apart(&new, "LD_LIBRARY_PATH=/opt/m/lib64\0", &old, ""));
    assert_refused(RG_FAULT_INPUT, "'new' and 'old' run one driver");
    assert_false(rg_drivers_are_apart(&new, "LD_LIBRARY_PATH=/opt/m/lib64\0", &old, ""));
    assert_refused(RG_FAULT_INPUT, "write 'vulkan@DRIVER=/opt/m'");
    assert_false(rg_drivers_are_apart(&old, "", &new, "LD_LIBRARY_PATH=/lib/x\0"));
    assert_refused(RG_FAULT_INPUT, "write 'vulkan@DRIVER=PREFIX'");
    assert_false(rg_drivers_are_apart(&old, "", &new, "LD_LIBRARY_PATH=/opt/m\0"));
    assert_refused(RG_FAULT_INPUT, "write 'vulkan@DRIVER=PREFIX'");
}

static void one_build_in_two_files_is_a_warning(void **state)
{
    (void)state;
    const char *chosen = "DRIVER=/opt/m\0";
    const struct rg_device_info old = device("old", "vulkan", "/lib/a.so", "b1", 7);
    const struct rg_device_info same = device("new", "vulkan@D=1", "/opt/a.so", "b1", 8);
    const struct rg_device_info other = device("new", "vulkan@D=1", "/opt/a.so", "b2", 8);
    const struct rg_device_info of_gl = device("new", "gl@D=1", "/lib/a.so", "b1", 7);
    assert_true(rg_drivers_are_apart(&old, "", &other, chosen));
    assert_true(rg_drivers_are_apart(&old, "", &of_gl, chosen));
    assert_int_equal(lines, 0);
    assert_true(rg_drivers_are_apart(&old, "", &same, chosen));
    assert_string_equal(logged, "warning: devices 'old' and 'new' run one build of a driver from "
                                "two files, /lib/a.so and /opt/a.so");
    assert_int_equal(lines, 1);
    assert_true(rg_drivers_are_apart(&old, "", &same, ""));
    assert_int_equal(lines, 1);
}

// A layered driver is another one if any of its files is; of an unknown one nothing is said.
static void all_files_of_a_driver_count(void **state)
{
    (void)state;
    const char *chosen = "DRIVER=/opt/m\0";
    struct rg_device_info a = device("old", "gl", "/lib/a.so", "b1", 7);
    struct rg_device_info b = device("new", "gl@D=1", "/lib/a.so", "b1", 7);
    struct rg_library *last = &b.libraries[RG_DRIVER_LIBRARIES - 1];
    *last = (struct rg_library){.path = "/opt/below.so", .build = "b9"};
    assert_true(rg_drivers_are_apart(&a, "", &b, chosen));
    assert_true(rg_drivers_are_apart(&b, "", &a, chosen));
    assert_int_equal(lines, 0);
    a = device("old", "gl", "", "", 0);
    b = device("new", "gl@D=1", "", "", 0);
    assert_true(rg_drivers_are_apart(&a, "", &b, chosen));
    assert_int_equal(lines, 0);
}

int main(void)
{
    unsetenv("LD_LIBRARY_PATH");
    const struct CMUnitTest tests[] = {
        IN_A_PLACE(names_choose_two_drivers_of_one_api),
        IN_A_PLACE(settings_besides_the_driver_are_told),
        IN_A_PLACE(one_file_under_two_names_is_an_error),
        IN_A_PLACE(one_build_in_two_files_is_a_warning),
        IN_A_PLACE(all_files_of_a_driver_count),
    };
    return cmocka_run_group_tests_name("drivers apart", tests, NULL, NULL);
}
