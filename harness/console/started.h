// When the system started this process, before loading it.
#ifndef RG_HARNESS_CONSOLE_STARTED_H
#define RG_HARNESS_CONSOLE_STARTED_H

// By rg_now_ms, to 10 ms; the current time if the system does not tell.
double rg_started_ms(void);

#endif
