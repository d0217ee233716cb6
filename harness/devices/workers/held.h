// The memory that a process holds.
#ifndef RG_HARNESS_DEVICES_WORKERS_HELD_H
#define RG_HARNESS_DEVICES_WORKERS_HELD_H

#include <stdint.h>
#include <sys/types.h>

// Bytes that are resident; 0 where the process has ended.
int64_t rg_held_bytes(pid_t process);

#endif
