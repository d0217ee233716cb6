// When two pictures of a cell are alike, what is said if not, and which files then show it.
// Stand-ins draw and compare them.
#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/base/log.h"
#include "core/image/files/io.h"
#include "harness/compare/diff/pair.h"
#include "harness/compare/gate/pictures/pictures.h"
#include "harness/compare/gate/sides/alike.h"
#include "harness/devices/frames/frame.h"
#include "harness/record/output.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/folder.h"
#include "tests/tools/process/logged.h"

// --- stand-ins ---

static struct rg_device devices[RG_SIDES];
static const struct rg_gate_cell cell = {
    .name = "rain", .subject = {.width = 8, .height = 4}, .frames = 3};
static struct rg_comparison found; // what comparing gives
static bool draws, compares, is_written;
static int written;
static struct rg_drawn a, b;

static int64_t asked_bytes; // of room in a folder

bool rg_output_can_be_written(const char *into, int64_t bytes)
{
    asked_bytes = bytes;
    return !access(into, W_OK);
}

bool rg_frame_draw_dry(struct rg_device *device, const struct rg_subject *subject, int frames,
                       struct rg_picture *picture)
{
    assert_ptr_equal(device, &devices[RG_SIDE_A]);
    assert_ptr_equal(subject, &cell.subject);
    assert_int_equal(frames, 3);
    picture->width = 77;
    return draws || rg_crash_error("it fell");
}

bool rg_frame_compare(struct rg_device *device, const struct rg_subject *subject, int frames,
                      const struct rg_device_info *other, const struct rg_picture *expected,
                      const struct rg_picture *dry, const struct rg_picture *picture,
                      struct rg_comparison *comparison)
{
    assert_ptr_equal(device, &devices[RG_SIDE_B]);
    assert_ptr_equal(other, &devices[RG_SIDE_A].info);
    assert_ptr_equal(subject, &cell.subject);
    assert_int_equal(frames, 3);
    assert_true(expected == &a.picture && picture == &b.picture && dry->width == 77);
    *comparison = found;
    return compares || rg_harness_error("no memory");
}

void rg_frame_tell_dry(struct rg_device *device, const struct rg_subject *subject, int frames,
                       float exposure, const char *option, char text[RG_FRAME_DRY])
{
    assert_ptr_equal(device, &devices[RG_SIDE_A]);
    snprintf(text, RG_FRAME_DRY, "no rain of %p at %d, %g, %s", (const void *)subject, frames,
             (double)exposure, option);
}

bool rg_pair_heatmaps(const char *prefix, const struct rg_picture *of_a,
                      const struct rg_picture *of_b, const struct rg_comparison *comparison)
{
    (void)comparison;
    assert_true(of_a == &a.picture && of_b == &b.picture);
    assert_string_equal(strrchr(prefix, '/') + 1, "rain.b");
    written++;
    return is_written;
}

// --- alike or not ---

static struct rg_agreement agreement;

// Pictures that hold the tiers from `strictest` on, of devices whose tiers are these.
static bool compare(int strictest, enum rg_tier of_a, enum rg_tier of_b, int64_t rain)
{
    devices[RG_SIDE_A].info.tier = of_a;
    devices[RG_SIDE_B].info.tier = of_b;
    found = (struct rg_comparison){.metrics = {.differing_pixels = 12, .differing_values = 20},
                                   .tiers = {.mask_pixels = rain, .max_codes = 5}};
    for (int tier = 0; tier < RG_TIER_COUNT; tier++) {
        found.tiers.of[tier].holds = tier >= strictest;
        snprintf(found.tiers.of[tier].why, sizeof(found.tiers.of[0].why), "why T%d", tier);
    }
    const char *to = agreement.folder;
    agreement = (struct rg_agreement){.outcome = RG_OK,
                                      .folder = to,
                                      .name = "rain.b",
                                      .would_hold = -1,
                                      .pixels = NAN,
                                      .difference = NAN};
    return rg_alike_pictures(&cell, &a, &b, &agreement);
}

static int set_up(void **state)
{
    (void)state;
    draws = compares = is_written = true;
    written = logged_lines = 0;
    agreement.folder = NULL;
    a.device = &devices[RG_SIDE_A];
    a.name = "old";
    b.device = &devices[RG_SIDE_B];
    b.name = "new";
    return 0;
}

static void pictures_must_hold_the_looser_tier_of_both(void **state)
{
    (void)state;
    static const struct {
        int strictest;
        enum rg_tier a, b;
        const char *said; // "": they are alike
    } rows[] = {
        {RG_T0, RG_T0, RG_T0, ""},
        {RG_T1, RG_T0, RG_T0, "the picture differs: why T0; T1 would hold"},
        {RG_T1, RG_T0, RG_T1, ""},
        {RG_T1, RG_T1, RG_T0, ""},
        {RG_T2, RG_T1, RG_T0, "the picture differs: why T1; T2 would hold"},
        {RG_TIER_COUNT, RG_T2, RG_T0, "the picture differs: why T2; no tier would hold: why T2"},
    };
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        const bool are_alike = compare(rows[i].strictest, rows[i].a, rows[i].b, 1);
        assert_string_equal(agreement.message, rows[i].said);
        assert_int_equal(are_alike, !*rows[i].said);
        assert_int_equal(agreement.outcome, are_alike ? RG_OK : RG_FAIL);
        assert_true(agreement.pixels == 12 && agreement.difference == 5);
        assert_int_equal(agreement.would_hold, are_alike ? -1 : rows[i].strictest);
        assert_ptr_equal(agreement.truth, are_alike ? NULL : a.name);
        assert_false(agreement.has_pictures);
    }
    assert_int_equal(logged_lines, 0);
}

