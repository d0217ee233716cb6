// DRIVER=PREFIX: which drivers are found in a folder, and which variables make loaders use them.
#include "harness/devices/drivers/prefix.h"

#include <elf.h>

#include "harness/devices/drivers/manifest.h"
#include "tests/harness/devices/drivers/place.h"

static struct rg_prefix prefix;

// --- finding ---

// Where a manifest is, the library that it names, and where that is.
static const struct layout {
    const char *api, *manifest, *named, *library;
} layouts[] = {
    {"vulkan", "usr/share/vulkan/icd.d/a.json", "liba.so", "usr/lib/x86_64-linux-gnu/liba.so"},
    {"vulkan", "usr/local/share/vulkan/icd.d/a.json", "liba.so",
     "usr/local/lib/arm-linux-x/liba.so"},
    {"vulkan", "share/vulkan/icd.d/a.json", "/usr/local/lib/liba.so", "lib64/liba.so"},
    {"vulkan", "etc/vulkan/icd.d/a.json", "/usr/lib/liba.so", "usr/lib/liba.so"},
    {"vulkan", "etc/vulkan/icd.d/a.json", "/opt/x/liba.so", "opt/x/liba.so"},
    {"vulkan", "src/amd/vulkan/a_devenv_icd.x86_64.json", "./liba.so", "src/amd/vulkan/liba.so"},
    {"vulkan", "src/gallium/targets/lvp/l_devenv_icd.x.json", "liba.so",
     "src/gallium/targets/lvp/liba.so"},
    {"gl", "usr/share/glvnd/egl_vendor.d/50.json", "liba.so", "usr/lib64/liba.so"},
    {"gl", "usr/local/share/glvnd/egl_vendor.d/50.json", "liba.so", "usr/local/lib64/liba.so"},
    {"gl", "share/glvnd/egl_vendor.d/50.json", "liba.so", "lib/x86_64-linux-gnu/liba.so"},
    {"gl", "etc/glvnd/egl_vendor.d/50.json", "liba.so", "lib/liba.so"},
    {"gl", "src/egl/50.json", "liba.so", "src/egl/liba.so"},
    {"opencl", "etc/OpenCL/vendors/a.icd", "liba.so", "usr/local/lib/liba.so"},
    {"opencl", "usr/etc/OpenCL/vendors/a.icd", "liba.so", "usr/lib/liba.so"},
    {"opencl", "src/gallium/targets/cl/a.icd", "liba.so", "src/gallium/targets/cl/liba.so"},
};

static void a_driver_is_found_in_each_form_of_folder(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof(layouts) / sizeof(layouts[0]); i++) {
        const struct layout *l = &layouts[i];
        const char *root = text_of("%d", (int)i);
        put_manifest(text_of("%s/%s", root, l->manifest), l->named);
        put_text(text_of("%s/%s", root, l->library), "code");
        if (!rg_prefix_read("new", l->api, in_place(root), &prefix))
            fail_msg("%s: %s", l->manifest, logged);
        assert_string_equal(prefix.path, in_place(root));
        assert_int_equal(prefix.driver_count, 1);
        assert_string_equal(prefix.drivers[0].api, l->api);
        assert_string_equal(prefix.drivers[0].manifest,
                            in_place(text_of("%s/%s", root, l->manifest)));
        assert_string_equal(prefix.drivers[0].library,
                            in_place(text_of("%s/%s", root, l->library)));
    }
    assert_int_equal(lines, 0);
}

// The folder of the machine's processor comes before the common one, as in the dynamic linker.
static void the_first_folder_with_the_library_counts(void **state)
{
    (void)state;
    put_manifest("usr/share/vulkan/icd.d/a.json", "liba.so");
    put_text("usr/lib/liba.so", "code");
    put_text("usr/lib/x86_64-linux-gnu/liba.so", "code");
    put_text("lib64", "a file, and no folder");
    assert_true(rg_prefix_read("new", "vulkan", place, &prefix));
    assert_int_equal(prefix.folder_count, 2);
    assert_string_equal(prefix.folders[0], in_place("usr/lib/x86_64-linux-gnu"));
    assert_string_equal(prefix.folders[1], in_place("usr/lib"));
    assert_string_equal(prefix.drivers[0].library, in_place("usr/lib/x86_64-linux-gnu/liba.so"));
    // The library at the named place counts before all folders.
    put_manifest("usr/share/vulkan/icd.d/a.json", "/usr/lib/liba.so");
    assert_true(rg_prefix_read("new", "vulkan", place, &prefix));
    assert_string_equal(prefix.drivers[0].library, in_place("usr/lib/liba.so"));
}

