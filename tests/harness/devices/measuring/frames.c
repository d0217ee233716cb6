// Frames on a device of fake.h: their timeline, sequences of them as files, and their pictures,
// with and without rain.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/base/log.h"
#include "core/image/files/io.h"
#include "core/techniques/proof.h"
#include "harness/console/interrupt.h"
#include "harness/devices/frames/frame.h"
#include "harness/devices/frames/sequence.h"
#include "harness/devices/frames/trace.h"
#include "tests/harness/devices/measuring/fake.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/folder.h"
#include "tests/tools/process/logged.h"

static int begin(void **state)
{
    *state = fake_open();
    log_forget();
    rg_log_listen(log_last, NULL);
    rg_interrupt_watch();
    fake_forget();
    return 0;
}

static int end(void **state)
{
    struct fake_device *fake = *state;
    const bool is_closed = rg_device_close(&fake->pub);
    rg_log_listen(NULL, NULL);
    rg_interrupt_watch();
    return !is_closed;
}

// A device that is lost at its first wait, and so cannot be closed well.
static struct fake_device *open_lost(void)
{
    struct fake_device *lost = fake_open();
    lost->waits_left = 0;
    return lost;
}

// --- a timeline ---

// Times in microseconds; a track of 0 names the process.
struct due {
    const char *name;
    int process, track;
    double at_us, us;
};

static void expect_name(const json_t *event, const char *what, const struct due *due)
{
    const json_t *name = json_object_get(json_object_get(event, "args"), "name");
    assert_string_equal(json_string_value(json_object_get(event, "ph")), "M");
    assert_string_equal(json_string_value(json_object_get(event, "name")), what);
    assert_string_equal(json_string_value(name), due->name);
}

static void expect_event(const json_t *event, const struct due *due)
{
    assert_int_equal(json_integer_value(json_object_get(event, "pid")), due->process);
    assert_int_equal(json_integer_value(json_object_get(event, "tid")), due->track);
    if (due->us < 0) {
        expect_name(event, due->track ? "thread_name" : "process_name", due);
        return;
    }
    assert_string_equal(json_string_value(json_object_get(event, "ph")), "X");
    assert_string_equal(json_string_value(json_object_get(event, "name")), due->name);
    assert_near(json_number_value(json_object_get(event, "ts")), due->at_us, 1e-3);
    assert_near(json_number_value(json_object_get(event, "dur")), due->us, 1e-3);
}

static const struct due timeline[] = {
    {"one: made", 1, 0, 0, -1},
    {"frames, wall clock", 1, 1, 0, -1},
    {"frames, the API's clock", 1, 2, 0, -1},
    {"frames that wait after each pass", 1, 3, 0, -1},
    {"open", 1, 1, 4000, 0},
    {"frame 1", 1, 1, 4000, 5000},
    {"frame 1", 1, 2, 4000, 2500},
    {"stir", 1, 3, 9000, 2000},
    {"show", 1, 3, 11000, 3000},
    {"frame 2, waiting after each pass", 1, 3, 9000, 5000},
    {"two: made", 2, 0, 0, -1},
    {"frames, wall clock", 2, 1, 0, -1},
    {"frames that wait after each pass", 2, 3, 0, -1},
    {"open", 2, 1, 15000, 0},
    {"frame 1", 2, 1, 15000, 5000},
    {"stir", 2, 3, 20000, 2000},
    {"show", 2, 3, 22000, 3000},
    {"frame 2, waiting after each pass", 2, 3, 20000, 5000},
};

