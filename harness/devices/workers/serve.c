#include "harness/devices/workers/serve.h"

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include "core/base/log.h"
#include "core/base/memory.h"
#include "harness/console/exit.h"
#include "harness/console/interrupt.h"
#include "harness/devices/workers/channel.h"
#include "harness/devices/workers/inside.h"

// Lines logged since the last reply.
static struct {
    int count;
    struct rg_message lines;
} logged;

// There was no memory for a message.
static bool lacks;

static void keep_line(enum rg_log_level level, const char *line, void *user)
{
    (void)user;
    if (logged.count >= RG_WORKER_MOST_LINES - (level != RG_LOG_ERROR))
        return;
    rg_put_int(&logged.lines, level);
    rg_put_text(&logged.lines, line);
    logged.count++;
}

// A reply is: whether the call succeeded, the failure, the lines, and the result.
static bool send_reply(struct rg_channel *channel, bool ok, const struct rg_message *result)
{
    static const struct rg_message nothing;
    struct rg_message reply = {0};
    const struct rg_failure failure =
        ok && !logged.count ? (struct rg_failure){.fault = RG_FAULT_NONE} : rg_failure_take();
    rg_put_int(&reply, ok);
    rg_put_int(&reply, failure.fault);
    rg_put_int(&reply, failure.outcome);
    rg_put_int(&reply, logged.count);
    rg_put(&reply, logged.lines.bytes, logged.lines.size);
    const bool is_made = !reply.failed && !logged.lines.failed;
    const bool sent = is_made && rg_channel_send(channel, &reply, ok ? result : &nothing);
    lacks = lacks || !is_made;
    rg_message_free(&reply);
    rg_message_free(&logged.lines);
    logged.count = 0;
    return sent;
}

static bool serve_one(struct rg_channel *channel, rg_service *const services[],
                      struct rg_message *request, enum rg_call *call)
{
    struct rg_message result = {0};
    *call = (enum rg_call)rg_take_index(request, RG_CALL_COUNT_OF_CALLS);
    rg_doing_begin(rg_call_doing(*call), "");
    const bool ok = !request->failed &&
                    (services[*call] || rg_error("a worker does not serve this call")) &&
                    services[*call](request, &result) && !request->failed && !result.failed;
    atomic_store(&channel->doing->taken_bytes, rg_memory_taken());
    const bool sent = send_reply(channel, ok, &result);
    rg_message_free(&result);
    return sent;
}

// Makes this process end with the harness, without core dumps, which would mostly hold the driver's
// memory. False if the harness did not start it.
static bool become_a_worker(pid_t harness)
{
    const struct rlimit none = {0, 0};
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    if (getppid() != harness)
        return false; // or the harness ended before this was set
    setrlimit(RLIMIT_CORE, &none);
    signal(SIGXFSZ, SIG_IGN);
    rg_interrupt_serve();
    return true;
}

int rg_serve(const char *argument, rg_service *const services[RG_CALL_COUNT_OF_CALLS])
{
    struct rg_channel channel;
    long harness = 0;
    struct rg_message request;
    enum rg_call call = RG_CALL_OPEN;
    if (sscanf(argument, RG_WORKER_CHANNEL, &harness) != 1 || !become_a_worker((pid_t)harness)) {
        rg_error("worker '%s': raingauge starts its workers itself; `raingauge --help` lists what "
                 "there is to start",
                 argument);
        return RG_EXIT_USAGE;
    }
    if (!rg_channel_join(&channel, RG_WORKER_SOCKET, RG_WORKER_PAGE))
        return RG_EXIT_HARNESS;
    rg_log_listen(keep_line, NULL);
    rg_doing_share(channel.doing);
    bool goes_on = true;
    while (goes_on && call != RG_CALL_CLOSE) {
        const enum rg_arrival arrival = rg_channel_receive(&channel, &request, -1);
        if (arrival == RG_NOT_YET)
            continue;
        lacks = lacks || arrival == RG_NO_ROOM;
        goes_on = arrival == RG_ARRIVED && serve_one(&channel, services, &request, &call);
        rg_message_free(&request);
    }
    rg_doing_share(NULL);
    rg_log_listen(NULL, NULL);
    rg_channel_close(&channel);
    return lacks ? RG_EXIT_HARNESS : RG_EXIT_PASS;
}
