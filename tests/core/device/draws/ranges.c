// The primitives that each occlusion query draws, as a kernel writes them: arguments of indirect
// draws, against cases worked out by hand.
#include "kernels/packing/params.h"
#include "tests/core/device/suite.h"
#include "tests/tools/expect.h"

enum { CHUNKS = 7, CHUNKS_A_QUERY = 3, QUERIES = 3, ARGUMENTS = 4 };

// The primitives before each chunk of the draw, and before its end. The second query has none, the
// third has one chunk. What follows the end belongs to no query.
static const uint32_t before[] = {0, 5, 9, 11, 11, 11, 11, 40, 70, 90};
static const uint32_t ends[QUERIES + 1] = {0, 11, 11, 40};

static void check(struct rg_device *device, int vertices)
{
    const packing_params p = {CHUNKS, CHUNKS_A_QUERY, vertices};
    struct rg_pass *pass = rg_pass_create(device, "packing_ranges");
    struct rg_buf *prims = make_buf(device, before, COUNT_OF(before), "primitives before");
    struct rg_buf *args = filled_buf(device, 0xcacacacau, QUERIES * ARGUMENTS, "arguments");
    assert_non_null(pass);
    assert_true(rg_pass_run(pass, &(struct rg_run){.params = &p,
                                                   .slots = {[1].buf = prims, [2].buf = args},
                                                   .extent = {QUERIES, 1, 1}}));
    uint32_t *got = read_words(args, QUERIES * ARGUMENTS);
    for (int q = 0; q < QUERIES; q++) {
        const uint32_t due[ARGUMENTS] = {(ends[q + 1] - ends[q]) * (uint32_t)vertices, 1,
                                         ends[q] * (uint32_t)vertices, 0};
        for (int i = 0; i < ARGUMENTS; i++)
            if (got[q * ARGUMENTS + i] != due[i])
                fail_msg("%d vertices, query %d: argument %d is %u, not %u", vertices, q, i,
                         got[q * ARGUMENTS + i], due[i]);
    }
    free(got);
    rg_pass_destroy(pass);
    rg_buf_destroy(prims);
    rg_buf_destroy(args);
}

static void each_query_draws_its_own_primitives(void **state)
{
    check(*state, 3);
    check(*state, 6);
}

static const struct CMUnitTest tests[] = {cmocka_unit_test(each_query_draws_its_own_primitives)};
const struct suite_tests range_tests = {tests, COUNT_OF(tests)};
