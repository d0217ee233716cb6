#define _GNU_SOURCE // strsignal
#include "harness/devices/workers/end.h"

#include <string.h>
#include <sys/wait.h>

#include "core/base/program.h"
#include "core/base/text/limits.h"
#include "harness/console/exit.h"

bool rg_worker_ended_lacking(int status)
{
    return WIFEXITED(status) && WEXITSTATUS(status) == RG_EXIT_HARNESS;
}

static bool ended_lacking(const struct rg_worker_end *end)
{
    return end->verdict == RG_WORKER_BY_ITSELF && rg_worker_ended_lacking(end->status);
}

enum rg_outcome rg_worker_end_outcome(const struct rg_worker_end *end)
{
    char limits[RG_LIMITS_TEXT];
    if (end->verdict == RG_WORKER_HANGS)
        return RG_TIMEOUT;
    const bool is_limited =
        ended_lacking(end) || (end->verdict == RG_WORKER_BY_ITSELF && rg_limits_low(limits));
    return is_limited || end->verdict == RG_WORKER_NO_ROOM ? RG_LACKING : RG_CRASH;
}

void rg_worker_tell_doing(const struct rg_doing *doing, char text[RG_WORKER_DOING])
{
    struct rg_doing seen = *doing; // the process shares it, and may have written over it
    seen.what[sizeof(seen.what) - 1] = seen.queued[sizeof(seen.queued) - 1] = 0;
    const bool is_told = *seen.queued && !strchr(seen.queued, ',') &&
                         strstr(seen.what, "running") && strstr(seen.what, seen.queued);
    snprintf(text, RG_WORKER_DOING, "%s%s%s%s", *seen.what ? " while " : "", seen.what,
             *seen.queued && !is_told ? "; not known to have ended: " : "",
             is_told ? "" : seen.queued);
}

// Writes how the process ended; `mend` gets the remedy, or "".
static void tell_line(const struct rg_worker_end *end, char *line, size_t size, const char **mend)
{
    char limits[RG_LIMITS_TEXT];
    *mend = end->verdict == RG_WORKER_NO_ROOM || ended_lacking(end)
                ? "; ask for a smaller --size, or allow more memory (ulimit -v)"
            : end->verdict == RG_WORKER_BY_ITSELF && rg_limits_low(limits) ? "; allow more"
                                                                           : "";
    if (end->verdict == RG_WORKER_HANGS)
        snprintf(line, size, "its driver did not come back within %d s", end->timeout_s);
    else if (end->verdict == RG_WORKER_HOLDS_TOO_MUCH)
        snprintf(line, size, "it took more than %lld MiB of memory and was ended",
                 (long long)(end->memory_bytes >> 20));
    else if (end->verdict == RG_WORKER_LIES)
        snprintf(line, size,
                 "it sent no message that can be taken, and was ended; a driver may have written "
                 "over it");
    else if (end->verdict == RG_WORKER_NO_ROOM)
        snprintf(line, size, "raingauge has no memory for what it replied");
    else if (ended_lacking(end))
        snprintf(line, size, "its process ended, for it had no memory for a message");
    else if (rg_limits_low(limits))
        snprintf(line, size, "its process ended %s", limits);
    else if (WIFSIGNALED(end->status))
        snprintf(line, size, "its driver crashed (%s)", strsignal(WTERMSIG(end->status)));
    else
        snprintf(line, size, "its driver ended the process with status %d",
                 WEXITSTATUS(end->status));
}

// A sanitizer's report has many lines, all of which are shown.
static void show_report(FILE *printed)
{
#ifdef __SANITIZE_ADDRESS__
    char line[512];
    rewind(printed);
    while (fgets(line, sizeof(line), printed))
        fputs(line, stderr);
#endif
    (void)printed;
}

void rg_worker_tell_end(const struct rg_worker_end *end, const char *doing, char *why, size_t size)
{
    char last[200], line[240];
    const char *mend;
    rg_program_last_line(end->printed, last, sizeof(last));
    tell_line(end, line, sizeof(line), &mend);
    snprintf(why, size, "%s%s%s%s", line, doing, last, mend);
    show_report(end->printed);
}
