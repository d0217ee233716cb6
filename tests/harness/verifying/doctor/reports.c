// The report of `raingauge doctor` in its two forms: every finding stands where it belongs.
#include "harness/compare/doctor/doctor.h"

#include <limits.h>

#include "harness/record/passport/key.h"
#include "harness/record/passport/passport.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/printed.h"

// --- a report with two devices: one that was examined, and one that crashed ---

static struct rg_examination examinations[2];
static struct rg_doctor_report report;

static void examine_one(struct rg_examination *e)
{
    *e = (struct rg_examination){
        .status = RG_OK,
        .info = {.name = "new",
                 .full = "gl",
                 .device = "made up",
                 .driver = "Mesa 1.2",
                 .api = "OpenGL 4.5 core",
                 .tier = RG_T1,
                 .limits = {.max_buffer_bytes = 4 << 20,
                            .max_image_px = 512,
                            .max_image_layers = 6,
                            .max_groups = {5, 7, 9},
                            .group_items = 64}},
        .opened = true,
        .probed = true,
        .drawn = true,
        .audited = true,
        .measured = true,
        .drawing = {.count = 2, .formats = {{RG_RGBA8, 12}, {RG_RGBA16F, 13}}, .ms = 2.5},
        .timer = {.passes = 3,
                  .wall_ms = 2,
                  .has_timer = true,
                  .api_ms = 3,
                  .ratio = 1.5,
                  .sync_us = 1.5,
                  .dispatch_us = 0.5,
                  .round_trip_us = 7},
        .ceilings = {.memory_gb_s = 12.5, .cache_gb_s = 99, .arithmetic_gop_s = 33.25}};
    rg_probe_name(e->probe);
    for (int i = 0; i < RG_PROBE_COUNT; i++)
        e->probe[i].compared = RG_PROBE_INPUTS;
    e->probe[2].different = 3;
    e->probe[2].largest_ulps = 7;
    for (int i = 1; i < 3; i++) {
        e->probe[RG_PROBE_OP_COUNT + i].different = i == 1 ? 12 : 1;
        e->probe[RG_PROBE_OP_COUNT + i].largest_ulps = i == 1 ? 10000 : 9999;
    }
}

static json_t *passport_of(const char *quota, const char *features, const char *environment)
{
    char text[1000];
    snprintf(text, sizeof(text),
             "{\"machine\": {\"cpu\": \"Fast CPU\", \"features\": [%s], \"cores_online\": 8,"
             " \"cores_allowed\": 4, \"cores_list\": \"0-3\", \"quota_cpus\": %s,"
             " \"kernel\": \"Linux 6\", \"distribution\": \"Debian\", \"clocks\": \"\","
             " \"memory_bytes\": 3221225472}, \"environment\": {%s},"
             " \"raingauge\": {\"version\": \"0.1\", \"commit\": \"abc\", \"compiler\": \"gcc\","
             " \"type\": \"release\"}}",
             features, quota, environment);
    json_t *passport = json_loads(text, 0, NULL);
    assert_non_null(passport);
    return passport;
}

static int begin(void **state)
{
    (void)state;
    report = (struct rg_doctor_report){.count = 2, .examinations = examinations};
    report.list.missing_count = 2;
    strcpy(report.list.missing[0].why, "opencl: no driver");
    strcpy(report.list.missing[1].why, "vulkan: neither");
    report.passport =
        passport_of("1.5", "\"avx\", \"fma\"", "\"LP_PERF\": \"x\", \"OMP_NUM_THREADS\": \"2\"");
    report.warnings = json_pack("[ss]", "beware", "take care");
    examine_one(&examinations[0]);
    examinations[1] = (struct rg_examination){
        .status = RG_CRASH, .info.name = "other", .why = "its driver crashed"};
    return 0;
}

static int end(void **state)
{
    (void)state;
    json_decref(report.passport);
    json_decref(report.warnings);
    return 0;
}

// The report as text, until the next call.
static const char *text_now(void)
{
    printed_begin();
    rg_doctor_print_text(&report);
    return printed_end();
}

// How many lines of a text are this one.
static int lines_like(const char *text, const char *line)
{
    int count = 0;
    for (const char *at = text; *at; at += strcspn(at, "\n") + (at[strcspn(at, "\n")] == '\n'))
        count += strcspn(at, "\n") == strlen(line) && !strncmp(at, line, strlen(line));
    return count;
}

#define assert_line(text, line)                                                                    \
    do {                                                                                           \
        if (lines_like(text, line) != 1)                                                           \
            fail_msg("not one line is '%s':\n%s", line, text);                                     \
    } while (0)

// --- for people ---

static int count_of(const char *text, const char *part)
{
    int count = 0;
    for (const char *at = text; (at = strstr(at, part)); at++)
        count++;
    return count;
}

