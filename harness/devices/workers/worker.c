#define _GNU_SOURCE // usleep
#include "harness/devices/workers/worker.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/base/alloc.h"
#include "core/base/files/nameless.h"
#include "core/base/log.h"
#include "core/base/memory.h"
#include "core/base/program.h"
#include "core/base/text/limits.h"
#include "harness/console/clock.h"
#include "harness/console/exit.h"
#include "harness/console/interrupt.h"
#include "harness/devices/workers/channel.h"
#include "harness/devices/workers/end.h"
#include "harness/devices/workers/environment.h"
#include "harness/devices/workers/held.h"
#include "harness/devices/workers/inside.h"

// The time limit for a program to answer whether it is a raingauge; --timeout, if shorter, applies.
enum { LOOK_MS = 100, END_MS = 5000, HELLO_MS = 20000 };

// Only the last printed line is reported. The output is in memory that does not count as the
// process's, so that more than this is dropped.
enum { MOST_PRINTED = 1 << 20 };

// Memory allowed to a process in addition to the memory that it counts (core/base/memory.h): the
// program, its driver, and compiled code.
#define OWN_BYTES ((int64_t)1 << 30)

struct rg_workers rg_workers = {.timeout_s = 120};

struct rg_worker {
    char *name, *environment; // owned
    pid_t process;            // 0: not running
    struct rg_channel channel;
    FILE *printed;        // the process prints into it, as drivers do
    bool is_interrupted;  // the process was told of the interruption
    bool is_closed;       // the device was closed
    bool closed_badly;    // something on the device was not closed
    bool was_open;        // the device was open, in this life or one before
    int64_t memory_bytes; // limit of the process's memory
    int64_t taken_bytes;  // of the limit, counted here (core/base/memory.h)
    int life;
    int ended;                   // processes that ended since it was renewed
    enum rg_outcome end;         // how its last process ended
    char doing[RG_WORKER_DOING]; // what that process was doing
};

struct rg_worker *rg_worker_create(const char *name, const char *environment)
{
    struct rg_worker *worker = rg_alloc(1, sizeof(*worker), name);
    if (!worker)
        return NULL;
    worker->channel.socket = -1;
    worker->name = strdup(name);
    worker->environment = rg_environment_copy(environment);
    if (worker->name && worker->environment)
        return worker;
    rg_worker_destroy(worker);
    return rg_harness_error_null("device '%s': no memory for its worker", name);
}

int rg_worker_life(const struct rg_worker *worker)
{
    return worker->life;
}

static bool tell_loss(const struct rg_worker *worker, enum rg_outcome outcome, const char *why)
{
    if (outcome == RG_CRASH)
        return rg_crash_error("device '%s': %s", worker->name, why);
    if (outcome == RG_TIMEOUT)
        return rg_timeout_error("device '%s': %s", worker->name, why);
    if (outcome == RG_LACKING)
        return rg_harness_error("device '%s': %s", worker->name, why);
    return rg_driver_error("device '%s': %s", worker->name, why);
}

pid_t rg_worker_process(const struct rg_worker *worker)
{
    return worker->process;
}

bool rg_worker_has(const struct rg_worker *worker, int life)
{
    return worker->process && worker->life == life;
}

bool rg_worker_still_has(const struct rg_worker *worker, int life)
{
    return rg_worker_has(worker, life) ||
           tell_loss(worker, worker->end, "what was open on it has gone with its process");
}

// --- its process ---

// Bytes counted for all workers.
static int64_t taken_by_all;

// Counts a worker's memory for the harness, so that others get less. The worker may have
// overwritten the page, so that at most its limit is counted.
static void count_taken(struct rg_worker *worker, int64_t bytes)
{
    const int64_t most = worker->memory_bytes;
    const int64_t taken = bytes < 0 ? 0 : bytes > most ? most : bytes;
    rg_memory_count(taken - worker->taken_bytes);
    taken_by_all += taken - worker->taken_bytes;
    worker->taken_bytes = taken;
}

static void forget_process(struct rg_worker *worker)
{
    count_taken(worker, 0);
    worker->process = 0;
    worker->is_interrupted = worker->is_closed = false;
    rg_channel_close(&worker->channel);
    if (worker->printed)
        fclose(worker->printed);
    worker->printed = NULL;
}

