// A timeline on a machine that has been up for years, an hour after it began: the system's count of
// milliseconds is large, and has no digits left for passes.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "harness/console/clock.h"
#include "harness/devices/frames/session.h"
#include "harness/devices/frames/trace.h"
#include "tests/tools/expect.h"

// --- stand-ins ---

enum { PASSES = 31 };

static struct rg_device device = {.info = {.name = "gl", .limits = {.has_clock = false}}};
static int session;

static double now_ms;

double rg_now_ms(void)
{
    return now_ms;
}

struct rg_session *rg_session_open(struct rg_device *own, const struct rg_subject *subject)
{
    (void)own;
    (void)subject;
    return (struct rg_session *)&session;
}

void rg_session_close(struct rg_session *own)
{
    (void)own;
}

struct rg_device *rg_session_device(const struct rg_session *own)
{
    (void)own;
    return &device;
}

bool rg_session_frames(struct rg_session *own, int frames, double *wall_ms)
{
    (void)own;
    *wall_ms = frames;
    return true;
}

bool rg_session_stages(struct rg_session *own,
                       void (*take)(const char *kernel, double ms, void *user), void *user)
{
    (void)own;
    for (int i = 0; i < PASSES; i++)
        take("pass", 0.1, user);
    return true;
}

// --- the test ---

static double number_of(const json_t *event, const char *name)
{
    return json_number_value(json_object_get(event, name));
}

static void passes_fill_their_frame(void **state)
{
    (void)state;
    struct rg_trace trace;
    now_ms = 1e12;
    rg_trace_begin(&trace);
    now_ms += 3600e3 + 0.001;
    assert_true(rg_trace_device(&trace, &device, NULL, 1));
    char *text = rg_trace_end(&trace, &device.info, 1);
    json_t *document = json_loads(text, 0, NULL);
    const json_t *events = json_object_get(document, "traceEvents");
    const size_t count = json_array_size(events);
    const json_t *frame = json_array_get(events, count - 1);
    assert_string_equal(json_string_value(json_object_get(frame, "name")),
                        "frame 2, waiting after each pass");
    assert_below(fabs(number_of(frame, "ts") - 3600e6 - 1), 0.2); // 1e12 ms have 0.1 us
    assert_below(fabs(number_of(frame, "dur") - 100.0 * PASSES), 1e-3);
    for (int i = 0; i < PASSES; i++) {
        const json_t *pass = json_array_get(events, count - 1 - PASSES + (size_t)i);
        assert_below(fabs(number_of(pass, "ts") - number_of(frame, "ts") - 100.0 * i), 1e-3);
        assert_below(fabs(number_of(pass, "dur") - 100), 1e-3);
    }
    json_decref(document);
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(passes_fill_their_frame)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