// A frame of 2 ms and 3 ms, on a device whose clock runs at half the speed, and on one without a
// clock.
static void a_timeline_has_a_track_for_each_clock(void **state)
{
    struct fake_device *fake = *state;
    enum { EVENTS = sizeof(timeline) / sizeof(timeline[0]) };
    const struct fake_script script = {.letter = 'A', .step_ms = 2, .draw_ms = 3};
    const struct rg_subject subject = {&fake_technique, &script, 8, 8};
    struct rg_device_info infos[2];
    struct rg_trace trace;
    rg_trace_begin(&trace);
    fake->clock_rate = 0.5;
    strcpy(fake->pub.info.driver, "made");
    for (int i = 0; i < 2; i++) {
        strcpy(fake->pub.info.name, i ? "two" : "one");
        fake->pub.info.limits.has_clock = !i;
        infos[i] = fake->pub.info;
        fake_pass(i ? 1 : 4);
        assert_true(rg_trace_device(&trace, &fake->pub, &subject, 1));
    }
    char *text = rg_trace_end(&trace, infos, 2);
    json_t *document = json_loads(text, 0, NULL);
    free(text);
    const json_t *events = json_object_get(document, "traceEvents");
    assert_int_equal(json_array_size(events), EVENTS);
    for (int i = 0; i < EVENTS; i++)
        expect_event(json_array_get(events, (size_t)i), &timeline[i]);
    assert_string_equal(json_string_value(json_object_get(document, "displayTimeUnit")), "ms");
    const json_t *passport = json_object_get(json_object_get(document, "otherData"), "passport");
    assert_int_equal(json_array_size(json_object_get(passport, "devices")), 2);
    json_decref(document);
    assert_int_equal(logged_lines, 0);
}

// Events before a device's failure stay; an interruption leaves frames out.
static void a_timeline_ends_early(void **state)
{
    struct fake_device *fake = *state;
    const struct fake_script script = {.letter = 'A', .draw_ms = 3, .interrupt_at = 2};
    const struct rg_subject subject = {&fake_technique, &script, 8, 8};
    struct rg_trace trace;
    rg_trace_begin(&trace);
    fake->pub.info.limits.has_clock = false;
    assert_true(rg_trace_device(&trace, &fake->pub, &subject, 5)); // three names, opening, a frame
    assert_int_equal(json_array_size(trace.events), 5 + 3);        // and one that waits
    rg_interrupt_watch();
    struct fake_device *lost = open_lost();
    assert_false(rg_trace_device(&trace, &lost->pub, &subject, 5));
    assert_non_null(strstr(logged, "lost"));
    assert_int_equal(json_array_size(trace.events), 8 + 5);
    assert_int_equal(trace.devices, 2);
    free(rg_trace_end(&trace, &fake->pub.info, 1));
    rg_device_close(&lost->pub);
}

// --- sequences ---

static int begin_in_folder(void **state)
{
    return make_folder(state) || begin(state);
}

static int end_in_folder(void **state)
{
    return remove_whole_folder(state) || end(state);
}

static int count_of(char event)
{
    int count = 0;
    for (const char *at = fake_events(); *at; at++)
        count += *at == event;
    return count;
}

static struct rg_sequence sequence(const struct fake_script *script, const char *path, int first,
                                   int last)
{
    return (struct rg_sequence){.subject = {&fake_technique, script, 8, 8},
                                .first = first,
                                .last = last,
                                .path = path,
                                .exposure = 0.5};
}

// Each frame is simulated once, and the wanted ones are drawn.
static void a_sequence_has_the_wanted_frames(void **state)
{
    struct fake_device *fake = *state;
    const struct fake_script script = {.letter = 'A'};
    const char *path = in_folder("a-%02d.png");
    const struct rg_sequence wanted = sequence(&script, path, 2, 4);
    fake->shown = 0x3c00; // 1, also of alpha
    struct rg_session *session = rg_sequence_run(&wanted, &fake->pub);
    assert_non_null(session);
    assert_int_equal(count_of('('), 1);
    assert_int_equal(count_of('A'), 4);
    assert_int_equal(count_of('.'), 3);
    static const struct {
        const char *name;
        bool is_there;
    } files[] = {{"a-01.png", false},
                 {"a-02.png", true},
                 {"a-03.png", true},
                 {"a-04.png", true},
                 {"a-05.png", false}};
    for (int i = 0; i < 5; i++)
        assert_int_equal(!access(in_folder(files[i].name), F_OK), files[i].is_there);
    struct rg_picture picture;
    assert_true(rg_picture_read(in_folder("a-03.png"), &picture));
    assert_int_equal(picture.width, 8);
    assert_int_equal(picture.channels, 3); // without the alpha that is 1 everywhere
    assert_near(picture.texels[0], 0.5, 0.01);
    rg_picture_destroy(&picture);
    rg_session_close(session);
    assert_int_equal(logged_lines, 0);
}

