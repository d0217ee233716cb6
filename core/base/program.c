#define _GNU_SOURCE // posix_spawn_file_actions_addclosefrom_np
#include "core/base/program.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <stdatomic.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/auxv.h>
#include <sys/wait.h>
#include <unistd.h>

enum { MAX_FDS = 8, MOST_STARTED = 256, MOST_ACTS = 8 };

typedef void (*act_before_end)(void);

// Programs that were started and not yet waited for; 0 marks a free place. A signal handler reads
// it.
static _Atomic pid_t started[MOST_STARTED];
static _Atomic(act_before_end) acts[MOST_ACTS];
static pid_t owner; // the process that `started` belongs to: a forked child has started nothing

static void remember(pid_t child)
{
    owner = getpid();
    for (int i = 0; i < MOST_STARTED; i++) {
        pid_t none = 0;
        if (atomic_compare_exchange_strong(&started[i], &none, child))
            return;
    }
}

static void forget(pid_t child)
{
    for (int i = 0; i < MOST_STARTED; i++) {
        pid_t it = child;
        atomic_compare_exchange_strong(&started[i], &it, 0);
    }
}

// Sets up the child's descriptors. `moved` are copies with numbers above all targets, so that no
// descriptor is overwritten before it is copied.
static int set_fds(posix_spawn_file_actions_t *actions, const int moved[], int fd_count)
{
    int error = 0;
    for (int i = 0; !error && i < fd_count; i++)
        error = moved[i] < 0 ? posix_spawn_file_actions_addopen(actions, i, "/dev/null", O_RDWR, 0)
                             : posix_spawn_file_actions_adddup2(actions, moved[i], i);
    return error ? error : posix_spawn_file_actions_addclosefrom_np(actions, fd_count);
}

// The child gets a process group of its own, because a terminal sends Ctrl-C to the whole
// foreground group.
static int set_signals(posix_spawnattr_t *attributes)
{
    sigset_t all, none;
    sigfillset(&all);
    sigemptyset(&none);
    posix_spawnattr_setsigdefault(attributes, &all);
    posix_spawnattr_setsigmask(attributes, &none);
    posix_spawnattr_setpgroup(attributes, 0);
    return posix_spawnattr_setflags(attributes, POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSIGMASK |
                                                    POSIX_SPAWN_SETPGROUP);
}

static int spawn(char *const environment[], const char *const args[], const int moved[],
                 int fd_count, pid_t *child)
{
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    int error = posix_spawn_file_actions_init(&actions);
    if (error)
        return error;
    error = posix_spawnattr_init(&attributes);
    if (!error) {
        if (!(error = set_fds(&actions, moved, fd_count)) && !(error = set_signals(&attributes)))
            error = posix_spawnp(child, args[0], &actions, &attributes, (char *const *)args,
                                 environment);
        posix_spawnattr_destroy(&attributes);
    }
    posix_spawn_file_actions_destroy(&actions);
    return error;
}

int rg_program_start_in(char *const environment[], const char *const args[], const int fds[],
                        int fd_count, pid_t *child)
{
    int moved[MAX_FDS] = {0}, count = 0, error = fd_count > MAX_FDS ? EINVAL : 0;
    for (; !error && count < fd_count; count++) {
        moved[count] = fds[count] < 0 ? -1 : fcntl(fds[count], F_DUPFD_CLOEXEC, fd_count);
        if (fds[count] >= 0 && moved[count] < 0)
            error = errno;
    }
    // Signals are blocked so that none arrives between the start of a program and its entry in
    // `started`.
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_BLOCK, &all, &before);
    if (!error && !(error = spawn(environment, args, moved, fd_count, child)))
        remember(*child);
    pthread_sigmask(SIG_SETMASK, &before, NULL);
    for (int i = 0; i < count; i++)
        if (moved[i] >= 0)
            close(moved[i]);
    return error;
}

int rg_program_start(const char *const args[], const int fds[], int fd_count, pid_t *child)
{
    return rg_program_start_in(environ, args, fds, fd_count, child);
}

const char *rg_program_mend(int error)
{
    switch (error) {
    case EMFILE:
    case ENFILE:
        return "allow more open files (ulimit -n)";
    case EAGAIN:
        return "allow more processes (ulimit -u, or the container's pids limit)";
    case E2BIG:
        return "give it fewer or shorter variables";
    case ENOMEM:
        return "close other programs, or allow more memory";
    case ENOENT:
        return "put it and /dev/null there";
    case EACCES:
        return "make it a program that may be run, in a folder that is not mounted noexec";
    default:
        return "have the container or its seccomp filter allow to start processes";
    }
}

bool rg_program_has_ended(pid_t child, int *status)
{
    const pid_t ended = waitpid(child, status, WNOHANG);
    if (!ended || (ended < 0 && errno == EINTR))
        return false;
    forget(child);
    return true;
}

void rg_program_wait(pid_t child, int *status)
{
    while (waitpid(child, status, 0) < 0 && errno == EINTR)
        continue;
    forget(child);
}

void rg_program_last_line(FILE *printed, char *last, size_t size)
{
    char line[512];
    *last = 0;
    rewind(printed);
    while (fgets(line, sizeof(line), printed)) {
        line[strcspn(line, "\r\n")] = 0;
        if (strpbrk(line, "abcdefghijklmnopqrstuvwxyz"))
            snprintf(last, size, ": %.160s", line);
    }
}

const char *rg_program_self(void)
{
    static char path[PATH_MAX];
    static const char proc[] = "/proc/self/exe";
    const char *const started_by = (const char *)(uintptr_t)getauxval(AT_EXECFN);
    return *path ? path : access(proc, X_OK) && realpath(started_by, path) ? path : proc;
}

void rg_program_folder(char place[PATH_MAX])
{
    const char *const self = rg_program_self();
    const ssize_t length = readlink(self, place, PATH_MAX - 1); // works after deletion, too
    if (length < 0)
        snprintf(place, PATH_MAX, "%s", self);
    else
        place[length] = 0;
    char *slash = strrchr(place, '/');
    if (slash)
        *slash = 0;
}

// Where parts lie, relative to the running program: beside it, installed, or in the build, whose
// programs and tests lie at several depths.
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

bool rg_program_part(const char *name, char *path, size_t size)
{
    char folder[PATH_MAX];
    rg_program_folder(folder);
    for (size_t i = 0; i < sizeof(places) / sizeof(places[0]); i++) {
        const int written = snprintf(path, size, "%s/%s%s", folder, places[i], name);
        if (written > 0 && (size_t)written < size && !access(path, R_OK))
            return true;
    }
    snprintf(path, size, "%s", folder);
    return false;
}

void rg_program_before_end(void (*act)(void))
{
    for (int i = 0; i < MOST_ACTS; i++) {
        act_before_end none = NULL;
        if (atomic_compare_exchange_strong(&acts[i], &none, act) || none == act)
            return;
    }
}

noreturn void rg_program_end_by(int number)
{
    sigset_t it;
    for (int i = 0; i < MOST_STARTED && getpid() == owner; i++)
        if (started[i])
            kill(-started[i], SIGKILL);
    for (int i = 0; i < MOST_ACTS && acts[i]; i++)
        acts[i]();
    signal(number, SIG_DFL);
    sigemptyset(&it);
    sigaddset(&it, number);
    pthread_sigmask(SIG_UNBLOCK, &it, NULL);
    raise(number);
    _exit(128 + number);
}
