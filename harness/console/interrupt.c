#include "harness/console/interrupt.h"

#include <signal.h>
#include <stddef.h>
#include <string.h>
#include <unistd.h>

#include "core/base/program.h"

// Long work has this long to end. With the clean-up after that, it is below 2 s.
enum { PATIENCE_S = 1 };

static const int numbers[] = {SIGINT, SIGTERM, SIGHUP, SIGALRM};
enum { NUMBERS = sizeof(numbers) / sizeof(numbers[0]) };

static volatile sig_atomic_t noted, is_watched, patience_s;

// SIGALRM is the end of the patience, or another program's timer for this one.
static void on_signal(int number)
{
    static const char line[] = "raingauge: what it was at did not stop within a second, and is not "
                               "waited for\n";
    if (is_watched && !noted && number != SIGALRM) {
        noted = number;
        alarm((unsigned)patience_s);
        return;
    }
    if (noted && number == SIGALRM && write(STDERR_FILENO, line, strlen(line)) < 0)
        number = noted; // a failed write changes nothing
    rg_program_end_by(noted ? noted : number);
}

// Blocks or unblocks the handled signals.
static void mask(int how)
{
    sigset_t set;
    sigemptyset(&set);
    for (int i = 0; i < NUMBERS; i++)
        sigaddset(&set, numbers[i]);
    sigprocmask(how, &set, NULL);
}

void rg_interrupt_hold(void)
{
    mask(SIG_BLOCK);
}

void rg_interrupt_heed(void)
{
    // SA_RESTART, so that drivers' system calls continue.
    struct sigaction action = {.sa_handler = on_signal, .sa_flags = SA_RESTART}, before;
    sigemptyset(&action.sa_mask);
    for (int i = 0; i < NUMBERS; i++) {
        const bool is_nohup = numbers[i] == SIGHUP && !sigaction(SIGHUP, NULL, &before) &&
                              before.sa_handler == SIG_IGN;
        if (!is_nohup)
            sigaction(numbers[i], &action, NULL);
    }
    mask(SIG_UNBLOCK);
}

static void watch_for(int seconds)
{
    alarm(0);
    patience_s = seconds;
    noted = 0;
    is_watched = 1;
    rg_interrupt_heed();
}

void rg_interrupt_watch(void)
{
    watch_for(PATIENCE_S);
}

void rg_interrupt_serve(void)
{
    watch_for(0);
}

int rg_interrupt_signal(void)
{
    return noted;
}

bool rg_interrupted(void)
{
    return noted != 0;
}
