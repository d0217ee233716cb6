// Sessions that are kept open belong to their subject, and true pictures to theirs.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <stdlib.h>

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

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(a_kept_session_is_of_its_subject)};
    return cmocka_run_group_tests_name("kept", tests, NULL, NULL);
}
