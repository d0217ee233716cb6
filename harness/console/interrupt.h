// Ending when asked to, by SIGINT (Ctrl-C), SIGTERM or SIGHUP (the terminal is gone).
//
// A signal ends the program at once, with the programs that it has started (core/base/program.h).
// Long work watches for signals instead, so that it can keep what it has: it looks here between its
// pieces. What has not ended a second after the first signal, or at a second one, ends at once. So
// the first process of a container, for which the kernel ends nothing, ends as any other.
#ifndef RG_HARNESS_CONSOLE_INTERRUPT_H
#define RG_HARNESS_CONSOLE_INTERRUPT_H

#include <stdbool.h>

// Signals wait until rg_interrupt_heed, also in a program that this one becomes by exec.
void rg_interrupt_hold(void);
// From now on signals end the program, whoever started it and let it ignore or block them. SIGHUP
// alone stays ignored where it is, as by nohup.
void rg_interrupt_heed(void);

// From now on the first signal is noted. Forgets one that came before.
void rg_interrupt_watch(void);
// The same for a process that whoever asks it ends: it has no patience of its own.
void rg_interrupt_serve(void);
// The signal that came, 0: none.
int rg_interrupt_signal(void);
bool rg_interrupted(void);

#endif
