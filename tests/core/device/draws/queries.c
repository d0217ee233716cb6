// The API's own occlusion queries, against the samples that fragments count on cpu:reference; on a
// native device, whose driver snaps corners by its own rules, against those that its own count.
#include "tests/core/device/draws/quads.h"
#include "tests/core/device/suite.h"
#include "tests/tools/expect.h"

enum { WIDTH = 333, HEIGHT = 217, QUADS = 20000, FEW = 96 };

// One way to query.
struct way {
    enum rg_depth_mode depth;
    enum rg_cull cull;
    bool scissor;
    int items_a_query, first; // the run's first item
};

// Depth that differs between pixels, so that queries see only some of their quads.
static struct rg_image *make_depth(struct rg_device *device)
{
    const struct rg_image_desc desc = {RG_D32F, WIDTH, HEIGHT, 1, 1};
    float *texels = malloc(WIDTH * HEIGHT * sizeof(float));
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        texels[i] = (float)(noise((uint32_t)i) >> 8) / (1 << 24);
    struct rg_image *depth = rg_image_create(device, &desc, "depth");
    assert_true(depth && rg_image_write(depth, 0, 0, texels));
    free(texels);
    return depth;
}

// The objects that a draw of `way` needs, on one device.
struct rig {
    struct rg_pass *pass;
    struct rg_buf *quads, *samples;
    struct rg_image *depth;
    int count;
};

static struct rig make_rig(struct rg_device *device, int count, int counters)
{
    float *quads = malloc((size_t)count * TEST_QUAD_WORDS * sizeof(float));
    quads_fill(quads, count, WIDTH, HEIGHT, QUAD_KINDS, 5);
    const struct rig rig = {
        .pass = rg_pass_create(device, "test_quads"),
        .quads = make_buf(device, quads, count * TEST_QUAD_WORDS, "quads"),
        .samples = filled_buf(device, 0, counters, "samples"),
        .depth = make_depth(device),
        .count = count,
    };
    free(quads);
    assert_non_null(rig.pass);
    return rig;
}

static void destroy_rig(struct rig *rig)
{
    rg_pass_destroy(rig->pass);
    rg_buf_destroy(rig->quads);
    rg_buf_destroy(rig->samples);
    rg_image_destroy(rig->depth);
}

static bool draw(const struct rig *rig, const struct way *way)
{
    const test_quads_params p = {0};
    const struct rg_draw to = {
        .depth = rig->depth,
        .depth_mode = way->depth,
        .cull = way->cull,
        .x0 = way->scissor ? 17 : 0,
        .y0 = way->scissor ? 5 : 0,
        .x1 = way->scissor ? 200 : 0,
        .y1 = way->scissor ? 211 : 0,
        .samples = rig->samples,
        .items_a_query = way->items_a_query,
    };
    return rg_pass_run(rig->pass, &(struct rg_run){.params = &p,
                                                   .slots = {[1].buf = rig->quads},
                                                   .origin = {way->first, 0, 0},
                                                   .extent = {rig->count - way->first, 1, 1},
                                                   .draw = &to});
}

// Samples by item, as fragments count them.
static uint32_t *counted(struct rg_device *device, const struct way *way)
{
    struct rg_device *reference = device->info.native ? NULL : rg_device_open("cpu:reference");
    struct way by_item = *way;
    by_item.items_a_query = 0;
    struct rig rig = make_rig(reference ? reference : device, QUADS, QUADS);
    assert_true(draw(&rig, &by_item));
    uint32_t *samples = read_words(rig.samples, QUADS);
    destroy_rig(&rig);
    assert_true(!reference || rg_device_close(reference));
    return samples;
}

static uint32_t sum_of(const uint32_t *samples, const struct way *way, int query)
{
    uint32_t sum = 0;
    for (int i = 0; i < way->items_a_query; i++) {
        const int item = query * way->items_a_query + i;
        sum += item < QUADS ? samples[item] : 0;
    }
    return sum;
}

// Draws twice, because answers must not add up.
static void check_way(struct rg_device *device, const struct way *way)
{
    const int queries = (QUADS + way->items_a_query - 1) / way->items_a_query;
    struct rig rig = make_rig(device, QUADS, queries);
    if (!device->info.limits.has_queries) {
        assert_lacks(draw(&rig, way), "no occlusion queries");
    } else {
        assert_true(draw(&rig, way) && draw(&rig, way));
        uint32_t *answers = read_words(rig.samples, queries), *due = counted(device, way), all = 0;
        for (int q = 0; q < queries; q++) {
            all += answers[q];
            if (answers[q] != sum_of(due, way, q))
                fail_msg("query %d of %d items: %u samples, not %u", q, way->items_a_query,
                         answers[q], sum_of(due, way, q));
        }
        assert_above(all, 0);
        free(answers);
        free(due);
    }
    destroy_rig(&rig);
}

static void queries_count_what_fragments_count(void **state)
{
    static const struct way ways[] = {
        {RG_DEPTH_OFF, RG_CULL_NONE, false, 32, 0},
        {RG_DEPTH_TEST, RG_CULL_NONE, false, 64, 0},
        {RG_DEPTH_TEST, RG_CULL_BACK, true, 160, 0},
        {RG_DEPTH_TEST, RG_CULL_FRONT, false, 96, 9600},
        {RG_DEPTH_TEST, RG_CULL_NONE, false, 32768, 0}, // all in one query
    };
    for (int i = 0; i < COUNT_OF(ways); i++)
        check_way(*state, &ways[i]);
}

static void queries_that_make_no_sense_are_refused(void **state)
{
    struct rg_device *device = *state;
    struct rig rig = make_rig(device, FEW, 2);
    assert_refused(draw(&rig, &(struct way){.items_a_query = 33}), "33 items");
    assert_refused(draw(&rig, &(struct way){.items_a_query = -32}), "-32 items");
    assert_refused(draw(&rig, &(struct way){.items_a_query = 64, .first = 32}), "from item 32");
    assert_refused(draw(&rig, &(struct way){.items_a_query = 32}), "2 counters for 3 queries");
    rg_buf_destroy(rig.samples);
    rig.samples = filled_buf(device, 0, 1, "one counter"); // too few: the second query is partial
    assert_refused(draw(&rig, &(struct way){.items_a_query = 64}), "1 counters for 2 queries");
    rg_buf_destroy(rig.samples);
    rig.samples = NULL;
    assert_refused(draw(&rig, &(struct way){.items_a_query = 32}), "no buffer for their answers");
    destroy_rig(&rig);
}

static const struct CMUnitTest tests[] = {
    cmocka_unit_test(queries_count_what_fragments_count),
    cmocka_unit_test(queries_that_make_no_sense_are_refused),
};
const struct suite_tests query_tests = {tests, COUNT_OF(tests)};
