// The atlas' cache file reads back as written, and is refused when damaged.
#define _DEFAULT_SOURCE // truncate
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <dirent.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/base/log.h"
#include "core/scene/atlas/cache.h"
#include "core/scene/atlas/levels.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/logged.h"

static char folder[] = "/tmp/raingauge-atlas-XXXXXX";
static char path[RG_ATLAS_PATH_SIZE], why[256];

static int setup(void **state)
{
    (void)state;
    rg_log_listen(log_last, NULL);
    if (!mkdtemp(folder) || setenv("XDG_CACHE_HOME", folder, 1))
        return 1;
    return !rg_atlas_cache_path(RG_ATLAS_SMALL, path, why);
}

static int teardown(void **state)
{
    (void)state;
    char name[RG_ATLAS_PATH_SIZE];
    unlink(path);
    snprintf(name, sizeof(name), "%s/raingauge", folder);
    rmdir(name);
    return rmdir(folder); // fails if a test left a file
}

// An atlas of arbitrary numbers: nothing here traces.
static struct rg_atlas *make(uint32_t seed)
{
    struct rg_atlas *atlas = rg_atlas_allocate(RG_ATLAS_SMALL);
    assert_non_null(atlas);
    for (int part = 0; part < RG_ATLAS_PART_COUNT; part++) {
        const size_t count = rg_atlas_image_texels(&atlas->images[part]);
        for (size_t i = 0; i < count; i++) {
            seed = seed * 1664525u + 1013904223u;
            atlas->images[part].texels[i] = (uint16_t)(seed >> 16 & 0x3bff);
        }
    }
    for (int i = 0; i < 4500; i++)
        (&atlas->point_factor[0][0][0][0])[i] = (float)(i + 1) / 4500;
    for (int i = 0; i < 50; i++)
        (&atlas->env_factor[0][0])[i] = (float)(i + 1) / 50;
    assert_true(rg_atlas_find_hash(atlas));
    return atlas;
}

static void expect_equal(const struct rg_atlas *a, const struct rg_atlas *b)
{
    assert_int_equal(a->hash, b->hash);
    assert_int_equal(a->first_level, b->first_level);
    assert_memory_equal(a->point_factor, b->point_factor, sizeof(a->point_factor));
    assert_memory_equal(a->env_factor, b->env_factor, sizeof(a->env_factor));
    for (int part = 0; part < RG_ATLAS_PART_COUNT; part++)
        assert_memory_equal(a->images[part].texels, b->images[part].texels,
                            rg_atlas_image_texels(&a->images[part]) * sizeof(uint16_t));
}

static void expect_state(enum rg_atlas_cached wanted)
{
    enum rg_atlas_cached state;
    why[0] = 0;
    struct rg_atlas *atlas = rg_atlas_cache_read(RG_ATLAS_SMALL, &state, why);
    assert_equals((atlas != NULL), (wanted == RG_ATLAS_SOUND));
    if (state != wanted)
        fail_msg("state %d, expected %d: %s", (int)state, (int)wanted, why);
    assert_true(atlas || why[0]);
    rg_atlas_destroy(atlas);
}

static void write_atlas(uint32_t seed)
{
    struct rg_atlas *atlas = make(seed);
    assert_true(rg_atlas_cache_write(atlas, why));
    rg_atlas_destroy(atlas);
}

static void test_round_trip(void **state)
{
    (void)state;
    enum rg_atlas_cached cached;
    expect_state(RG_ATLAS_ABSENT);
    struct rg_atlas *atlas = make(1);
    assert_true(rg_atlas_cache_write(atlas, why));
    struct rg_atlas *read = rg_atlas_cache_read(RG_ATLAS_SMALL, &cached, why);
    assert_non_null(read);
    assert_int_equal(cached, RG_ATLAS_SOUND);
    expect_equal(atlas, read);
    rg_atlas_destroy(atlas);
    rg_atlas_destroy(read);
}

static void flip(long offset, int whence, unsigned char bits)
{
    FILE *file = fopen(path, "r+b");
    assert_non_null(file);
    assert_int_equal(fseek(file, offset, whence), 0);
    const long at = ftell(file);
    const int byte = fgetc(file);
    assert_differs(byte, EOF);
    fseek(file, at, SEEK_SET);
    fputc(byte ^ bits, file);
    assert_int_equal(fclose(file), 0);
}

