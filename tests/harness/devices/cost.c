// What a frame costs through a worker, against the same in this process: taken in turn, so that the
// machine's drift meets both. It is no test, for nothing is asserted on time (docs/performance.md).
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "harness/console/clock.h"
#include "harness/devices/devices.h"
#include "harness/devices/serving/serving.h"
#include "harness/devices/workers/worker.h"
#include "harness/frames/session.h"
#include "harness/record/stats.h"

enum { ROUNDS = 200, WAYS = 2 };

struct times {
    double told_ms[ROUNDS], around_ms[ROUNDS]; // a frame, by the session and by our own clock
};

static bool take(struct rg_session *session, int frames, double *told_ms, double *around_ms)
{
    const double start_ms = rg_now_ms();
    const bool ok = rg_session_frames(session, frames, told_ms);
    *around_ms = (rg_now_ms() - start_ms) / frames;
    *told_ms /= frames;
    return ok;
}

// Frames a call.
static void print(struct times times[WAYS], int frames)
{
    double told[ROUNDS], around[ROUNDS];
    for (int i = 0; i < ROUNDS; i++) {
        told[i] = times[1].told_ms[i] / times[0].told_ms[i];
        around[i] = times[1].around_ms[i] / times[0].around_ms[i];
    }
    printf("%2d frames a call: %.3f ms a frame in this process; through a worker %+.2f %% as "
           "measured, "
           "%+.2f %% as waited for\n",
           frames, rg_median(times[0].told_ms, ROUNDS).median,
           100 * (rg_median(told, ROUNDS).median - 1),
           100 * (rg_median(around, ROUNDS).median - 1));
}

static bool compare(struct rg_session *sessions[WAYS], int frames)
{
    static struct times times[WAYS];
    bool ok = true;
    for (int i = 0; ok && i < ROUNDS; i++)
        for (int w = 0; ok && w < WAYS; w++)
            ok = take(sessions[(i + w) % WAYS], frames, &times[(i + w) % WAYS].told_ms[i],
                      &times[(i + w) % WAYS].around_ms[i]);
    if (ok)
        print(times, frames);
    return ok;
}

int main(int argc, char **argv)
{
    if (argc == 3 && !strcmp(argv[1], RG_WORKER_ARGUMENT))
        return rg_serving(argv[2]);
    const char *name = argc > 1 ? argv[1] : "cpu";
    if (!getenv("GOMP_SPINCOUNT")) { // threads that spin would hold up those of the other process
        setenv("GOMP_SPINCOUNT", "0", 1);
        return execv("/proc/self/exe", argv);
    }
    rg_workers.program = "/proc/self/exe";
    struct rg_device *devices[WAYS] = {rg_device_open(name), rg_devices_open_one(name)};
    const struct rg_technique *technique = rg_technique_find("flow");
    void *defaults = rg_settings_create(technique);
    void *settings = rg_settings_copy(technique, defaults, "environment_px=64 resolution_px=64");
    free(defaults);
    const struct rg_subject subject = {technique, settings, 128, 128};
    struct rg_session *sessions[WAYS] = {NULL, NULL};
    bool ok = devices[0] && devices[1] && settings;
    for (int w = 0; ok && w < WAYS; w++)
        ok = (sessions[w] = rg_session_run(devices[w], &subject, 5)) != NULL;
    ok = ok && compare(sessions, 1) && compare(sessions, 10);
    for (int w = 0; w < WAYS; w++) {
        rg_session_close(sessions[w]);
        rg_device_close(devices[w]);
    }
    free(settings);
    return !ok;
}
