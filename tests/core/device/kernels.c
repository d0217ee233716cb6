// Kernels run once for every item of any grid, and atomics lose nothing.
#include "kernels/probe/copy_params.h"
#include "tests/core/device/suite.h"
#include "tests/kernels/atomics_params.h"
#include "tests/kernels/fault_params.h"
#include "tests/kernels/idle_params.h"

enum { POISON = 0x99999999 };

// Copies a grid's items within a larger grid; all others must keep their words.
static void check_copy(struct rg_device *device, struct rg_extent whole, struct rg_extent origin,
                       struct rg_extent extent)
{
    const int count = whole.width * whole.height * whole.depth;
    const struct probe_copy_params params = {whole.width, whole.height, 0x5eed};
    uint32_t *words = noise_words(count, 3);
    struct rg_buf *source = make_buf(device, words, count, "source");
    struct rg_buf *target = filled_buf(device, POISON, count, "target");
    struct rg_pass *pass = rg_pass_create(device, "probe_copy");
    assert_non_null(pass);
    assert_true(rg_pass_run(pass, &(struct rg_run){.params = &params,
                                                   .slots = {[1].buf = source, [2].buf = target},
                                                   .extent = extent,
                                                   .origin = origin}));
    uint32_t *got = read_words(target, count);
    for (int i = 0; i < count; i++) {
        const int x = i % whole.width, y = i / whole.width % whole.height;
        const int z = i / whole.width / whole.height;
        const bool inside = x >= origin.width && x < origin.width + extent.width &&
                            y >= origin.height && y < origin.height + extent.height &&
                            z >= origin.depth && z < origin.depth + extent.depth;
        if (got[i] != (inside ? words[i] ^ 0x5eed : POISON))
            fail_msg("item %d, %d, %d of %dx%dx%d", x, y, z, whole.width, whole.height,
                     whole.depth);
    }
    free(got);
    free(words);
    rg_pass_destroy(pass);
    rg_buf_destroy(source);
    rg_buf_destroy(target);
}

static void grids_cover_their_items_and_no_others(void **state)
{
    static const struct {
        struct rg_extent whole, origin, extent;
    } grids[] = {
        {{1, 1, 1}, {0, 0, 0}, {1, 1, 1}},      {{65, 1, 1}, {0, 0, 0}, {65, 1, 1}},
        {{200, 1, 1}, {63, 0, 0}, {66, 1, 1}},  {{67, 33, 5}, {0, 0, 0}, {67, 33, 5}},
        {{67, 33, 5}, {1, 2, 3}, {64, 30, 1}},  {{130, 9, 7}, {129, 8, 6}, {1, 1, 1}},
        {{3, 5, 300}, {1, 1, 17}, {2, 3, 200}},
    };
    for (int i = 0; i < COUNT_OF(grids); i++)
        check_copy(*state, grids[i].whole, grids[i].origin, grids[i].extent);
}

// llvmpipe and lavapipe cannot run 70,000 work groups at once.
static void grids_are_folded(void **state)
{
    const int groups = 70000;
    const int items = groups * ((struct rg_device *)*state)->info.limits.group_items;
    check_copy(*state, (struct rg_extent){items, 1, 1}, (struct rg_extent){0}, //
               (struct rg_extent){items, 1, 1});
    check_copy(*state, (struct rg_extent){3, groups, 1}, (struct rg_extent){0},
               (struct rg_extent){2, groups, 1});
    check_copy(*state, (struct rg_extent){1, 2, groups}, (struct rg_extent){0, 0, 1},
               (struct rg_extent){1, 2, groups - 1});
}

static void folding_is_counted(void **state)
{
    struct rg_device *device = *state;
    const struct rg_work before = *rg_device_work(device);
    const int limit = device->info.limits.max_groups[1];
    check_copy(device, (struct rg_extent){1, 70000, 1}, (struct rg_extent){0},
               (struct rg_extent){1, 70000, 1});
    const struct rg_work *after = rg_device_work(device);
    assert_int_equal(after->runs - before.runs, 1);
    assert_int_equal(after->items - before.items, 70000);
    assert_int_equal(after->dispatches - before.dispatches, (70000 + (int64_t)limit - 1) / limit);
}

