// When this process was started, before it was loaded.
#ifndef RG_HARNESS_CONSOLE_STARTED_H
#define RG_HARNESS_CONSOLE_STARTED_H

// By rg_now_ms, to 10 ms; now, where the system does not tell.
double rg_started_ms(void);

#endif
