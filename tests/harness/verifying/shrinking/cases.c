// Cases as files: what is written is read back, what is no case is refused by its line, and the
// user's own files go along.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/base/log.h"
#include "harness/compare/shrink/case.h"
#include "harness/compare/shrink/files.h"
#include "tests/tools/expect.h"
#include "tests/tools/instance.h"
#include "tests/tools/process/folder.h"

static char path[64];

static const struct rg_case other_bits = {.run.frames = 3,
                                          .stages_run = 17,
                                          .stage = "raster_quads",
                                          .asset = "target",
                                          .difference = RG_DIFFERENCE_LAST_BITS,
                                          .expected = 0xab,
                                          .found = 0xfedcba9876543210,
                                          .device = "vulkan@A=x y",
                                          .truth = "cpu:reference"};

static void write_text(const char *to, const char *text)
{
    FILE *file = fopen(to, "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
}

// The caller frees it.
static char *read_text(const char *from)
{
    FILE *file = fopen(from, "r");
    if (!file)
        fail_msg("%s is not there", from);
    char *text = calloc(1, 4096);
    assert_non_null(text);
    assert_at_most(fread(text, 1, 4095, file), 4095);
    fclose(file);
    return text;
}

// Writes a case of a technique with these settings, and reads it back: every parameter has the same
// value. The caller frees both cases.
static void write_and_read(struct rg_case *c, const char *technique, const char *base,
                           const char *more, struct rg_case *read)
{
    const struct rg_param_table *table = rg_technique_find(technique)->params;
    c->run.subject = (struct rg_subject){rg_technique_find(technique),
                                         settings_of(technique, base, more), 96, 64};
    assert_true(rg_case_write(c, "a note", path));
    assert_true(rg_case_read(path, read));
    assert_ptr_equal(read->run.subject.technique, c->run.subject.technique);
    for (int i = 0; i < table->count; i++) {
        char due[RG_PATH_SIZE], found[RG_PATH_SIZE];
        rg_params_text(&table->rows[i], c->run.subject.settings, due, sizeof(due));
        rg_params_text(&table->rows[i], read->run.subject.settings, found, sizeof(found));
        if (table->rows[i].kind != RG_PARAM_FILE || !rg_file_is_own(due))
            assert_string_equal(found, due);
    }
}

static void what_is_written_is_read(void **state)
{
    (void)state;
    struct rg_case c = other_bits, read;
    write_and_read(&c, "raster", "scene=mesh model=torus", "share=0.25 view=7", &read);
    assert_int_equal(read.run.subject.width, 96);
    assert_int_equal(read.run.subject.height, 64);
    assert_int_equal(read.run.frames, 3);
    assert_int_equal(read.stages_run, 17);
    assert_string_equal(read.stage, "raster_quads");
    assert_string_equal(read.asset, "target");
    assert_int_equal(read.difference, RG_DIFFERENCE_LAST_BITS);
    assert_int_equal(read.fall.outcome, RG_OK);
    assert_true(read.expected == 0xab && read.found == 0xfedcba9876543210);
    assert_string_equal(read.device, "vulkan@A=x y");
    assert_string_equal(read.truth, "cpu:reference");
    char *text = read_text(path);
    assert_string_equal(
        text, "# A difference between two devices: raingauge render --case FILE --device D\n"
              "# a note\ntechnique raster\nsize 96x64\nframes 3\nset scene=mesh\nset share=0.25\n"
              "set model=torus\nset view=7\nbehind 17\nstage raster_quads\nasset target\n"
              "class last-bits\nexpected 00000000000000ab\nfound fedcba9876543210\n"
              "truth cpu:reference\ndevice vulkan@A=x y\n");
    free(text);
    rg_case_free(&c);
    rg_case_free(&read);
    assert_null(read.run.subject.settings);
}

// A failure, of a run that opening began.
static void a_failure_is_written_and_read(void **state)
{
    (void)state;
    struct rg_case c = other_bits, read;
    c.difference = RG_DIFFERENCE_NONE;
    c.fall = (struct rg_fall){RG_TIMEOUT, "while running kernel 'raster_mesh'"};
    c.stage[0] = 0;
    c.stages_run = c.run.frames = 0;
    write_and_read(&c, "raster", "", "", &read);
    assert_int_equal(read.run.frames, 0);
    assert_int_equal(read.stages_run, 0);
    assert_string_equal(read.stage, "-");
    assert_int_equal(read.difference, RG_DIFFERENCE_NONE);
    assert_int_equal(read.fall.outcome, RG_TIMEOUT);
    assert_string_equal(read.fall.what, "while running kernel 'raster_mesh'");
    assert_true(read.found == 0);
    rg_case_free(&c);
    rg_case_free(&read);
}

// A preset stands first, since it sets other parameters; one of these, set back to its own default,
// is written too.
static void a_preset_comes_first(void **state)
{
    (void)state;
    struct rg_case c = other_bits, read;
    void *defaults = rg_settings_create(rg_technique_find("cartoon"));
    const struct rg_param *drops = rg_params_find(rg_technique_find("cartoon")->params, "drops_s");
    char more[64] = "drops_s=";
    rg_params_text(drops, defaults, more + strlen(more), sizeof(more) - strlen(more));
    write_and_read(&c, "cartoon", "preset=table", more, &read);
    char *text = read_text(path);
    const char *preset = strstr(text, "\nset preset=table\n"), *back = strstr(text, more);
    assert_non_null(preset);
    assert_non_null(back);
    assert_true(preset < back);
    assert_null(strstr(text, "scene=")); // the preset says it
    free(text);
    free(defaults);
    rg_case_free(&c);
    rg_case_free(&read);
}

// --- what is no case ---

static const char CASE[] = "technique raster\nsize 96x64\nframes 3\nbehind 17\nstage raster_quads\n"
                           "asset target\nclass last-bits\nexpected 00000000000000ab\n"
                           "found 00000000000000ac\ntruth cpu:reference\ndevice vulkan\n";

// Reads the case with a line that begins with this word replaced.
static bool read_with(const char *word, const char *line, struct rg_case *c)
{
    char text[2048];
    const char *at = strstr(CASE, word), *end = strchr(at, '\n');
    snprintf(text, sizeof(text), "%.*s%s%s", (int)(at - CASE), CASE, line, end);
    write_text(path, text);
    return rg_case_read(path, c);
}

static const struct {
    const char *word, *line;
    bool is_read;
} limits[] = {
    {"size", "size 16384x1", true},
    {"size", "size 1x16384", true},
    {"size", "size 16385x1", false},
    {"size", "size 1x16385", false},
    {"size", "size 0x5", false},
    {"size", "size 5x0", false},
    {"size", "size 5x", false},
    {"size", "size 5x5x5", false},
    {"size", "size 5 x 5", false},
    {"size", "size -1x5", false},
    {"frames", "frames 0", true},
    {"frames", "frames 10000000", true},
    {"frames", "frames -1", false},
    {"frames", "frames 10000001", false},
    {"frames", "frames 3x", false},
    {"behind", "behind 0", true},
    {"behind", "behind -1", false},
    {"expected", "expected 00000000000000aB", false},
    {"expected", "expected 0ab", false},
    {"expected", "expected 00000000000000abx", false},
    {"found", "found 000000000000000ac", false},
    {"found", "found fffffffffffffffe", true},
    {"class", "class edge", true},
    {"class", "class none", false},
    {"class", "class ok", false},
    {"class", "class fail", false},
    {"class", "class crash\nfails while it ran", true},
    {"class", "class error\nfails so", true},
    {"class", "class crash", false},
    {"class", "class edge\nfails so", false},
    {"technique", "technique rasters", false},
    {"technique", "technique raster\ntechnique raster", false},
    {"stage", "stage", false},
    {"device", "device", false},
    {"truth", "# nothing", false},
    {"expected", "# nothing", false},
    {"size", "# nothing", false},
    {"frames", "frames 3\n\n  # nothing", true},
};

static void lines_have_their_limits(void **state)
{
    (void)state;
    rg_log_hold(true);
    for (size_t i = 0; i < sizeof(limits) / sizeof(limits[0]); i++) {
        struct rg_case c;
        if (read_with(limits[i].word, limits[i].line, &c) != limits[i].is_read)
            fail_msg("%s: %s", limits[i].line, rg_last_error());
        rg_case_free(&c);
    }
    rg_log_hold(false);
}

static void a_wrong_line_is_named(void **state)
{
    (void)state;
    static const struct {
        const char *word, *line, *says;
    } cases[] = {
        {"size", "size 0x5",
         "line 2: size '0x5' is no value of a case here; write one anew with "
         "`raingauge shrink`"},
        {"frames", "frame 3",
         "line 3: 'frame' is no line of a case here; write one anew with "
         "`raingauge shrink`"},
        {"frames", "frames -1",
         "line 3: frames '-1' is no value of a case here; write one anew "
         "with `raingauge shrink`"},
        {"behind", "set scene=quads\nset scene=mesh",
         "line 5: 'scene' is set twice; leave one out"},
        {"behind", "set share=2", "line 4: parameter 'share'"},
        {"asset", "asset a\nasset b", "line 7: 'asset' is there twice; leave one out"},
        {"behind", "file model=a.obj", "line 4: "},
    };
    char due[512];
    rg_log_hold(true);
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        struct rg_case c;
        assert_false(read_with(cases[i].word, cases[i].line, &c));
        snprintf(due, sizeof(due), "%s: %s", path, cases[i].says);
        if (strncmp(rg_last_error(), due, strlen(due)) != 0)
            fail_msg("%s: %s", cases[i].line, rg_last_error());
        rg_case_free(&c);
    }
    rg_log_hold(false);
}

