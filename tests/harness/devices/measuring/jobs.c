// Jobs: how a device's image is judged, which parts of its instance a record keeps, and where a
// pass's time goes.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "core/base/log.h"
#include "core/image/compare/compare.h"
#include "harness/devices/frames/frame.h"
#include "harness/devices/measure/measure.h"
#include "tests/tools/expect.h"
#include "tests/tools/instance.h"

#define CHEAP                                                                                      \
    "view=pane panes=mirror environment=sky environment_px=16 reflection_px=16 resolution_px=64"

enum { SIZE_PX = 128 };

// --- a device is judged by its tier, over the rain mask ---

// Makes this many pixels with rain two codes brighter in red.
static void brighten(struct rg_picture *picture, const struct rg_picture *dry, int pixels)
{
    for (int i = 0; i < SIZE_PX * SIZE_PX && pixels > 0; i++) {
        float *texel = picture->texels + (size_t)i * 4;
        const double red = texel[0], encoded = 1.055 * pow(red, 1 / 2.4) - 0.055;
        if (fabs(red - dry->texels[(size_t)i * 4]) < 0.1 || encoded < 0.1 || encoded > 0.9)
            continue;
        const double code = floor(encoded * 255 + 0.5) + 2;
        texel[0] = (float)pow((code / 255 + 0.055) / 1.055, 2.4);
        pixels--;
    }
    assert_int_equal(pixels, 0);
}

static enum rg_outcome judge(struct rg_device *device, const void *settings,
                             const struct rg_expected *expected, char *detail, size_t size)
{
    struct rg_record record = {0};
    struct rg_job job = {.subject = {rg_technique_find("flow"), settings, SIZE_PX, SIZE_PX},
                         .device = device,
                         .check_frames = RG_CHECK_FRAMES,
                         .record = &record};
    if (rg_job_open(&job))
        rg_job_check(&job, expected);
    snprintf(detail, size, "%s", record.detail);
    rg_job_close(&job);
    return record.outcome;
}

// The image that cpu:reference draws of a technique, and its background.
static void expect(struct rg_expected *expected, const struct rg_technique *technique,
                   const void *settings)
{
    struct rg_device *device = rg_device_open("cpu:reference");
    const struct rg_subject subject = {technique, settings, SIZE_PX, SIZE_PX};
    struct rg_session *session = rg_session_run(device, &subject, RG_CHECK_FRAMES);
    *expected = (struct rg_expected){0};
    assert_true(rg_expected_read(expected, session));
    assert_string_equal(expected->device.name, "cpu:reference");
    rg_session_close(session);
    assert_true(rg_frame_draw_dry(device, &subject, RG_CHECK_FRAMES, &expected->dry));
    assert_true(rg_device_close(device));
}

static void test_tiers_by_the_mask(void **state)
{
    (void)state;
    enum { PIXELS = 12 }; // below 0.1 % of the picture, above 0.1 % of the rain mask
    char detail[256];
    void *settings = settings_of("flow", CHEAP, "move=paper drops=90 drop_height_per_mm=1");
    struct rg_device *device = rg_device_open("cpu");
    struct rg_expected expected;
    expect(&expected, rg_technique_find("flow"), settings);
    assert_int_equal(judge(device, settings, &expected, detail, sizeof(detail)), RG_OK);
    brighten(&expected.picture, &expected.dry, PIXELS);
    ((char *)expected.texels)[0] ^= 1; // the device's image is no longer identical
    assert_int_equal(judge(device, settings, &expected, detail, sizeof(detail)), RG_FAIL);
    assert_non_null(strstr(detail, "(T0)"));
    device->info.tier = RG_T1;
    assert_int_equal(judge(device, settings, &expected, detail, sizeof(detail)), RG_FAIL);
    if (!strstr(detail, "of the mask is above 1/255"))
        fail_msg("failed for another reason: %s", detail);
    device->info.tier = RG_T2; // T2 allows more pixels that are two codes off
    assert_int_equal(judge(device, settings, &expected, detail, sizeof(detail)), RG_OK);
    device->info.tier = RG_T1;
    rg_picture_destroy(&expected.dry); // without a background the mask is the whole picture
    assert_int_equal(judge(device, settings, &expected, detail, sizeof(detail)), RG_OK);
    rg_expected_free(&expected);
    assert_true(rg_device_close(device));
    free(settings);
}