// The first frame may be the one before any step.
static void a_sequence_begins_at_frame_0(void **state)
{
    struct fake_device *fake = *state;
    static const double draws_ms[] = {1};
    const struct fake_script script = {.letter = 'A', .frames_ms = draws_ms + 1};
    const char *path = in_folder("%d.exr");
    const struct rg_sequence wanted = sequence(&script, path, 0, 1);
    struct rg_session *session = rg_sequence_run(&wanted, &fake->pub);
    assert_non_null(session);
    assert_int_equal(count_of('A'), 1);
    assert_int_equal(count_of('.'), 2);
    assert_true(!access(in_folder("0.exr"), F_OK) && !access(in_folder("1.exr"), F_OK));
    rg_session_close(session);
}

static void what_is_written_until_a_signal_is_told(void **state)
{
    struct fake_device *fake = *state;
    char due[300];
    const struct fake_script script = {.letter = 'A', .interrupt_at = 3};
    const char *path = in_folder("%d.png");
    const struct rg_sequence some = sequence(&script, path, 2, 9);
    assert_null(rg_sequence_run(&some, &fake->pub));
    snprintf(due, sizeof(due), "%s: interrupted; frames 2-3 are written", path);
    assert_string_equal(logged, due);
    assert_int_equal(count_of('A'), 3);
    assert_true(!access(in_folder("3.png"), F_OK) && access(in_folder("4.png"), F_OK));
    const struct rg_sequence none = sequence(&script, path, 7, 9);
    assert_null(rg_sequence_run(&none, &fake->pub));
    snprintf(due, sizeof(due), "%s: interrupted; nothing was written", path);
    assert_string_equal(logged, due);
    assert_int_equal(logged_lines, 2);
}

static void a_sequence_that_cannot_be_written_is_not_begun(void **state)
{
    struct fake_device *fake = *state;
    const struct fake_script script = {.letter = 'A'};
    const char *path = in_folder("none/%d.png");
    const struct rg_sequence wanted = sequence(&script, path, 1, 9);
    assert_null(rg_sequence_run(&wanted, &fake->pub));
    assert_int_equal(logged_lines, 1);
    assert_string_equal(fake_events(), "");
}

// --- one frame ---

static void a_frame_is_the_last_of_its_steps(void **state)
{
    struct fake_device *fake = *state;
    const struct fake_script script = {.letter = 'A'};
    const struct rg_subject subject = {&fake_technique, &script, 8, 8};
    struct rg_session *session = rg_frame_run(&fake->pub, &subject, 3);
    assert_non_null(session);
    assert_string_equal(fake_events(), "(AAA.|");
    rg_session_close(session);
}

// A drawing of an eighth of the sides tells how long a very large picture takes: 64 times a second.
static void a_very_large_picture_is_foretold(void **state)
{
    struct fake_device *fake = *state;
    static const struct {
        int width, height;
        const char *long_s;
        const char *says;
        int opened;
    } rows[] = {
        {4096, 4096, "63", "fake of 4096x4096: drawing it once takes about 64 s", 2},
        {4096, 4096, "65", "", 2},
        {8192, 2048, "63", "fake of 8192x2048: drawing it once takes about 64 s", 2},
        {4096, 4095, "63", "", 1},
    };
    static const double draws_ms[] = {1000};
    const struct fake_script script = {.letter = 'A', .draw_ms = 1, .frames_ms = draws_ms + 1};
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        const struct rg_subject subject = {&fake_technique, &script, rows[i].width, rows[i].height};
        fake_forget();
        *logged = 0;
        setenv("RG_LONG_S", rows[i].long_s, 1);
        struct rg_session *session = rg_frame_run(&fake->pub, &subject, 1);
        assert_non_null(session);
        assert_string_equal(logged, rows[i].says);
        assert_int_equal(count_of('('), rows[i].opened);
        rg_session_close(session);
    }
    setenv("RG_LONG_S", "1e9", 1);
}