// Each of these lines must be there.
static void a_line_that_is_missing_is_told(void **state)
{
    (void)state;
    static const char *const words[] = {"technique", "size",  "frames",   "behind", "stage",
                                        "asset",     "class", "expected", "truth",  "device"};
    char due[256];
    snprintf(due, sizeof(due),
             "%s: lacks its technique, size, frames, stage, what it is behind, asset, class, "
             "expected digest or devices; write one anew with `raingauge shrink`",
             path);
    rg_log_hold(true);
    for (size_t i = 0; i < sizeof(words) / sizeof(words[0]); i++) {
        struct rg_case c;
        if (read_with(words[i], "# nothing", &c) || strcmp(rg_last_error(), due) != 0)
            fail_msg("%s: %s", words[i], rg_last_error());
        rg_case_free(&c);
    }
    struct rg_case c;
    assert_true(read_with("found", "# nothing", &c)); // a device that fails leaves none
    rg_case_free(&c);
    rg_log_hold(false);
}

// --- the user's own files ---

static void files_go_along(void **state)
{
    (void)state;
    struct rg_case c = other_bits, read;
    char own[96], sent[128], assignment[192];
    snprintf(own, sizeof(own), "%s/of.mine.json", folder);
    snprintf(sent, sizeof(sent), "%s.files/lights_file.json", path);
    snprintf(assignment, sizeof(assignment), "lights_file=%s", own);
    write_text(own, "{\"lights\": []}");
    write_and_read(&c, "streaks", "", assignment, &read);
    const struct rg_param *param = rg_params_find(c.run.subject.technique->params, "lights_file");
    char value[RG_PATH_SIZE], *text = read_text(path), *copy = read_text(sent);
    rg_params_text(param, read.run.subject.settings, value, sizeof(value));
    assert_string_equal(value, sent);
    assert_string_equal(copy, "{\"lights\": []}");
    assert_non_null(strstr(text, "\nfile lights_file=lights_file.json\n"));
    assert_null(strstr(text, own));
    free(text);
    free(copy);
    rg_log_hold(true);
    // A case may read nothing else, and may not replace what is read.
    struct rg_subject *subject = &read.run.subject;
    assert_false(rg_file_receive(subject->technique, (void *)(uintptr_t)subject->settings,
                                 "lights_file=../of.mine.json", path));
    assert_string_equal(rg_last_error(), "'lights_file=../of.mine.json' names no file beside the "
                                         "case; write it as KEY=NAME");
    assert_false(rg_file_receive(subject->technique, (void *)(uintptr_t)subject->settings,
                                 "lights_file=none.json", path));
    snprintf(assignment, sizeof(assignment),
             "%s.files/none.json is not there; send the folder along with the case", path);
    assert_string_equal(rg_last_error(), assignment);
    assert_false(rg_file_receive(subject->technique, (void *)(uintptr_t)subject->settings,
                                 "lights_file=", path));
    assert_string_equal(rg_last_error(),
                        "'lights_file=' names no file beside the case; write it as "
                        "KEY=NAME");
    assert_false(rg_files_spared_by_case(subject, path));
    assert_non_null(strstr(rg_last_error(), "case.txt.files: would be overwritten"));
    assert_true(rg_files_spared_by_case(&c.run.subject, path));
    assert_false(rg_files_spared_by_case(&c.run.subject, own));
    rg_log_hold(false);
    unlink(own);
    unlink(sent);
    rg_case_free(&c);
    rg_case_free(&read);
}

