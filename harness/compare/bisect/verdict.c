#include "harness/compare/bisect/verdict.h"

#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "core/base/log.h"
#include "core/base/program.h"
#include "harness/console/clock.h"
#include "harness/console/exit.h"
#include "harness/console/interrupt.h"

static const struct {
    const char *name;
    int git; // exit status inside `git bisect run`
} verdicts[] = {
    [RG_JUDGED_NONE] = {"none", RG_EXIT_SIGNALLED},
    [RG_JUDGED_GOOD] = {"good", RG_EXIT_PASS},
    [RG_JUDGED_BAD] = {"bad", RG_EXIT_FAIL},
    [RG_JUDGED_SKIP] = {"skip", RG_EXIT_GIT_SKIP},
    [RG_JUDGED_AGAIN] = {"again", RG_EXIT_SIGNALLED},
    [RG_JUDGED_STOP] = {"stop", RG_EXIT_SIGNALLED},
};

const char *rg_judgement_name(enum rg_judgement verdict)
{
    return verdicts[verdict].name;
}

int rg_judgement_git(enum rg_judgement verdict)
{
    const bool is_asked = verdict == RG_JUDGED_STOP && rg_interrupted();
    return verdicts[verdict].git + (is_asked ? rg_interrupt_signal() : 0);
}

static enum rg_judgement judgement_of(int status, bool crash_is_bad)
{
    switch (status) {
    case RG_EXIT_PASS:
        return RG_JUDGED_GOOD;
    case RG_EXIT_FAIL:
        return RG_JUDGED_BAD;
    case RG_EXIT_INCONCLUSIVE:
        return RG_JUDGED_AGAIN;
    case RG_EXIT_NOTHING:
    case RG_EXIT_UNSUPPORTED:
    case RG_EXIT_GIT_SKIP:
        return RG_JUDGED_SKIP;
    case RG_EXIT_SIGNALLED + SIGINT:
    case RG_EXIT_SIGNALLED + SIGTERM:
    case RG_EXIT_SIGNALLED + SIGHUP:
        return RG_JUDGED_STOP;
    default:
        if (status <= RG_EXIT_SIGNALLED)
            return RG_JUDGED_STOP;
        return crash_is_bad ? RG_JUDGED_BAD : RG_JUDGED_SKIP;
    }
}

// Waits for a process, and sends SIGTERM to its group if raingauge is interrupted. Returns its exit
// status as a shell reports it.
static int wait_for(pid_t child)
{
    enum { PAUSE_MS = 5 };
    bool is_asked = false;
    int status = RG_EXIT_SIGNALLED << 8; // if the process cannot be waited for
    while (!rg_program_has_ended(child, &status)) {
        if (rg_interrupted() && !is_asked) {
            is_asked = true;
            kill(-child, SIGTERM);
        }
        nanosleep(&(struct timespec){.tv_nsec = PAUSE_MS * 1000000}, NULL);
    }
    return WIFSIGNALED(status) ? RG_EXIT_SIGNALLED + WTERMSIG(status) : WEXITSTATUS(status);
}

// Runs a line in a shell and returns its exit status; below 0: the shell could not be started.
static int run_line(const char *line, bool prints_here)
{
    const char *const args[] = {"/bin/sh", "-c", line, NULL};
    const int fds[] = {-1, prints_here ? STDOUT_FILENO : STDERR_FILENO, STDERR_FILENO};
    pid_t child;
    fflush(NULL);
    const int error = rg_program_start(args, fds, 3, &child);
    if (!error)
        return wait_for(child);
    rg_harness_error("/bin/sh: cannot be started: %s; %s", strerror(error), rg_program_mend(error));
    return -1;
}

// Sets a variable of the command's environment; NULL changes nothing.
static bool hand_over(const char *variable, const char *value)
{
    return !value || !setenv(variable, value, 1) ||
           rg_harness_error("bisect: no memory for %s; close other programs", variable);
}

static int try_once(const struct rg_judging *judging, const char *candidate, const char *good,
                    int number)
{
    char budget[32];
    snprintf(budget, sizeof(budget), "%.10gs", ldexp(judging->budget_s, number));
    const bool ok = hand_over(RG_VARIABLE_CANDIDATE, candidate) &&
                    hand_over(RG_VARIABLE_GOOD, good) && hand_over(RG_VARIABLE_BUDGET, budget);
    return ok ? run_line(judging->line, judging->prints_here) : -1;
}

struct rg_judged rg_judge(const struct rg_judging *judging, const char *candidate, const char *good)
{
    struct rg_judged judged = {.verdict = RG_JUDGED_AGAIN};
    const double start_ms = rg_now_ms();
    while (judged.verdict == RG_JUDGED_AGAIN && judged.tries < judging->tries) {
        judged.status = try_once(judging, candidate, good, judged.tries);
        judged.verdict = judged.status < 0 || rg_interrupted()
                             ? RG_JUDGED_STOP
                             : judgement_of(judged.status, judging->crash_is_bad);
        judged.tries++;
    }
    if (judged.verdict == RG_JUDGED_AGAIN)
        judged.verdict = RG_JUDGED_SKIP;
    judged.seconds = (rg_now_ms() - start_ms) / 1000;
    return judged;
}

// Only git knows this file's place, because of work trees and GIT_DIR.
int rg_bisect_status_of_error(void)
{
    static const char *const args[] = {
        "/bin/sh", "-c", "test -e \"$(git rev-parse --git-path BISECT_START)\"", NULL};
    const int exit = rg_exit_of_error();
    pid_t child;
    int status = -1; // if the process cannot be waited for
    if (rg_program_start(args, (const int[]){-1, -1, -1}, 3, &child))
        return exit;
    rg_program_wait(child, &status);
    const bool git_is_bisecting = WIFEXITED(status) && !WEXITSTATUS(status);
    return git_is_bisecting ? rg_judgement_git(RG_JUDGED_STOP) : exit;
}
