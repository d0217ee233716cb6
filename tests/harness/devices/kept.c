// Sessions that are kept open belong to their subject, and true pictures to theirs.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <stdlib.h>
#include <string.h>

#include "harness/devices/kept.h"
#include "tests/tools/expect.h"
#include "tests/tools/instance.h"

static struct rg_subject subject_of(const char *set, int width)
{
    return (struct rg_subject){rg_technique_find("raster"), settings_of("raster", "", set), width,
                               16};
}

static int width_of(struct rg_session *session)
{
    struct rg_picture picture;
    assert_non_null(session);
    assert_true(rg_session_draw(session) && rg_session_read_picture(session, &picture));
    const int width = picture.width;
    rg_picture_destroy(&picture);
    return width;
}

// Whoever measures puts sessions of other subjects between two that ask for one.
static void a_kept_session_is_of_its_subject(void **state)
{
    (void)state;
    struct rg_device *device = rg_device_open("cpu");
    assert_non_null(device);
    const struct rg_devices devices = {.count = 1, .devices = {device}};
    struct rg_kept kept = {.devices = &devices};
    const struct rg_subject small = subject_of("billboards=10", 16),
                            large = subject_of("billboards=20", 48);
    struct rg_session *first = rg_kept_open(&kept, device, &small);
    assert_int_equal(width_of(first), 16);
    assert_ptr_equal(rg_kept_open(&kept, device, &small), first);
    rg_kept_put(&kept, rg_session_open(device, &large));
    assert_int_equal(width_of(rg_kept_open(&kept, device, &small)), 16);
    assert_int_equal(width_of(rg_kept_open(&kept, device, &large)), 48);
    assert_int_equal(width_of(rg_kept_open(&kept, device, &small)), 16);
    const struct rg_picture *truth = rg_kept_truth(&kept, &large, 1);
    assert_int_equal(truth->width, 48);
    assert_int_equal(rg_kept_truth(&kept, &small, 1)->width, 16);
    assert_ptr_equal(rg_kept_truth(&kept, &large, 1), truth);
    assert_int_equal(width_of(rg_kept_open(&kept, device, &large)),
                     48); // truths are drawn by sessions, too
    assert_true(rg_kept_free(&kept));
    assert_true(rg_device_close(device));
    free((void *)small.settings);
    free((void *)large.settings);
}

// A device of the command's is taken, and another one is opened once.
static void a_device_is_opened_once(void **state)
{
    (void)state;
    struct rg_device *device = rg_device_open("cpu");
    assert_non_null(device);
    const struct rg_devices devices = {.count = 1, .devices = {device}}, none = {.count = 0};
    struct rg_kept kept = {.devices = &devices}, own = {.devices = &none};
    assert_ptr_equal(rg_kept_device(&kept, "cpu"), device);
    struct rg_device *reference = rg_kept_device(&kept, "cpu:reference");
    assert_non_null(reference);
    assert_string_equal(reference->info.name, "cpu:reference");
    assert_ptr_equal(rg_kept_device(&kept, "cpu:reference"), reference);
    assert_null(kept.own[1]);
    assert_true(rg_kept_free(&kept));
    assert_null(kept.own[0]);
    assert_ptr_equal(kept.devices, &devices);
    struct rg_device *first = rg_kept_device(&own, "cpu"),
                     *second = rg_kept_device(&own, "cpu:reference");
    assert_ptr_not_equal(first, second);
    assert_ptr_equal(rg_kept_device(&own, "cpu"), first);
    assert_ptr_equal(rg_kept_device(&own, "cpu:reference"), second);
    assert_true(rg_kept_free(&own));
    assert_true(rg_device_close(device));
}

// Whatever of a subject is another makes another session.
static void every_part_of_a_subject_counts(void **state)
{
    (void)state;
    struct rg_device *device = rg_device_open("cpu");
    assert_non_null(device);
    const struct rg_devices devices = {.count = 1, .devices = {device}};
    struct rg_kept kept = {.devices = &devices};
    const struct rg_subject first = subject_of("billboards=10", 16),
                            last = subject_of("billboards=11", 16);
    struct rg_subject high = first, wide = first;
    high.height = 24;
    wide.width = 17;
    const struct rg_subject all[] = {first, high, last, wide};
    for (int i = 0; i < 4; i++) {
        const int made = kept.truth_count;
        const struct rg_picture *truth = rg_kept_truth(&kept, &all[i], 1);
        assert_int_equal(truth->height, i == 1 ? 24 : 16);
        assert_int_equal(truth->width, i == 3 ? 17 : 16);
        assert_int_equal(kept.truth_count, made + 1);
    }
    struct rg_session *session = rg_kept_open(&kept, device, &first);
    assert_ptr_equal(rg_kept_open(&kept, device, &first), session);
    assert_ptr_not_equal(rg_kept_open(&kept, device, &high), session);
    assert_true(rg_kept_free(&kept));
    assert_true(rg_device_close(device));
    free((void *)first.settings);
    free((void *)last.settings);
}

// Of nine pictures the first is gone, and is drawn again.
static void the_oldest_picture_goes(void **state)
{
    (void)state;
    struct rg_device *device = rg_device_open("cpu");
    assert_non_null(device);
    const struct rg_devices devices = {.count = 1, .devices = {device}};
    struct rg_kept kept = {.devices = &devices};
    const struct rg_subject subject = subject_of("billboards=10", 16);
    static const struct {
        int frames, made;
    } rows[] = {{1, 1}, {2, 2}, {3, 3}, {4, 4}, {5, 5},  {6, 6},  {7, 7},  {8, 8},
                {1, 8}, {8, 8}, {9, 9}, {2, 9}, {1, 10}, {9, 10}, {3, 10}, {2, 11}};
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        assert_non_null(rg_kept_truth(&kept, &subject, rows[i].frames));
        assert_int_equal(kept.truth_count, rows[i].made);
    }
    assert_true(rg_kept_free(&kept));
    assert_int_equal(kept.truth_count, 0);
    assert_true(rg_device_close(device));
    free((void *)subject.settings);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_kept_session_is_of_its_subject),
        cmocka_unit_test(a_device_is_opened_once),
        cmocka_unit_test(every_part_of_a_subject_counts),
        cmocka_unit_test(the_oldest_picture_goes),
    };
    return cmocka_run_group_tests_name("kept", tests, NULL, NULL);
}