// Another build's program; NULL: this one.
static const char *program_of(const struct rg_worker *worker)
{
    return rg_environment_find(worker->environment, RG_WORKER_PROGRAM);
}

// A running worker's limit rises when others hold less. The harness's memory for pictures is not
// subtracted, because they pass through the worker's memory.
static void limit_memory(struct rg_worker *worker)
{
    const int64_t others = taken_by_all - worker->taken_bytes;
    worker->memory_bytes =
        rg_workers.memory_bytes ? rg_workers.memory_bytes : rg_memory_limit() - others + OWN_BYTES;
}

int64_t rg_worker_grant(struct rg_worker *worker)
{
    limit_memory(worker);
    return rg_memory_grant(worker->taken_bytes);
}

// Makes the file that the process prints into. Writes append, also after the harness has emptied
// the file.
static bool make_printed(struct rg_worker *worker, char why[RG_NAMELESS_WHY])
{
    const int file = rg_file_nameless(why);
    if (file < 0)
        return false;
    fcntl(file, F_SETFL, O_APPEND);
    worker->printed = fdopen(file, "w+");
    if (worker->printed)
        return true;
    close(file);
    snprintf(why, RG_NAMELESS_WHY, "no memory for what it prints; close other programs");
    return false;
}

static bool make_channel(struct rg_channel *channel, int theirs[2], char why[RG_NAMELESS_WHY])
{
    const int error = rg_channel_create(channel, theirs);
    if (error)
        snprintf(why, RG_NAMELESS_WHY, "no %s: %s; %s",
                 channel->socket < 0 ? "socket to it (socketpair)" : "page to share with it (mmap)",
                 strerror(error), rg_program_mend(error));
    return !error;
}

// Starts the process with its ends of the channel. Returns 0 or the errno.
static int start_program(struct rg_worker *worker, const int theirs[2])
{
    char argument[24];
    const int printed = fileno(worker->printed);
    const int fds[RG_WORKER_FDS] = {
        -1, printed, printed, [RG_WORKER_SOCKET] = theirs[0], [RG_WORKER_PAGE] = theirs[1]};
    snprintf(argument, sizeof(argument), RG_WORKER_CHANNEL, (long)getpid());
    const char *const other = program_of(worker);
    const char *const args[] = {other ? other : rg_workers.program, RG_WORKER_ARGUMENT, argument,
                                NULL};
    char **environment = rg_environment_with(worker->environment);
    const int error =
        environment ? rg_program_start_in(environment, args, fds, RG_WORKER_FDS, &worker->process)
                    : ENOMEM;
    free(environment);
    return error;
}

// Starts the worker. False on failure, with the reason in `why`, or one logged line if it is an
// input error. A process that the machine refuses says nothing about the driver.
static bool start(struct rg_worker *worker, char *why, size_t size)
{
    char lack[RG_NAMELESS_WHY];
    int theirs[2] = {-1, -1};
    const bool has_means =
        make_printed(worker, lack) && make_channel(&worker->channel, theirs, lack);
    const int error = has_means ? start_program(worker, theirs) : 0;
    for (int i = 0; i < 2; i++)
        if (theirs[i] >= 0)
            close(theirs[i]);
    if (has_means && !error) {
        limit_memory(worker);
        worker->channel.most_bytes = worker->memory_bytes;
        worker->channel.patience_ms = 1000 * rg_workers.timeout_s;
        worker->life++;
        return true;
    }
    forget_process(worker);
    worker->end = RG_LACKING;
    if (has_means && program_of(worker)) {
        worker->end = RG_ERROR;
        return rg_error("device '%s': " RG_WORKER_PROGRAM "=%s cannot be started: %s", worker->name,
                        program_of(worker), strerror(error));
    }
    snprintf(why, size, "no process could be started for it: %s%s%s",
             has_means ? strerror(error) : lack, has_means ? "; " : "",
             has_means ? rg_program_mend(error) : "");
    return false;
}

// Waits for a process that has closed its channel, and kills it if that takes long. A process stuck
// in the kernel does not end even then, and is left as killed.
static int end_process(struct rg_worker *worker)
{
    int status = 0;
    const double start_ms = rg_now_ms();
    while (!rg_program_has_ended(worker->process, &status)) {
        const double waited_ms = rg_now_ms() - start_ms;
        if (waited_ms > END_MS)
            kill(worker->process, SIGKILL);
        if (waited_ms > 2 * END_MS)
            return SIGKILL;
        usleep(500);
    }
    return status;
}

