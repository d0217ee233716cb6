// A worker: a process that holds one device for a command, so that a driver that crashes, hangs or
// exhausts memory ends nothing else. The harness makes calls, the worker serves them
// (harness/devices/workers/serve.h).
//
// A worker is this program, started again at the first call, and restarted at the next call after
// it has ended; after RG_WORKER_LIVES ends it is given up. A call counts as done only if the worker
// says so, whatever its exit status.
#ifndef RG_HARNESS_DEVICES_WORKERS_WORKER_H
#define RG_HARNESS_DEVICES_WORKERS_WORKER_H

#include <sys/types.h>

#include "core/base/outcome.h"
#include "harness/devices/workers/calls.h"
#include "harness/devices/workers/fields.h"

enum { RG_WORKER_LIVES = 3 };

// How workers are started and watched: constants for the process, set before the first start.
struct rg_workers {
    const char *program;  // rg_program_self(); NULL: no workers, so that devices live in this
                          // process, as they do in a worker
    const char *hello;    // the answer required of another program; NULL: none are used
    int timeout_s;        // a worker is ended after no operation has begun for so long
    int64_t memory_bytes; // a worker that holds more is ended; 0: the memory limit
                          // (core/base/memory.h) and 1 GiB
};
extern struct rg_workers rg_workers;
// The first argument of a program that is started as a worker.
#define RG_WORKER_ARGUMENT "worker"
// The variable in a worker's environment that names its program, if not rg_workers.program: another
// build, whose messages are checked first.
#define RG_WORKER_PROGRAM "RG_PROGRAM"

struct rg_worker;

// Makes a worker for a device, without starting it. `environment` holds "KEY=value" in addition to
// the harness's variables, each ended by a zero, the last by two; NULL: none. Both are copied.
// NULL, and one logged line, when memory runs out.
struct rg_worker *rg_worker_create(const char *name, const char *environment);
// Makes a running worker close its device, which logs leaks. False, with a logged line, if there
// are any, or if it ends meanwhile.
bool rg_worker_retire(struct rg_worker *worker);
// The reply to closing: a bool, whether nothing was left on the device and nothing had failed.
extern const struct rg_field rg_closed_fields[];
// The activity of the process when it last crashed or was ended, as in the line about that: " while
// running kernel 'flow_blur'"; "": unknown.
const char *rg_worker_end_doing(const struct rg_worker *worker);
// Ends the process, so that the next call starts a new one, and resets the count of ends. For
// callers that crash a driver deliberately and repeatedly.
void rg_worker_renew(struct rg_worker *worker);
// Makes rg_worker_retire return false, because something on the device could not be closed, which
// has been logged.
void rg_worker_closes_badly(struct rg_worker *worker);
// Ends the worker, by force if necessary. False, with one logged line, if it had closed its device
// and then ended as in a driver's crash. Accepts NULL.
bool rg_worker_destroy(struct rg_worker *worker);

// Its process; 0: none is running.
pid_t rg_worker_process(const struct rg_worker *worker);
// How often it has been started; state of earlier lives is gone.
int rg_worker_life(const struct rg_worker *worker);
// Whether state of its process in that life still exists.
bool rg_worker_has(const struct rg_worker *worker, int life);
// The same; if not, one line has been logged.
bool rg_worker_still_has(const struct rg_worker *worker, int life);

// The current memory limit of the worker (rg_memory_grant).
int64_t rg_worker_grant(struct rg_worker *worker);

// Makes a call and waits for the reply; the worker's messages are logged here. False, with one
// logged line, if the call failed, or if the worker ended, which is a crash or timeout error. Free
// `reply` in either case.
bool rg_worker_call(struct rg_worker *worker, enum rg_call call, const struct rg_message *request,
                    struct rg_message *reply);
// The same for callers that report a worker's end themselves. Returns RG_OK or the outcome of the
// worker's error. If the worker ended, logs nothing, writes one line to `why` and returns how it
// ended.
enum rg_outcome rg_worker_try(struct rg_worker *worker, enum rg_call call,
                              const struct rg_message *request, struct rg_message *reply, char *why,
                              size_t why_size);
// As rg_worker_call for a reply that is a struct with these fields. Zero it before; the caller
// frees its blocks and lists in either case.
bool rg_worker_fetch(struct rg_worker *worker, enum rg_call call, const struct rg_message *request,
                     const struct rg_field *fields, void *all);
// The same for calls with an empty reply.
bool rg_worker_ask(struct rg_worker *worker, enum rg_call call, const struct rg_message *request);
// Ends taking a reply and frees it; returns whether it was valid and fully taken.
bool rg_worker_finish(struct rg_message *reply, bool ok);

#endif
