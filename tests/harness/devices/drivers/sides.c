// Devices with settings of their own are opened with folders of their own for compiled code, and
// only with the driver that their names choose. The worker is this program again, as a driver that
// tells its variables.
#include <unistd.h>

#include "harness/devices/devices.h"
#include "harness/devices/drivers/side.h"
#include "harness/devices/workers/device.h"
#include "harness/devices/workers/serve.h"
#include "tests/harness/devices/drivers/place.h"

// --- in the worker ---

static const char *value_of(const char *variable)
{
    const char *value = getenv(variable);
    return value ? value : "";
}

// A device whose `api` is where Mesa keeps its code; a test chooses its driver and its libraries.
static bool open_device(struct rg_message *request, struct rg_message *reply)
{
    static struct rg_told_device told;
    struct rg_device_info *info = &told.info;
    const char *cache = value_of("MESA_SHADER_CACHE_DIR");
    snprintf(info->name, sizeof(info->name), "%.100s", rg_take_text(request));
    snprintf(info->driver, sizeof(info->driver), "%.100s", value_of("RG_TEST_DRIVER"));
    snprintf(info->libraries[0].path, RG_LIBRARY_PATH, "%.500s", value_of("RG_TEST_LIBRARY"));
    snprintf(info->libraries[1].build, RG_BUILD_ID_SIZE, "%.100s", value_of("RG_TEST_BUILD"));
    rg_info("opened in %s", strstr(cache, "/sides/") ? strstr(cache, "/sides/") : cache);
    rg_put_fields(reply, rg_told_device_fields, &told);
    return true;
}

// Loads no library, and says which ones it was asked for, unless the first is good.
static bool load(struct rg_message *request, struct rg_message *reply)
{
    char why[2 * PATH_MAX] = "";
    const int count = (int)rg_take_int(request);
    for (int i = 0; i < count; i++)
        snprintf(why + strlen(why), sizeof(why) - strlen(why), "%s;", rg_take_text(request));
    rg_put_text(reply, strstr(why, "good") ? "" : why);
    return true;
}

static bool shut(struct rg_message *request, struct rg_message *reply)
{
    (void)request;
    rg_put_fields(reply, rg_closed_fields, &(bool){true});
    return true;
}

static rg_service *const services[RG_CALL_COUNT_OF_CALLS] = {
    [RG_CALL_OPEN] = open_device, [RG_CALL_LOAD] = load, [RG_CALL_CLOSE] = shut};

// --- in the harness ---

static int begin(void **state)
{
    static const char *const unset[] = {"LP_PERF",         "GALLIVM_PERF",
                                        "GALLIVM_DEBUG",   "LP_NATIVE_VECTOR_WIDTH",
                                        "RG_TEST_LIBRARY", "MESA_SHADER_CACHE_DIR"};
    const int failed = begin_place(state);
    for (size_t i = 0; i < sizeof(unset) / sizeof(unset[0]); i++)
        unsetenv(unset[i]);
    setenv("XDG_CACHE_HOME", place, 1);
    setenv("RG_TEST_DRIVER", "first", 1);
    setenv("RG_TEST_BUILD", "1", 1);
    return failed;
}

// Opens and closes a device, which is opened in its worker this often. Returns where its code is
// kept, from "/sides/" on.
static const char *opened_in(const char *name, int times)
{
    forget_lines();
    struct rg_device *device = rg_devices_open_one(name);
    if (!device)
        fail_msg("%s: %s", name, logged);
    assert_int_equal(lines, times);
    assert_true(rg_device_close(device));
    assert_int_equal(lines, times);
    return text_of("%s", logged + strlen("opened in "));
}

// A driver is known once it was opened. From then on its folder is found at once.
static void each_driver_of_a_side_has_its_folder(void **state)
{
    (void)state;
    const char *first = opened_in("toy@A=1", 2);
    assert_memory_equal(first, "/sides/", 7);
    assert_int_equal(strlen(first), strlen("/sides//") + 2 * 16 + strlen("/mesa"));
    assert_null(strstr(first, "/0000000000000000/"));
    assert_string_equal(opened_in("toy@A=1", 1), first);
    setenv("RG_TEST_DRIVER", "second", 1);
    const char *second = opened_in("toy@A=1", 2);
    assert_memory_equal(second, first, strlen("/sides/") + 16); // of the same settings
    assert_string_not_equal(second, first);
    setenv("RG_TEST_BUILD", "2", 1);
    assert_string_not_equal(opened_in("toy@A=1", 2), second);
    setenv("RG_TEST_DRIVER", "first", 1);
    setenv("RG_TEST_BUILD", "1", 1);
    assert_string_equal(opened_in("toy@A=1", 2), first);
    assert_int_not_equal(memcmp(opened_in("toy@A=2", 2), first, strlen("/sides/") + 16), 0);
}

