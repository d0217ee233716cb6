#include "harness/console/interrupt.h"

#include <signal.h>
#include <stddef.h>

static volatile sig_atomic_t noted;

static void note(int number)
{
    noted = number;
}

void rg_interrupt_watch(void)
{
    // SA_RESTART: drivers' system calls go on. SA_RESETHAND: a second signal kills, as by default.
    struct sigaction action = {.sa_handler = note, .sa_flags = SA_RESTART | (int)SA_RESETHAND};
    sigemptyset(&action.sa_mask);
    noted = 0;
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
}

int rg_interrupt_signal(void)
{
    return noted;
}

bool rg_interrupted(void)
{
    return noted != 0;
}
