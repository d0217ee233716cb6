// The memory of a process.
#ifndef RG_HARNESS_DEVICES_WORKERS_HELD_H
#define RG_HARNESS_DEVICES_WORKERS_HELD_H

#include <stdint.h>
#include <sys/types.h>

// Resident bytes; 0 if the process has ended.
int64_t rg_held_bytes(pid_t process);

#endif
