// Measures what the harness adds to a frame: a bare loop over the technique, a session on the same
// instance, and a session in a worker. They run in turn, so that the machine's drift affects all
// three. It is no test: nothing is asserted on time (docs/performance.md).
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/base/stats.h"
#include "harness/console/clock.h"
#include "harness/devices/devices.h"
#include "harness/devices/measure/serving/serving.h"
#include "harness/devices/workers/worker.h"
#include "harness/devices/frames/session.h"
#include "harness/devices/frames/calling.h"

enum { ROUNDS = 600 };
enum way { BARE, HERE, WORKER, WAYS };

struct timed {
    struct rg_session *sessions[WAYS];                     // BARE uses HERE's session
    double told_ms[WAYS][ROUNDS], around_ms[WAYS][ROUNDS]; // a frame, as reported and by our clock
};

static bool run_bare(struct rg_instance *bare, int frames)
{
    bool ok = true;
    for (int i = 0; ok && i < frames; i++)
        ok = bare->technique->step(bare) && bare->technique->draw(bare);
    return ok && rg_device_sync(bare->device);
}

static bool take(struct timed *timed, enum way way, int round, int frames)
{
    double told_ms;
    const double start_ms = rg_now_ms();
    const bool ok = way == BARE ? run_bare(timed->sessions[BARE]->instance, frames)
                                : rg_session_frames(timed->sessions[way], frames, &told_ms);
    const double around_ms = rg_now_ms() - start_ms;
    timed->around_ms[way][round] = around_ms / frames;
    timed->told_ms[way][round] = (way == BARE ? around_ms : told_ms) / frames;
    return ok;
}

static double percent_more(const double *more, const double *than)
{
    double ratios[ROUNDS];
    for (int i = 0; i < ROUNDS; i++)
        ratios[i] = more[i] / than[i];
    return 100 * (rg_median(ratios, ROUNDS).median - 1);
}

// Each way follows each other one equally often: a way that follows itself would find its caches
// warm.
static bool compare(struct timed *timed, int frames)
{
    enum { ORDERS = 6 };
    static const enum way orders[ORDERS][WAYS] = {{BARE, HERE, WORKER}, {BARE, WORKER, HERE},
                                                  {HERE, BARE, WORKER}, {HERE, WORKER, BARE},
                                                  {WORKER, BARE, HERE}, {WORKER, HERE, BARE}};
    bool ok = true;
    for (int round = 0; ok && round < ROUNDS; round++)
        for (int i = 0; ok && i < WAYS; i++)
            ok = take(timed, orders[round % ORDERS][i], round, frames);
    if (!ok)
        return false;
    const double *bare = timed->told_ms[BARE];
    double sorted[ROUNDS];
    memcpy(sorted, bare, sizeof(sorted));
    printf(
        "%2d frames a call: %.3f ms a frame in a bare loop; a session %+.2f %%; through a worker "
        "%+.2f %% as measured, %+.2f %% as waited for\n",
        frames, rg_median(sorted, ROUNDS).median, percent_more(timed->told_ms[HERE], bare),
        percent_more(timed->told_ms[WORKER], bare), percent_more(timed->around_ms[WORKER], bare));
    return true;
}

static bool open_all(struct timed *timed, struct rg_device *devices[2],
                     const struct rg_subject *subject)
{
    timed->sessions[BARE] = timed->sessions[HERE] = rg_session_run(devices[0], subject, 5);
    timed->sessions[WORKER] = rg_session_run(devices[1], subject, 5);
    return timed->sessions[HERE] && timed->sessions[WORKER];
}

int main(int argc, char **argv)
{
    if (argc == 3 && !strcmp(argv[1], RG_WORKER_ARGUMENT))
        return rg_serving(argv[2]);
    const char *name = argc > 1 ? argv[1] : "cpu";
    if (!getenv("GOMP_SPINCOUNT")) { // spinning threads would slow the other process
        setenv("GOMP_SPINCOUNT", "0", 1);
        return execv("/proc/self/exe", argv);
    }
    rg_workers.program = "/proc/self/exe";
    static struct timed timed;
    struct rg_device *devices[2] = {rg_device_open(name), rg_devices_open_one(name)};
    const struct rg_technique *technique = rg_technique_find("flow");
    void *defaults = rg_settings_create(technique);
    void *settings = rg_settings_copy(technique, defaults, "environment_px=64 resolution_px=64");
    free(defaults);
    const struct rg_subject subject = {technique, settings, 96, 96};
    const bool ok = devices[0] && devices[1] && settings && open_all(&timed, devices, &subject) &&
                    compare(&timed, 1) && compare(&timed, 10);
    for (int way = HERE; way < WAYS; way++)
        rg_session_close(timed.sessions[way]);
    for (int i = 0; i < 2; i++)
        rg_device_close(devices[i]);
    free(settings);
    return !ok;
}
