#define _GNU_SOURCE // pipe2
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "core/base/cage/cage.h"
#include "core/base/program.h"
#include "core/base/text/limits.h"

static int64_t now_ms(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return now.tv_sec * 1000LL + now.tv_nsec / 1000000;
}

// --- its reply ---

// Reads one piece of the reply. False when the reply has ended or may grow no further.
static bool take(int from, int64_t most_bytes, size_t *room, struct rg_caged *caged)
{
    enum { LEAST_BYTES = 1 << 16 };
    if (caged->bytes == *room) {
        const size_t more = *room ? 2 * *room : LEAST_BYTES;
        char *reply = realloc(caged->reply, more);
        caged->has_room = reply != NULL;
        if (!reply)
            return false;
        caged->reply = reply;
        *room = more;
    }
    const ssize_t got = read(from, caged->reply + caged->bytes, *room - caged->bytes);
    if (got <= 0)
        return got < 0 && errno == EINTR;
    caged->bytes += (size_t)got;
    caged->is_cut = (int64_t)caged->bytes > most_bytes;
    return !caged->is_cut;
}

// Reads the reply until the program closes its end of the pipe, and kills it after `timeout_s`. A
// program that closes its end and goes on has the same time as any other.
static void attend(pid_t child, int reply, int timeout_s, int64_t most_bytes,
                   struct rg_caged *caged)
{
    enum { LOOK_MS = 200, BEHIND_CLOSE_US = 100 };
    const int64_t deadline_ms = now_ms() + 1000LL * timeout_s;
    bool is_open = true;
    size_t room = 0;
    while (now_ms() <= deadline_ms && !caged->is_cut && caged->has_room) {
        if (!is_open)
            usleep(BEHIND_CLOSE_US);
        else if (poll(&(struct pollfd){.fd = reply, .events = POLLIN}, 1, LOOK_MS) > 0)
            is_open = take(reply, most_bytes, &room, caged);
        caged->ended = !is_open && rg_program_has_ended(child, &caged->status);
        if (caged->ended)
            return;
    }
    kill(child, SIGKILL);
    rg_program_wait(child, &caged->status);
}

// --- the program ---

int rg_caged_run(const char *const args[], int file, int timeout_s, int64_t most_bytes,
                 struct rg_caged *caged)
{
    static char off[] = RG_CAGE_VARIABLE "=off";
    const char *const asked = getenv(RG_CAGE_VARIABLE);
    char *const environment[] = {asked && !strcmp(asked, "off") ? off : NULL, NULL};
    int reply[2] = {-1, -1};
    *caged = (struct rg_caged){.has_room = true};
    if (pipe2(reply, O_CLOEXEC))
        return errno;
    pid_t child = 0;
    const int error = rg_program_start_in(
        environment, args,
        (const int[]){-1, -1, -1, [RG_CAGE_REPLY] = reply[1], [RG_CAGE_FILE] = file},
        RG_CAGE_FILE + 1, &child);
    close(reply[1]);
    if (!error)
        attend(child, reply[0], timeout_s, most_bytes, caged);
    close(reply[0]);
    return error;
}

// How it ended if the machine kept it from its work. RG_CAGED_FILE: the machine did not.
static enum rg_caged_end refused(const struct rg_caged *caged, const char *library, char *why,
                                 size_t size)
{
    enum { NOT_LOADED = 127 }; // the dynamic loader's exit status, and the shell's
    char limits[RG_LIMITS_TEXT];
    const int status = caged->ended && WIFEXITED(caged->status) ? WEXITSTATUS(caged->status) : -1;
    if (status == RG_CAGE_REFUSED) {
        snprintf(why, size,
                 "the system gives its reader no cage (seccomp, prctl, capset), as in an emulator; "
                 "allow these, "
                 "or set " RG_CAGE_VARIABLE "=off to read files that you trust without one");
        return RG_CAGED_MACHINE;
    }
    if (!caged->has_room || status == RG_CAGE_NO_MEMORY) {
        snprintf(
            why, size,
            "no memory for what %s makes of it; close other programs, or allow more (ulimit -v)",
            library);
        return RG_CAGED_LACKING;
    }
    if (!caged->is_cut && rg_limits_low(limits)) {
        snprintf(why, size, "%s cannot read it %s; allow more", library, limits);
        return RG_CAGED_LACKING;
    }
    if (status != NOT_LOADED)
        return RG_CAGED_FILE;
    snprintf(why, size,
             "what reads it with %s could not be loaded, as where a library is absent; install "
             "raingauge's packages again",
             library);
    return RG_CAGED_MACHINE;
}

enum rg_caged_end rg_caged_end(const struct rg_caged *caged, const char *library, char *why,
                               size_t size)
{
    const int status = caged->status;
    const bool crashed = WIFSIGNALED(status);
    if (caged->ended && !status && !caged->is_cut && caged->has_room)
        return RG_CAGED_SOUND;
    const enum rg_caged_end end = refused(caged, library, why, size);
    if (end != RG_CAGED_FILE)
        return end;
    if (caged->is_cut)
        snprintf(why, size, "%s made more of it than it can hold; the file is damaged: repair it",
                 library);
    else if (!caged->ended || (crashed && WTERMSIG(status) == SIGXCPU))
        snprintf(why, size,
                 "%s did not come to an end with it in time; the file is damaged or too large: "
                 "repair, convert or reduce it",
                 library);
    else if (crashed)
        snprintf(why, size, "%s crashed on it (%s); the file is damaged: repair or convert it",
                 library, strsignal(WTERMSIG(status)));
    else
        snprintf(why, size,
                 "%s ended with status %d on it; the file is damaged: repair or convert it",
                 library, WEXITSTATUS(status));
    return RG_CAGED_FILE;
}
