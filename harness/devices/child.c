#define _DEFAULT_SOURCE // MAP_ANONYMOUS
#include "harness/devices/child.h"

#include <errno.h>
#include <signal.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "core/base/log.h"
#include "core/base/program.h"

void *rg_child_answer_create(size_t size)
{
    void *answer = mmap(NULL, size, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (answer == MAP_FAILED)
        return rg_error_null("no memory for %zu bytes: %s", size, strerror(errno));
    return answer;
}

void rg_child_answer_destroy(void *answer, size_t size)
{
    if (answer)
        munmap(answer, size);
}

static void ignore_line(enum rg_log_level level, const char *line, void *user)
{
    (void)level;
    (void)line;
    (void)user;
}

// _exit: a driver's destructors are not part of the work, and some of them crash.
static void run_child(void (*work)(void *), void *answer, FILE *printed)
{
    dup2(fileno(printed), STDOUT_FILENO);
    dup2(fileno(printed), STDERR_FILENO);
    rg_log_listen(ignore_line, NULL);
    work(answer);
    _exit(0);
}

// Waits for up to `timeout_s`; false: it still runs.
static bool wait_for(pid_t child, int timeout_s, int *status)
{
    const struct timespec pause = {0, 2000000};
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    const time_t deadline = now.tv_sec + timeout_s;
    while (waitpid(child, status, WNOHANG) == 0) {
        clock_gettime(CLOCK_MONOTONIC, &now);
        if (now.tv_sec > deadline)
            return false;
        nanosleep(&pause, NULL);
    }
    return true;
}

static enum rg_outcome explain(int status, bool ended, int timeout_s, FILE *printed, char *why,
                               size_t why_size)
{
    char last[200];
    if (ended && WIFEXITED(status) && WEXITSTATUS(status) == 0)
        return RG_OK;
    rg_program_last_line(printed, last, sizeof(last));
    if (!ended) {
        snprintf(why, why_size, "its driver did not come back within %d s%s", timeout_s, last);
        return RG_TIMEOUT;
    }
    if (WIFSIGNALED(status))
        snprintf(why, why_size, "its driver crashed (%s)%s", strsignal(WTERMSIG(status)), last);
    else
        snprintf(why, why_size, "its driver ended the process with status %d%s",
                 WEXITSTATUS(status), last);
    return RG_CRASH;
}

enum rg_outcome rg_child_run(void (*work)(void *), void *answer, int timeout_s, char *why,
                             size_t why_size)
{
    FILE *printed = tmpfile();
    fflush(NULL);
    pid_t child = printed ? fork() : -1;
    if (child == 0)
        run_child(work, answer, printed);
    if (child < 0) {
        snprintf(why, why_size, "no child process could be started: %s", strerror(errno));
        if (printed)
            fclose(printed);
        return RG_ERROR;
    }
    int status = 0;
    bool ended = wait_for(child, timeout_s, &status);
    if (!ended) {
        kill(child, SIGKILL);
        waitpid(child, &status, 0);
    }
    enum rg_outcome end = explain(status, ended, timeout_s, printed, why, why_size);
    fclose(printed);
    return end;
}
