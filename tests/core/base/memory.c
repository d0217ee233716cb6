// A limit of memory: what is taken counts, started processes learn the limit, and a refusal is one
// line.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "core/base/memory.h"
#include "tests/core/root.h"
#include "tests/tools/expect.h"

#define MIB ((int64_t)1 << 20)

static int warnings;

static void count_warnings(enum rg_log_level level, const char *line, void *user)
{
    (void)user;
    warnings += level == RG_LOG_WARNING && strstr(line, "RG_MEMORY_BYTES=1e9: is no whole number");
}

// This test runs first, before a limit is chosen. The variable holds no number: it is ignored, with
// one warning.
static void without_a_choice_a_tenth_of_what_is_free_is_kept(void **state)
{
    (void)state;
    rg_log_listen(count_warnings, NULL);
    const int64_t available = rg_memory_available(), left = rg_memory_left();
    rg_log_listen(NULL, NULL);
    assert_int_equal(warnings, 1);
    assert_above(available, 0);
    // Other processes take and give memory meanwhile.
    assert_above(left, available / 2);
    assert_below(left, available * 95 / 100);
    assert_false(rg_memory_take(available));
    assert_true(rg_memory_take(100 * MIB));
    assert_at_most(rg_memory_left(), left - 50 * MIB);
    rg_memory_give(100 * MIB);
}

static void what_is_taken_counts_until_it_is_given_back(void **state)
{
    (void)state;
    rg_memory_allow(10 * MIB);
    rg_memory_allow(0); // 0 is no choice
    assert_int_equal(rg_memory_left(), 10 * MIB);
    assert_true(rg_memory_take(10 * MIB - 4));
    assert_false(rg_memory_take(5)); // small pieces count as well
    assert_false(rg_memory_allows(5));
    assert_true(rg_memory_allows(4));
    rg_memory_allow(4 * MIB); // less than is taken already
    assert_int_equal(rg_memory_left(), 0);
    assert_false(rg_memory_take(1));
    rg_memory_give(10 * MIB - 4);
    assert_int_equal(rg_memory_left(), 4 * MIB);
}

// The user may allow more than is free; started processes learn the choice.
static void a_choice_outweighs_what_is_free(void **state)
{
    (void)state;
    const int64_t more = rg_memory_available() * 2;
    rg_memory_allow(more);
    assert_int_equal(rg_memory_left(), more);
    assert_int_equal(atoll(getenv("RG_MEMORY_BYTES")), more);
}

static void a_refusal_has_the_numbers(void **state)
{
    (void)state;
    char text[RG_MEMORY_TEXT];
    assert_string_equal(rg_memory_text(37 * MIB, text), "37 MiB");
    assert_string_equal(rg_memory_text(MIB / 16, text), "64 KiB");
    assert_string_equal(rg_memory_text(5 * MIB / 2, text), "2.5 MiB");
    assert_string_equal(rg_memory_text(5325 * MIB, text), "5.2 GiB");
    rg_memory_allow(3174 * MIB);
    assert_false(rg_memory_refuse("streaks on cpu", 5325 * MIB, "a smaller --size"));
    assert_string_equal(rg_last_error(),
                        "streaks on cpu needs 5.2 GiB, and 3.1 GiB of --memory are left; allow "
                        "more, or ask for less: a smaller --size");
}

// A large piece must fit into what is left, though it is not counted.
static void large_pieces_of_the_host_are_refused(void **state)
{
    (void)state;
    rg_memory_allow(10 * MIB);
    assert_true(rg_memory_allows_piece(64 * MIB - 1));
    assert_false(rg_memory_allows_piece(64 * MIB));
    rg_memory_allow(100 * MIB);
    void *fits = rg_alloc(99, MIB, "a map");
    assert_non_null(fits);
    free(fits);
    assert_null(rg_alloc(101, MIB, "a map"));
    assert_non_null(
        strstr(rg_last_error(), "a map needs 101 MiB, and 100 MiB of --memory are left"));
}

static int64_t available(void)
{
    return rg_memory_available_under(root);
}

// The tightest group around this process decides. Inactive file pages count as free.
static void what_groups_of_version_2_leave_is_what_is_free(void **state)
{
    (void)state;
    assert_int_equal(available(), 0); // without files it is unknown
    put("/proc/meminfo", "MemTotal: 4096 kB\nMemFree: 1 kB\nMemAvailable:    3072 kB\n");
    assert_int_equal(available(), 3 * MIB);
    put("/proc/self/cgroup", "0::/outer/inner\n");
    put("/sys/fs/cgroup/outer/inner/memory.max", "max\n");
    put("/sys/fs/cgroup/outer/inner/memory.current", "1048576\n");
    assert_int_equal(available(), 3 * MIB);
    put("/sys/fs/cgroup/outer/memory.max", "3145728\n");
    put("/sys/fs/cgroup/outer/memory.current", "2097152\n");
    assert_int_equal(available(), MIB);
    put("/sys/fs/cgroup/outer/memory.stat", "anon 5\ninactive_file 524288\nactive_file 7\n");
    assert_int_equal(available(), 3 * MIB / 2);
    put("/sys/fs/cgroup/outer/inner/memory.max", "2097152\n");
    assert_int_equal(available(), MIB);
    put("/sys/fs/cgroup/outer/inner/memory.max", "1048576\n");
    assert_int_equal(available(), 1); // 1 means known to be nothing
}

static void what_groups_of_version_1_leave_is_what_is_free(void **state)
{
    (void)state;
    put("/proc/meminfo", "MemAvailable: 3072 kB\n");
    put("/proc/self/cgroup", "4:cpu:/elsewhere\n3:hugetlb,memory:/docker/abc\n");
    put("/sys/fs/cgroup/memory/docker/abc/memory.limit_in_bytes", "9223372036854771712\n");
    put("/sys/fs/cgroup/memory/docker/abc/memory.usage_in_bytes", "1048576\n");
    assert_int_equal(available(), 3 * MIB);
    put("/sys/fs/cgroup/memory/docker/abc/memory.limit_in_bytes", "3145728\n");
    assert_int_equal(available(), 2 * MIB);
    put("/sys/fs/cgroup/memory/docker/abc/memory.stat",
        "inactive_file 7\ntotal_inactive_file 524288\n");
    assert_int_equal(available(), 5 * MIB / 2);
    put("/sys/fs/cgroup/hugetlb,memory/memory.limit_in_bytes",
        "2097152\n"); // mounted by both names
    put("/sys/fs/cgroup/hugetlb,memory/memory.usage_in_bytes", "1048576\n");
    assert_int_equal(available(), MIB);
}

int main(void)
{
    setenv("RG_MEMORY_BYTES", "1e9", 1);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(without_a_choice_a_tenth_of_what_is_free_is_kept),
        cmocka_unit_test(what_is_taken_counts_until_it_is_given_back),
        cmocka_unit_test(a_choice_outweighs_what_is_free),
        cmocka_unit_test(a_refusal_has_the_numbers),
        cmocka_unit_test(large_pieces_of_the_host_are_refused),
        cmocka_unit_test_setup_teardown(what_groups_of_version_2_leave_is_what_is_free, make_root,
                                        remove_root),
        cmocka_unit_test_setup_teardown(what_groups_of_version_1_leave_is_what_is_free, make_root,
                                        remove_root),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
