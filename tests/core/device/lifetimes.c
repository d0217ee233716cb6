// Objects and devices come and go without a trace, and exist side by side.
#include <stdio.h>
#include <time.h>
#include <unistd.h>

#include "core/device/shared.h"
#include "kernels/probe/copy_params.h"
#include "tests/core/device/suite.h"
#include "tests/tools/expect.h"

enum { ROUNDS = 1000, WARM_UP = 100, MAX_GROWTH_BYTES = 16 << 20 };

static int64_t resident_bytes(void)
{
    long pages = 0, resident = 0;
    FILE *file = fopen("/proc/self/statm", "r");
    if (!file || fscanf(file, "%ld %ld", &pages, &resident) != 2)
        resident = 0;
    if (file)
        fclose(file);
    return (int64_t)resident * sysconf(_SC_PAGESIZE);
}

// Growth since `before`. AddressSanitizer keeps freed memory for a while, and finds leaks itself.
static int64_t grown_bytes(int64_t before)
{
#ifdef __SANITIZE_ADDRESS__
    return 0 * before;
#else
    return resident_bytes() - before;
#endif
}

static void check_as_many_live(const struct rg_device *device, const struct rg_work *before)
{
    const struct rg_work *work = rg_device_work(device);
    assert_int_equal(work->live_buffers, before->live_buffers);
    assert_int_equal(work->live_images, before->live_images);
    assert_int_equal(work->live_passes, before->live_passes);
    assert_int_equal(work->live_bytes, before->live_bytes);
}

// 64 KiB each, and written, so that they take memory: a leak of one in ten is found.
static void buffers_leave_nothing_behind(void **state)
{
    enum { WORDS = 16384 };
    const struct rg_work work = *rg_device_work(*state);
    uint32_t *words = noise_words(WORDS, 5);
    int64_t before = 0;
    for (int i = 0; i < ROUNDS; i++) {
        if (i == WARM_UP)
            before = resident_bytes();
        rg_buf_destroy(make_buf(*state, words, WORDS, "short-lived"));
    }
    free(words);
    assert_below(grown_bytes(before), MAX_GROWTH_BYTES);
    check_as_many_live(*state, &work);
}

static void images_leave_nothing_behind(void **state)
{
    const struct rg_work work = *rg_device_work(*state);
    const struct rg_image_desc desc = {RG_RGBA32F, 64, 64, 1, 3};
    uint32_t *texels = calloc(64 * 64, 16);
    int64_t before = 0;
    for (int i = 0; i < ROUNDS; i++) {
        if (i == WARM_UP)
            before = resident_bytes();
        struct rg_image *image = rg_image_create(*state, &desc, "short-lived");
        assert_non_null(image);
        assert_true(rg_image_write(image, 0, 0, texels));
        rg_image_destroy(image);
    }
    free(texels);
    assert_below(grown_bytes(before), MAX_GROWTH_BYTES);
    check_as_many_live(*state, &work);
}

static void passes_leave_nothing_behind(void **state)
{
    const struct rg_work work = *rg_device_work(*state);
    struct rg_buf *source = filled_buf(*state, 0, 64, "source");
    struct rg_buf *target = filled_buf(*state, 0, 64, "target");
    const struct probe_copy_params params = {64, 1, 1};
    const struct rg_run run = {
        .params = &params, .slots = {[1].buf = source, [2].buf = target}, .extent = {64, 1, 1}};
    int64_t before = 0;
    for (int i = 0; i < ROUNDS; i++) {
        if (i == ROUNDS / 10)
            before = resident_bytes();
        struct rg_pass *pass = rg_pass_create(*state, "probe_copy");
        assert_non_null(pass);
        assert_true(rg_pass_run(pass, &run));
        rg_pass_destroy(pass);
    }
    assert_true(rg_device_sync(*state));
    assert_below(grown_bytes(before), MAX_GROWTH_BYTES);
    rg_buf_destroy(source);
    rg_buf_destroy(target);
    check_as_many_live(*state, &work);
}

static void destroying_nothing_is_allowed(void **state)
{
    (void)state;
    rg_buf_destroy(NULL);
    rg_image_destroy(NULL);
    rg_pass_destroy(NULL);
    assert_true(rg_device_close(NULL));
}

static void devices_open_and_close(void **state)
{
    (void)state;
    int64_t before = 0;
    for (int i = 0; i < 10; i++) {
        if (i == 3)
            before = resident_bytes();
        struct rg_device *device = rg_device_open(suite_device);
        assert_non_null(device);
        struct rg_buf *buf = filled_buf(device, (uint32_t)i, 100, "words");
        uint32_t *words = read_words(buf, 100);
        assert_int_equal(words[99], i);
        free(words);
        rg_buf_destroy(buf);
        assert_true(rg_device_close(device));
    }
    assert_below(grown_bytes(before), 4 * MAX_GROWTH_BYTES);
}

