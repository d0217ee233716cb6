// How a worker's process ended, in words and as an outcome.
#ifndef RG_HARNESS_DEVICES_WORKERS_END_H
#define RG_HARNESS_DEVICES_WORKERS_END_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#include "core/base/doing.h"
#include "core/base/outcome.h"

// Why a process ended, if we ended it.
enum rg_worker_verdict {
    RG_WORKER_BY_ITSELF,
    RG_WORKER_HANGS,
    RG_WORKER_HOLDS_TOO_MUCH,
    RG_WORKER_NO_ROOM,
    RG_WORKER_LIES,
};

struct rg_worker_end {
    enum rg_worker_verdict verdict;
    int status;           // as waitpid has it
    int64_t memory_bytes; // that it was allowed to hold
    int timeout_s;
    FILE *printed; // what it printed
};

// Whether a process said so by its status: raingauge's own code in it lacked memory, and no driver
// is at fault.
bool rg_worker_ended_lacking(int status);
// Crash, timeout or lacking.
enum rg_outcome rg_worker_end_outcome(const struct rg_worker_end *end);

// Writes what the process was doing, and which kernels nobody had waited for: a driver may compile
// and run kernels at any time, in its own threads. The text is "", or begins with a space or a ;.
enum { RG_WORKER_DOING = 560 };
void rg_worker_tell_doing(const struct rg_doing *doing, char text[RG_WORKER_DOING]);
// Writes how the process ended, what it was doing, and the last line that it printed.
void rg_worker_tell_end(const struct rg_worker_end *end, const char *doing, char *why, size_t size);

#endif