// A process that was asked to close its device only has to end. False, with one logged line, if it
// does not end well.
static bool end(struct rg_worker *worker)
{
    char last[200];
    rg_channel_close(&worker->channel);
    const int status = end_process(worker);
    rg_program_last_line(worker->printed, last, sizeof(last));
    const bool well =
        !worker->is_closed || !status || rg_worker_ended_lacking(status) ||
        rg_crash_error("device '%s': its process ended with status %d when all was done%s",
                       worker->name, WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status),
                       last);
    forget_process(worker);
    return well;
}

bool rg_worker_destroy(struct rg_worker *worker)
{
    if (!worker)
        return true;
    const bool well = !worker->process || end(worker);
    free(worker->name);
    free(worker->environment);
    free(worker);
    return well;
}

// --- watching ---

// Passes an interruption on, because the terminal's Ctrl-C does not reach the worker, which has its
// own process group. It does so once, since a second signal would end the worker. Returns whether
// it did so now.
static bool pass_on_interruption(struct rg_worker *worker)
{
    if (!rg_interrupted() || worker->is_interrupted)
        return false;
    kill(worker->process, SIGINT);
    return worker->is_interrupted = true;
}

// Whether the process has ended, even if a child of it keeps the channel open. Does not reap it.
static bool is_dead(const struct rg_worker *worker)
{
    siginfo_t info = {0};
    return waitid(P_PID, (id_t)worker->process, &info, WEXITED | WNOHANG | WNOWAIT)
               ? errno == ECHILD
               : info.si_pid == worker->process;
}

static void drop_much_printed(const struct rg_worker *worker)
{
    struct stat printed;
    const int file = fileno(worker->printed);
    if (!fstat(file, &printed) && printed.st_size > MOST_PRINTED && ftruncate(file, 0))
        rg_warning("device '%s': what it prints cannot be dropped: %s", worker->name,
                   strerror(errno));
}

static enum rg_arrival watch(struct rg_worker *worker, struct rg_message *reply,
                             enum rg_worker_verdict *verdict)
{
    const struct rg_doing *doing = worker->channel.doing;
    uint64_t seen = 0;
    double since_ms = rg_now_ms();
    for (;;) {
        drop_much_printed(worker);
        const enum rg_arrival arrival = rg_channel_receive(&worker->channel, reply, LOOK_MS);
        if (arrival == RG_DAMAGED)
            *verdict = RG_WORKER_LIES;
        if (arrival == RG_NO_ROOM)
            *verdict = RG_WORKER_NO_ROOM;
        if (arrival != RG_NOT_YET)
            return arrival;
        const bool is_told_now = pass_on_interruption(worker);
        const uint64_t count = atomic_load(&doing->count);
        if (count != seen || is_told_now)
            since_ms = rg_now_ms();
        seen = count;
        if (rg_now_ms() - since_ms > 1000.0 * rg_workers.timeout_s)
            *verdict = RG_WORKER_HANGS;
        else if (rg_held_bytes(worker->process) > worker->memory_bytes)
            *verdict = RG_WORKER_HOLDS_TOO_MUCH;
        if (*verdict != RG_WORKER_BY_ITSELF)
            return RG_ENDED;
        if (is_dead(worker)) // its last reply may have arrived meanwhile
            return rg_channel_receive(&worker->channel, reply, 0) == RG_ARRIVED ? RG_ARRIVED
                                                                                : RG_ENDED;
    }
}

// --- reporting its end ---

static enum rg_outcome bury(struct rg_worker *worker, enum rg_worker_verdict verdict, char *why,
                            size_t size)
{
    if (verdict != RG_WORKER_BY_ITSELF)
        kill(worker->process, SIGKILL);
    const struct rg_worker_end end = {.verdict = verdict,
                                      .status = end_process(worker),
                                      .memory_bytes = worker->memory_bytes,
                                      .timeout_s = rg_workers.timeout_s,
                                      .printed = worker->printed};
    rg_worker_tell_doing(worker->channel.doing, worker->doing);
    rg_worker_tell_end(&end, worker->doing, why, size);
    forget_process(worker);
    worker->ended++;
    return worker->end = rg_worker_end_outcome(&end);
}

// --- messages ---

