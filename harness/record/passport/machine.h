// The machine as described by Linux: everything that decides how fast and how exactly software
// devices run.
#ifndef RG_HARNESS_RECORD_PASSPORT_MACHINE_H
#define RG_HARNESS_RECORD_PASSPORT_MACHINE_H

#include <stdint.h>

struct rg_machine {
    char cpu[128];          // "" when unknown: "Intel(R) Xeon(R) Processor @ 2.10GHz"
    char features[256];     // instruction sets that affect code or results, by Linux's names
    int cores_online;       // of the machine; 0: unknown
    int cores_allowed;      // that this process may run on; 0: unknown
    char cores_list[128];   // the same in Linux's notation, "0-3,6"
    double quota_cpus;      // CPU time a second granted by the cgroup; 0: unlimited
    char kernel[160];       // "Linux 6.1.0-18-amd64 x86_64"
    char distribution[128]; // "Debian GNU/Linux 12 (bookworm)"
    // How Linux may set the clocks, "performance, at most 3.6 GHz, boost on"; "": unknown. Never
    // their current rates.
    char clocks[96];
    int64_t memory_bytes; // 0: unknown
    int gpu_nodes;        // render nodes and NVIDIA devices that drivers could open
};

// Reads the machine from the files under `root`: "" for this one, or a folder with a copy in tests.
// Unreadable values stay 0 or "".
void rg_machine_read(struct rg_machine *machine, const char *root);

// The number of CPUs in a Linux list such as "0-3,6"; 0 if it is malformed.
int rg_cpu_list_count(const char *list);

#endif
