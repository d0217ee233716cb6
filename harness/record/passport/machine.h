// The machine as Linux describes it: what decides how fast and how exactly software devices run.
#ifndef RG_HARNESS_RECORD_PASSPORT_MACHINE_H
#define RG_HARNESS_RECORD_PASSPORT_MACHINE_H

#include <stdint.h>

struct rg_machine {
    char cpu[128];          // "Intel(R) Xeon(R) Processor @ 2.10GHz"; "" when unknown
    char features[256];     // instruction sets that change code or results, by Linux' names
    int cores_online;       // of the machine; 0: unknown
    int cores_allowed;      // that this process may run on; 0: unknown
    char cores_list[128];   // the same as Linux prints it, "0-3,6"
    double quota_cpus;      // CPU time a second that the cgroup grants; 0: no limit
    char kernel[160];       // "Linux 6.1.0-18-amd64 x86_64"
    char distribution[128]; // "Debian GNU/Linux 12 (bookworm)"
    // What Linux lets its clocks do, "performance, at most 3.6 GHz, boost on"; "": it does not
    // tell. Never what they are doing now.
    char clocks[96];
    int64_t memory_bytes; // 0: unknown
    int gpu_nodes;        // render nodes and NVIDIA devices that a driver could open
};

// Reads the machine from the files under `root`: "" for this one, a folder with a copy for tests.
// What cannot be read is left 0 or "".
void rg_machine_read(struct rg_machine *machine, const char *root);

// How many numbers a Linux list such as "0-3,6" names; 0 for what is none.
int rg_cpu_list_count(const char *list);

#endif
