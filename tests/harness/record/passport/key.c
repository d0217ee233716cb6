// A device's comparison key depends on some fields of its passport and ignores others.
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "harness/record/passport/origins.h"

static json_t *make_passport(void)
{
    return json_pack(
        "{s{ssssssss}s{sss[ss]sisisssnsssssssI}s{ssssss}}", "raingauge", "version", "0.1.0",
        "commit", "0123", "compiler", "gcc 12.2.0", "type", "release", "machine", "cpu",
        "Toy CPU @ 1.00GHz", "features", "avx2", "fma", "cores_online", 8, "cores_allowed", 4,
        "cores_list", "0-3", "quota_cpus", "kernel", "Linux 6.1.0-18-amd64 x86_64", "distribution",
        "Toy Linux 3", "clocks", "performance", "memory_bytes", (json_int_t)1 << 33, "environment",
        "LP_NUM_THREADS", "2", "RG_KERNEL_DIR", "/tmp/kernels", "VK_DRIVER_FILES", "/tmp/a.json");
}

static json_t *make_device(void)
{
    return json_pack("{sssssssssb}", "name", "gl", "api", "OpenGL 4.5 core", "device",
                     "llvmpipe (LLVM 15.0.6, 256 bits)", "driver", "Mesa 22.3.6", "software", 1);
}

// The key after one field has changed; without a field, the key as it is.
static void key_with(const char *group, const char *field, json_t *value, char key[RG_KEY_SIZE])
{
    json_t *passport = make_passport(), *device = make_device();
    if (field)
        json_object_set_new(strcmp(group, "device") ? json_object_get(passport, group) : device,
                            field, value);
    json_t *parts = rg_key_parts(passport, device);
    rg_key_hash(parts, key);
    json_decref(parts);
    json_decref(device);
    json_decref(passport);
}

static void assert_changes(bool changes, const char *group, const char *field, json_t *value)
{
    char key[RG_KEY_SIZE], other[RG_KEY_SIZE];
    key_with(NULL, NULL, NULL, key);
    key_with(group, field, value, other);
    assert_int_equal(strlen(key), 16);
    if ((strcmp(key, other) != 0) != changes)
        fail_msg("%s.%s: %s and %s", group, field, key, other);
}

// Sets the version of a library in a passport.
static void set_library(json_t *passport, const char *name, const char *version)
{
    json_t *build = json_object_get(passport, "raingauge");
    if (!json_object_get(build, "libraries"))
        json_object_set_new(build, "libraries", json_object());
    json_object_set_new(json_object_get(build, "libraries"), name, json_string(version));
}

static void libraries_that_differ_are_named(void **state)
{
    (void)state;
    json_t *now = make_passport(), *then = make_passport();
    char text[RG_KEY_TEXT] = "unset";
    set_library(now, "glibc", "2.41");
    rg_key_libraries(now, then, text); // an earlier program did not say
    assert_string_equal(text, "");
    set_library(then, "glibc", "2.36");
    set_library(now, "meshoptimizer", "0.22");
    set_library(then, "meshoptimizer", "0.22");
    rg_key_libraries(now, then, text);
    assert_string_equal(text, "glibc 2.41 and not 2.36");
    set_library(now, "meshoptimizer", "0.18");
    rg_key_libraries(now, then, text);
    assert_string_equal(text, "glibc 2.41 and not 2.36; meshoptimizer 0.18 and not 0.22");
    json_decref(now);
    json_decref(then);
}

static void what_speed_depends_on_changes_it(void **state)
{
    (void)state;
    assert_changes(true, "machine", "cpu", json_string("Toy CPU @ 2.00GHz"));
    assert_changes(true, "machine", "features", json_pack("[s]", "avx2"));
    assert_changes(true, "machine", "cores_allowed", json_integer(2));
    assert_changes(true, "machine", "quota_cpus", json_real(1.5));
    assert_changes(true, "machine", "clocks", json_string("powersave"));
    assert_changes(true, "machine", "kernel", json_string("Linux 6.1.0-20-amd64 x86_64"));
    assert_changes(true, "raingauge", "compiler", json_string("clang 14.0.6"));
    assert_changes(true, "raingauge", "type", json_string("debug"));
    assert_changes(true, "environment", "LP_NUM_THREADS", json_string("1"));
    assert_changes(true, "environment", "LP_NATIVE_VECTOR_WIDTH", json_string("128"));
    assert_changes(true, "device", "api", json_string("OpenGL 4.6 core"));
    assert_changes(true, "device", "device", json_string("llvmpipe (LLVM 16.0.0, 256 bits)"));
    assert_changes(true, "device", "driver", json_string("Mesa 23.1.0"));
}

