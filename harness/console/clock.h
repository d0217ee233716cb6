// The clock that raingauge goes by: wall time that only goes forward.
#ifndef RG_HARNESS_CONSOLE_CLOCK_H
#define RG_HARNESS_CONSOLE_CLOCK_H

// Milliseconds from an arbitrary start.
double rg_now_ms(void);

#endif
