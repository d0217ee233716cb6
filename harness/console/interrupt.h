// Ending cleanly when asked to: the first SIGINT (Ctrl-C) or SIGTERM is only noted, and long work
// looks here between its pieces. A second one kills.
#ifndef RG_HARNESS_CONSOLE_INTERRUPT_H
#define RG_HARNESS_CONSOLE_INTERRUPT_H

#include <stdbool.h>

// From now on signals are noted. Forgets one that came before.
void rg_interrupt_watch(void);
// The signal that came, 0: none.
int rg_interrupt_signal(void);
bool rg_interrupted(void);

#endif