// Two devices take turns in one thread, each call on the other one.
static void check_interleaved(struct rg_device *const devices[2])
{
    enum { WORDS = 1001 };
    struct rg_buf *source[2], *target[2];
    struct rg_pass *pass[2];
    uint32_t *words[2];
    for (int d = 0; d < 2; d++) {
        words[d] = noise_words(WORDS, (uint32_t)d * 77);
        source[d] = make_buf(devices[d], words[d], WORDS, "source");
    }
    for (int d = 0; d < 2; d++) {
        target[d] = filled_buf(devices[d], 0, WORDS, "target");
        assert_non_null(pass[d] = rg_pass_create(devices[d], "probe_copy"));
    }
    for (int i = 0; i < 20; i++) {
        const struct probe_copy_params params = {WORDS, 1, noise((uint32_t)i)};
        const int d = i % 2;
        assert_true(rg_pass_run(
            pass[d], &(struct rg_run){.params = &params,
                                      .slots = {[1].buf = source[d], [2].buf = target[d]},
                                      .extent = {WORDS, 1, 1}}));
    }
    for (int d = 0; d < 2; d++) {
        uint32_t *got = read_words(target[d], WORDS);
        for (int i = 0; i < WORDS; i++)
            assert_int_equal(got[i], words[d][i] ^ noise((uint32_t)(18 + d)));
        free(got);
        free(words[d]);
    }
    for (int d = 0; d < 2; d++) {
        rg_pass_destroy(pass[d]);
        rg_buf_destroy(source[d]);
        rg_buf_destroy(target[d]);
    }
}

static void devices_live_side_by_side(void **state)
{
    struct rg_device *twin = rg_device_open(suite_device);
    struct rg_device *reference = rg_device_open("cpu:reference");
    assert_true(twin && reference);
    check_interleaved((struct rg_device *[]){*state, twin});
    check_interleaved((struct rg_device *[]){reference, twin});
    assert_true(rg_device_close(twin));
    check_interleaved((struct rg_device *[]){*state, reference});
    assert_true(rg_device_close(reference));
}

// Pointers that a leak checker finds, so that it does not report the leaks made on purpose.
static void *leaked[3];

static void closing_reports_what_still_lives(void **state)
{
    (void)state;
    struct rg_device *device = rg_device_open(suite_device);
    assert_non_null(device);
    const struct rg_image_desc desc = {RG_RGBA8, 4, 4, 1, 1};
    leaked[0] = rg_buf_create(device, 64, "leaked");
    leaked[1] = rg_image_create(device, &desc, "leaked");
    leaked[2] = rg_pass_create(device, "probe_copy");
    assert_true(leaked[0] && leaked[1] && leaked[2]);
    const struct rg_device_info info = device->info;
    listen();
    assert_false(rg_device_close(device));
    // A validating driver may add lines of its own.
    const char *lines = heard_all();
    assert_non_null(strstr(lines, "1 buffers, 1 images and 1 passes not destroyed"));
    assert_non_null(strstr(lines, info.name));
}

// One object of any kind is enough.
static void closing_reports_each_kind(void **state)
{
    (void)state;
    static void *each[3]; // so that a leak checker finds them
    const struct rg_image_desc desc = {RG_RGBA8, 4, 4, 1, 1};
    for (int kind = 0; kind < 3; kind++) {
        struct rg_device *device = rg_device_open(suite_device);
        assert_non_null(device);
        each[kind] = kind == 0   ? (void *)rg_buf_create(device, 64, "leaked")
                     : kind == 1 ? (void *)rg_image_create(device, &desc, "leaked")
                                 : (void *)rg_pass_create(device, "probe_copy");
        assert_non_null(each[kind]);
        listen();
        assert_false(rg_device_close(device));
        assert_non_null(strstr(heard_all(), "not destroyed"));
    }
}

// --- shared things ---

// A shared buffer of four words, all of them the argument; counts what is made and destroyed.
static int things_made, things_destroyed;

static void *thing_make(struct rg_device *device, const void *arg)
{
    things_made++;
    return *(const uint32_t *)arg ? filled_buf(device, *(const uint32_t *)arg, 4, "thing") : NULL;
}

static void thing_destroy(void *thing)
{
    things_destroyed++;
    rg_buf_destroy(thing);
}

static const struct rg_shared_kind thing_kind = {"thing", thing_make, thing_destroy};
static const struct rg_shared_kind other_kind = {"other thing", thing_make, thing_destroy};

// A shared thing that holds another one.
static struct rg_device *box_device;

static void *box_make(struct rg_device *device, const void *arg)
{
    box_device = device;
    return rg_shared_get(device, "inside", &thing_kind, arg) ? calloc(1, 1) : NULL;
}