// --- rain ---

// It rains in frames from `from` to `to`; without rain a picture is 0.5 everywhere.
static struct {
    int from, to;
} rain;

struct drizzle {
    struct rg_instance pub;
    struct drizzle_settings {
        double wet;
    } settings;
};

static bool open_drizzle(struct rg_instance *instance)
{
    (void)instance;
    return true;
}

static bool step_drizzle(struct rg_instance *instance)
{
    instance->frame++;
    return true;
}

static bool draw_drizzle(struct rg_instance *instance)
{
    const bool rains = ((struct drizzle *)instance)->settings.wet > 0 &&
                       instance->frame >= rain.from && instance->frame <= rain.to;
    ((struct fake_device *)instance->device)->shown = rains ? 0x3a00 : 0x3800;
    return true;
}

static const struct rg_param drizzle_rows[] = {
    {"wet", RG_PARAM_FLOAT, 0, 1, 0, 1, "1", "whether it rains", NULL}};
static const struct rg_param_table drizzle_params = {.technique = "drizzle",
                                                     .rows = drizzle_rows,
                                                     .count = 1,
                                                     .settings_size =
                                                         sizeof(struct drizzle_settings)};
static const struct rg_proof drizzle_proof = {.dry = "wet=0"};
static const struct rg_technique drizzle = {.name = "drizzle",
                                            .params = &drizzle_params,
                                            .proof = &drizzle_proof,
                                            .size = sizeof(struct drizzle),
                                            .settings = offsetof(struct drizzle, settings),
                                            .open = open_drizzle,
                                            .step = step_drizzle,
                                            .draw = draw_drizzle};
static const struct drizzle_settings wet = {1};
enum { SIDE = 16 };
static const struct rg_subject drizzles = {&drizzle, &wet, SIDE, SIDE};

static void a_frame_with_rain_is_looked_for(void **state)
{
    struct fake_device *fake = *state;
    static const struct {
        int frame, from, to;
        const char *text;
    } rows[] = {
        {0, 50, 999, "no rain at frame 0, so that nothing is compared; take --frame 60"},
        {0, 61, 999, "no rain at frame 0, so that nothing is compared; take --frame 240"},
        {60, 1, 60, "no rain at frame 60, nor at 240, so that"},
        {240, 100, 999, "no rain at frame 240, nor at 60, so that"},
        {7, 241, 999,
         "no rain at frame 7, nor at 60 and 240, so that nothing is compared; give "
         "another size or setting"},
    };
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        char text[RG_FRAME_DRY];
        rain.from = rows[i].from;
        rain.to = rows[i].to;
        rg_frame_tell_dry(&fake->pub, &drizzles, rows[i].frame, 1, "--frame", text);
        assert_memory_equal(text, rows[i].text, strlen(rows[i].text));
    }
    // A device that fails shows no rain either, and only the caller's line says so.
    char text[RG_FRAME_DRY];
    struct fake_device *lost = open_lost();
    rain.from = 0;
    rg_frame_tell_dry(&lost->pub, &drizzles, 7, 1, "--frame", text);
    assert_non_null(strstr(text, "nor at 60 and 240"));
    assert_int_equal(logged_lines, 0);
    rg_info("what follows is told");
    assert_int_equal(logged_lines, 1);
    rg_device_close(&lost->pub);
}

// A picture of one value, with another one in its first row.
static struct rg_picture picture_of(float value, float first_row)
{
    struct rg_picture picture;
    assert_true(rg_picture_create(&picture, SIDE, SIDE, 4, "made"));
    for (int i = 0; i < SIDE * SIDE * 4; i++)
        picture.texels[i] = i < SIDE * 4 ? first_row : value;
    return picture;
}

