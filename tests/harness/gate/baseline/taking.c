// How a session fills a row of a baseline, and which parts stay empty where it fails. A stand-in is
// the session.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/devices/frames/frame.h"
#include "harness/devices/frames/session.h"
#include "tests/harness/gate/baseline/made.h"
#include "tests/harness/gate/cells/read.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/logged.h"

// --- stand-ins ---

// The calls of a session, in their order; the one that fails.
enum call { NONE, RUN, READ, PICTURE, STATE_0, STATE_1, TELL, COUNT, CODE, CALLS };
static enum call fails;
static int closed;
static struct rg_device device, reference;
static const unsigned char texels[] = {1, 2, 3}, words[] = {4, 5, 6, 7};

static bool does(enum call call)
{
    return fails != call || rg_driver_error("call %d failed", (int)call);
}

struct rg_session *rg_session_run(struct rg_device *of, const struct rg_subject *subject,
                                  int frames)
{
    assert_true(of == &device && subject->width == 16 && frames == 5);
    return does(RUN) ? (struct rg_session *)of : NULL;
}

void rg_session_close(struct rg_session *session)
{
    closed += session != NULL;
}

static void *copy(const void *bytes, size_t size)
{
    void *made = malloc(size);
    assert_non_null(made);
    return memcpy(made, bytes, size);
}

void *rg_session_read(struct rg_session *session, size_t *size)
{
    (void)session;
    *size = sizeof(texels);
    return does(READ) ? copy(texels, sizeof(texels)) : NULL;
}

bool rg_session_picture(const struct rg_session *session, const void *read,
                        struct rg_picture *picture)
{
    (void)session;
    assert_memory_equal(read, texels, sizeof(texels));
    return does(PICTURE) && rg_picture_create(picture, 2, 2, 4, "made");
}

int rg_session_state_count(const struct rg_session *session)
{
    (void)session;
    return 2;
}

void *rg_session_read_state(struct rg_session *session, int index, struct rg_state *layout,
                            size_t *size)
{
    (void)session;
    layout->name = index ? "dry" : "wet";
    *size = sizeof(words) - (size_t)index;
    return does(index ? STATE_1 : STATE_0) ? copy(words, sizeof(words)) : NULL;
}

bool rg_session_tell(const struct rg_session *session, struct rg_account *account)
{
    (void)session;
    *account = (struct rg_account){.counter_count = 2, .counters = {{"drops", 5}, {"rays", 6}}};
    return does(TELL);
}

bool rg_session_count(struct rg_session *session, struct rg_tally *tally)
{
    (void)session;
    tally->items = 9;
    return does(COUNT);
}

bool rg_session_code(struct rg_session *session, struct rg_session_code *code)
{
    (void)session;
    code->libraries = 77;
    return does(CODE);
}

// --- a row ---

static const char text_of_cells[] = "rain raster 16x12 5 seed=3\n";

static int set_up(void **state)
{
    (void)state;
    snprintf(device.info.name, RG_DEVICE_NAME_SIZE, "gl");
    snprintf(reference.info.name, RG_DEVICE_NAME_SIZE, "cpu:reference");
    return read_cells(text_of_cells);
}

static void a_row_has_all_that_a_session_leaves(void **state)
{
    (void)state;
    struct rg_baseline_row row = {.outcome = RG_OK};
    struct rg_picture picture;
    char digest[RG_DIGEST_SIZE];
    fails = NONE;
    closed = 0;
    rg_baseline_take(cells.cells, &device, &row, &picture);
    assert_int_equal(row.outcome, RG_OK);
    assert_string_equal(row.cell, "rain");
    assert_string_equal(row.technique, "raster");
    assert_string_equal(row.device, "gl");
    rg_digest_of_cell(cells.cells, digest);
    assert_string_equal(row.settings, digest);
    rg_digest_of(texels, sizeof(texels), digest);
    assert_string_equal(row.picture, digest);
    assert_int_equal(row.state_count, 2);
    for (int i = 0; i < 2; i++) {
        assert_string_equal(row.states[i].name, i ? "dry" : "wet");
        rg_digest_of(words, sizeof(words) - (size_t)i, digest);
        assert_string_equal(row.states[i].digest, digest);
    }
    assert_true(row.counters.count == 2 && row.counters.counters[1].value == 6);
    assert_string_equal(row.counters.counters[0].name, "drops");
    assert_true(row.work.items == 9 && row.code.libraries == 77);
    assert_true(picture.width == 2 && picture.texels && closed == 1);
    rg_picture_destroy(&picture);
}

static void a_call_that_fails_ends_the_row(void **state)
{
    (void)state;
    for (int call = RUN; call < CALLS; call++) {
        struct rg_baseline_row row = {.outcome = RG_OK};
        struct rg_picture picture;
        char why[40];
        fails = (enum call)call;
        closed = 0;
        snprintf(why, sizeof(why), "call %d failed", call);
        rg_baseline_take(cells.cells, &device, &row, &picture);
        assert_int_equal(row.outcome, RG_ERROR);
        assert_string_equal(row.why, why);
        assert_false(row.is_ours);
        assert_true(!picture.texels && closed == (call != RUN));
    }
}

// A digest is of all that makes a cell, and of nothing else.
static void a_cell_has_a_digest_of_all_that_makes_it(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        bool is_same;
    } rows[] = {
        {"other raster 16x12 5 seed=3", true},
        {"rain raster 16x12 5 billboards=7 seed=3", false},
        {"rain raster 12x16 5 seed=3", false},
        {"rain raster 16x13 5 seed=3", false},
        {"rain raster 17x12 5 seed=3", false},
        {"rain raster 16x12 5 seed=3 quads=7", false}, // the last of them
        {"rain raster 16x12 5 seed=3 quads=2000", true},
        {"rain raster 16x12 6 seed=3", false},
        {"rain raster 16x12 5 seed=4", false},
        {"rain raster 16x12 5", false},
        {"rain flow 16x12 5 seed=3", false},
    };
    char first[RG_DIGEST_SIZE], other[RG_DIGEST_SIZE];
    rg_digest_of_cell(cells.cells, first);
    assert_int_equal(strlen(first), 16);
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        struct rg_gate_cells made;
        assert_true(rg_gate_cells_of("c", rows[i].text, strlen(rows[i].text), &made));
        rg_digest_of_cell(made.cells, other);
        if (!strcmp(first, other) != rows[i].is_same)
            fail_msg("%s", rows[i].text);
        rg_gate_cells_free(&made);
    }
}

int main(void)
{
    rg_log_listen(log_last, NULL);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_row_has_all_that_a_session_leaves),
        cmocka_unit_test(a_call_that_fails_ends_the_row),
        cmocka_unit_test(a_cell_has_a_digest_of_all_that_makes_it),
    };
    return cmocka_run_group_tests(tests, set_up, free_cells);
}