// A file in the folder of a case's kernel would be removed with it.
static void a_kernels_folder_is_spared(void **state)
{
    (void)state;
    char kernel[96], own[128], assignment[160];
    snprintf(kernel, sizeof(kernel), "%s.kernel", path);
    snprintf(own, sizeof(own), "%s/a.json", kernel);
    snprintf(assignment, sizeof(assignment), "lights_file=%s", own);
    assert_int_equal(mkdir(kernel, 0700), 0);
    write_text(own, "{}");
    void *settings = settings_of("streaks", "", assignment);
    const struct rg_subject subject = {rg_technique_find("streaks"), settings, 8, 8};
    rg_log_hold(true);
    assert_false(rg_files_spared_by_case(&subject, path));
    assert_non_null(strstr(rg_last_error(), "case.txt.kernel: would be overwritten"));
    rg_log_hold(false);
    unlink(own);
    rmdir(kernel);
    free(settings);
}

static void endings_are_of_letters_and_digits(void **state)
{
    (void)state;
    static const char *const cases[][2] = {
        {"a.json", ".json"},     {"a.b/c", ""},    {"a/b.c.mp4", ".mp4"}, {"a.", ""},
        {"a.t-t", ""},           {".obj", ".obj"}, {"none", ""},          {"a.b.c d", ""},
        {"a.123456", ".123456"}, {"a.1234567", ""}};
    const struct rg_param param = {.name = "map"};
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        char ending[8], name[RG_FILE_NAME], due[32];
        rg_file_ending(cases[i][0], ending, sizeof(ending));
        assert_string_equal(ending, cases[i][1]);
        if (i + 1 == sizeof(cases) / sizeof(cases[0]))
            break; // there is more room in a name
        rg_file_sent_name(&param, cases[i][0], name);
        snprintf(due, sizeof(due), "map%s", cases[i][1]);
        assert_string_equal(name, due);
    }
}

