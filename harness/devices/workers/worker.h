// A worker: a process that holds one device for a command, so that a driver that crashes, hangs or
// eats all memory takes along nothing else. The harness asks, the worker serves
// (harness/devices/workers/serve.h).
//
// A worker is this program, started again. It is started when it is first asked, and once more when
// it is asked after it has ended; one that has ended RG_WORKER_LIVES times is left out. What was
// asked counts as done only when the worker says so, whatever its exit status.
#ifndef RG_HARNESS_DEVICES_WORKERS_WORKER_H
#define RG_HARNESS_DEVICES_WORKERS_WORKER_H

#include <sys/types.h>

#include "core/base/outcome.h"
#include "harness/devices/workers/calls.h"
#include "harness/devices/workers/fields.h"

enum { RG_WORKER_LIVES = 3 };

// How workers are started and watched: for all of a process, set before the first is started.
struct rg_workers {
    const char *program;  // rg_program_self(); NULL: there are no workers, and devices live in this
                          // process, as they do in a worker
    const char *hello;    // what a worker of another program must answer; NULL: there are none
    int timeout_s;        // a worker that has begun nothing for so long is ended
    int64_t memory_bytes; // one that holds more is ended; 0: what may be taken (core/base/memory.h)
                          // and 1 GiB
};
extern struct rg_workers rg_workers;
// The first argument of a program that is started as a worker.
#define RG_WORKER_ARGUMENT "worker"
// The variable of a worker's environment that names its program where that is not
// rg_workers.program: another build, which is greeted first.
#define RG_WORKER_PROGRAM "RG_PROGRAM"

struct rg_worker;

// A worker for the device of this name, not started yet. `environment` holds "KEY=value" over the
// harness's own, each ended by a zero, the last by two; NULL: none. Both are copied. NULL, and one
// logged line, without memory.
struct rg_worker *rg_worker_create(const char *name, const char *environment);
// Has a worker that lives close its device, which logs what is left on it. False, with a logged
// line, where something is, or where it ends meanwhile.
bool rg_worker_retire(struct rg_worker *worker);
// What a worker replies to that: a bool, whether nothing was left and nothing on it had failed.
extern const struct rg_field rg_closed_fields[];
// What its process did when it crashed or was ended last, as the line about that has it: " while
// running kernel 'flow_blur'"; "": nothing that is known.
const char *rg_worker_end_doing(const struct rg_worker *worker);
// Ends its process, so that the next call has a new one, and forgets how often one ended: for those
// who bring a driver down on purpose, again and again.
void rg_worker_renew(struct rg_worker *worker);
// Has rg_worker_retire return false: something on the device could not be closed, and a line is
// logged.
void rg_worker_closes_badly(struct rg_worker *worker);
// Ends it, at once where it does not end by itself. False, with one logged line, where it had
// closed its device and ended as a driver does that crashes. NULL is accepted.
bool rg_worker_destroy(struct rg_worker *worker);

// Its process; 0: none lives.
pid_t rg_worker_process(const struct rg_worker *worker);
// How often it has been started: what lived in the process of another life is gone.
int rg_worker_life(const struct rg_worker *worker);
// Whether what lived in its process in that life still does.
bool rg_worker_has(const struct rg_worker *worker, int life);
// The same; where it does not, one line has been logged.
bool rg_worker_still_has(const struct rg_worker *worker, int life);

// What the worker may take in all (rg_memory_grant), as others have left it by now.
int64_t rg_worker_grant(struct rg_worker *worker);

// Asks for a call and waits for the reply. What the worker logged meanwhile is logged here. False,
// with one logged line, where the call failed, or the worker ended: the error then is a crash or a
// timeout. `reply` is to be freed in either case.
bool rg_worker_call(struct rg_worker *worker, enum rg_call call, const struct rg_message *request,
                    struct rg_message *reply);
// The same for those who tell themselves how the worker ended: RG_OK, what the worker's error comes
// to, or, with nothing logged and one line in `why`, how it ended.
enum rg_outcome rg_worker_try(struct rg_worker *worker, enum rg_call call,
                              const struct rg_message *request, struct rg_message *reply, char *why,
                              size_t why_size);
// As rg_worker_call where the reply is a struct of these fields, which is zeroed before, and whose
// blocks and lists the caller frees in either case.
bool rg_worker_fetch(struct rg_worker *worker, enum rg_call call, const struct rg_message *request,
                     const struct rg_field *fields, void *all);
// Where nothing but success comes back.
bool rg_worker_ask(struct rg_worker *worker, enum rg_call call, const struct rg_message *request);
// Ends the taking of a reply, which is freed: whether it went well, and nothing is left of it.
bool rg_worker_finish(struct rg_message *reply, bool ok);

#endif
