// Buffers keep their words, wherever and however many are written.
#include "tests/core/device/suite.h"

static void buffers_keep_what_was_written(void **state)
{
    static const int counts[] = {1, 3, 63, 64, 257, 65537, 1000003};
    for (int c = 0; c < COUNT_OF(counts); c++) {
        uint32_t *words = noise_words(counts[c], (uint32_t)c);
        struct rg_buf *buf = make_buf(*state, words, counts[c], "words");
        uint32_t *back = read_words(buf, counts[c]);
        assert_memory_equal(back, words, (size_t)counts[c] * 4);
        rg_buf_destroy(buf);
        free(words);
        free(back);
    }
}

static void parts_are_written_and_read_at_offsets(void **state)
{
    enum { WORDS = 4099 };
    static const struct {
        int first, count;
    } parts[] = {{0, 1}, {1, 1}, {7, 31}, {63, 66}, {1001, 2003}, {WORDS - 1, 1}, {WORDS - 5, 5}};
    uint32_t *words = noise_words(WORDS, 1);
    struct rg_buf *buf = make_buf(*state, words, WORDS, "words");
    for (int i = 0; i < COUNT_OF(parts); i++) {
        const int64_t offset = parts[i].first * 4, size = parts[i].count * 4;
        uint32_t *part = noise_words(parts[i].count, 1000u * (uint32_t)i);
        memcpy(words + parts[i].first, part, (size_t)size);
        assert_true(rg_buf_write(buf, offset, part, size));
        memset(part, 0, (size_t)size);
        assert_true(rg_buf_read(buf, offset, part, size));
        assert_memory_equal(part, words + parts[i].first, (size_t)size);
        free(part);
    }
    uint32_t *back = read_words(buf, WORDS);
    assert_memory_equal(back, words, WORDS * 4);
    free(back);
    free(words);
    rg_buf_destroy(buf);
}

static void what_the_caller_passed_may_change_at_once(void **state)
{
    enum { WORDS = 50000 };
    uint32_t *words = noise_words(WORDS, 2), *kept = noise_words(WORDS, 2);
    struct rg_buf *buf = make_buf(*state, words, WORDS, "words");
    memset(words, 0, WORDS * 4);
    uint32_t *back = read_words(buf, WORDS);
    assert_memory_equal(back, kept, WORDS * 4);
    free(back);
    free(words);
    free(kept);
    rg_buf_destroy(buf);
}

static void work_is_counted(void **state)
{
    const struct rg_work before = *rg_device_work(*state);
    uint32_t words[8] = {0};
    struct rg_buf *buf = make_buf(*state, words, 8, "words");
    assert_true(rg_buf_read(buf, 4, words, 12));
    const struct rg_work *after = rg_device_work(*state);
    assert_int_equal(after->bytes_written - before.bytes_written, 32);
    assert_int_equal(after->bytes_read - before.bytes_read, 12);
    assert_int_equal(after->live_buffers - before.live_buffers, 1);
    assert_int_equal(after->live_bytes - before.live_bytes, 32);
    rg_buf_destroy(buf);
    assert_int_equal(after->live_bytes, before.live_bytes);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(buffers_keep_what_was_written),
    cmocka_unit_test(parts_are_written_and_read_at_offsets),
    cmocka_unit_test(what_the_caller_passed_may_change_at_once),
    cmocka_unit_test(work_is_counted),
};
const struct suite_tests buffer_tests = {tests, COUNT_OF(tests)};
