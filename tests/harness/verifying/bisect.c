// A bisect's search over every short list: the first bad candidate, and candidates that cannot be
// judged. Then the list itself.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <string.h>

#include "core/base/log.h"

#include "harness/compare/bisect/bisect.h"
#include "tests/tools/expect.h"

enum { LONGEST = 11 };

// Searches a list in which `first_bad` and all after it are bad, and the set bits of `skipped`
// cannot be judged.
static struct rg_search search(int count, int first_bad, uint64_t skipped, int *judged)
{
    enum rg_judgement verdicts[64] = {[0] = RG_JUDGED_GOOD};
    verdicts[count - 1] = RG_JUDGED_BAD;
    *judged = 0;
    for (;;) {
        const struct rg_search found = rg_search_of(verdicts, count);
        const int64_t next = found.next;
        if (next < 0)
            return found;
        assert_in_range(next, found.good + 1, found.bad - 1);
        assert_int_equal(verdicts[next], RG_JUDGED_NONE);
        verdicts[next] = skipped >> next & 1 ? RG_JUDGED_SKIP
                         : next >= first_bad ? RG_JUDGED_BAD
                                             : RG_JUDGED_GOOD;
        ++*judged;
    }
}

static void finds_what_can_be_known(void **state)
{
    (void)state;
    for (int count = 2; count <= LONGEST; count++)
        for (int first_bad = 1; first_bad < count; first_bad++)
            for (unsigned skipped = 0; skipped < 1u << count; skipped += 2) {
                int judged, good = first_bad - 1, bad = first_bad;
                if (skipped >> (count - 1) & 1)
                    continue; // the ends can be judged
                while (good > 0 && skipped >> good & 1)
                    good--;
                while (bad < count - 1 && skipped >> bad & 1)
                    bad++;
                const struct rg_search found = search(count, first_bad, skipped, &judged);
                assert_int_equal(found.good, good);
                assert_int_equal(found.bad, bad);
                assert_int_equal(found.left, 0);
            }
}

static void halves(void **state)
{
    (void)state;
    for (int count = 2; count <= 63; count++)
        for (int first_bad = 1; first_bad < count; first_bad++) {
            int judged;
            const struct rg_search whole = rg_search_of((enum rg_judgement[64]){0}, count);
            search(count, first_bad, 0, &judged);
            assert_at_most(judged, whole.steps);
            assert_at_most(1 << whole.steps, 2 * (count - 1));
        }
}

// The middle 20 of 60 cannot be judged: the search leaves them in leaps.
static void leaves_a_stretch_in_leaps(void **state)
{
    (void)state;
    enum rg_judgement verdicts[62] = {RG_JUDGED_GOOD, [61] = RG_JUDGED_BAD};
    int judged = 0;
    for (int64_t next = 0; next >= 0; judged++) {
        const struct rg_search found = rg_search_of(verdicts, 62);
        next = found.next;
        if (next < 21 || next > 40)
            break;
        verdicts[next] = RG_JUDGED_SKIP;
    }
    assert_int_equal(judged, 1);
}

// --- lists ---

static void add(const char *names, struct rg_candidates *candidates)
{
    static const char *const all[] = {"a", "b", "c", "d", "e"};
    for (; *names; names++)
        assert_true(rg_candidates_add(*names == 'x' ? "x" : all[*names - 'a'], candidates));
}

static void check_list(const char *names, const char *good, const char *bad, const char *wanted)
{
    struct rg_candidates c = {.count = 0};
    add(good, &c);
    add(names, &c);
    add(bad, &c);
    assert_int_equal(rg_candidates_between(&c), wanted != NULL);
    for (int64_t i = 0; wanted && i < c.count; i++)
        assert_int_equal(*c.names[i], wanted[i]);
    if (wanted)
        assert_int_equal(c.count, strlen(wanted));
    rg_candidates_free(&c);
}

static void lists_go_from_good_to_bad(void **state)
{
    (void)state;
    rg_log_hold(true);
    check_list("abcde", "b", "d", "bcd");
    check_list("abcde", "e", "a", "edcba");
    check_list("bcd", "a", "e", "abcde");
    check_list("", "a", "e", "ae");
    check_list("abcde", "a", "x", NULL);
    check_list("abcde", "x", "a", NULL);
    check_list("abc", "a", "a", NULL);
    check_list("abcb", "a", "c", NULL);
    rg_log_hold(false);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(finds_what_can_be_known),
        cmocka_unit_test(halves),
        cmocka_unit_test(leaves_a_stretch_in_leaps),
        cmocka_unit_test(lists_go_from_good_to_bad),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
