// A device in this process and the same one in a worker, each with a session of one subject.
#ifndef RG_TESTS_HARNESS_DEVICES_WORKERS_PAIR_H
#define RG_TESTS_HARNESS_DEVICES_WORKERS_PAIR_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/devices/devices.h"
#include "harness/devices/frames/session.h"
#include "harness/devices/workers/device.h"
#include "tests/tools/instance.h"

enum { LOCAL, REMOTE };

static char logged[2048];

static inline void keep(enum rg_log_level level, const char *line, void *user)
{
    (void)level;
    (void)user;
    const size_t used = strlen(logged);
    snprintf(logged + used, sizeof(logged) - used, "%s\n", line);
}

// A device here and the same one in a worker, and a subject.
struct pair {
    struct rg_device *devices[2];
    struct rg_session *sessions[2];
    void *settings;
    struct rg_subject subject;
};

static inline struct pair open_pair(const char *technique, const char *set, int frames)
{
    struct pair pair = {.subject = {rg_technique_find(technique), NULL, 48, 32}};
    pair.subject.settings = pair.settings = settings_of(technique, "", set);
    rg_workers.program = "/proc/self/exe";
    pair.devices[REMOTE] = rg_devices_open_one("cpu");
    pair.devices[LOCAL] = rg_device_open("cpu");
    for (int i = 0; i < 2; i++) {
        assert_non_null(pair.devices[i]);
        pair.sessions[i] = rg_session_run(pair.devices[i], &pair.subject, frames);
        assert_non_null(pair.sessions[i]);
    }
    assert_null(rg_remote_worker(pair.devices[LOCAL]));
    assert_non_null(rg_remote_worker(pair.devices[REMOTE]));
    return pair;
}

static inline void close_pair(struct pair *pair)
{
    for (int i = 0; i < 2; i++) {
        rg_session_close(pair->sessions[i]);
        assert_true(rg_device_close(pair->devices[i]));
    }
    free(pair->settings);
}

static inline struct pair open_flow(int frames)
{
    return open_pair("flow", "environment_px=64 resolution_px=96", frames);
}

// The stages of a frame, in order.
struct stages {
    int count;
    const char *kernels[64];
    double ms;
};

static inline void note_stage(const char *kernel, double ms, void *user)
{
    struct stages *stages = user;
    stages->kernels[stages->count++] = kernel;
    stages->ms += ms;
}

#endif
