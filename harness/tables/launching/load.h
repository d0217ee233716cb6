// What others took of the processors while a worker was measured.
#ifndef RG_HARNESS_TABLES_LAUNCHING_LOAD_H
#define RG_HARNESS_TABLES_LAUNCHING_LOAD_H

#include <sys/types.h>

// Times in seconds since an arbitrary start; zeros where the kernel does not report them.
struct rg_load {
    double all;         // of all processors together, idle time included
    double busy;        // of it, that all processes took
    double stolen;      // of it, that a hypervisor gave to other machines
    double own;         // of it, that this process and the worker took
    double ran, waited; // of the worker's threads: on a processor, and ready to run without one
};

// Reads it; `worker` is the worker's process, 0: this one.
struct rg_load rg_load_now(pid_t worker);
// Shares between two readings: of all processor time that other machines took; and of the worker's
// time, that it waited for a processor, as far as other processes took so much. Threads of the
// worker that wait for each other are no disturbance, and neither is a process on a core that it
// leaves idle.
void rg_load_shares(const struct rg_load *before, const struct rg_load *now, double *stolen,
                    double *others);

#endif