// One flipped bit anywhere is noticed: in the magic, version, size, sample, hash, a factor or a
// texel.
static void test_flipped_bits(void **state)
{
    (void)state;
    static const struct {
        long offset;
        enum rg_atlas_cached wanted;
    } flips[] = {{0, RG_ATLAS_DAMAGED},      {12, RG_ATLAS_STALE},      {16, RG_ATLAS_STALE},
                 {26, RG_ATLAS_STALE},       {32, RG_ATLAS_DAMAGED},    {44, RG_ATLAS_DAMAGED},
                 {18000, RG_ATLAS_DAMAGED},  {18200, RG_ATLAS_DAMAGED}, {30000, RG_ATLAS_DAMAGED},
                 {9999999, RG_ATLAS_DAMAGED}};
    write_atlas(2);
    for (size_t i = 0; i < sizeof(flips) / sizeof(flips[0]); i++) {
        flip(flips[i].offset, SEEK_SET, 4);
        expect_state(flips[i].wanted);
        flip(flips[i].offset, SEEK_SET, 4);
    }
    flip(-1, SEEK_END, 1);
    expect_state(RG_ATLAS_DAMAGED);
    flip(-1, SEEK_END, 1);
    expect_state(RG_ATLAS_SOUND);
}

static void test_wrong_lengths(void **state)
{
    (void)state;
    write_atlas(3);
    struct stat st;
    assert_int_equal(stat(path, &st), 0);
    const long lengths[] = {0, 7, 100, 18250, 1000000, st.st_size - 1, st.st_size + 1};
    for (int i = 0; i < 7; i++) {
        write_atlas(3);
        assert_int_equal(truncate(path, lengths[i]), 0);
        expect_state(RG_ATLAS_DAMAGED);
    }
    write_atlas(3);
    expect_state(RG_ATLAS_SOUND);
}

// Reading things that are not regular files neither hangs nor does harm.
static void test_other_things(void **state)
{
    (void)state;
    unlink(path);
    assert_int_equal(mkfifo(path, 0600), 0);
    expect_state(RG_ATLAS_DAMAGED);
    unlink(path);
    assert_int_equal(mkdir(path, 0700), 0);
    expect_state(RG_ATLAS_DAMAGED);
    struct rg_atlas *atlas = make(4);
    assert_false(rg_atlas_cache_write(atlas, why)); // a file cannot take a folder's place
    assert_non_null(strstr(why, path));
    assert_int_equal(rmdir(path), 0);
    setenv("XDG_CACHE_HOME", "/proc/nowhere", 1);
    assert_false(rg_atlas_cache_write(atlas, why));
    expect_state(RG_ATLAS_ABSENT);
    setenv("XDG_CACHE_HOME", "/dev/null", 1);
    assert_false(rg_atlas_cache_write(atlas, why));
    expect_state(RG_ATLAS_ABSENT);
    setenv("XDG_CACHE_HOME", folder, 1);
    rg_atlas_destroy(atlas);
}

// On a full disk the old file stays, and no other is left beside it.
static void test_full_disk(void **state)
{
    (void)state;
    write_atlas(6);
    struct rg_atlas *atlas = make(7);
    struct rlimit limit, small;
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &limit), 0);
    small = limit;
    small.rlim_cur = 1000000;
    signal(SIGXFSZ, SIG_IGN);
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &small), 0);
    const bool written = rg_atlas_cache_write(atlas, why);
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &limit), 0);
    assert_false(written);
    assert_non_null(strstr(why, "File too large"));
    expect_state(RG_ATLAS_SOUND);
    rg_atlas_destroy(atlas);
}

static int files_beside(void)
{
    char name[RG_ATLAS_PATH_SIZE];
    int count = 0;
    snprintf(name, sizeof(name), "%s/raingauge", folder);
    DIR *open = opendir(name);
    assert_non_null(open);
    for (const struct dirent *entry; (entry = readdir(open));)
        count += strcmp(entry->d_name, ".") != 0 && strcmp(entry->d_name, "..") != 0;
    closedir(open);
    return count;
}

// A process that is killed while it writes leaves the old file and no other.
static void test_killed(void **state)
{
    (void)state;
    write_atlas(8);
    struct rg_atlas *atlas = make(9);
    const pid_t writer = fork();
    assert_at_least(writer, 0);
    if (!writer) {
        const struct rlimit none = {0, 0}, small = {1000000, 1000000};
        signal(SIGXFSZ, SIG_DFL);
        _exit(setrlimit(RLIMIT_CORE, &none) || setrlimit(RLIMIT_FSIZE, &small) ||
              rg_atlas_cache_write(atlas, why));
    }
    int status;
    assert_int_equal(waitpid(writer, &status, 0), writer);
    assert_true(WIFSIGNALED(status));
    assert_equals(WTERMSIG(status), SIGXFSZ);
    assert_int_equal(files_beside(), 1);
    expect_state(RG_ATLAS_SOUND);
    rg_atlas_destroy(atlas);
}