static void egl_needs_no_manifest(void **state)
{
    (void)state;
    put_text("lib/libEGL.so.1", "code");
    assert_true(rg_prefix_read("new", "gl", place, &prefix));
    assert_int_equal(prefix.driver_count, 1);
    assert_string_equal(prefix.drivers[0].manifest, "");
    assert_string_equal(prefix.drivers[0].library, in_place("lib/libEGL.so.1"));
    put_text("lib/libEGL_mesa.so.0", "code");
    assert_true(rg_prefix_read("new", "gl", place, &prefix));
    assert_int_equal(prefix.driver_count, 1);
    assert_string_equal(prefix.drivers[0].library, in_place("lib/libEGL_mesa.so.0"));
    put_manifest("share/glvnd/egl_vendor.d/50.json", "libEGL_other.so.0");
    put_text("lib/libEGL_other.so.0", "code");
    assert_true(rg_prefix_read("new", "gl", place, &prefix));
    assert_int_equal(prefix.driver_count, 1);
    assert_string_equal(prefix.drivers[0].library, in_place("lib/libEGL_other.so.0"));
}

// --- refusals ---

static void refuse(const char *api, const char *path, enum rg_fault fault, const char *says)
{
    assert_false(rg_prefix_read("new", api, path, &prefix));
    assert_refused(fault, says);
}

static void what_has_no_driver_of_the_api_is_refused(void **state)
{
    (void)state;
    const char *file = put_text("file", "");
    const unsigned char other = EM_RISCV;
    refuse("vulkan", in_place("none"), RG_FAULT_INPUT, "is no folder");
    refuse("vulkan", file, RG_FAULT_INPUT, text_of("DRIVER=%s is no folder", file));
    refuse("vulkan", place, RG_FAULT_NONE,
           "has no driver of vulkan, which has a file share/vulkan");
    refuse("gl", place, RG_FAULT_NONE, "has no driver of gl, which has libEGL_mesa.so.0 among");
    refuse("opencl", place, RG_FAULT_NONE, "has no driver of opencl, which has a file etc/OpenCL");
    // A driver of another API changes nothing of that, whether it is sound or not.
    put_manifest("etc/OpenCL/vendors/a.icd", "libcl.so");
    const char *foreign = put_library("usr/lib/libcl.so", offsetof(Elf64_Ehdr, e_machine), other);
    refuse("vulkan", place, RG_FAULT_NONE, "has no driver of vulkan");
    refuse("opencl", place, RG_FAULT_INPUT,
           text_of("device 'new': %s is for another processor", foreign));
    const char *lacking = put_manifest("usr/share/vulkan/icd.d/a.json", "libnone.so");
    refuse("vulkan", place, RG_FAULT_NONE,
           text_of("'new': %s names a library that is not", lacking));
    const char *empty = put_text("usr/share/vulkan/icd.d/b.json", "{}");
    refuse("vulkan", place, RG_FAULT_NONE, text_of("'new': %s names a library that is not", empty));
    refuse("gl", place, RG_FAULT_NONE, "has no driver of gl");
    // A library elsewhere is not the folder's; one of another API is no driver either.
    const char *outside = put_text("outside/liba.so", "code");
    const char *strayed = put_manifest("in/usr/share/vulkan/icd.d/a.json", outside);
    refuse("vulkan", in_place("in"), RG_FAULT_NONE,
           text_of("'new': %s names a library that is not", strayed));
    put_text("in/lib/liba.so", "code");
    assert_true(rg_prefix_read("new", "vulkan", in_place("in"), &prefix));
    assert_string_equal(prefix.drivers[0].library, in_place("in/lib/liba.so"));
    refuse("opencl", in_place("in"), RG_FAULT_NONE, "has no driver of opencl");
}

// --- variables ---

static const char *value_of(const struct rg_worker_variables *variables, const char *key)
{
    const char *value = rg_variables_find(variables, key);
    return value ? value : "(none)";
}

static void expect_copy(const char *copy, const char *library)
{
    struct rg_manifest m;
    rg_manifest_read(in_place(copy), &m);
    assert_int_equal(m.fault, RG_MANIFEST_WELL);
    assert_string_equal(m.library, in_place(library));
}