static void each_finding_has_a_line(void **state)
{
    (void)state;
    static const char *const due[] = {
        "  cpu         Fast CPU",
        "  features    avx fma",
        "  cores       8 online, 4 allowed (0-3), quota of 1.5 CPUs; memory 3.0 GiB",
        "  clocks      unknown",
        "  system      Linux 6, Debian",
        "  variables   LP_PERF=x",
        "              OMP_NUM_THREADS=2",
        "  raingauge   0.1, commit abc, gcc, release",
        "new",
        "  api         OpenGL 4.5 core, GPU",
        "  device      made up",
        "  driver      Mesa 1.2",
        "  limits      buffers of 4 MiB, images of 512 px and 6 layers, 5x7x9 groups of 64 items",
        "  arithmetic  FAIL multiply: 3 of 65536 results differ from C, the largest by 7 ulp",
        "  drawing     FAIL RGBA16F: 13 of 12288 pixels are not what cpu:reference draws",
        "  drawing     RGBA8, with depth and blending: what cpu:reference draws, in 2.5 ms",
        "  timer       UNTRUSTED: 3.00 ms by the API, 2.00 ms by wall clock (ratio 1.500)",
        "  costs       sync 1.5 us, dispatch 0.5 us, dispatch and sync 7.0 us",
        "  ceilings    copies 12.5 GB/s in memory, 99.0 GB/s in cache; 33.2 Gop/s",
        "other",
        "  PROBLEM     crash: its driver crashed",
        "missing",
        "  drivers     opencl: no driver",
        "              vulkan: neither",
        "warnings",
        "  -           beware",
        "  -           take care",
        "1 of 2 devices are well: they work, and compute what C computes",
    };
    const char *text = text_now(), *before = text;
    for (size_t i = 0; i < sizeof(due) / sizeof(due[0]); i++) {
        assert_line(text, due[i]);
        assert_true(strstr(text, due[i]) >= before); // in this order
        before = strstr(text, due[i]);
    }
    assert_int_equal(count_of(text, "PROBLEM"), 1);
    assert_int_equal(count_of(text, "  arithmetic "), 1);
}

static void the_key_is_the_device_s(void **state)
{
    (void)state;
    char key[RG_KEY_SIZE], due[100];
    json_t *device = rg_passport_device(&examinations[0].info);
    json_t *parts = rg_key_parts(report.passport, device);
    rg_key_hash(parts, key);
    snprintf(due, sizeof(due), "  key         %s of cpu Fast CPU; features avx fma; cores 4;", key);
    const char *text = text_now();
    assert_non_null(strstr(text, due));
    json_decref(parts);
    json_decref(device);
}

// A line says which part a device or a machine lacks.
static void what_is_lacking_is_told(void **state)
{
    (void)state;
    struct rg_examination *e = &examinations[0];
    char due[100];
    end(NULL);
    report.passport = passport_of("null", "", "");
    report.warnings = json_array();
    report.list.missing_count = 0;
    examine_one(e);
    e->info.software = true;
    e->info.limits.max_groups[0] = e->info.limits.max_groups[1] = INT_MAX;
    e->probe[2].different = 0;
    e->timer.has_timer = false;
    e->drawing.count = 0;
    strcpy(e->info.limits.no_draws, "has no queue that draws");
    const char *text = text_now();
    assert_line(text, "  features    none of interest");
    assert_line(text, "  cores       8 online, 4 allowed (0-3), no quota; memory 3.0 GiB");
    assert_line(text, "  variables   none is set that matters (docs/environment.md)");
    assert_line(text, "  api         OpenGL 4.5 core, software");
    assert_line(text,
                "  limits      buffers of 4 MiB, images of 512 px and 6 layers, any number of "
                "items");
    assert_line(text, "  timer       none; wall clock says 2.00 ms");
    assert_line(text, "  drawing     none: it has no queue that draws");
    snprintf(due, sizeof(due),
             "  arithmetic  all %d operations that kernels use give the same bits as C",
             RG_PROBE_OP_COUNT);
    assert_line(text, due);
    assert_null(strstr(text, "\nmissing\n"));
    assert_null(strstr(text, "\nwarnings\n"));
    e->timer.has_timer = e->timer.trusted = true;
    e->drawing = (struct rg_drawing){.count = 1, .formats = {{RG_RGBA8, 13}}};
    text = text_now();
    assert_non_null(strstr(text, "  timer       trusted: 3.00 ms by the API"));
    assert_line(text, "  drawing     FAIL RGBA8: 13 of 12288 pixels are not what cpu:reference "
                      "draws");
    assert_null(strstr(text, "drawing     none"));
}

