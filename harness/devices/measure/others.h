// The share of this machine's processors that others take: other programs, and other machines on
// the same hardware (steal).
#ifndef RG_HARNESS_DEVICES_MEASURE_OTHERS_H
#define RG_HARNESS_DEVICES_MEASURE_OTHERS_H

#include <sys/types.h>

// A reading of times since boot, in milliseconds of all processors that this process may use.
struct rg_processors {
    int count;    // number of processors; 0: Linux does not tell
    double at_ms; // by rg_now_ms
    double idle_ms, stolen_ms;
    double own_ms;   // of this process and of `ours`
    double grain_ms; // precision of idle_ms and of stolen_ms
    // Time of the threads of `ours`: on a processor, and ready to run without one. Zeros if there
    // are none, or if Linux keeps no such statistics.
    double ran_ms, waited_ms;
};

// Shares of the processors' time, 0 to 1: at least this much, for time within the precision does
// not count. A launch of some milliseconds else lost a tenth of its time to a single tick.
struct rg_taken {
    double stolen; // by other machines
    double others; // by other programs; at most the share of their time that our threads waited: a
                   // program on a core that they leave idle disturbs nothing
};

// Reads the processors from `root`/proc/stat: "" for this machine, or a folder with a copy in
// tests. `ours`: processes whose time is our own, besides this one and its children that have
// ended.
struct rg_processors rg_processors_read(const char *root, const pid_t *ours, int our_count);
// The same for this machine.
typedef struct rg_processors rg_watch(const pid_t *ours, int our_count);
rg_watch rg_processors_now;
// The shares that others took between two readings with the same processes; zeros if unknown.
struct rg_taken rg_taken_between(const struct rg_processors *before,
                                 const struct rg_processors *after);
// Time for finding out whether the machine is busy, from RG_PROBE_S. 0: it is known to be busy, so
// that nobody looks, and no sample is taken again.
double rg_probe_ms(void);
// Watches the machine for that time, in which this process does nothing, by readings of `watch`.
// Returns the share that others take, if the machine is busy; else 0, as where nobody looks. Ends
// early on an interruption.
double rg_machine_busy(rg_watch *watch);
// The same; logs one warning if it is busy.
void rg_machine_probe(rg_watch *watch);

#endif
