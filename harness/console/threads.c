#include "harness/console/threads.h"

#include <errno.h>
#include <fcntl.h>
#include <omp.h>
#include <pthread.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/base/log.h"
#include "core/base/program.h"

enum { THREADS_A_PROCESSOR = 4 };

long rg_threads_most(void)
{
    const long processors = sysconf(_SC_NPROCESSORS_ONLN);
    return THREADS_A_PROCESSOR * (processors < 1 ? 1 : processors);
}

static const char count_name[] = "OMP_NUM_THREADS", stderr_name[] = "RG_STDERR";

// libgomp's threads spin for tens of milliseconds before they sleep. On a busy machine this blocks
// the thread that they wait for, and frames can take ten times as long. Sets a millisecond, unless
// the user has chosen. True if something changed.
static bool spin_briefly(void)
{
    return !getenv("GOMP_SPINCOUNT") && !getenv("OMP_WAIT_POLICY") &&
           !setenv("GOMP_SPINCOUNT", "8000", 0);
}

// Removes a thread count that libgomp rejects, so that no other process of raingauge has it
// complain again; lists are left to libgomp. Reduces a count that is too large, because each thread
// needs a stack and frames could take a hundred times as long. True if something changed.
static bool limit_threads(void)
{
    const char *given = getenv(count_name);
    char *end, most[24];
    const long threads = given ? strtol(given, &end, 10) : 1;
    if (given && (end == given || threads < 1))
        return !unsetenv(count_name);
    if (threads <= rg_threads_most())
        return false;
    rg_warning("%s=%.40s: more than %d threads on each of %ld processors; %ld are used", count_name,
               given, THREADS_A_PROCESSOR, rg_threads_most() / THREADS_A_PROCESSOR,
               rg_threads_most());
    snprintf(most, sizeof(most), "%ld", rg_threads_most());
    return !setenv(count_name, most, 1);
}

// libgomp complained when this process was loaded; the reloaded one would repeat it, so its stderr
// is silenced. A variable tells that process which descriptor is the real stderr.
static void silence_stderr(void)
{
    char number[16];
    const int saved = dup(STDERR_FILENO), nothing = open("/dev/null", O_WRONLY | O_CLOEXEC);
    snprintf(number, sizeof(number), "%d", saved);
    if (saved >= 0 && nothing >= 0 && !setenv(stderr_name, number, 1))
        dup2(nothing, STDERR_FILENO);
    if (nothing >= 0)
        close(nothing);
}

static void restore_stderr(void)
{
    const char *number = getenv(stderr_name);
    const int saved = number ? atoi(number) : -1;
    if (saved > STDERR_FILENO && dup2(saved, STDERR_FILENO) >= 0)
        close(saved);
    unsetenv(stderr_name);
}

void rg_threads_settle(char **argv)
{
    restore_stderr();
    const bool spins = spin_briefly();
    if (!limit_threads() && !spins)
        return;
    silence_stderr();
    execv(rg_program_self(), argv);
    restore_stderr();
    if (spins)
        unsetenv("GOMP_SPINCOUNT"); // the passport must not claim a value that libgomp never read
}

// --- as many as can be started ---

static void *wait_at(void *gate)
{
    pthread_mutex_lock(gate);
    pthread_mutex_unlock(gate);
    return NULL;
}

void rg_threads_fit(void)
{
    pthread_mutex_t gate = PTHREAD_MUTEX_INITIALIZER;
    const int wanted = omp_get_max_threads() - 1;
    pthread_t *threads = calloc((size_t)wanted + 1, sizeof(*threads));
    int made = 0, error = 0;
    if (!threads)
        return;                // it is not known that there are fewer
    pthread_mutex_lock(&gate); // so that all are there at once
    while (!error && made < wanted &&
           !(error = pthread_create(&threads[made], NULL, wait_at, &gate)))
        made++;
    pthread_mutex_unlock(&gate);
    for (int i = 0; i < made; i++)
        pthread_join(threads[i], NULL);
    free(threads);
    if (!error)
        return;
    rg_warning("%d of %d threads can be started: %s; allow more processes or memory (ulimit -u, "
               "-v), or set %s",
               made + 1, wanted + 1, strerror(error), count_name);
    omp_set_num_threads(made + 1);
}
