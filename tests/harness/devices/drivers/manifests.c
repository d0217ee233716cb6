// Manifests: what is read of them, what a copy holds, and where they are installed.
#include "harness/devices/drivers/manifest.h"

#include <elf.h>
#include <unistd.h>

#include "tests/harness/devices/drivers/place.h"

// --- reading ---

static void a_manifest_names_a_library(void **state)
{
    (void)state;
    put_text("lib/libhere.so", "code");
    const struct {
        const char *name, *text;
        enum rg_manifest_fault fault;
        const char *named, *library; // of the library, from the place on unless it is bare
        bool is_bare;
    } rows[] = {
        {"d/a.json", "{\"ICD\": {\"library_path\": \"libany.so.1\"}}", RG_MANIFEST_WELL,
         "libany.so.1", "libany.so.1", true},
        {"d/b.json", "{\"ICD\": {\"library_path\": \"../lib/libhere.so\"}}", RG_MANIFEST_WELL,
         "../lib/libhere.so", "/d/../lib/libhere.so", false},
        {"d/c.json", "{\"ICD\": {\"library_path\": \"./libhere.so\"}}", RG_MANIFEST_NO_LIBRARY,
         "./libhere.so", "/d/./libhere.so", false},
        {"d/d.icd", "libany.so.1 \n", RG_MANIFEST_WELL, "libany.so.1", "libany.so.1", true},
        {"d/e.json", "libany.so.1\n", RG_MANIFEST_NO_FORM, "", "", false},
        {"d/f.icd", "\n", RG_MANIFEST_NO_FORM, "", "", false},
        {"d/g.json", "{\"ICD\": {}}", RG_MANIFEST_NO_FORM, "", "", false},
        {"d/icd", "{\"ICD\": {\"library_path\": \"libany.so.1\"}}", RG_MANIFEST_WELL, "libany.so.1",
         "libany.so.1", true},
    };
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        struct rg_manifest m;
        const char *path = put_text(rows[i].name, rows[i].text);
        rg_manifest_read(path, &m);
        assert_string_equal(m.path, path);
        if (m.fault != rows[i].fault || m.is_bare != rows[i].is_bare)
            fail_msg("%s: fault %d, bare %d", rows[i].name, (int)m.fault, m.is_bare);
        assert_string_equal(m.named, rows[i].named);
        assert_string_equal(m.library, *rows[i].library == '/'
                                           ? text_of("%s%s", place, rows[i].library)
                                           : rows[i].library);
    }
}

static void a_whole_path_is_the_library_s(void **state)
{
    (void)state;
    struct rg_manifest m;
    const char *library = put_text("lib/libhere.so", "code");
    rg_manifest_read(put_manifest("a.json", library), &m);
    assert_int_equal(m.fault, RG_MANIFEST_WELL);
    assert_string_equal(m.library, library);
    assert_false(m.is_bare);
    rg_manifest_read(put_manifest("b.icd", text_of("%s.1", library)), &m);
    assert_int_equal(m.fault, RG_MANIFEST_NO_LIBRARY);
    rg_manifest_read(in_place("none.json"), &m);
    assert_int_equal(m.fault, RG_MANIFEST_ABSENT);
    assert_string_equal(m.path, in_place("none.json"));
}

// --- writing ---

static const char *content_of(const char *path)
{
    static char text[1024];
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    text[fread(text, 1, sizeof(text) - 1, file)] = 0;
    fclose(file);
    return text;
}

// All that a loader reads besides the library stays as it is.
static void a_copy_has_another_library(void **state)
{
    (void)state;
    struct rg_manifest m;
    const char *copy = in_place("copy.json");
    rg_manifest_read(put_manifest("a.json", "libany.so.1"), &m);
    assert_true(rg_manifest_write(&m, "/opt/lib/libother.so", copy));
    json_t *json = json_load_file(copy, 0, NULL), *icd = json_object_get(json, "ICD");
    assert_string_equal(json_string_value(json_object_get(icd, "library_path")),
                        "/opt/lib/libother.so");
    assert_string_equal(json_string_value(json_object_get(icd, "api_version")), "1.1.0");
    assert_string_equal(json_string_value(json_object_get(json, "file_format_version")), "1.0.1");
    json_decref(json);
    rg_manifest_read(put_manifest("a.icd", "libany.so.1"), &m);
    assert_true(rg_manifest_write(&m, "/opt/lib/libother.so", in_place("copy.icd")));
    assert_string_equal(content_of(in_place("copy.icd")), "/opt/lib/libother.so\n");
    // A library without a manifest gets one.
    assert_true(rg_manifest_write(&(struct rg_manifest){.path = "raingauge.json"},
                                  "/opt/lib/libother.so", in_place("made.json")));
    rg_manifest_read(in_place("made.json"), &m);
    assert_string_equal(m.named, "/opt/lib/libother.so");
    assert_non_null(
        strstr(content_of(in_place("made.json")), "\"file_format_version\": \"1.0.0\""));
    assert_int_equal(lines, 0);
}

static ino_t file_at(const char *path)
{
    struct stat what;
    assert_int_equal(stat(path, &what), 0);
    return what.st_ino;
}

