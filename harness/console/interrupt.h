// Ending on request: SIGINT (Ctrl-C), SIGTERM or SIGHUP (the terminal is gone).
//
// A signal ends the program at once, with the programs that it has started (core/base/program.h).
// Long work watches for signals instead, and checks between its pieces, so that it can keep its
// results. If it has not ended a second after the first signal, or at a second signal, it is ended
// at once. So a container's first process, for which the kernel ignores default actions, ends like
// any other.
#ifndef RG_HARNESS_CONSOLE_INTERRUPT_H
#define RG_HARNESS_CONSOLE_INTERRUPT_H

#include <stdbool.h>

// Holds signals back until rg_interrupt_heed, also in a program that replaces this one by exec.
void rg_interrupt_hold(void);
// From now on signals end the program, even if its parent had them ignored or blocked. Only an
// ignored SIGHUP stays ignored, as by nohup.
void rg_interrupt_heed(void);

// From now on the first signal is noted instead. Clears an earlier one.
void rg_interrupt_watch(void);
// The same for a process whose parent ends it, which has no patience limit of its own.
void rg_interrupt_serve(void);
// The signal noted, 0: none; and whether there is one.
int rg_interrupt_signal(void);
bool rg_interrupted(void);

#endif