static void only_sides_have_folders(void **state)
{
    (void)state;
    static const char *const changing[] = {"GALLIVM_DEBUG", "GALLIVM_PERF",
                                           "LP_NATIVE_VECTOR_WIDTH", "LP_PERF"};
    assert_string_equal(opened_in("toy", 1), "");
    assert_string_equal(opened_in("cpu@A=1", 1), "");
    assert_string_equal(opened_in("toy@MESA_SHADER_CACHE_DIR=/mine", 2), "/mine");
    // Variables that change a driver's code, and are not in its key, make all of them sides, unless
    // the user says where code is kept.
    for (int i = 0; i < 4; i++) {
        setenv(changing[i], "1", 1);
        assert_memory_equal(opened_in("toy", 2), "/sides/", 7);
        setenv("MESA_SHADER_CACHE_DIR", "/mine", 1);
        assert_string_equal(opened_in("toy", 1), "/mine");
        unsetenv("MESA_SHADER_CACHE_DIR");
        unsetenv(changing[i]);
    }
    assert_string_equal(opened_in("toy", 1), "");
}

// It runs last, since there is no way back.
static void gates_make_every_device_a_side(void **state)
{
    (void)state;
    rg_sides_begin();
    assert_memory_equal(opened_in("toy", 2), "/sides/", 7);
    assert_string_equal(opened_in("cpu", 1), "");
}

// --- the driver that was named ---

static const char *make_prefix(const char *name)
{
    put_manifest(text_of("%s/share/vulkan/icd.d/a.json", name), "liba.so");
    put_text(text_of("%s/lib/liba.so", name), "code");
    return text_of("vulkan@DRIVER=%s", in_place(name));
}

static void a_driver_that_cannot_be_loaded_is_refused(void **state)
{
    (void)state;
    const char *name = make_prefix("bad");
    assert_null(rg_devices_open_one(name));
    assert_refused(RG_FAULT_SETUP,
                   text_of("device '%s': %s cannot be loaded: %s;; install the package", name,
                           in_place("bad/lib/liba.so"), in_place("bad/lib/liba.so")));
}

static void the_driver_that_runs_is_the_named_one(void **state)
{
    (void)state;
    const char *name = make_prefix("good");
    setenv("RG_TEST_LIBRARY", in_place("good/lib/liba.so"), 1);
    struct rg_device *device = rg_devices_open_one(text_of("new=%s", name));
    assert_non_null(device);
    assert_string_equal(device->info.name, "new");
    assert_string_equal(device->info.full, name);
    assert_true(rg_device_close(device));
    forget_lines();
    setenv("RG_TEST_LIBRARY", "/usr/lib/other.so", 1);
    assert_null(rg_devices_open_one(name));
    assert_int_equal(rg_failure_take().fault, RG_FAULT_INPUT);
    assert_non_null(strstr(logged, "its driver is /usr/lib/other.so, and not one of"));
}

int main(int argc, char **argv)
{
    if (argc == 3 && !strcmp(argv[1], RG_WORKER_ARGUMENT))
        return rg_serve(argv[2], services);
#define OF_SIDES(test) cmocka_unit_test_setup_teardown(test, begin, end_place)
    const struct CMUnitTest tests[] = {
        OF_SIDES(each_driver_of_a_side_has_its_folder),
        OF_SIDES(only_sides_have_folders),
        OF_SIDES(a_driver_that_cannot_be_loaded_is_refused),
        OF_SIDES(the_driver_that_runs_is_the_named_one),
        OF_SIDES(gates_make_every_device_a_side),
    };
    rg_workers.program = "/proc/self/exe";
    return cmocka_run_group_tests_name("sides", tests, NULL, NULL);
}