static void a_file_is_loaded_whole(void **state)
{
    (void)state;
    size_t size;
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite("a\0b", 1, 3, file), 3);
    fclose(file);
    char *bytes = rg_file_load(path, &size);
    assert_non_null(bytes);
    assert_int_equal(size, 3);
    assert_memory_equal(bytes, "a\0b", 4);
    free(bytes);
    rg_log_hold(true);
    assert_null(rg_file_load("/nonexistent/a.obj", &size));
    assert_string_equal(rg_last_error(), "/nonexistent/a.obj: No such file or directory; name a "
                                         "file that can be read");
    write_text(path, ""); // an empty file is whole, too
    bytes = rg_file_load(path, &size);
    assert_non_null(bytes);
    assert_int_equal(size, 0);
    assert_int_equal(*bytes, 0);
    free(bytes);
    rg_log_hold(false);
}

static int set_up(void **state)
{
    if (make_folder(state))
        return -1;
    snprintf(path, sizeof(path), "%s/case.txt", folder);
    return 0;
}

static int tear_down(void **state)
{
    char files[80];
    snprintf(files, sizeof(files), "%s.files", path);
    unlink(path);
    rmdir(files);
    return remove_folder(state);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_written_is_read),
        cmocka_unit_test(a_failure_is_written_and_read),
        cmocka_unit_test(a_preset_comes_first),
        cmocka_unit_test(lines_have_their_limits),
        cmocka_unit_test(a_line_that_is_missing_is_told),
        cmocka_unit_test(a_wrong_line_is_named),
        cmocka_unit_test(files_go_along),
        cmocka_unit_test(a_kernels_folder_is_spared),
        cmocka_unit_test(endings_are_of_letters_and_digits),
        cmocka_unit_test(a_file_is_loaded_whole),
    };
    return cmocka_run_group_tests_name("cases", tests, set_up, tear_down);
}
