// A started program gets what it is given, and nothing else of this process.
#define _GNU_SOURCE // memfd_create
#include <errno.h>
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>

#include "core/base/program.h"
#include "tests/tools/expect.h"

// A file in memory that holds a text, read from its start.
static int file_of(const char *text)
{
    const int fd = memfd_create("text", 0); // no FD_CLOEXEC, so an exec would leave it open
    assert_at_least(fd, 0);
    assert_int_equal(pwrite(fd, text, strlen(text), 0), (ssize_t)strlen(text));
    return fd;
}

// Runs a program with these descriptors, expects status 0, and returns what it printed to the file
// at 1.
static const char *run(const char *const args[], const int fds[], int fd_count)
{
    static char text[512];
    pid_t child;
    int status;
    assert_int_equal(rg_program_start(args, fds, fd_count, &child), 0);
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_int_equal(status, 0);
    const ssize_t length = pread(fds[1], text, sizeof(text) - 1, 0);
    assert_at_least(length, 0);
    text[length] = 0;
    close(fds[1]);
    return text;
}

// Runs a line of the shell, and gives it a file for its output alone.
static const char *run_line(const char *line)
{
    return run((const char *const[]){"sh", "-c", line, NULL}, (const int[]){-1, file_of(""), -1},
               3);
}

static void descriptors_are_those_that_were_given(void **state)
{
    (void)state;
    const int gaps[] = {file_of(""), file_of("")}, a = file_of("first"), b = file_of("second");
    int fds[8] = {-1, file_of(""), -1, -1, -1, -1, -1, -1};
    assert_above(gaps[0], 2);
    assert_above(gaps[1], gaps[0]);
    assert_above(a, gaps[1]);
    assert_above(b, a);
    assert_below(b, 8);
    fds[a] = b, fds[b] = a; // each gets the number of the other
    close(gaps[0]);         // the copies of these two must not take these numbers
    close(gaps[1]);
    char line[128];
    snprintf(line, sizeof(line), "cat; echo noise >&2; cat <&%d; cat <&%d", a, b);
    assert_string_equal(run((const char *const[]){"sh", "-c", line, NULL}, fds, b + 1),
                        "secondfirst");
    close(a);
    close(b);
}

static void it_gets_no_other_descriptor(void **state)
{
    (void)state;
    const int others[] = {file_of("other"), file_of("other")};
    char line[128];
    snprintf(line, sizeof(line),
             "for n in 0 1 2 %d %d; do test -e /proc/$$/fd/$n && echo $n; done; :", others[0],
             others[1]);
    assert_string_equal(run_line(line), "0\n1\n2\n");
    close(others[0]);
    close(others[1]);
}

static void no_signal_is_ignored_or_blocked(void **state)
{
    (void)state;
    sigset_t blocked;
    sigemptyset(&blocked);
    sigaddset(&blocked, SIGTERM);
    sigprocmask(SIG_BLOCK, &blocked, NULL);
    signal(SIGXFSZ, SIG_IGN);
    unsigned long long ignored, held;
    // Not through the shell, which unblocks signals.
    const char *const args[] = {"sed", "-n", "s/^Sig\\(Blk\\|Ign\\)://p", "/proc/self/status",
                                NULL};
    const char *text = run(args, (const int[]){-1, file_of(""), -1}, 3);
    assert_int_equal(sscanf(text, "%llx %llx", &held, &ignored), 2);
    assert_int_equal(held, 0);
    assert_int_equal(ignored & 0x7fffffff, 0); // the C library keeps 32 and 33 to itself
    signal(SIGXFSZ, SIG_DFL);
    sigprocmask(SIG_UNBLOCK, &blocked, NULL);
}

static void it_has_a_process_group_of_its_own(void **state)
{
    (void)state;
    assert_string_equal(
        run_line("read -r line < /proc/$$/stat; set -- $line; test $5 = $$ && echo own"), "own\n");
}

static void what_is_missing_is_not_started(void **state)
{
    (void)state;
    pid_t child;
    const int next = dup(0);
    close(next);
    assert_int_equal(rg_program_start((const char *const[]){"raingauge-nonsense", NULL},
                                      (const int[]){-1, 1, 2}, 3, &child),
                     ENOENT);
    assert_int_equal(waitpid(-1, NULL, 0), -1);
    const int after = dup(0);
    assert_int_equal(after, next); // no descriptor is left open
    close(after);
}

static void its_last_words_are_kept(void **state)
{
    (void)state;
    char last[200];
    FILE *printed = tmpfile();
    assert_non_null(printed);
    rg_program_last_line(printed, last, sizeof(last));
    assert_string_equal(last, "");
    fputs("first\nno room\r\n---\n\n", printed);
    rg_program_last_line(printed, last, sizeof(last));
    assert_string_equal(last, ": no room");
    fclose(printed);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(descriptors_are_those_that_were_given),
        cmocka_unit_test(it_gets_no_other_descriptor),
        cmocka_unit_test(no_signal_is_ignored_or_blocked),
        cmocka_unit_test(it_has_a_process_group_of_its_own),
        cmocka_unit_test(what_is_missing_is_not_started),
        cmocka_unit_test(its_last_words_are_kept),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