// Another process may be reading the file, which is replaced as a whole and only if it changes.
static void a_copy_that_is_there_stays(void **state)
{
    (void)state;
    struct rg_manifest m;
    const char *copy = in_place("copies/copy.json");
    put_text("copies/empty", "");
    rg_manifest_read(put_manifest("a.json", "libany.so.1"), &m);
    assert_true(rg_manifest_write(&m, "/opt/a.so", copy));
    const ino_t first = file_at(copy);
    FILE *reader = fopen(copy, "r"); // keeps the number from being used again
    assert_true(rg_manifest_write(&m, "/opt/a.so", copy));
    assert_int_equal(file_at(copy), first);
    assert_true(rg_manifest_write(&m, "/opt/b.so", copy));
    assert_int_not_equal(file_at(copy), first);
    assert_non_null(strstr(content_of(copy), "/opt/b.so"));
    fclose(reader);
    assert_int_equal(access(text_of("%s.%d", copy, (int)getpid()), F_OK), -1);
    assert_int_equal(lines, 0);
    assert_false(rg_manifest_write(&m, "/opt/b.so", in_place("none/copy.json")));
    assert_refused(RG_FAULT_INPUT, text_of("%s: cannot be written", in_place("none/copy.json")));
}

// --- places ---

static void a_tree_is_told_from_its_manifest(void **state)
{
    (void)state;
    static const char *const rows[][2] = {
        {"/opt/mesa/usr/share/vulkan/icd.d/a.json", "/opt/mesa"},
        {"/opt/mesa/usr/local/share/vulkan/icd.d/a.json", "/opt/mesa"},
        {"/opt/mesa/share/vulkan/icd.d/a.json", "/opt/mesa"},
        {"/opt/mesa/etc/vulkan/icd.d/a.json", "/opt/mesa"},
        {"/opt/mesa/usr/share/glvnd/egl_vendor.d/a.json", "/opt/mesa"},
        {"/opt/mesa/etc/OpenCL/vendors/a.icd", "/opt/mesa"},
        {"/opt/mesa/usr/etc/OpenCL/vendors/a.icd", "/opt/mesa"},
        {"/opt/mesa/usr/vulkan/icd.d/a.json", "/opt/mesa"},
        {"/opt/mesa/usr/share/vulkan/icd.data/a.json", ""},
        {"/opt/mesa/usr/share/vulkan/a.json", ""},
        {"/a.json", ""},
    };
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        char tree[PATH_MAX];
        put_text(rows[i][0] + 1, "");
        rg_manifest_tree(text_of("%s%s", place, rows[i][0]), tree);
        const char *due = *rows[i][1] ? text_of("%s%s", place, rows[i][1]) : "";
        if (strcmp(tree, due) != 0)
            fail_msg("%s is of '%s'", rows[i][0], tree);
        rg_manifest_tree(text_of("%s/none%s", place, rows[i][0]), tree);
        assert_string_equal(tree, "");
    }
}

static void a_path_is_below_a_folder(void **state)
{
    (void)state;
    put_text("opt/mesa/lib/a.so", "");
    put_text("opt/mesa2/a.so", "");
    assert_int_equal(symlink(in_place("opt/mesa"), in_place("link")), 0);
    assert_true(rg_path_is_below(in_place("opt/mesa/lib/a.so"), in_place("opt/mesa")));
    assert_true(rg_path_is_below(in_place("opt/mesa/lib/a.so"), in_place("opt/mesa/")));
    assert_true(rg_path_is_below(in_place("opt/mesa/lib/a.so"), in_place("link")));
    assert_true(rg_path_is_below(in_place("opt/mesa/lib/a.so"), "/"));
    assert_false(rg_path_is_below(in_place("opt/mesa2/a.so"), in_place("opt/mesa")));
    assert_false(rg_path_is_below(in_place("opt/mesa"), in_place("opt/mesa")));
    assert_false(rg_path_is_below(in_place("opt/mesa/lib/a.so"), in_place("opt/none")));
    assert_false(rg_path_is_below(in_place("opt"), in_place("opt/mesa")));
}

static void a_library_is_of_a_processor(void **state)
{
    (void)state;
    const size_t machine = offsetof(Elf64_Ehdr, e_machine);
    assert_false(rg_library_is_foreign("/proc/self/exe"));
    assert_true(rg_library_is_foreign(put_library("a.so", machine, EM_RISCV)));
    assert_true(rg_library_is_foreign(put_library("b.so", EI_CLASS, ELFCLASS32)));
    // The dynamic linker tells of files that are no libraries.
    assert_false(rg_library_is_foreign(put_library("c.so", EI_MAG0, 'x')));
    unsigned char noise[256];
    memset(noise, 'x', sizeof(noise));
    assert_false(rg_library_is_foreign(put_bytes("d.so", noise, sizeof(noise))));
    assert_false(rg_library_is_foreign(put_text("e.so", "text")));
    assert_false(rg_library_is_foreign(in_place("none.so")));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_A_PLACE(a_manifest_names_a_library),       IN_A_PLACE(a_whole_path_is_the_library_s),
        IN_A_PLACE(a_copy_has_another_library),       IN_A_PLACE(a_copy_that_is_there_stays),
        IN_A_PLACE(a_tree_is_told_from_its_manifest), IN_A_PLACE(a_path_is_below_a_folder),
        IN_A_PLACE(a_library_is_of_a_processor),
    };
    return cmocka_run_group_tests_name("manifests", tests, NULL, NULL);
}
