// The clock of all measurements: monotonic wall time.
#ifndef RG_HARNESS_CONSOLE_CLOCK_H
#define RG_HARNESS_CONSOLE_CLOCK_H

// Milliseconds from an arbitrary start.
double rg_now_ms(void);

#endif
