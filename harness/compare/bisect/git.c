#include "harness/compare/bisect/git.h"

#include <sys/wait.h>

#include "core/base/program.h"
#include "harness/console/exit.h"
#include "harness/console/interrupt.h"

int rg_git_status(enum rg_judgement verdict)
{
    return verdict == RG_JUDGED_GOOD   ? RG_EXIT_PASS
           : verdict == RG_JUDGED_BAD  ? RG_EXIT_FAIL
           : verdict == RG_JUDGED_SKIP ? RG_EXIT_GIT_SKIP
           : rg_interrupted()          ? RG_EXIT_SIGNALLED + rg_interrupt_signal()
                                       : RG_EXIT_SIGNALLED;
}

// Only git knows this file's place, because of work trees and GIT_DIR.
static bool git_is_bisecting(void)
{
    static const char *const args[] = {
        "/bin/sh", "-c", "test -e \"$(git rev-parse --git-path BISECT_START)\"", NULL};
    pid_t child;
    int status = -1; // if the process cannot be waited for
    if (rg_program_start(args, (const int[]){-1, -1, -1}, 3, &child))
        return false;
    rg_program_wait(child, &status);
    return WIFEXITED(status) && !WEXITSTATUS(status);
}

int rg_git_status_of_usage(void)
{
    return git_is_bisecting() ? rg_git_status(RG_JUDGED_STOP) : RG_EXIT_USAGE;
}
