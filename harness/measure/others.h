// What others take of this machine's processors: other programs, and other machines on the same
// hardware (steal).
#ifndef RG_HARNESS_MEASURE_OTHERS_H
#define RG_HARNESS_MEASURE_OTHERS_H

#include <sys/types.h>

// A reading of times since boot, in milliseconds of all processors that this process may use.
struct rg_processors {
    int count;    // of processors; 0: Linux does not tell
    double at_ms; // by rg_now_ms
    double idle_ms, stolen_ms;
    double own_ms;   // of this process and those that are ours
    double grain_ms; // to which idle_ms is known
    // Of the threads of those that are ours: on a processor, and ready to run without one. Zeros if
    // there are none, or Linux keeps no such statistics.
    double ran_ms, waited_ms;
};

// Shares of the processors' time, 0 to 1.
struct rg_taken {
    double stolen; // by other machines
    double others; // by other programs, at least: what the grain leaves open is not counted. Less
                   // if ours waited less: a program on a core that they leave idle disturbs nothing
};

// Reads the processors from `root`/proc/stat: "" for this machine, or a folder with a copy in
// tests. `ours`: processes whose time is our own, beside this one and its children that have ended.
struct rg_processors rg_processors_read(const char *root, const pid_t *ours, int our_count);
// The same of this machine.
typedef struct rg_processors rg_watch(const pid_t *ours, int our_count);
rg_watch rg_processors_now;
// What others took between two readings with the same processes; zeros if that is not known.
struct rg_taken rg_taken_between(const struct rg_processors *before,
                                 const struct rg_processors *after);
// For how long to look whether the machine is busy, from RG_PROBE_S. 0: it is known to be, so that
// nobody looks, and no sample is taken again.
double rg_probe_ms(void);
// Looks for that time, in which this process does nothing, whether the machine is busy,
// by readings of `watch`, and logs one warning if it is. Ends early on an interruption.
void rg_machine_probe(rg_watch *watch);

#endif