static void test_where(void **state)
{
    (void)state;
    char place[RG_ATLAS_PATH_SIZE], home[RG_ATLAS_PATH_SIZE];
    const char *set = getenv("HOME");
    snprintf(home, sizeof(home), "%s", set ? set : "/");
    setenv("XDG_CACHE_HOME", "no/absolute/path", 1);
    setenv("HOME", "/somewhere", 1);
    assert_true(rg_atlas_cache_path(RG_ATLAS_FULL, place, why));
    assert_string_equal(place, "/somewhere/.cache/raingauge/streaks-full.atlas");
    unsetenv("HOME");
    assert_false(rg_atlas_cache_path(RG_ATLAS_FULL, place, why));
    assert_non_null(strstr(why, "XDG_CACHE_HOME"));
    expect_state(RG_ATLAS_ABSENT);
    char longest[2 * RG_ATLAS_PATH_SIZE];
    memset(longest, '/', sizeof(longest) - 1);
    longest[sizeof(longest) - 1] = 0;
    setenv("XDG_CACHE_HOME", longest, 1);
    assert_false(rg_atlas_cache_path(RG_ATLAS_FULL, place, why));
    setenv("HOME", home, 1);
    setenv("XDG_CACHE_HOME", folder, 1);
}

// While two processes write all the time, a reader finds one of their files, whole.
static void test_writers_at_once(void **state)
{
    (void)state;
    write_atlas(5);
    pid_t writers[2];
    for (uint32_t w = 0; w < 2; w++) {
        writers[w] = fork();
        assert_at_least(writers[w], 0);
        if (writers[w])
            continue;
        struct rg_atlas *atlas = rg_atlas_allocate(RG_ATLAS_SMALL);
        bool good = atlas != NULL;
        for (int i = 0; good && i < 6; i++) {
            atlas->images[0].texels[i] = (uint16_t)(w + 1);
            good = rg_atlas_find_hash(atlas) && rg_atlas_cache_write(atlas, why);
        }
        rg_atlas_destroy(atlas);
        _exit(!good);
    }
    for (int i = 0; i < 12; i++)
        expect_state(RG_ATLAS_SOUND);
    for (int w = 0; w < 2; w++) {
        int status;
        assert_int_equal(waitpid(writers[w], &status, 0), writers[w]);
        assert_int_equal(status, 0);
    }
    expect_state(RG_ATLAS_SOUND);
}

// raingauge cannot compute the original database: one line says how to pack it.
static void test_unpacked_database(void **state)
{
    (void)state;
    logged_lines = 0;
    assert_null(rg_atlas_load(RG_ATLAS_CAVE, NULL));
    assert_int_equal(logged_lines, 1);
    assert_non_null(strstr(rg_last_error(), "streaks-cave.atlas"));
    assert_non_null(strstr(rg_last_error(), "atlas --from"));
}

// Each size has a file of its own, and the traced ones have one of other swings.
static void test_sizes(void **state)
{
    (void)state;
    static const enum rg_atlas_size measured[RG_ATLAS_SIZE_COUNT] = {
        RG_ATLAS_MEASURED,   RG_ATLAS_MEASURED_SMALL, RG_ATLAS_CAVE,
        RG_ATLAS_CAVE_SMALL, RG_ATLAS_MEASURED,       RG_ATLAS_MEASURED_SMALL};
    const struct rg_atlas_kind *kinds = rg_atlas_kinds;
    char paths[RG_ATLAS_SIZE_COUNT][RG_ATLAS_PATH_SIZE];
    for (int i = 0; i < RG_ATLAS_SIZE_COUNT; i++) {
        const enum rg_atlas_size size = (enum rg_atlas_size)i;
        assert_int_equal(kinds[i].measured, measured[i]);
        assert_int_equal(kinds[i].is_small, kinds[measured[i]].is_small);
        assert_int_equal(kinds[i].is_packed, kinds[measured[i]].is_packed);
        assert_true(kinds[i].is_packed || kinds[measured[i]].detail.swings == RG_SWINGS_MEASURED);
        assert_true(rg_atlas_cache_path(size, paths[i], why));
        for (int k = 0; k < i; k++)
            assert_string_not_equal(paths[i], paths[k]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_sizes),           cmocka_unit_test(test_round_trip),
        cmocka_unit_test(test_flipped_bits),    cmocka_unit_test(test_wrong_lengths),
        cmocka_unit_test(test_other_things),    cmocka_unit_test(test_full_disk),
        cmocka_unit_test(test_where),           cmocka_unit_test(test_killed),
        cmocka_unit_test(test_writers_at_once), cmocka_unit_test(test_unpacked_database),
    };
    return cmocka_run_group_tests(tests, setup, teardown);
}