// The loaders get copies of manifests, because those in the folder name libraries elsewhere.
static void loaders_use_the_folder_alone(void **state)
{
    (void)state;
    struct rg_worker_variables variables = {.text = NULL};
    put_manifest("mesa/share/vulkan/icd.d/a.json", "liba.so");
    put_manifest("mesa/share/vulkan/icd.d/b.json", "libb.so");
    put_manifest("mesa/share/glvnd/egl_vendor.d/50.json", "libegl.so");
    put_manifest("mesa/etc/OpenCL/vendors/c.icd", "libc.so");
    static const char *const libraries[] = {"liba.so", "libb.so", "libegl.so", "libc.so",
                                            "dri/x_dri.so"};
    for (int i = 0; i < 5; i++)
        put_text(text_of("mesa/lib64/%s", libraries[i]), "code");
    put_text("mesa/lib/dri/y_dri.so", "code"); // the first folder counts
    put_text("mesa/lib/gbm/dri_gbm.so", "code");
    put_text("copies/empty", "");
    assert_true(rg_prefix_read("new", "gl", in_place("mesa"), &prefix));
    assert_true(rg_variables_set(&variables, "LD_LIBRARY_PATH", "/before"));
    assert_true(rg_prefix_set(&prefix, in_place("copies"), &variables));
    const char *vulkan =
        text_of("%s:%s", in_place("copies/vulkan-00-a.json"), in_place("copies/vulkan-01-b.json"));
    assert_string_equal(value_of(&variables, "VK_DRIVER_FILES"), vulkan);
    assert_string_equal(value_of(&variables, "VK_ICD_FILENAMES"), vulkan);
    assert_string_equal(value_of(&variables, "__EGL_VENDOR_LIBRARY_FILENAMES"),
                        in_place("copies/gl-02-50.json"));
    assert_string_equal(value_of(&variables, "OCL_ICD_VENDORS"), in_place("copies"));
    assert_string_equal(value_of(&variables, "OCL_ICD_FILENAMES"), "");
    assert_string_equal(value_of(&variables, "LD_LIBRARY_PATH"),
                        text_of("%s:%s:/before", in_place("mesa/lib64"), in_place("mesa/lib")));
    assert_string_equal(value_of(&variables, "LIBGL_DRIVERS_PATH"), in_place("mesa/lib64/dri"));
    assert_string_equal(value_of(&variables, "GBM_BACKENDS_PATH"), in_place("mesa/lib/gbm"));
    expect_copy("copies/vulkan-00-a.json", "mesa/lib64/liba.so");
    expect_copy("copies/vulkan-01-b.json", "mesa/lib64/libb.so");
    expect_copy("copies/gl-02-50.json", "mesa/lib64/libegl.so");
    expect_copy("copies/opencl-03-c.icd", "mesa/lib64/libc.so");
    rg_variables_free(&variables);
}

// Mesa's EGL without a manifest gets one; a libEGL that is the driver itself needs none.
static void a_vendor_of_egl_gets_a_manifest(void **state)
{
    (void)state;
    static const char *const libraries[] = {"libEGL_mesa.so.0", "libEGL.so.1"};
    for (int i = 0; i < 2; i++) {
        struct rg_worker_variables variables = {.text = NULL};
        put_text(text_of("%d/lib/%s", i, libraries[i]), "code");
        put_text("copies/empty", "");
        assert_true(rg_prefix_read("new", "gl", in_place(text_of("%d", i)), &prefix));
        assert_true(rg_prefix_set(&prefix, in_place("copies"), &variables));
        assert_string_equal(value_of(&variables, "__EGL_VENDOR_LIBRARY_FILENAMES"),
                            i ? "(none)" : in_place("copies/gl-00-raingauge.json"));
        assert_string_equal(value_of(&variables, "LD_LIBRARY_PATH"),
                            in_place(text_of("%d/lib", i)));
        assert_string_equal(value_of(&variables, "VK_DRIVER_FILES"), "(none)");
        assert_string_equal(value_of(&variables, "OCL_ICD_VENDORS"), "(none)");
        assert_string_equal(value_of(&variables, "LIBGL_DRIVERS_PATH"), "(none)");
        rg_variables_free(&variables);
    }
    expect_copy("copies/gl-00-raingauge.json", "0/lib/libEGL_mesa.so.0");
}

static void copies_need_a_folder(void **state)
{
    (void)state;
    struct rg_worker_variables variables = {.text = NULL};
    put_manifest("mesa/share/vulkan/icd.d/a.json", "liba.so");
    put_text("mesa/lib/liba.so", "code");
    assert_true(rg_prefix_read("new", "vulkan", in_place("mesa"), &prefix));
    assert_false(rg_prefix_set(&prefix, in_place("none"), &variables));
    assert_refused(RG_FAULT_INPUT, "none/vulkan-00-a.json: cannot be written");
    rg_variables_free(&variables);
}

int main(void)
{
    static const char *const variables[] = {
        "VK_DRIVER_FILES",    "VK_ICD_FILENAMES",  "__EGL_VENDOR_LIBRARY_FILENAMES",
        "OCL_ICD_VENDORS",    "OCL_ICD_FILENAMES", "LD_LIBRARY_PATH",
        "LIBGL_DRIVERS_PATH", "GBM_BACKENDS_PATH"};
    for (size_t i = 0; i < sizeof(variables) / sizeof(variables[0]); i++)
        unsetenv(variables[i]);
    const struct CMUnitTest tests[] = {
        IN_A_PLACE(a_driver_is_found_in_each_form_of_folder),
        IN_A_PLACE(the_first_folder_with_the_library_counts),
        IN_A_PLACE(egl_needs_no_manifest),
        IN_A_PLACE(what_has_no_driver_of_the_api_is_refused),
        IN_A_PLACE(loaders_use_the_folder_alone),
        IN_A_PLACE(a_vendor_of_egl_gets_a_manifest),
        IN_A_PLACE(copies_need_a_folder),
    };
    return cmocka_run_group_tests_name("prefixes", tests, NULL, NULL);
}
