// What signals do to a process: end it, be noted, or end it after all.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <signal.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "harness/console/interrupt.h"
#include "tests/tools/expect.h"

// An alarm that never rings, or a busy machine would end processes that have a second.
static unsigned alarm_s;

unsigned alarm(unsigned seconds)
{
    const unsigned left_s = alarm_s;
    alarm_s = seconds;
    return left_s;
}

// --- processes, which exit with 0 if all is well, or are ended ---

enum { WELL = 0, WRONG = 9 };

static int ended_by_a_signal(void)
{
    rg_interrupt_heed();
    raise(SIGTERM);
    return WRONG;
}

static int ended_though_its_parent_ignored_it(void)
{
    signal(SIGINT, SIG_IGN);
    rg_interrupt_heed();
    raise(SIGINT);
    return WRONG;
}

static int ended_by_a_timer(void)
{
    rg_interrupt_watch();
    raise(SIGALRM); // which is another program's, for nothing was noted
    return WRONG;
}

static int hangs_up_as_by_nohup(void)
{
    signal(SIGHUP, SIG_IGN);
    rg_interrupt_heed();
    raise(SIGHUP);
    rg_interrupt_watch();
    raise(SIGHUP);
    return rg_interrupted() ? WRONG : WELL;
}

static int hung_up(void)
{
    rg_interrupt_heed();
    raise(SIGHUP);
    return WRONG;
}

// A watch notes the first signal, and has an alarm set for long work, which has a second.
static int notes_the_first(void)
{
    rg_interrupt_watch();
    if (rg_interrupted() || rg_interrupt_signal())
        return WRONG;
    raise(SIGTERM);
    return rg_interrupted() && rg_interrupt_signal() == SIGTERM && alarm_s == 1 ? WELL : WRONG;
}

static int notes_a_hangup(void)
{
    rg_interrupt_watch();
    raise(SIGHUP);
    return rg_interrupt_signal() == SIGHUP ? WELL : WRONG;
}

// A worker, which its parent ends, has no alarm.
static int serves(void)
{
    rg_interrupt_serve();
    raise(SIGINT);
    return rg_interrupt_signal() == SIGINT && !alarm_s ? WELL : WRONG;
}

// A second watch forgets the signal, and the alarm with it.
static int forgets(void)
{
    rg_interrupt_watch();
    raise(SIGINT);
    rg_interrupt_watch();
    if (rg_interrupted() || alarm_s)
        return WRONG;
    raise(SIGTERM);
    return rg_interrupt_signal() == SIGTERM ? WELL : WRONG;
}

static int ended_by_the_second(void)
{
    rg_interrupt_watch();
    raise(SIGTERM);
    raise(SIGINT);
    return WRONG;
}

static int ended_by_the_alarm(void)
{
    rg_interrupt_watch();
    raise(SIGINT);
    raise(SIGALRM);
    return WRONG;
}

// Signals that were held back come once they are heeded, or watched for.
static int holds(void)
{
    rg_interrupt_hold();
    raise(SIGTERM);
    raise(SIGHUP);
    raise(SIGINT);
    rg_interrupt_heed();
    return WRONG;
}

static int holds_until_it_watches(void)
{
    rg_interrupt_hold();
    raise(SIGINT);
    if (rg_interrupted())
        return WRONG;
    rg_interrupt_watch();
    return rg_interrupt_signal() == SIGINT ? WELL : WRONG;
}

// --- how they end ---

// Runs one in a process of its own; what it writes to stderr comes back.
static int end_of(int (*act)(void), char *said, size_t size)
{
    int ends[2], status;
    assert_int_equal(pipe(ends), 0);
    const pid_t child = fork();
    if (!child) {
        dup2(ends[1], STDERR_FILENO);
        for (int number = 1; number < 16; number++)
            signal(number, SIG_DFL);
        _exit(act());
    }
    close(ends[1]);
    const ssize_t got = read(ends[0], said, size - 1);
    said[got > 0 ? got : 0] = 0;
    close(ends[0]);
    assert_int_equal(waitpid(child, &status, 0), child);
    return status;
}

static void each_ends_as_it_should(void **state)
{
    (void)state;
    static const struct {
        int (*act)(void);
        int by; // a signal; 0: it ends well
        bool speaks;
    } rows[] = {{ended_by_a_signal, SIGTERM, false},
                {ended_though_its_parent_ignored_it, SIGINT, false},
                {ended_by_a_timer, SIGALRM, false},
                {hangs_up_as_by_nohup, 0, false},
                {hung_up, SIGHUP, false},
                {notes_the_first, 0, false},
                {notes_a_hangup, 0, false},
                {serves, 0, false},
                {forgets, 0, false},
                {ended_by_the_second, SIGTERM, false},
                {ended_by_the_alarm, SIGINT, true},
                {holds_until_it_watches, 0, false}};
    static const char line[] = "raingauge: what it was at did not stop within a second, and is not "
                               "waited for\n";
    char said[256];
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        const int status = end_of(rows[i].act, said, sizeof(said));
        if (rows[i].by ? !WIFSIGNALED(status) || WTERMSIG(status) != rows[i].by : status != WELL)
            fail_msg("row %zu: status %d", i, status);
        assert_string_equal(said, rows[i].speaks ? line : "");
    }
    // Of those held back, any may be the first.
    assert_true(WIFSIGNALED(end_of(holds, said, sizeof(said))));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_ends_as_it_should),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