// A queued run keeps its parameters when the next run sets others.
static void runs_keep_their_parameters(void **state)
{
    enum { RUNS = 200, WORDS = 64 };
    struct rg_buf *source = filled_buf(*state, 0, RUNS * WORDS, "source");
    struct rg_buf *target = filled_buf(*state, POISON, RUNS * WORDS, "target");
    struct rg_pass *pass = rg_pass_create(*state, "probe_copy");
    assert_non_null(pass);
    for (int r = 0; r < RUNS; r++) {
        struct probe_copy_params params = {RUNS * WORDS, 1, (uint32_t)r};
        assert_true(
            rg_pass_run(pass, &(struct rg_run){.params = &params,
                                               .slots = {[1].buf = source, [2].buf = target},
                                               .extent = {WORDS, 1, 1},
                                               .origin = {r * WORDS, 0, 0}}));
        params.salt = POISON;
    }
    uint32_t *got = read_words(target, RUNS * WORDS);
    for (int i = 0; i < RUNS * WORDS; i++)
        assert_int_equal(got[i], i / WORDS);
    free(got);
    rg_pass_destroy(pass);
    rg_buf_destroy(source);
    rg_buf_destroy(target);
}

// In a buffer that a kernel reads and writes, each item finds the word that it wrote last. What is
// told of the kernel's slots says that it does both.
static void items_find_their_own_words(void **state)
{
    enum { WIDTH = 96, HEIGHT = 5, WORDS = WIDTH * HEIGHT };
    const struct rg_kernel *kernel = rg_kernel_find("test_idle");
    uint32_t *words = noise_words(WORDS, 5);
    assert_int_equal(kernel->slots[0].kind, RG_SLOT_IN);
    assert_int_equal(kernel->slots[1].kind, RG_SLOT_INOUT);
    struct rg_buf *marks = filled_buf(*state, 1, WORDS, "marks");
    struct rg_buf *runs = make_buf(*state, words, WORDS, "runs");
    struct rg_pass *pass = rg_pass_create(*state, "test_idle");
    assert_non_null(pass);
    for (int r = 0; r < 2; r++)
        assert_true(rg_pass_run(pass, &(struct rg_run){.params = &(test_idle_params){WIDTH},
                                                       .slots = {[1].buf = marks, [2].buf = runs},
                                                       .extent = {WIDTH, HEIGHT, 1}}));
    uint32_t *got = read_words(runs, WORDS);
    for (int i = 0; i < WORDS; i++)
        assert_int_equal(got[i], words[i] + 2);
    free(got);
    free(words);
    rg_pass_destroy(pass);
    rg_buf_destroy(marks);
    rg_buf_destroy(runs);
}

// Each run reads the previous run's writes, without a sync in between.
static void runs_follow_each_other(void **state)
{
    enum { WORDS = 10007 };
    uint32_t *words = noise_words(WORDS, 4), expected = 0;
    struct rg_buf *bufs[2] = {make_buf(*state, words, WORDS, "even"),
                              filled_buf(*state, POISON, WORDS, "odd")};
    struct rg_pass *pass = rg_pass_create(*state, "probe_copy");
    assert_non_null(pass);
    for (int r = 0; r < 40; r++) {
        const struct probe_copy_params params = {WORDS, 1, noise((uint32_t)r)};
        expected ^= params.salt;
        assert_true(rg_pass_run(
            pass, &(struct rg_run){.params = &params,
                                   .slots = {[1].buf = bufs[r % 2], [2].buf = bufs[(r + 1) % 2]},
                                   .extent = {WORDS, 1, 1}}));
    }
    uint32_t *got = read_words(bufs[0], WORDS);
    for (int i = 0; i < WORDS; i++)
        assert_int_equal(got[i], words[i] ^ expected);
    free(got);
    free(words);
    rg_pass_destroy(pass);
    rg_buf_destroy(bufs[0]);
    rg_buf_destroy(bufs[1]);
}