// A driver's error names its device; a user's error does not. If limits are low, a driver that
// fails or gives no device is neither at fault nor absent: raingauge lacks memory.
static void relay(const struct rg_worker *worker, enum rg_log_level level, enum rg_fault fault,
                  enum rg_outcome outcome, const char *line)
{
    char named[1500], limits[RG_LIMITS_TEXT];
    const bool is_error = level == RG_LOG_ERROR;
    const bool is_limited =
        is_error && (fault == RG_FAULT_DRIVER || fault == RG_FAULT_SETUP) && rg_limits_low(limits);
    if (is_error && fault == RG_FAULT_NONE && !worker->was_open && rg_limits_low(limits)) {
        rg_harness_error("device '%s': its driver gives none %s; allow more", worker->name, limits);
        return;
    }
    const char *const begin =
        is_error && fault != RG_FAULT_INPUT && !strstr(line, worker->name) ? worker->name : NULL;
    snprintf(named, sizeof(named), "%s%s%s%s%s%s%s", begin ? "device '" : "", begin ? begin : "",
             begin ? "': " : "", line, is_limited ? " (" : "", is_limited ? limits : "",
             is_limited ? "; allow more)" : "");
    rg_log_relay(level, is_limited ? RG_FAULT_HARNESS : fault, is_limited ? RG_LACKING : outcome,
                 named);
}

// Logs the worker's lines, and returns whether the call succeeded. A failed call has given its
// reason.
static bool open_reply(const struct rg_worker *worker, struct rg_message *reply)
{
    const bool ok = rg_take_index(reply, 2);
    const enum rg_fault fault = (enum rg_fault)rg_take_index(reply, RG_FAULTS);
    const enum rg_outcome outcome = (enum rg_outcome)rg_take_index(reply, RG_OUTCOME_COUNT);
    const int count = rg_take_index(reply, RG_WORKER_MOST_LINES + 1);
    bool has_told = ok;
    if (!ok && !rg_outcome_is_broken(outcome) && outcome != RG_UNSUPPORTED)
        rg_message_fail(reply);
    for (int i = 0; i < count && !reply->failed; i++) {
        const int level = rg_take_index(reply, RG_LOG_LEVELS);
        const char *line = rg_take_text(reply);
        if (!reply->failed)
            relay(worker, (enum rg_log_level)level, fault, outcome, line);
        has_told = has_told || level == RG_LOG_ERROR;
    }
    return (has_told || rg_message_fail(reply)) && ok && !reply->failed;
}

// Sends the call, then the request.
static bool send(struct rg_worker *worker, enum rg_call call, const struct rg_message *request)
{
    static const struct rg_message nothing;
    char room[sizeof(int64_t)]; // so that it takes no memory, which may be wanting
    struct rg_message head = {.bytes = room, .room = sizeof(room)};
    rg_put_int(&head, call);
    return rg_channel_send(&worker->channel, &head, request ? request : &nothing);
}

// --- coming to life ---

// Waits for a message up to the patience, which signals do not shorten.
static bool receives(struct rg_worker *worker, struct rg_message *reply, int patience_ms)
{
    const double end_ms = rg_now_ms() + patience_ms;
    enum rg_arrival arrival = RG_NOT_YET;
    while (arrival == RG_NOT_YET && rg_now_ms() < end_ms)
        arrival = rg_channel_receive(&worker->channel, reply, LOOK_MS);
    return arrival == RG_ARRIVED;
}

// Whether a process of another program uses the same messages. Any other answer cannot be
// understood.
static bool is_greeted(struct rg_worker *worker)
{
    struct rg_message reply = {0}, due = {0};
    const int timeout_s = rg_workers.timeout_s;
    const int patience_ms = timeout_s < HELLO_MS / 1000 ? timeout_s * 1000 : HELLO_MS;
    rg_put_int(&due, true); // a success, no error, no lines
    rg_put_int(&due, RG_FAULT_NONE);
    rg_put_int(&due, RG_OK);
    rg_put_int(&due, 0);
    rg_put_text(&due, rg_workers.hello);
    const bool same = send(worker, RG_CALL_HELLO, NULL) && receives(worker, &reply, patience_ms) &&
                      reply.size == due.size && !due.failed &&
                      !memcmp(reply.bytes, due.bytes, (size_t)due.size);
    rg_message_free(&reply);
    rg_message_free(&due);
    return same;
}

