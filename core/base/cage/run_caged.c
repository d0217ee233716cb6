#define _GNU_SOURCE // memfd_create
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "core/base/cage/cage.h"
#include "core/base/program.h"

// Where such a program is, seen from the folder of the running one: beside it, installed, or in the
// build, whose programs and tests lie at several depths.
static const char *const places[] = {
    "",
    "../lib/raingauge/",
    "../" RG_LIBDIR "/raingauge/",
    "../core/",
    "../../core/",
    "../../../core/",
    "../../../../core/",
    "../../../../../core/",
};

bool rg_caged_find(const char *program, char *path, size_t size)
{
    char folder[PATH_MAX];
    const ssize_t length = readlink("/proc/self/exe", folder, sizeof(folder) - 1);
    folder[length < 0 ? 0 : length] = 0;
    char *slash = strrchr(folder, '/');
    if (slash)
        *slash = 0;
    for (size_t i = 0; i < sizeof(places) / sizeof(places[0]); i++) {
        const int written = snprintf(path, size, "%s/%s%s", folder, places[i], program);
        if (written > 0 && (size_t)written < size && !access(path, X_OK))
            return true;
    }
    snprintf(path, size, "%s", folder);
    return false;
}

static int64_t now_ms(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return now.tv_sec * 1000LL + now.tv_nsec / 1000000;
}

// False when it had to be killed. Its end of `alive` closes when it ends; one that closes it and
// goes on has as long as any other.
static bool wait_for_end(pid_t child, int alive, int timeout_s, int *status)
{
    enum { LOOK_MS = 200, BEHIND_CLOSE_US = 100 };
    const int64_t deadline_ms = now_ms() + 1000LL * timeout_s;
    bool is_closed = false;
    while (now_ms() <= deadline_ms) {
        if (is_closed)
            usleep(BEHIND_CLOSE_US);
        else
            is_closed = poll(&(struct pollfd){.fd = alive, .events = POLLIN}, 1, LOOK_MS) > 0;
        if (is_closed && rg_program_has_ended(child, status))
            return true;
    }
    kill(child, SIGKILL);
    rg_program_wait(child, status);
    return false;
}

int rg_caged_run(const char *const args[], int file, int timeout_s, struct rg_caged *caged)
{
    static char *const no_environment[] = {NULL};
    int alive[2] = {-1, -1};
    *caged = (struct rg_caged){.reply = memfd_create("raingauge reply", MFD_CLOEXEC)};
    int error = caged->reply < 0 || pipe2(alive, O_CLOEXEC) ? errno : 0;
    pid_t child = 0;
    if (!error) {
        // The end of `alive` that the process has closes when it ends.
        error =
            rg_program_start_in(no_environment, args,
                                (const int[]){-1, -1, -1, [RG_CAGE_REPLY] = caged->reply,
                                              [RG_CAGE_ALIVE] = alive[1], [RG_CAGE_FILE] = file},
                                RG_CAGE_FILE + 1, &child);
        close(alive[1]);
    }
    if (!error)
        caged->ended = wait_for_end(child, alive[0], timeout_s, &caged->status);
    if (alive[0] >= 0)
        close(alive[0]);
    return error;
}

bool rg_caged_is_sound(const struct rg_caged *caged, const char *library, char *why, size_t size)
{
    enum { NOT_LOADED = 127 }; // of the dynamic loader, as of shells
    const int status = caged->status;
    const bool crashed = WIFSIGNALED(status);
    if (!caged->ended || (crashed && WTERMSIG(status) == SIGXCPU))
        snprintf(why, size,
                 "%s did not come to an end with it in time; the file is damaged or too large: "
                 "repair, convert or reduce it",
                 library);
    else if (crashed)
        snprintf(why, size, "%s crashed on it (%s); the file is damaged: repair or convert it",
                 library, strsignal(WTERMSIG(status)));
    else if (WEXITSTATUS(status) == NOT_LOADED)
        snprintf(why, size,
                 "what reads it with %s could not be loaded, as where a library is absent; install "
                 "raingauge's packages again",
                 library);
    else if (WEXITSTATUS(status))
        snprintf(why, size,
                 "%s ended with status %d on it; the file is damaged: repair or convert it",
                 library, WEXITSTATUS(status));
    return caged->ended && status == 0;
}
