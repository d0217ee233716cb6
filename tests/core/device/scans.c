// Prefix sums and compaction against the host's.
#include "core/device/scan.h"
#include "tests/core/device/suite.h"

static const int sizes[] = {1, 63, 64, 65, 4095, 4096, 4097, 262145, 1000003};
enum { LARGEST = 1000003, SENTINEL = 0x5e5e5e5e };

static void check_sum(struct rg_scan *scan, struct rg_buf *values, struct rg_buf *sums,
                      const uint32_t *words, int count)
{
    const uint32_t stale = SENTINEL; // where a larger run left the same total
    assert_true(rg_buf_write(sums, 4 * (uint64_t)count, &stale, sizeof(stale)));
    assert_true(rg_scan_sum(scan, values, sums, count));
    uint32_t *got = read_words(sums, LARGEST + 2), sum = 0;
    for (int i = 0; i < count; sum += words[i++])
        if (got[i] != sum)
            fail_msg("sum %d of %d is %u, not %u", i, count, got[i], sum);
    assert_int_equal(got[count], sum);
    assert_int_equal(got[LARGEST + 1], SENTINEL);
    free(got);
}

static void sums_equal_the_hosts(void **state)
{
    uint32_t *words = noise_words(LARGEST, 6);
    struct rg_buf *values = make_buf(*state, words, LARGEST, "values");
    struct rg_buf *sums = filled_buf(*state, SENTINEL, LARGEST + 2, "sums");
    struct rg_scan *scan = rg_scan_create(*state, LARGEST);
    assert_non_null(scan);
    for (int s = COUNT_OF(sizes) - 1; s >= 0; s--)
        check_sum(scan, values, sums, words, sizes[s]);
    check_sum(scan, values, sums, words, 0);
    rg_scan_destroy(scan);
    scan = rg_scan_create(*state, 64);
    assert_non_null(scan);
    check_sum(scan, values, sums, words, 64);
    rg_scan_destroy(scan);
    rg_buf_destroy(values);
    rg_buf_destroy(sums);
    free(words);
}

static void check_compact(struct rg_scan *scan, struct rg_buf *flags, struct rg_buf *indices,
                          const uint32_t *words, int count)
{
    struct rg_buf *found = filled_buf(flags->device, SENTINEL, 2, "found");
    assert_true(rg_scan_compact(scan, flags, indices, found, count));
    const int capacity = (int)(indices->size / 4);
    uint32_t *got = read_words(indices, capacity), *got_found = read_words(found, 2);
    int expected = 0;
    for (int i = 0; i < count; i++) {
        if (words[i] && expected < capacity && got[expected] != (uint32_t)i)
            fail_msg("index %d of %d is %u, not %d", expected, count, got[expected], i);
        expected += words[i] != 0;
    }
    assert_int_equal(got_found[0], expected);
    assert_int_equal(got_found[1], SENTINEL);
    free(got);
    free(got_found);
    rg_buf_destroy(found);
}

// One flag in `period` is set, to any value but 0.
static void compacted_indices_equal_the_hosts(void **state)
{
    static const uint32_t periods[] = {1, 2, 97, 1000000000};
    struct rg_scan *scan = rg_scan_create(*state, LARGEST);
    struct rg_buf *indices = filled_buf(*state, SENTINEL, LARGEST, "indices");
    struct rg_buf *few = filled_buf(*state, SENTINEL, 100, "few");
    assert_non_null(scan);
    for (int p = 0; p < COUNT_OF(periods); p++) {
        uint32_t *words = noise_words(LARGEST, 7);
        for (int i = 0; i < LARGEST; i++)
            words[i] = noise(words[i]) % periods[p] == 0 ? words[i] | 0x80000000u : 0;
        struct rg_buf *flags = make_buf(*state, words, LARGEST, "flags");
        for (int s = 0; s < COUNT_OF(sizes); s++)
            check_compact(scan, flags, indices, words, sizes[s]);
        check_compact(scan, flags, few, words, LARGEST);
        check_compact(scan, flags, few, words, 0);
        rg_buf_destroy(flags);
        free(words);
    }
    rg_buf_destroy(few);
    rg_buf_destroy(indices);
    rg_scan_destroy(scan);
}

static void scans_refuse_what_does_not_fit(void **state)
{
    assert_refused(rg_scan_create(*state, 0), "0 elements");
    assert_refused(rg_scan_create(*state, -1), "-1 elements");
    struct rg_scan *scan = rg_scan_create(*state, 100);
    struct rg_buf *values = filled_buf(*state, 1, 100, "values");
    struct rg_buf *sums = filled_buf(*state, 1, 101, "sums");
    struct rg_buf *small = filled_buf(*state, 1, 99, "small");
    struct rg_buf *short_by_one = filled_buf(*state, 1, 100, "short by one"); // lacks the total
    assert_non_null(scan);
    assert_refused(rg_scan_sum(scan, values, short_by_one, 100), "101 are needed");
    assert_refused(rg_scan_sum(scan, values, sums, 101), "101 elements");
    assert_refused(rg_scan_sum(scan, values, sums, -1), "-1 elements");
    assert_refused(rg_scan_sum(scan, values, values, 100), "'values'");
    assert_refused(rg_scan_sum(scan, small, sums, 100), "'small'");
    assert_refused(rg_scan_compact(scan, small, values, sums, 100), "'small'");
    assert_refused(rg_scan_compact(scan, values, values, sums, 100), "one object");
    assert_true(rg_scan_sum(scan, values, sums, 100));
    rg_buf_destroy(values);
    rg_buf_destroy(sums);
    rg_buf_destroy(small);
    rg_buf_destroy(short_by_one);
    rg_scan_destroy(scan);
    rg_scan_destroy(NULL);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(sums_equal_the_hosts),
    cmocka_unit_test(compacted_indices_equal_the_hosts),
    cmocka_unit_test(scans_refuse_what_does_not_fit),
};
const struct suite_tests scan_tests = {tests, COUNT_OF(tests)};
