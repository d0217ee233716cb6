// The threads of OpenMP, as the environment sets them before raingauge is loaded.
#ifndef RG_HARNESS_CONSOLE_THREADS_H
#define RG_HARNESS_CONSOLE_THREADS_H

// As many as raingauge lets be asked for: four a processor.
long rg_threads_most(void);

// Makes the variables that libgomp reads sound, and starts raingauge again with them where one has
// changed, for libgomp reads them once, when it is loaded. Threads are at most four a processor,
// with one warning where more are asked for. What libgomp complains of it says once.
void rg_threads_settle(char **argv);

// Has OpenMP take as many threads as can be started, with one warning where that are fewer than it
// would: libgomp ends a process that cannot start one.
void rg_threads_fit(void);

#endif
