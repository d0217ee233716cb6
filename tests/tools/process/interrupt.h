// A signal to this process without its alarm, which would end a test that a busy machine delays for
// a second.
#ifndef RG_TESTS_TOOLS_PROCESS_INTERRUPT_H
#define RG_TESTS_TOOLS_PROCESS_INTERRUPT_H

#include <signal.h>
#include <unistd.h>

static inline void interrupt_by(int number)
{
    raise(number);
    alarm(0);
}

#endif
