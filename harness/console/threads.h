// OpenMP's threads, whose variables must be set before raingauge is loaded.
#ifndef RG_HARNESS_CONSOLE_THREADS_H
#define RG_HARNESS_CONSOLE_THREADS_H

// The largest thread count that raingauge allows: four a processor.
long rg_threads_most(void);

// Corrects the variables that libgomp reads, and restarts raingauge if one has changed, because
// libgomp reads them once, when it is loaded. Threads are limited to four a processor, with one
// warning if more are asked for. libgomp's complaints appear once.
void rg_threads_settle(char **argv);

// Limits OpenMP to as many threads as can be started, because libgomp ends a process that cannot
// start one. Warns once if that is fewer than it would use.
void rg_threads_fit(void);

#endif