static void what_else_changes_does_not(void **state)
{
    (void)state;
    assert_changes(false, "machine", "cpu", json_string("  Toy CPU   @ 1.00GHz "));
    assert_changes(false, "machine", "cores_list", json_string("4-7"));
    assert_changes(false, "machine", "cores_online", json_integer(16));
    assert_changes(false, "machine", "memory_bytes", json_integer(1));
    assert_changes(false, "machine", "distribution", json_string("Toy Linux 4"));
    assert_changes(false, "raingauge", "commit", json_string("4567-dirty"));
    assert_changes(false, "raingauge", "program", json_string("89ab"));
    assert_changes(false, "environment", "RG_KERNEL_DIR", json_string("/tmp/others"));
    assert_changes(false, "environment", "VK_DRIVER_FILES", json_string("/tmp/b.json"));
    assert_changes(false, "environment", "HOME", json_string("/tmp"));
    assert_changes(false, "device", "name", json_string("gl:0"));
}

// A slightly different quota is the same to a tenth of a CPU.
static void quotas_are_rounded(void **state)
{
    (void)state;
    char one[RG_KEY_SIZE], near[RG_KEY_SIZE], other[RG_KEY_SIZE];
    key_with("machine", "quota_cpus", json_real(1.5), one);
    key_with("machine", "quota_cpus", json_real(1.52), near);
    key_with("machine", "quota_cpus", json_real(1.6), other);
    assert_string_equal(one, near);
    assert_string_not_equal(one, other);
}

static void parts_are_told(void **state)
{
    (void)state;
    char text[RG_KEY_TEXT];
    json_t *passport = make_passport(), *device = make_device();
    json_t *now = rg_key_parts(passport, device);
    json_object_set_new(device, "driver", json_string("Mesa 21.0"));
    json_object_set_new(json_object_get(passport, "machine"), "clocks", json_string(""));
    json_t *then = rg_key_parts(passport, device);
    rg_key_difference(now, then, text);
    assert_string_equal(text,
                        "clocks performance and not unknown; driver Mesa 22.3.6 and not Mesa 21.0");
    rg_key_difference(now, now, text);
    assert_string_equal(text, "");
    rg_key_text(now, text);
    assert_string_equal(text,
                        "cpu Toy CPU @ 1.00GHz; features avx2 fma; cores 4; quota none; "
                        "clocks performance; kernel Linux 6.1.0-18-amd64 x86_64; compiler gcc "
                        "12.2.0, release; variables LP_NUM_THREADS=2; api OpenGL 4.5 core; "
                        "device llvmpipe (LLVM 15.0.6, 256 bits); driver Mesa 22.3.6");
    rg_key_text(then, text);
    assert_non_null(strstr(text, "; clocks unknown; "));
    json_decref(then);
    json_object_set_new(json_object_get(passport, "machine"), "quota_cpus", json_real(2.5));
    json_object_set_new(json_object_get(passport, "environment"), "OMP_PLACES", json_string("{0}"));
    then = rg_key_parts(passport, device);
    assert_string_equal(json_string_value(json_object_get(then, "quota")), "2.5 CPUs");
    assert_string_equal(json_string_value(json_object_get(then, "variables")),
                        "LP_NUM_THREADS=2 OMP_PLACES={0}");
    json_decref(then);
    json_decref(now);
    json_decref(device);
    json_decref(passport);
}

// A record's passport with some devices; `driver` is that of gl.
static json_t *passport_of(const char *cpu, const char *first, const char *second,
                           const char *driver)
{
    json_t *passport = make_passport(), *devices = json_array();
    for (int i = 0; i < 2; i++) {
        const char *name = i ? second : first;
        json_t *device = make_device();
        json_object_set_new(device, "name", json_string(name ? name : ""));
        if (name && !strcmp(name, "gl"))
            json_object_set_new(device, "driver", json_string(driver));
        if (name)
            json_array_append(devices, device);
        json_decref(device);
    }
    json_object_set_new(passport, "devices", devices);
    json_object_set_new(json_object_get(passport, "machine"), "cpu", json_string(cpu));
    return passport;
}

// Records are of one machine if no device that they share, nor the machine, has another key.
static void records_have_origins(void **state)
{
    (void)state;
    static const struct {
        const char *cpu, *first, *second, *driver;
        int origin;
    } rows[] = {{"Toy", "cpu", NULL, "", 0},          {"Toy", "cpu", "gl", "Mesa 22", 0},
                {"Toy", "gl", "cpu", "Mesa 25", 1},   {"Toy", "gl", NULL, "Mesa 25", 1},
                {"Toy", "vulkan", NULL, "", 0},       {"Other", "cpu", NULL, "", 2},
                {"Toy", NULL, NULL, "", 0},           {"Toy", "cpu", "gl", "Mesa 22", 0},
                {"Other", "cpu", "gl", "Mesa 22", 2}, {"Third", NULL, NULL, "", 3}};
    struct rg_origins origins = {0};
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        json_t *passport = passport_of(rows[i].cpu, rows[i].first, rows[i].second, rows[i].driver);
        const bool is_new = rows[i].origin == origins.count;
        assert_int_equal(rg_origins_known(&origins, passport), is_new ? -1 : rows[i].origin);
        assert_int_equal(rg_origins_find(&origins, passport), rows[i].origin);
        json_decref(passport);
    }
    char text[RG_KEY_TEXT], key[RG_KEY_SIZE];
    rg_origin_difference(&origins.all[1], &origins.all[0], text);
    assert_string_equal(text, "driver Mesa 25 and not Mesa 22");
    rg_origin_difference(&origins.all[2], &origins.all[0], text);
    assert_string_equal(text, "cpu Other and not Toy");
    assert_string_equal(origins.all[2].text, "Other, 4 cores");
    json_t *one = passport_of("Toy", "gl", NULL, "Mesa 22"), *device = make_device();
    json_object_set_new(device, "driver", json_string("Mesa 22"));
    json_t *parts = rg_key_parts(one, device);
    rg_key_hash(parts, key);
    rg_origin_key(one, text);
    assert_string_equal(text, key); // of an only device its own key
    assert_true(rg_key_is(key) && !rg_key_is("0123456789abcdeg") && !rg_key_is("0123456789abcde"));
    json_decref(parts);
    json_decref(device);
    json_decref(one);
    rg_origins_free(&origins);
}