// Ends a process with incompatible messages.
static bool turn_away(struct rg_worker *worker)
{
    kill(worker->process, SIGKILL);
    end_process(worker);
    forget_process(worker);
    worker->end = RG_ERROR;
    worker->ended++;
    return rg_error("device '%s': " RG_WORKER_PROGRAM "=%s is no raingauge that this one can ask; "
                    "build both from commits whose messages between processes are the same",
                    worker->name, program_of(worker));
}

// Ensures that a process is running. False, with the reason in `why` or one logged line, if it has
// ended too often or cannot be started.
static bool comes_to_life(struct rg_worker *worker, char *why, size_t size)
{
    if (worker->process)
        return true;
    if (worker->ended < RG_WORKER_LIVES)
        return start(worker, why, size) &&
               (!program_of(worker) || is_greeted(worker) || turn_away(worker));
    snprintf(why, size, "left out, for its process has ended %d times", worker->ended);
    return false;
}

// --- calls ---

enum rg_outcome rg_worker_try(struct rg_worker *worker, enum rg_call call,
                              const struct rg_message *request, struct rg_message *reply, char *why,
                              size_t why_size)
{
    enum rg_worker_verdict verdict = RG_WORKER_BY_ITSELF;
    *reply = (struct rg_message){0};
    *why = 0;
    if (request && request->failed)
        return rg_failure_take().outcome;
    if (!comes_to_life(worker, why, why_size))
        return worker->end;
    const bool is_sent = send(worker, call, request);
    if (!is_sent)
        verdict = errno == ETIMEDOUT ? RG_WORKER_HANGS : RG_WORKER_BY_ITSELF;
    if (!is_sent || watch(worker, reply, &verdict) != RG_ARRIVED)
        return bury(worker, verdict, why, why_size);
    count_taken(worker, atomic_load(&worker->channel.doing->taken_bytes));
    reply->device = worker->name;
    const bool ok = open_reply(worker, reply);
    worker->was_open = worker->was_open || (ok && call == RG_CALL_OPEN);
    return ok ? RG_OK : rg_failure_take().outcome;
}

bool rg_worker_call(struct rg_worker *worker, enum rg_call call, const struct rg_message *request,
                    struct rg_message *reply)
{
    char why[960];
    const enum rg_outcome outcome = rg_worker_try(worker, call, request, reply, why, sizeof(why));
    return outcome == RG_OK || (*why && tell_loss(worker, outcome, why));
}

bool rg_worker_finish(struct rg_message *reply, bool ok)
{
    ok = ok && (reply->at == reply->size || rg_message_fail(reply)) && !reply->failed;
    rg_message_free(reply);
    return ok;
}

bool rg_worker_fetch(struct rg_worker *worker, enum rg_call call, const struct rg_message *request,
                     const struct rg_field *fields, void *all)
{
    static const struct rg_field nothing[] = {RG_FIELDS_END};
    struct rg_message reply;
    const bool ok = rg_worker_call(worker, call, request, &reply) &&
                    rg_take_fields(&reply, fields ? fields : nothing, all);
    return rg_worker_finish(&reply, ok);
}

bool rg_worker_ask(struct rg_worker *worker, enum rg_call call, const struct rg_message *request)
{
    return rg_worker_fetch(worker, call, request, NULL, NULL);
}

const char *rg_worker_end_doing(const struct rg_worker *worker)
{
    return worker->doing;
}

void rg_worker_renew(struct rg_worker *worker)
{
    if (worker->process) {
        kill(worker->process, SIGKILL);
        end_process(worker);
        forget_process(worker);
    }
    worker->ended = 0;
}

const struct rg_field rg_closed_fields[] = {
    {RG_KIND_INTEGER, 0, sizeof(bool), 0, 1, .entries = 1},
    RG_FIELDS_END,
};

// A lack of memory does not count as closing badly: the process ends, and finished work is whole.
void rg_worker_closes_badly(struct rg_worker *worker)
{
    worker->closed_badly = worker->closed_badly || rg_failure_take().outcome != RG_LACKING;
}

bool rg_worker_retire(struct rg_worker *worker)
{
    const bool was_alive = worker->process;
    bool is_clean = true;
    worker->is_closed =
        was_alive && rg_worker_fetch(worker, RG_CALL_CLOSE, NULL, rg_closed_fields, &is_clean);
    if (was_alive && !worker->is_closed)
        rg_worker_closes_badly(worker);
    return is_clean && !worker->closed_badly;
}
