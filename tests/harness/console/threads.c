#define _GNU_SOURCE // RTLD_NOLOAD
// How many threads a process has, by its variables: it sets them right and starts itself anew. This
// program does that when it is started with an argument, and prints what it then has.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <dlfcn.h>
#include <omp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "harness/console/threads.h"
#include "tests/tools/expect.h"

static const char *self;

static const char *value_of(const char *name)
{
    const char *value = getenv(name);
    return value ? value : "-";
}

static int settle(char **argv)
{
    rg_threads_settle(argv);
    printf("%s %s %s", value_of("OMP_NUM_THREADS"), value_of("GOMP_SPINCOUNT"),
           value_of("RG_STDERR"));
    fprintf(stderr, "its own\n");
    return fflush(stdout);
}

// Starts this program with these variables; what it says on stdout, or on stderr, comes back.
static const char *said_with(const char *threads, const char *spins, const char *policy, int fd)
{
    static char said[2048];
    int ends[2], status;
    size_t used = 0;
    assert_int_equal(pipe(ends), 0);
    const pid_t child = fork();
    if (!child) {
        const char *const names[] = {"OMP_NUM_THREADS", "GOMP_SPINCOUNT", "OMP_WAIT_POLICY"};
        const char *const values[] = {threads, spins, policy};
        for (int i = 0; i < 3; i++)
            values[i] ? setenv(names[i], values[i], 1) : unsetenv(names[i]);
        if (!freopen("/dev/null", "w", fd == STDOUT_FILENO ? stderr : stdout))
            _exit(9);
        dup2(ends[1], fd);
        close(ends[0]);
        close(ends[1]);
        execl(self, self, "settle", NULL);
        _exit(9);
    }
    close(ends[1]);
    for (ssize_t got; (got = read(ends[0], said + used, sizeof(said) - 1 - used)) > 0;)
        used += (size_t)got;
    said[used] = 0;
    close(ends[0]);
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_int_equal(status, 0);
    return said;
}

// A number that libgomp takes stays, up to four threads a processor; spinning is short unless the
// user has chosen. No other process learns where the real stderr was.
static void variables_are_set_right(void **state)
{
    (void)state;
    char most[32], more[32], many[64];
    snprintf(most, sizeof(most), "%ld", rg_threads_most());
    snprintf(more, sizeof(more), "%ld", rg_threads_most() + 1);
    snprintf(many, sizeof(many), "%s 8000 -", most);
    const struct {
        const char *threads, *spins, *policy, *found;
    } rows[] = {{NULL, NULL, NULL, "- 8000 -"}, {"1", NULL, NULL, "1 8000 -"},
                {"1", "5", NULL, "1 5 -"},      {"1", NULL, "active", "1 - -"},
                {"abc", "5", NULL, "- 5 -"},    {"0", NULL, NULL, "- 8000 -"},
                {"-3", NULL, NULL, "- 8000 -"}, {"1,1", "5", NULL, "1,1 5 -"},
                {most, NULL, NULL, many},       {more, NULL, NULL, many},
                {"100000", NULL, NULL, many}};
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++)
        assert_string_equal(
            said_with(rows[i].threads, rows[i].spins, rows[i].policy, STDOUT_FILENO),
            rows[i].found);
}

static int count_in(const char *text, const char *part)
{
    int count = 0;
    for (const char *at = text; (at = strstr(at, part)); at++)
        count++;
    return count;
}

// Each complaint comes once, and what the started program says comes after it.
static void complaints_come_once(void **state)
{
    (void)state;
    char more[32], due[256];
    const long processors = sysconf(_SC_NPROCESSORS_ONLN);
    assert_int_equal(rg_threads_most(), 4 * processors);
    snprintf(more, sizeof(more), "%ld", rg_threads_most() + 1);
    snprintf(due, sizeof(due),
             "raingauge: warning: OMP_NUM_THREADS=%s: more than 4 threads on each of %ld "
             "processors; %ld are used\nits own\n",
             more, processors, rg_threads_most());
    assert_string_equal(said_with(more, NULL, NULL, STDERR_FILENO), due);
    assert_string_equal(said_with("1", NULL, NULL, STDERR_FILENO), "its own\n");
}

// libgomp complains of a value when it is loaded; others wait until threads are asked for.
static void libgomp_s_complaint_comes_once(void **state)
{
    (void)state;
    void *library = dlopen("libgomp.so.1", RTLD_LAZY | RTLD_NOLOAD);
    if (!library)
        skip();
    const char *wrong = said_with("abc", NULL, NULL, STDERR_FILENO);
    dlclose(library);
    assert_int_equal(count_in(wrong, "Invalid value for environment variable"), 1);
    assert_int_equal(count_in(wrong, "its own\n"), 1);
    assert_int_equal(count_in(wrong, "raingauge: "), 0);
}

// In a child that may have so many threads and wants four: how many it then has, and what it says.
// Its user has no other process, so that the limit counts the child's threads alone.
static int threads_of(int most, char *said, size_t size)
{
    enum { NOBODY_ELSE = 1845321 };
    int ends[2], status;
    assert_int_equal(pipe(ends), 0);
    const pid_t child = fork();
    if (!child) {
        const struct rlimit limit = {(rlim_t)most, (rlim_t)most};
        dup2(ends[1], STDERR_FILENO);
        if (setrlimit(RLIMIT_NPROC, &limit) || setuid(NOBODY_ELSE))
            _exit(99);
        omp_set_num_threads(4);
        rg_threads_fit();
        _exit(omp_get_max_threads());
    }
    close(ends[1]);
    const ssize_t got = read(ends[0], said, size - 1);
    said[got > 0 ? got : 0] = 0;
    close(ends[0]);
    assert_int_equal(waitpid(child, &status, 0), child);
    return WEXITSTATUS(status);
}

static void no_more_threads_than_there_can_be(void **state)
{
    (void)state;
    char said[512];
    if (getuid() != 0)
        skip(); // limits of other users are root's to set
    assert_int_equal(threads_of(4, said, sizeof(said)), 4);
    assert_string_equal(said, "");
    assert_int_equal(threads_of(3, said, sizeof(said)), 3);
    assert_string_equal(said,
                        "raingauge: warning: 3 of 4 threads can be started: Resource temporarily "
                        "unavailable; allow more processes or memory (ulimit -u, -v), or set "
                        "OMP_NUM_THREADS\n");
}

int main(int argc, char **argv)
{
    if (argc > 1 && !strcmp(argv[1], "settle"))
        return settle(argv);
    self = argv[0];
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(variables_are_set_right),
        cmocka_unit_test(complaints_come_once),
        cmocka_unit_test(libgomp_s_complaint_comes_once),
        cmocka_unit_test(no_more_threads_than_there_can_be),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