static void without_rain_nothing_is_compared(void **state)
{
    (void)state;
    char due[RG_FRAME_DRY];
    snprintf(due, sizeof(due), "no rain of %p at 3, 1, FRAMES", (const void *)&cell.subject);
    assert_false(compare(RG_TIER_COUNT, RG_T1, RG_T0, 0));
    assert_string_equal(agreement.message, due);
    assert_true(agreement.outcome == RG_NOTHING && agreement.is_ours);
    assert_true(isnan(agreement.pixels) && isnan(agreement.difference));
}

static void what_cannot_be_compared_fails_on_its_side(void **state)
{
    (void)state;
    draws = false;
    assert_false(compare(RG_T0, RG_T0, RG_T0, 1));
    assert_string_equal(agreement.message, "it fell");
    assert_true(agreement.outcome == RG_CRASH && agreement.device == a.name && !agreement.is_ours);
    draws = true;
    compares = false;
    assert_false(compare(RG_T0, RG_T0, RG_T0, 1));
    assert_string_equal(agreement.message, "no memory");
    assert_true(agreement.outcome == RG_LACKING && agreement.device == a.name);
    assert_true(agreement.is_ours);
}

// --- files ---

static void remove_all(const char *from)
{
    static const char *const ends[] = {"a.png", "b.png", "a.exr", "b.exr"};
    char path[PATH_MAX];
    for (int i = 0; i < 4; i++) {
        snprintf(path, sizeof(path), "%.200s/rain.b-%s", from, ends[i]);
        if (unlink(path))
            fail_msg("%s is not there", path);
    }
}

// Reads the first value of a side's picture again.
static float value_of(const char *from, const char *end)
{
    char path[PATH_MAX];
    struct rg_picture read = {0};
    snprintf(path, sizeof(path), "%.200s/rain.b-%s", from, end);
    assert_true(rg_picture_read(path, &read));
    const float value = read.texels[0];
    rg_picture_destroy(&read);
    return value;
}

static void pictures_that_differ_are_written(void **state)
{
    assert_int_equal(make_folder(state), 0);
    assert_true(rg_picture_create(&a.picture, 2, 2, 4, "a"));
    assert_true(rg_picture_create(&b.picture, 2, 2, 4, "b"));
    for (int i = 0; i < 16; i++) {
        a.picture.texels[i] = i % 4 == 3 ? 1 : 0.25F;
        b.picture.texels[i] = i % 4 == 3 ? 1 : 0.5F;
    }
    agreement.folder = folder;
    assert_true(compare(RG_T0, RG_T0, RG_T0, 1));
    assert_int_equal(written, 0);
    assert_false(compare(RG_T1, RG_T0, RG_T0, 1));
    assert_true(agreement.has_pictures && written == 1);
    assert_true(value_of(folder, "a.exr") == 0.25F && value_of(folder, "b.exr") == 0.5F);
    assert_below(value_of(folder, "a.png"), value_of(folder, "b.png"));
    remove_all(folder);
    is_written = false;
    assert_false(compare(RG_T1, RG_T0, RG_T0, 1));
    assert_false(agreement.has_pictures);
    assert_int_equal(agreement.outcome, RG_FAIL);
    remove_all(folder);
    assert_int_equal(remove_folder(state), 0);
    rg_picture_destroy(&a.picture);
    rg_picture_destroy(&b.picture);
}

static void a_picture_has_a_name_that_file_systems_take(void **state)
{
    (void)state;
    static const char *const ends[] = {"-a.png", "-b.png", "-flip.png", "-difference.png"};
    char path[PATH_MAX], other[PATH_MAX];
    for (int i = 0; i < RG_GATE_PICTURES; i++) {
        rg_gate_picture_path("out", "rain.gl", i, path);
        assert_ptr_equal(strstr(path, "out/rain.gl-"), path);
        assert_string_equal(path + strlen("out/rain.gl"), ends[i]);
    }
    rg_gate_picture_path("out", "a/b.gl", 0, path);
    rg_gate_picture_path("out", "a_b.gl", 0, other);
    assert_ptr_equal(strstr(path, "out/a_b.gl_"), path);
    assert_string_not_equal(path, other);
    char long_name[PATH_MAX];
    memset(long_name, 'f', sizeof(long_name));
    long_name[PATH_MAX / 2 + 1] = 0;
    assert_false(rg_gate_pictures_can_be_written(long_name, 1));
    assert_non_null(strstr(rg_last_error(), "...: is too long a name for a folder"));
    assert_true(rg_gate_pictures_can_be_written("/tmp", 1));
    // Four pictures of 3 bytes a pixel, and both sides' light.
    const int64_t pixels = 1000;
    asked_bytes = 0;
    assert_true(rg_gate_pictures_can_be_written("/tmp", pixels));
    assert_equals(asked_bytes, 4 * 3 * pixels + 2 * rg_picture_file_bytes("a.exr", pixels));
    assert_false(rg_gate_pictures_can_be_written("/nonexistent/out", 1));
}

int main(void)
{
    rg_log_listen(log_last, NULL);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(pictures_must_hold_the_looser_tier_of_both, set_up),
        cmocka_unit_test_setup(without_rain_nothing_is_compared, set_up),
        cmocka_unit_test_setup(what_cannot_be_compared_fails_on_its_side, set_up),
        cmocka_unit_test_setup(pictures_that_differ_are_written, set_up),
        cmocka_unit_test(a_picture_has_a_name_that_file_systems_take),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