// A long text is broken at spaces, so that no line has more than 100 characters; a longer word
// stays whole.
static void lines_are_broken_at_spaces(void **state)
{
    (void)state;
    char *why = report.list.missing[0].why, due[200];
    *why = 0;
    for (int i = 0; i < 25; i++)
        strcat(why, "abcdefg ");
    const char *text = text_now();
    snprintf(due, sizeof(due), "  drivers     %.79s", why); // ten words, of 86 characters
    assert_line(text, due);
    snprintf(due, sizeof(due), "              %.79s", why);
    assert_line(text, due);
    snprintf(due, sizeof(due), "              %.40s", why); // the last five, as they are
    assert_line(text, due);
    memset(why, 'w', 86);
    strcpy(why + 86, " next");
    text = text_now();
    snprintf(due, sizeof(due), "  drivers     %.86s", why);
    assert_line(text, due);
    assert_line(text, "              next");
    memset(why, 'w', 120);
    strcpy(why + 120, " next");
    text = text_now();
    snprintf(due, sizeof(due), "  drivers     %.120s", why);
    assert_line(text, due);
    assert_line(text, "              next");
}

// The drivers' own functions stand side by side, with how many results differ and by how much.
static void functions_of_drivers_stand_in_a_table(void **state)
{
    (void)state;
    static struct rg_examination many[9];
    static const char *const cells[][2] = {
        {"=", "="}, {"0.0183% >9999", "="}, {"<0.01% 9999", "="}};
    char due[100];
    examinations[1] = examinations[0];
    strcpy(examinations[1].info.name, "a long device's name");
    for (int i = 1; i < 3; i++)
        examinations[1].probe[RG_PROBE_OP_COUNT + i].different = 0;
    const char *text = text_now();
    assert_line(text, "builtin                  new a long device");
    for (int i = 0; i < 3; i++) {
        snprintf(due, sizeof(due), "%-14s%14s%14s",
                 examinations[0].probe[RG_PROBE_OP_COUNT + i].name, cells[i][0], cells[i][1]);
        assert_line(text, due);
    }
    // Six fit beside each other; the others follow below. One that was not probed has no column.
    for (int i = 0; i < 9; i++) {
        many[i] = examinations[0];
        many[i].probed = i != 4;
        snprintf(many[i].info.name, sizeof(many[i].info.name), "d%d", i);
    }
    report.examinations = many;
    report.count = 9;
    text = text_now();
    snprintf(due, sizeof(due), "builtin       %14s%14s%14s%14s%14s%14s", "d0", "d1", "d2", "d3",
             "d5", "d6");
    assert_line(text, due);
    snprintf(due, sizeof(due), "builtin       %14s%14s", "d7", "d8");
    assert_line(text, due);
    assert_line(text, "9 of 9 devices are well: they work, and compute what C computes");
    report.count = 0;
    assert_null(strstr(text_now(), "builtin"));
}

// --- for machines ---

// The value at a path such as "devices.0.name".
static const json_t *at(const json_t *value, const char *path)
{
    char key[64];
    for (const char *from = path; value && *from;
         from += strlen(key) + (from[strlen(key)] == '.')) {
        snprintf(key, sizeof(key), "%.*s", (int)strcspn(from, "."), from);
        value = json_is_array(value) ? json_array_get(value, (size_t)atoi(key))
                                     : json_object_get(value, key);
    }
    return value;
}

static json_t *document(void)
{
    printed_begin();
    rg_doctor_print_json(&report);
    json_t *root = json_loads(printed_end(), 0, NULL);
    assert_non_null(root);
    return root;
}

static void expect_number(const json_t *root, const char *path, double due)
{
    const json_t *value = at(root, path);
    if (!json_is_number(value) || json_number_value(value) != due)
        fail_msg("%s is %g", path, json_number_value(value));
}

static void expect_text(const json_t *root, const char *path, const char *due)
{
    const char *text = json_string_value(at(root, path));
    if (!text || strcmp(text, due) != 0)
        fail_msg("%s is %s", path, text ? text : "no text");
}

static const struct {
    const char *path;
    double due;
} numbers[] = {
    {"format", 1},
    {"devices.0.limits.max_buffer_bytes", 4194304},
    {"devices.0.limits.max_image_px", 512},
    {"devices.0.limits.max_image_layers", 6},
    {"devices.0.limits.max_groups.0", 5},
    {"devices.0.limits.max_groups.1", 7},
    {"devices.0.limits.max_groups.2", 9},
    {"devices.0.limits.group_items", 64},
    {"devices.0.operations.2.compared", 65536},
    {"devices.0.operations.2.different", 3},
    {"devices.0.operations.2.largest_ulps", 7},
    {"devices.0.operations.1.different", 0},
    {"devices.0.builtins.1.different", 12},
    {"devices.0.builtins.1.largest_ulps", 10000},
    {"devices.0.drawing.formats.1.compared", 12288},
    {"devices.0.drawing.formats.1.different", 13},
    {"devices.0.drawing.ms", 2.5},
    {"devices.0.timer.passes", 3},
    {"devices.0.timer.wall_ms", 2},
    {"devices.0.timer.api_ms", 3},
    {"devices.0.timer.ratio", 1.5},
    {"devices.0.timer.sync_us", 1.5},
    {"devices.0.timer.dispatch_us", 0.5},
    {"devices.0.timer.round_trip_us", 7},
    {"devices.0.ceilings.memory_gb_s", 12.5},
    {"devices.0.ceilings.cache_gb_s", 99},
    {"devices.0.ceilings.arithmetic_gop_s", 33.25},
    {"passport.machine.cores_allowed", 4},
};

