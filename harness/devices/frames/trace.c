#include "harness/devices/frames/trace.h"

#include "core/base/log.h"
#include "harness/console/clock.h"
#include "harness/console/interrupt.h"
#include "harness/devices/frames/session.h"
#include "harness/record/named.h"
#include "harness/record/passport/passport.h"

enum track { FRAMES = 1, API_CLOCK, PASSES, TRACKS };

// --- events ---

static void add(struct rg_trace *trace, json_t *event)
{
    if (!trace->events || json_array_append_new(trace->events, event)) {
        json_decref(trace->events);
        trace->events = NULL;
    }
}

static void name_it(struct rg_trace *trace, const char *what, int track, const char *name)
{
    add(trace, json_pack("{sssssisis{so}}", "ph", "M", "name", what, "pid", trace->devices, "tid",
                         track, "args", "name", rg_json_text(name)));
}

// The clock of the trace, which begins with it: on a machine that is up for weeks, the system's
// count of milliseconds has no digits left for a pass.
static double clock_ms(const struct rg_trace *trace)
{
    return rg_now_ms() - trace->begin_ms;
}

// A slice from `at_ms` of the trace's clock on. Times are in microseconds.
static void add_slice(struct rg_trace *trace, enum track track, const char *name, double at_ms,
                      double ms)
{
    add(trace, json_pack("{sssssisisfsf}", "ph", "X", "name", name, "pid", trace->devices, "tid",
                         (int)track, "ts", 1e3 * at_ms, "dur", 1e3 * ms));
}

// --- frames ---

// A frame as it is timed, by both clocks. The API's begins where the wall clock's does, since its
// zero is arbitrary.
static bool trace_frame(struct rg_trace *trace, struct rg_session *session, const char *name)
{
    const bool has_clock = rg_session_device(session)->info.limits.has_clock;
    int64_t begin_ns = 0, end_ns = 0;
    double wall_ms;
    if (has_clock && !rg_session_time(session, &begin_ns))
        return false;
    const double at_ms = clock_ms(trace);
    if (!rg_session_frames(session, 1, &wall_ms) ||
        (has_clock && !rg_session_time(session, &end_ns)))
        return false;
    add_slice(trace, FRAMES, name, at_ms, wall_ms);
    if (has_clock)
        add_slice(trace, API_CLOCK, name, at_ms, 1e-6 * (double)(end_ns - begin_ns));
    return true;
}

struct passes {
    struct rg_trace *trace;
    double at_ms;
};

static void add_pass(const char *kernel, double ms, void *user)
{
    struct passes *passes = user;
    add_slice(passes->trace, PASSES, kernel, passes->at_ms, ms);
    passes->at_ms += ms;
}

// The slice of the frame encloses those of its passes, which fill it one after the other.
static bool trace_passes(struct rg_trace *trace, struct rg_session *session, const char *name)
{
    const double at_ms = clock_ms(trace);
    struct passes passes = {trace, at_ms};
    if (!rg_session_stages(session, add_pass, &passes))
        return false;
    add_slice(trace, PASSES, name, at_ms, passes.at_ms - at_ms);
    return true;
}

static bool trace_frames(struct rg_trace *trace, struct rg_session *session, int frames)
{
    bool ok = true;
    for (int i = 0; ok && i < 2 * frames && !rg_interrupted(); i++) {
        char name[48];
        const bool waits = i % 2;
        snprintf(name, sizeof(name), waits ? "frame %d, waiting after each pass" : "frame %d",
                 i + 1);
        ok = waits ? trace_passes(trace, session, name) : trace_frame(trace, session, name);
    }
    return ok;
}

bool rg_trace_device(struct rg_trace *trace, struct rg_device *device,
                     const struct rg_subject *subject, int frames)
{
    static const char *const tracks[TRACKS] = {[FRAMES] = "frames, wall clock",
                                               [API_CLOCK] = "frames, the API's clock",
                                               [PASSES] = "frames that wait after each pass"};
    char title[RG_DEVICE_NAME_SIZE + sizeof(device->info.driver) + 2];
    trace->devices++;
    snprintf(title, sizeof(title), "%s: %s", device->info.name, device->info.driver);
    name_it(trace, "process_name", 0, title);
    for (int track = FRAMES; track < TRACKS; track++)
        if (track != API_CLOCK || device->info.limits.has_clock)
            name_it(trace, "thread_name", track, tracks[track]);
    const double at_ms = clock_ms(trace);
    struct rg_session *session = rg_session_open(device, subject);
    if (!session)
        return false;
    add_slice(trace, FRAMES, "open", at_ms, clock_ms(trace) - at_ms);
    const bool ok = trace_frames(trace, session, frames);
    rg_session_close(session);
    return ok;
}

// --- the document ---

void rg_trace_begin(struct rg_trace *trace)
{
    *trace = (struct rg_trace){.events = json_array(), .begin_ms = rg_now_ms()};
}

// Microseconds keep their nanoseconds for ten days. With the nine digits of other documents, a pass
// after some seconds would end outside its frame.
#define FLAGS (JSON_COMPACT | JSON_REAL_PRECISION(15))

char *rg_trace_end(struct rg_trace *trace, const struct rg_device_info *infos, int count)
{
    json_t *document =
        trace->events ? json_pack("{sosss{so}}", "traceEvents", trace->events, "displayTimeUnit",
                                  "ms", "otherData", "passport", rg_passport_json(infos, count))
                      : NULL;
    char *text = document ? json_dumps(document, FLAGS) : NULL;
    json_decref(document);
    if (!text)
        rg_harness_error("trace: no memory for its events");
    return text;
}