// --- flow with one more fact and many more passes ---

static bool open_talker(struct rg_instance *instance)
{
    const bool ok = rg_technique_find("flow")->open(instance);
    rg_tell(instance, "panes", 6);
    return ok;
}

// 72 more passes, each named twice a frame. The last takes a millisecond each time.
enum { OWN_PASSES = RG_MAX_PASS_TIMES + 8 };

static bool step_talker(struct rg_instance *instance)
{
    static char names[OWN_PASSES][16];
    for (int i = 0; i < 2 * OWN_PASSES; i++) {
        const int own = i % OWN_PASSES;
        snprintf(names[own], sizeof(names[0]), "pass %d", own);
        if (own == OWN_PASSES - 1)
            nanosleep(&(struct timespec){.tv_nsec = 1000000}, NULL);
        if (instance->after_stage)
            instance->after_stage(&(struct rg_opened_stage){.row.kernel = names[own]},
                                  instance->user);
    }
    for (struct rg_fact *f = instance->facts; f < instance->facts + instance->fact_count; f++)
        f->number += 1;
    return rg_technique_find("flow")->step(instance);
}

static int64_t counter_of(const struct rg_record *record, const char *name)
{
    for (int i = 0; i < record->counter_count; i++)
        if (!strcmp(record->counters[i].name, name))
            return record->counters[i].value;
    return -1;
}

static void test_what_a_record_keeps(void **state)
{
    (void)state;
    struct rg_technique talker = *rg_technique_find("flow");
    talker.open = open_talker;
    talker.step = step_talker;
    void *settings = settings_of("flow", CHEAP, "");
    struct rg_device *device = rg_device_open("cpu");
    struct rg_expected expected;
    expect(&expected, &talker, settings);
    struct rg_record record = {0};
    struct rg_job job = {.subject = {&talker, settings, SIZE_PX, SIZE_PX},
                         .device = device,
                         .check_frames = RG_CHECK_FRAMES,
                         .record = &record};
    const struct rg_measure_options options = {
        .most_samples = 3, .least_samples = 3, .sample_ms = 1, .warm_up_ms = 1};
    assert_true(rg_job_open(&job) && rg_job_check(&job, &expected) &&
                rg_job_warm_up(&job, &options));
    rg_jobs_measure(&job, 1, &options);
    assert_int_equal(record.outcome, RG_OK);
    assert_int_equal(counter_of(&record, "pixels_lit"), 2 * SIZE_PX * SIZE_PX); // drawn twice
    assert_int_equal(record.fact_count, 7);                                     // after flow's own
    assert_string_equal(record.facts[6].name, "panes");
    assert_equals(record.facts[6].number, 6 + RG_CHECK_FRAMES);
    // Every name once; flow's own passes came too late to get one.
    assert_int_equal(record.pass_count, RG_MAX_PASS_TIMES);
    for (int i = 0; i < RG_MAX_PASS_TIMES - 1; i++) {
        char name[16];
        snprintf(name, sizeof(name), "pass %d", i);
        assert_string_equal(record.passes[i].name, name);
    }
    const struct rg_pass_time *other = &record.passes[RG_MAX_PASS_TIMES - 1];
    assert_string_equal(other->name, "other");
    assert_at_least(other->ms, 2); // it has the last pass, both times
    rg_job_close(&job);
    rg_expected_free(&expected);
    assert_true(rg_device_close(device));
    free(settings);
}

// --- how many samples a cell takes ---

static bool step_slowly(struct rg_instance *instance)
{
    nanosleep(&(struct timespec){.tv_nsec = 20000000}, NULL);
    return rg_technique_find("flow")->step(instance);
}

