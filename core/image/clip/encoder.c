#define _GNU_SOURCE // SOCK_CLOEXEC
#include "core/image/clip/encoder.h"

#include <errno.h>
#include <poll.h>
#include <signal.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "core/base/files/nameless.h"
#include "core/base/log.h"
#include "core/base/program.h"

enum { FRAMES_FD, CODED_FD, MESSAGES_FD, FDS };
enum { WAIT_MS = 100 };

// One pass, because frames come once. Constant quality at level 16 of 63: the eye hardly tells a
// frame from its picture. Rain, which is all edges, takes as many bytes as it needs. -D leaves out
// the date and the random number that would make two files differ. Threads code columns of tiles,
// whose number follows from the width, so that the number of cores changes no byte.
static const char *const arguments[] = {
    "vpxenc",
    "--codec=vp9",
    "--profile=0",
    "-D",
    "--quiet",
    "--disable-warning-prompt",
    "--passes=1",
    "--good",
    "--cpu-used=2",
    "--end-usage=q",
    "--cq-level=16",
    "--color-space=bt709",
    "--threads=8",
    "--output=-",
    "-",
    NULL,
};

static bool make_room(struct rg_encoder *e)
{
    char why[RG_NAMELESS_WHY] = "close other programs";
    e->coded = rg_file_nameless(why);
    const int messages = e->coded < 0 ? -1 : rg_file_nameless(why);
    e->messages = messages < 0 ? NULL : fdopen(messages, "w+");
    if (messages >= 0 && !e->messages)
        close(messages);
    return e->messages || rg_harness_error("%s: cannot be made: %s", e->name, why);
}

// vpxenc reads from a socket, because writing to a pipe that nobody reads would kill this process.
static bool start(struct rg_encoder *e)
{
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends))
        return rg_harness_error("%s: no socket to hand frames to vpxenc (socketpair): %s", e->name,
                                strerror(errno));
    e->feed = ends[1];
    const int fds[FDS] = {
        [FRAMES_FD] = ends[0], [CODED_FD] = e->coded, [MESSAGES_FD] = fileno(e->messages)};
    const int error = rg_program_start(arguments, fds, FDS, &e->process);
    close(ends[0]);
    if (!error)
        return true;
    e->process = 0;
    if (error == ENOENT || error == EACCES)
        return rg_unsupported("%s: a clip is made by vpxenc, which is not here; install the Debian "
                              "package vpx-tools, or write pictures (-o NAME-%%04d.png)",
                              e->name);
    return rg_harness_error("%s: vpxenc could not be started: %s; %s", e->name, strerror(error),
                            rg_program_mend(error));
}

bool rg_encoder_start(struct rg_encoder *e, const char *name, double patience_s, bool (*stop)(void))
{
    *e = (struct rg_encoder){
        .name = name, .patience_s = patience_s, .stop = stop, .feed = -1, .coded = -1};
    return make_room(e) && start(e);
}

// --- running ---

static double now_s(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + (double)now.tv_nsec * 1e-9;
}

// Whether the encoder hangs, with one logged line if so. The size of its file shows whether it
// still codes.
static bool hangs(struct rg_encoder *e)
{
    struct stat st;
    if (!e->patience_s)
        return false;
    if (fstat(e->coded, &st) == 0 && st.st_size != e->coded_bytes) {
        e->coded_bytes = st.st_size;
        e->since_s = now_s();
    }
    return now_s() - e->since_s > e->patience_s &&
           !rg_timeout_error(
               "%s: vpxenc did nothing for %.0f s and was ended; nothing was written; "
               "--timeout gives it longer",
               e->name, e->patience_s);
}

// Whether to stop waiting.
static bool given_up(struct rg_encoder *e)
{
    return (e->stop && e->stop()) || hangs(e);
}

// Waits for the encoder's end; false if it was told to stop or hangs.
static bool wait_for_end(struct rg_encoder *e, int *status)
{
    const struct timespec pause = {0, 2000000};
    while (!rg_program_has_ended(e->process, status)) {
        if (given_up(e))
            return false;
        nanosleep(&pause, NULL);
    }
    e->process = 0;
    return true;
}

// Logs how the encoder ended: badly, or before it had all frames.
static bool tell_end(const struct rg_encoder *e, int status)
{
    char last[200];
    rg_program_last_line(e->messages, last, sizeof(last));
    if (WIFSIGNALED(status) && WTERMSIG(status) == SIGXFSZ)
        return rg_harness_error("%s: cannot be written: %s; allow larger files (ulimit -f)",
                                e->name, strerror(EFBIG));
    if (WIFSIGNALED(status))
        return rg_driver_error("%s: vpxenc was ended by a signal (%s)%s; nothing was written",
                               e->name, strsignal(WTERMSIG(status)), last);
    if (WEXITSTATUS(status))
        return rg_driver_error("%s: vpxenc ended with status %d%s; nothing was written", e->name,
                               WEXITSTATUS(status), last);
    return rg_driver_error("%s: vpxenc ended before it had coded all frames%s; nothing was written",
                           e->name, last);
}

bool rg_encoder_feed(struct rg_encoder *e, const void *data, size_t bytes)
{
    e->since_s = now_s();
    for (const char *at = data; bytes > 0;) {
        if (given_up(e))
            return false;
        struct pollfd ready = {.fd = e->feed, .events = POLLOUT};
        if (poll(&ready, 1, WAIT_MS) <= 0)
            continue;
        const ssize_t sent = send(e->feed, at, bytes, MSG_NOSIGNAL | MSG_DONTWAIT);
        if (sent < 0 && (errno == EAGAIN || errno == EINTR))
            continue;
        if (sent <= 0) {
            int status = 0;
            return wait_for_end(e, &status) && tell_end(e, status);
        }
        e->since_s = now_s();
        at += sent;
        bytes -= (size_t)sent;
    }
    return true;
}

// A socket whose other end was closed with bytes unread reports an error.
static bool has_read_all(const struct rg_encoder *e)
{
    int error = 0;
    socklen_t size = sizeof(error);
    return getsockopt(e->feed, SOL_SOCKET, SO_ERROR, &error, &size) == 0 && error == 0;
}

bool rg_encoder_finish(struct rg_encoder *e)
{
    int status = 0;
    struct stat st;
    e->since_s = now_s();
    shutdown(e->feed, SHUT_WR);
    if (!wait_for_end(e, &status))
        return false;
    if (status || !has_read_all(e) || fstat(e->coded, &st) || st.st_size == 0)
        return tell_end(e, status);
    return true;
}

void rg_encoder_end(struct rg_encoder *e)
{
    if (e->process) {
        kill(e->process, SIGKILL);
        rg_program_wait(e->process, NULL);
    }
    if (e->feed >= 0)
        close(e->feed);
    if (e->coded >= 0)
        close(e->coded);
    if (e->messages)
        fclose(e->messages);
    *e = (struct rg_encoder){.feed = -1, .coded = -1};
}