static void box_destroy(void *box)
{
    const uint32_t none = 0; // finds the existing thing; making one of 0 would fail
    void *inside = rg_shared_get(box_device, "inside", &thing_kind, &none);
    assert_non_null(inside);
    rg_shared_put(box_device, inside);
    rg_shared_put(box_device, inside);
    free(box);
}

static const struct rg_shared_kind box_kind = {"box", box_make, box_destroy};

static void things_are_shared_by_key_and_kind(void **state)
{
    const struct rg_work work = *rg_device_work(*state);
    const uint32_t seven = 7, nine = 9, none = 0;
    char key[] = "a = 7";
    things_made = things_destroyed = 0;
    void *first = rg_shared_get(*state, key, &thing_kind, &seven);
    key[4] = '9';
    void *other = rg_shared_get(*state, key, &thing_kind, &nine);
    key[4] = '7';
    void *again = rg_shared_get(*state, key, &thing_kind, &none);
    void *kin = rg_shared_get(*state, key, &other_kind, &nine);
    assert_true(first && other && kin && first == again && first != other && first != kin);
    assert_int_equal(things_made, 3);
    assert_null(rg_shared_get(*state, "none", &thing_kind, &none));
    uint32_t *words = read_words(first, 4);
    assert_int_equal(words[3], 7);
    free(words);
    rg_shared_put(*state, first);
    rg_shared_put(*state, NULL);
    assert_int_equal(things_destroyed, 0);
    rg_shared_put(*state, again);
    assert_int_equal(things_destroyed, 1);
    rg_shared_put(*state, other);
    rg_shared_put(*state, kin);
    assert_int_equal(things_destroyed, 3);
    // A thing that was destroyed is made again.
    rg_shared_put(*state, rg_shared_get(*state, key, &thing_kind, &nine));
    assert_int_equal(things_made, 5);
    assert_int_equal(things_destroyed, 4);
    check_as_many_live(*state, &work);
}

static void shared_things_hold_shared_things(void **state)
{
    const struct rg_work work = *rg_device_work(*state);
    const uint32_t seven = 7;
    void *box = rg_shared_get(*state, "box", &box_kind, &seven);
    void *inside = rg_shared_get(*state, "inside", &thing_kind, &seven);
    assert_true(box && inside);
    rg_shared_put(*state, inside);
    rg_shared_put(*state, box);
    check_as_many_live(*state, &work);
}

static void closing_reports_what_is_still_shared(void **state)
{
    (void)state;
    struct rg_device *device = rg_device_open(suite_device);
    const uint32_t seven = 7;
    things_destroyed = 0;
    assert_non_null(rg_shared_get(device, "kept", &thing_kind, &seven));
    assert_non_null(rg_shared_get(device, "kept", &thing_kind, &seven));
    assert_refused(rg_device_close(device), "closed with thing 'kept' not put back by 2");
    assert_int_equal(things_destroyed, 1);
}

static void time_goes_on(void **state)
{
    int64_t first_ns, second_ns;
    assert_true(rg_device_time(*state, &first_ns));
    assert_true(rg_device_sync(*state));
    assert_true(rg_device_time(*state, &second_ns));
    assert_at_least(second_ns, first_ns);
}

static double wall_ns(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec * 1e9 + (double)now.tv_nsec;
}

// Device time is in nanoseconds: within a factor of 2 of the wall clock. `raingauge doctor` checks
// it more closely.
static void time_is_in_nanoseconds(void **state)
{
    int64_t first_ns, second_ns;
    const double before_ns = wall_ns();
    assert_true(rg_device_time(*state, &first_ns));
    const double from_ns = wall_ns();
    nanosleep(&(struct timespec){.tv_nsec = 20000000}, NULL);
    const double to_ns = wall_ns();
    assert_true(rg_device_time(*state, &second_ns));
    const double found_ns = (double)(second_ns - first_ns);
    assert_above(found_ns, (to_ns - from_ns) / 2);
    assert_below(found_ns, (wall_ns() - before_ns) * 2);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(buffers_leave_nothing_behind),
    cmocka_unit_test(images_leave_nothing_behind),
    cmocka_unit_test(passes_leave_nothing_behind),
    cmocka_unit_test(destroying_nothing_is_allowed),
    cmocka_unit_test(devices_open_and_close),
    cmocka_unit_test(devices_live_side_by_side),
    cmocka_unit_test(closing_reports_what_still_lives),
    cmocka_unit_test(closing_reports_each_kind),
    cmocka_unit_test(things_are_shared_by_key_and_kind),
    cmocka_unit_test(shared_things_hold_shared_things),
    cmocka_unit_test(closing_reports_what_is_still_shared),
    cmocka_unit_test(time_goes_on),
    cmocka_unit_test(time_is_in_nanoseconds),
};
const struct suite_tests lifetime_tests = {tests, COUNT_OF(tests)};