// The results of tests/kernels/atomics.h, computed one item after the other.
static void expect_atomics(int items, int buckets, uint32_t *counts, int32_t *extremes)
{
    for (int x = 0; x < items; x++) {
        const int bucket = x % buckets;
        counts[bucket] += (uint32_t)x;
        counts[buckets + bucket] |= 1u << (x / buckets % 32);
        counts[2 * buckets + bucket] = (uint32_t)x;
        if (1000 - x < extremes[bucket])
            extremes[bucket] = 1000 - x;
        if (x - 1000 > extremes[buckets + bucket])
            extremes[buckets + bucket] = x - 1000;
        if (x < buckets)
            extremes[2 * buckets + bucket] = -x;
    }
}

static void atomics_lose_nothing(void **state)
{
    enum { MAX_WORDS = 3 * 7 };
    static const struct {
        int items, buckets;
    } cases[] = {{1, 1}, {1000, 7}, {50000, 1}, {1000000, 7}};
    struct rg_pass *pass = rg_pass_create(*state, "test_atomics");
    assert_non_null(pass);
    for (int c = 0; c < COUNT_OF(cases); c++) {
        const struct test_atomics_params params = {cases[c].buckets};
        const int words = 3 * params.buckets;
        uint32_t expected_counts[MAX_WORDS] = {0};
        int32_t expected_extremes[MAX_WORDS] = {0};
        expect_atomics(cases[c].items, params.buckets, expected_counts, expected_extremes);
        struct rg_buf *counts = filled_buf(*state, 0, words, "counts");
        struct rg_buf *extremes = filled_buf(*state, 0, words, "extremes");
        assert_true(
            rg_pass_run(pass, &(struct rg_run){.params = &params,
                                               .slots = {[1].buf = counts, [2].buf = extremes},
                                               .extent = {cases[c].items, 1, 1}}));
        uint32_t *got_counts = read_words(counts, words), *got = read_words(extremes, words);
        assert_memory_equal(got_counts, expected_counts, (size_t)words * 4);
        assert_memory_equal(got, expected_extremes, (size_t)words * 4);
        free(got_counts);
        free(got);
        rg_buf_destroy(counts);
        rg_buf_destroy(extremes);
    }
    rg_pass_destroy(pass);
}

// Other devices do not check indices: one out of range is the kernel's fault.
static void reference_notices_an_index_out_of_range(void **state)
{
    if (strcmp(suite_device, "cpu:reference") != 0)
        skip();
    struct rg_buf *target = filled_buf(*state, POISON, 10, "target");
    struct rg_pass *pass = rg_pass_create(*state, "test_fault");
    assert_non_null(pass);
    static const struct {
        int offset;
        const char *message; // NULL: the indices are in range
    } cases[] = {{0, NULL}, {5, NULL}, {6, "target[10]"}, {-1, "target[-1]"}, {10, "target[10]"}};
    for (int c = 0; c < COUNT_OF(cases); c++) {
        const struct test_fault_params params = {cases[c].offset};
        const struct rg_run run = {
            .params = &params, .slots = {[1].buf = target}, .extent = {5, 1, 1}};
        if (cases[c].message) {
            assert_refused(rg_pass_run(pass, &run), cases[c].message);
            assert_refused(rg_pass_run(pass, &run), "test_fault");
            assert_refused(rg_pass_run(pass, &run), "holds 10");
        } else {
            assert_true(rg_pass_run(pass, &run));
        }
    }
    rg_pass_destroy(pass);
    rg_buf_destroy(target);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(grids_cover_their_items_and_no_others),
    cmocka_unit_test(grids_are_folded),
    cmocka_unit_test(folding_is_counted),
    cmocka_unit_test(runs_keep_their_parameters),
    cmocka_unit_test(items_find_their_own_words),
    cmocka_unit_test(runs_follow_each_other),
    cmocka_unit_test(atomics_lose_nothing),
    cmocka_unit_test(reference_notices_an_index_out_of_range),
};
const struct suite_tests kernel_tests = {tests, COUNT_OF(tests)};
