// A technique takes exactly the memory that it says it needs. A request above the limit is refused
// in one line with the numbers, and leaves nothing behind.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

#include "core/base/log.h"
#include "core/base/memory.h"
#include "core/image/files/io.h"
#include "tests/tools/expect.h"
#include "tests/tools/instance.h"

// Settings that change the use of memory: images, buffers, textures and meshes. Environments are
// small, and so are scenes, which come last, since opening one takes seconds.
static const struct subject {
    const char *technique, *set;
    int width, height;
} subjects[] = {
    {"raster", "", 64, 48},
    {"raster", "scene=mesh", 640, 480},
    {"cartoon", "style=gooch", 64, 64},
    {"cartoon", "", 512, 256},
    {"flow", "resolution_px=64 environment_px=32", 64, 64},
    {"flow", "resolution_px=512 move=paper direction=texel environment_px=64", 320, 200},
    {"drops", "", 64, 64},
    {"drops", "columns=64 rows=64 max_drops=500", 256, 256},
    {"shower", "geometry=off particles=1000", 64, 64},
    {"shower", "geometry=off particles=200000", 256, 64},
    {"shower", "city=small", 128, 64},
    {"streaks", "atlas=small city=small depth_map_px=256 shadow_map_px=64 lights=4", 96, 54},
};
enum { SUBJECTS = sizeof(subjects) / sizeof(subjects[0]), CITIES = 2 };

static int logged;

static void count_lines(enum rg_log_level level, const char *line, void *user)
{
    (void)line;
    (void)user;
    logged += level == RG_LOG_ERROR;
}

// The most bytes that one frame took on the device.
static int64_t taken_by(const struct subject *s, struct rg_device *device, const void *settings)
{
    const struct rg_technique *technique = rg_technique_find(s->technique);
    struct rg_instance *instance =
        rg_instance_open(technique, device, settings, s->width, s->height);
    assert_non_null(instance);
    const int64_t before = device->work->before_bytes;
    assert_true(technique->step(instance) && technique->draw(instance));
    rg_instance_close(instance);
    return device->work->most_bytes - before;
}

static void what_is_counted_is_what_is_taken(void **state)
{
    (void)state;
    rg_memory_allow((int64_t)64 << 30);
    for (int i = 0; i < SUBJECTS; i++) {
        const struct subject *s = &subjects[i];
        const struct rg_technique *technique = rg_technique_find(s->technique);
        void *settings = settings_of(s->technique, "", s->set);
        struct rg_device *device = rg_device_open("cpu");
        assert_non_null(device);
        const int64_t counted = rg_instance_bytes(technique, device, settings, s->width, s->height);
        const struct rg_work *work = rg_device_work(device);
        assert_int_equal(work->live_bytes + work->runs + work->dispatches + work->items, 0);
        assert_int_equal(work->bytes_written + work->bytes_read, 0);
        const int64_t taken = taken_by(s, device, settings);
        if (counted != taken)
            print_message("%s %s: counted %lld, taken %lld\n", s->technique, s->set,
                          (long long)counted, (long long)taken);
        assert_int_equal(counted, taken);
        assert_true(rg_device_close(device));
        free(settings);
    }
}

// Too little memory is refused, and exactly enough is accepted. A refused instance gives all memory
// back.
static void what_exceeds_what_is_allowed_is_refused(void **state)
{
    (void)state;
    for (int i = 0; i < SUBJECTS - CITIES; i++) {
        const struct subject *s = &subjects[i];
        const struct rg_technique *technique = rg_technique_find(s->technique);
        void *settings = settings_of(s->technique, "", s->set);
        struct rg_device *device = rg_device_open("cpu");
        char text[RG_MEMORY_TEXT];
        const int64_t needed = rg_instance_bytes(technique, device, settings, s->width, s->height);
        const int64_t target = (int64_t)s->width * s->height * 8;
        rg_memory_allow(target); // only the first image fits
        logged = 0;
        rg_log_listen(count_lines, NULL);
        assert_null(rg_instance_open(technique, device, settings, s->width, s->height));
        rg_log_listen(NULL, NULL);
        assert_int_equal(logged, 1);
        assert_non_null(strstr(rg_last_error(), s->technique));
        assert_non_null(strstr(rg_last_error(), rg_memory_text(target, text)));
        assert_int_equal(rg_memory_left(), target);
        rg_memory_allow(needed);
        assert_int_equal(taken_by(s, device, settings), needed);
        assert_true(rg_device_close(device));
        free(settings);
    }
}

static long most_resident_kib(void)
{
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss;
}

// A large picture is counted before any of its memory is taken, so that a refusal takes no time.
// The test runs first, while this process is small.
static void large_pictures_are_refused_before_anything_is_taken(void **state)
{
    (void)state;
    const struct rg_technique *technique = rg_technique_find("raster");
    void *settings = settings_of(technique->name, "", "");
    struct rg_device *device = rg_device_open("cpu");
    const long before_kib = most_resident_kib();
    rg_memory_allow((int64_t)200 << 20); // the first image, of 128 MiB, would fit
    assert_null(rg_instance_open(technique, device, settings, 4096, 4096));
    assert_non_null(strstr(rg_last_error(), "raster of 4096x4096 on cpu needs"));
    assert_below(most_resident_kib(), before_kib + 64 * 1024);
    assert_true(rg_device_close(device));
    free(settings);
}

// A picture's file takes at least the bytes that were announced, and at most twenty times as many.
static void files_take_what_they_are_said_to_take(void **state)
{
    (void)state;
    static const char *const paths[] = {"/tmp/raingauge-room.png", "/tmp/raingauge-room.exr"};
    for (int i = 0; i < SUBJECTS - CITIES; i++) {
        const struct subject *s = &subjects[i];
        if (strstr(s->set, "geometry=off"))
            continue; // nearly black
        const struct rg_technique *technique = rg_technique_find(s->technique);
        void *settings = settings_of(s->technique, "", s->set);
        struct rg_device *device = rg_device_open("cpu");
        struct rg_instance *instance = rg_instance_open(technique, device, settings, 640, 480);
        struct rg_picture picture = {0};
        assert_non_null(instance);
        assert_true(technique->step(instance) && technique->draw(instance) &&
                    rg_frame_read_picture(instance, &picture));
        rg_picture_drop_opaque_alpha(&picture);
        for (int p = 0; p < 2; p++) {
            struct stat file;
            assert_true(rg_picture_write(paths[p], &picture, &(struct rg_write_options){0}));
            assert_int_equal(stat(paths[p], &file), 0);
            unlink(paths[p]);
            const int64_t said = rg_picture_file_bytes(paths[p], 640 * 480);
            if (file.st_size < said || file.st_size > 20 * said)
                print_message("%s %s: %lld said, %lld taken\n", s->technique, paths[p],
                              (long long)said, (long long)file.st_size);
            assert_between(file.st_size, said, 20 * said);
        }
        rg_picture_destroy(&picture);
        rg_instance_close(instance);
        assert_true(rg_device_close(device));
        free(settings);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(large_pictures_are_refused_before_anything_is_taken),
        cmocka_unit_test(what_is_counted_is_what_is_taken),
        cmocka_unit_test(files_take_what_they_are_said_to_take),
        cmocka_unit_test(what_exceeds_what_is_allowed_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