static const char *const texts[][2] = {
    {"devices.0.name", "new"},
    {"devices.0.api", "OpenGL 4.5 core"},
    {"devices.0.status", "ok"},
    {"devices.0.why", ""},
    {"devices.0.operations.2.name", "multiply"},
    {"devices.0.drawing.formats.0.name", "RGBA8"},
    {"devices.0.drawing.formats.1.name", "RGBA16F"},
    {"devices.1.name", "other"},
    {"devices.1.status", "crash"},
    {"devices.1.why", "its driver crashed"},
    {"missing.0", "opencl: no driver"},
    {"missing.1", "vulkan: neither"},
    {"warnings.0", "beware"},
    {"warnings.1", "take care"},
};

static void each_finding_has_its_key(void **state)
{
    (void)state;
    json_t *root = document();
    for (size_t i = 0; i < sizeof(numbers) / sizeof(numbers[0]); i++)
        expect_number(root, numbers[i].path, numbers[i].due);
    for (size_t i = 0; i < sizeof(texts) / sizeof(texts[0]); i++)
        expect_text(root, texts[i][0], texts[i][1]);
    assert_int_equal(json_array_size(at(root, "devices")), 2);
    assert_int_equal(json_array_size(at(root, "devices.0.operations")), RG_PROBE_OP_COUNT);
    assert_int_equal(json_array_size(at(root, "devices.0.builtins")), RG_PROBE_BUILTIN_COUNT);
    assert_int_equal(json_array_size(at(root, "devices.0.drawing.formats")), 2);
    assert_true(json_is_false(at(root, "devices.0.timer.trusted")));
    json_decref(root);
}

// A key is there if its part of the examination was done; what is without a limit, or was not
// measured, is null.
static void what_was_not_done_has_no_key(void **state)
{
    (void)state;
    static const char *const keys[] = {"limits", "operations", "builtins", "drawing",
                                       "timer",  "ceilings",   "api"};
    struct rg_examination *e = &examinations[0];
    e->info.limits.max_groups[1] = INT_MAX;
    e->timer.has_timer = false;
    e->timer.trusted = true;
    json_t *root = document();
    assert_true(json_is_null(at(root, "devices.0.limits.max_groups.1")));
    expect_number(root, "devices.0.limits.max_groups.2", 9);
    assert_true(json_is_null(at(root, "devices.0.timer.api_ms")));
    assert_true(json_is_null(at(root, "devices.0.timer.ratio")));
    assert_true(json_is_true(at(root, "devices.0.timer.trusted")));
    expect_number(root, "devices.0.timer.wall_ms", 2);
    for (int i = 0; i < 7; i++)
        assert_null(json_object_get(at(root, "devices.1"), keys[i]));
    json_decref(root);
    e->drawn = e->audited = e->measured = false;
    root = document();
    for (int i = 0; i < 7; i++)
        assert_int_equal(json_object_get(at(root, "devices.0"), keys[i]) != NULL, i < 3 || i == 6);
    json_decref(root);
}

// --- failures ---

static void operations_that_differ_are_counted_without_drivers_own(void **state)
{
    (void)state;
    assert_int_equal(rg_examination_failures(&examinations[0]), 1);
    examinations[0].probe[0].different = 1;
    assert_int_equal(rg_examination_failures(&examinations[0]), 2);
    examinations[0].probe[RG_PROBE_OP_COUNT - 1].different = 65536;
    assert_int_equal(rg_examination_failures(&examinations[0]), 3);
}

int main(void)
{
#define OF_REPORT(test) cmocka_unit_test_setup_teardown(test, begin, end)
    const struct CMUnitTest tests[] = {
        OF_REPORT(each_finding_has_a_line),
        OF_REPORT(the_key_is_the_device_s),
        OF_REPORT(what_is_lacking_is_told),
        OF_REPORT(lines_are_broken_at_spaces),
        OF_REPORT(functions_of_drivers_stand_in_a_table),
        OF_REPORT(each_finding_has_its_key),
        OF_REPORT(what_was_not_done_has_no_key),
        OF_REPORT(operations_that_differ_are_counted_without_drivers_own),
    };
    return cmocka_run_group_tests_name("reports of doctor", tests, NULL, NULL);
}