// The other device's scene is black, and its rain 0.25 brighter, as here on a scene of 0.5.
static void rain_is_compared_without_the_scenes(void **state)
{
    struct fake_device *fake = *state;
    const struct rg_device_info other = {.name = "other", .native = true};
    struct rg_picture expected = picture_of(0, 0.25f), dry = picture_of(0, 0);
    struct rg_picture picture = picture_of(0.5f, 0.75f);
    struct rg_comparison comparison;
    picture.texels[SIDE * SIDE * 4 - 1] = 0.4f; // no light is below 0
    assert_true(rg_frame_compare_rain(&fake->pub, &drizzles, 3, &other, &expected, &dry, &picture,
                                      0.5f, &comparison));
    assert_int_equal(comparison.metrics.differing_values, 0);
    assert_string_equal(comparison.tier, "T0");
    assert_equals(comparison.exposure, 0.5);
    assert_int_equal(comparison.tiers.mask_pixels, SIDE);
    assert_false(comparison.tiers.mask_is_whole);
    rg_comparison_destroy(&comparison);
    rg_picture_destroy(&picture);
    rg_picture_destroy(&dry);
    rg_picture_destroy(&expected);
}

// Compares 0.5 and 0.7 with 0.505 and `expected_rain`, in front of 0.505.
static struct rg_tiers compare(struct fake_device *fake, bool differ, bool has_dry,
                               float expected_rain)
{
    const struct rg_device_info other = {.name = "other", .native = differ};
    struct rg_picture expected = picture_of(0.505f, expected_rain),
                      dry = picture_of(0.505f, 0.505f);
    struct rg_picture picture = picture_of(0.5f, 0.7f);
    struct rg_comparison comparison;
    assert_int_equal(rg_frame_scenes_differ(&fake->pub.info, &other), differ);
    assert_true(rg_frame_compare(&fake->pub, &drizzles, 3, &other, &expected, has_dry ? &dry : NULL,
                                 &picture, &comparison));
    const struct rg_tiers tiers = comparison.tiers;
    rg_comparison_destroy(&comparison);
    rg_picture_destroy(&picture);
    rg_picture_destroy(&dry);
    rg_picture_destroy(&expected);
    return tiers;
}

static void scenes_that_differ_are_compared_first(void **state)
{
    struct fake_device *fake = *state;
    // The picture without the scenes' difference is equal up to rounding.
    const struct rg_tiers rains = compare(fake, true, true, 0.705f);
    assert_true(rains.of[RG_T1].holds);
    assert_int_equal(rains.mask_pixels, SIDE);
    // Without a background, or with other things in the whole picture, nothing is taken.
    const struct rg_tiers whole = compare(fake, true, false, 0.705f);
    assert_true(whole.mask_is_whole && whole.of[RG_T2].holds);
    const struct rg_tiers others = compare(fake, true, true, 0.1f);
    assert_true(others.mask_is_whole && !others.of[RG_T2].holds);
    // Of two devices that draw alike, the scene is the background.
    const struct rg_tiers alike = compare(fake, false, true, 0.705f);
    assert_true(!alike.mask_is_whole && !alike.of[RG_T1].holds);
    assert_int_equal(alike.mask_pixels, SIDE);
}

int main(void)
{
#define WITH_FAKE(test)      cmocka_unit_test_setup_teardown(test, begin, end)
#define WITH_FAKE_FILE(test) cmocka_unit_test_setup_teardown(test, begin_in_folder, end_in_folder)
    const struct CMUnitTest tests[] = {
        WITH_FAKE(a_timeline_has_a_track_for_each_clock),
        WITH_FAKE(a_timeline_ends_early),
        WITH_FAKE_FILE(a_sequence_has_the_wanted_frames),
        WITH_FAKE_FILE(a_sequence_begins_at_frame_0),
        WITH_FAKE_FILE(what_is_written_until_a_signal_is_told),
        WITH_FAKE_FILE(a_sequence_that_cannot_be_written_is_not_begun),
        WITH_FAKE(a_frame_is_the_last_of_its_steps),
        WITH_FAKE(a_very_large_picture_is_foretold),
        WITH_FAKE(a_frame_with_rain_is_looked_for),
        WITH_FAKE(rain_is_compared_without_the_scenes),
        WITH_FAKE(scenes_that_differ_are_compared_first),
    };
    return cmocka_run_group_tests_name("frames", tests, NULL, NULL);
}