// The key of several devices is of all of them; without any, the machine's.
static void keys_are_of_all_devices(void **state)
{
    (void)state;
    static const struct {
        const char *cpu, *first, *second, *driver;
    } rows[] = {{"Toy", NULL, NULL, ""},           {"Toy", "cpu", NULL, ""},
                {"Toy", "cpu", "gl", "Mesa 22"},   {"Toy", "cpu", "gl", "Mesa 25"},
                {"Other", "cpu", "gl", "Mesa 22"}, {"Other", NULL, NULL, ""}};
    enum { COUNT = sizeof(rows) / sizeof(rows[0]) };
    char keys[COUNT][RG_KEY_SIZE], key[RG_KEY_SIZE];
    for (int i = 0; i < COUNT; i++) {
        json_t *passport = passport_of(rows[i].cpu, rows[i].first, rows[i].second, rows[i].driver);
        rg_origin_key(passport, keys[i]);
        assert_true(rg_key_is(keys[i]));
        for (int k = 0; k < i; k++)
            assert_string_not_equal(keys[i], keys[k]);
        struct rg_origins origins = {0};
        assert_int_equal(rg_origins_find(&origins, passport), 0);
        assert_string_equal(origins.all[0].key, keys[i]);
        rg_origins_free(&origins);
        json_decref(passport);
    }
    json_t *passport = make_passport(), *host = rg_key_parts(passport, NULL);
    rg_key_hash(host, key);
    rg_origin_key(passport, keys[0]); // a record that lacks its devices
    assert_string_equal(keys[0], key);
    json_decref(host);
    json_decref(passport);
}

// A machine's key grows with the devices that its records bring; a part that differs on several
// devices is told once.
static void origins_gather_devices(void **state)
{
    (void)state;
    char text[RG_KEY_TEXT], key[RG_KEY_SIZE];
    struct rg_origins origins = {0}, others = {0};
    json_t *first = passport_of("Toy", "cpu", NULL, ""),
           *second = passport_of("", "gl", "cpu", "M");
    json_t *both = passport_of("Toy", "cpu", "gl", "Mesa 22.3.6");
    json_t *one = passport_of("Toy", "gl", NULL, "Mesa 22.3.6");
    rg_origin_key(both, key);
    assert_int_equal(rg_origins_find(&origins, first), 0);
    assert_int_equal(rg_origins_find(&origins, one), 0);
    assert_string_equal(origins.all[0].key, key);
    json_t *device = json_array_get(json_object_get(second, "devices"), 1);
    json_object_set_new(device, "driver", json_string("M"));
    json_object_set_new(device, "api", json_string("C11"));
    assert_int_equal(rg_origins_find(&others, second), 0);
    assert_string_equal(others.all[0].text, "unknown processor, 4 cores");
    rg_origin_difference(&origins.all[0], &others.all[0], text);
    assert_string_equal(text, "cpu Toy and not unknown; api OpenGL 4.5 core and not C11; driver "
                              "Mesa 22.3.6 and not M");
    rg_origin_difference(&origins.all[0], &origins.all[0], text);
    assert_string_equal(text, "");
    json_decref(first);
    json_decref(second);
    json_decref(both);
    json_decref(one);
    rg_origins_free(&origins);
    rg_origins_free(&others);
}

static void origins_have_names(void **state)
{
    (void)state;
    static const struct {
        int origin;
        const char *name;
    } rows[] = {{0, "A"}, {25, "Z"}, {26, "AA"}, {27, "AB"}, {51, "AZ"}, {52, "BA"}, {702, "AAA"}};
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        char name[RG_ORIGIN_NAME];
        rg_origin_name(rows[i].origin, name);
        assert_string_equal(name, rows[i].name);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_speed_depends_on_changes_it),
        cmocka_unit_test(what_else_changes_does_not),
        cmocka_unit_test(quotas_are_rounded),
        cmocka_unit_test(parts_are_told),
        cmocka_unit_test(libraries_that_differ_are_named),
        cmocka_unit_test(records_have_origins),
        cmocka_unit_test(keys_are_of_all_devices),
        cmocka_unit_test(origins_gather_devices),
        cmocka_unit_test(origins_have_names),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