// As many as the time allows, within bounds: slow and fast cells in one run.
static void test_samples(void **state)
{
    (void)state;
    const struct rg_technique *flow = rg_technique_find("flow");
    struct rg_technique slow = *flow;
    slow.step = step_slowly;
    const struct rg_measure_options options = {.most_samples = 40,
                                               .least_samples = 2,
                                               .sample_ms = 1,
                                               .job_ms = 200,
                                               .warm_up_ms = 1,
                                               .passes_ms = 400};
    void *settings = settings_of("flow", CHEAP, "");
    struct rg_device *device = rg_device_open("cpu");
    struct rg_record records[2] = {0};
    struct rg_job jobs[2];
    for (int i = 0; i < 2; i++) {
        jobs[i] = (struct rg_job){.subject = {i ? &slow : flow, settings, 16, 16},
                                  .device = device,
                                  .check_frames = 1,
                                  .record = &records[i]};
        assert_true(rg_job_open(&jobs[i]) && rg_job_warm_up(&jobs[i], &options));
    }
    rg_jobs_measure(jobs, 2, &options);
    for (int i = 0; i < 2; i++) {
        assert_int_equal(records[i].outcome, RG_OK);
        assert_int_equal(records[i].sample_count, jobs[i].record->wanted_samples);
        assert_between(records[i].sample_count, 2, 40);
        assert_between(records[i].pass_frames, 2, 40);
        rg_job_close(&jobs[i]);
    }
    assert_at_most(records[1].sample_count, 5); // 40 ms each, with the frame before it
    assert_true(rg_device_close(device));
    free(settings);
}

// --- frames of one age ---

enum { WINDOW_CHECK_FRAMES = 5, WINDOW_FRAMES = 4 };
static int frames_of_age[WINDOW_CHECK_FRAMES + WINDOW_FRAMES + 1]; // the last counts all older ones

static bool step_with_age(struct rg_instance *instance)
{
    const int64_t most = WINDOW_CHECK_FRAMES + WINDOW_FRAMES;
    frames_of_age[instance->frame < most ? instance->frame : most]++;
    return rg_technique_find("flow")->step(instance);
}

static void test_window(void **state)
{
    (void)state;
    struct rg_technique aging = *rg_technique_find("flow");
    aging.step = step_with_age;
    const struct rg_measure_options options = {
        .most_samples = 9, .least_samples = 9, .sample_ms = 1000, .warm_up_ms = 1000};
    void *settings = settings_of("flow", CHEAP, "");
    struct rg_device *device = rg_device_open("cpu");
    struct rg_record record = {0};
    struct rg_job job = {.subject = {&aging, settings, 16, 16},
                         .device = device,
                         .check_frames = WINDOW_CHECK_FRAMES,
                         .window_frames = WINDOW_FRAMES,
                         .record = &record};
    assert_true(rg_job_open(&job) && rg_job_count(&job) && rg_job_warm_up(&job, &options));
    rg_jobs_measure(&job, 1, &options);
    assert_int_equal(record.outcome, RG_OK);
    assert_int_equal(record.sample_count, 9);
    assert_int_equal(record.frames_a_sample, WINDOW_FRAMES - 1); // the first frame is not timed
    assert_int_equal(frames_of_age[WINDOW_CHECK_FRAMES + WINDOW_FRAMES], 0);
    // Each sample follows check frames of its own, and includes the last frame of the window.
    assert_at_least(frames_of_age[0], 9);
    assert_at_least(frames_of_age[WINDOW_CHECK_FRAMES + WINDOW_FRAMES - 1], 9);
    rg_job_close(&job);
    assert_true(rg_device_close(device));
    free(settings);
}

// --- how much counters grow in a frame ---

static void test_counted(void **state)
{
    (void)state;
    static const char *const names[] = {"pixels_lit", "of no technique", NULL};
    void *settings = settings_of("flow", CHEAP, "");
    struct rg_device *device = rg_device_open("cpu");
    struct rg_record record = {0};
    struct rg_job job = {.subject = {rg_technique_find("flow"), settings, 32, 16},
                         .device = device,
                         .check_frames = 3,
                         .counted = names,
                         .record = &record};
    assert_true(rg_job_open(&job) && rg_job_count(&job) && rg_job_count(&job));
    assert_int_equal(record.counted_count, 2); // of the last count
    assert_string_equal(record.counted[0].name, "pixels_lit");
    assert_int_equal(record.counted[0].value, 32 * 16);
    assert_int_equal(record.counted[1].value, 0);
    rg_job_close(&job);
    assert_true(rg_device_close(device));
    free(settings);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_counted),
        cmocka_unit_test(test_tiers_by_the_mask),
        cmocka_unit_test(test_what_a_record_keeps),
        cmocka_unit_test(test_samples),
        cmocka_unit_test(test_window),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
