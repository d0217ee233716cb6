// The memory that may be taken; callers ask here before they take large pieces.
//
// Devices that run on the CPU count their buffers and images here as long as these live; what
// worker processes have taken is added. Short-lived memory of the host is checked but not counted.
#ifndef RG_CORE_BASE_MEMORY_H
#define RG_CORE_BASE_MEMORY_H

#include <stdbool.h>
#include <stdint.h>

enum { RG_MEMORY_TEXT = 24 };

// Bytes that this machine can give without swapping (MemAvailable), or that the control groups
// around the process still allow, whichever is less. A group allows its limit less its use, where
// files that the kernel can drop do not count as use. 0: unknown.
int64_t rg_memory_available(void);
// The same, reading Linux's files below `root`.
int64_t rg_memory_available_under(const char *root);

// Sets the limit, if `bytes` is above 0, also for processes started from here on (environment
// variable RG_MEMORY_BYTES). The default limit is what is available, less a tenth.
void rg_memory_allow(int64_t bytes);

// The limit in bytes to hand to a worker process that has taken `theirs` of the bytes counted here:
// `theirs` plus what is left. 0 where the user chose no limit: the worker then finds its own.
int64_t rg_memory_grant(int64_t theirs);

// The limit in bytes: the user's choice, or what was free at first.
int64_t rg_memory_limit(void);
// Bytes that may still be taken: 0 or more.
int64_t rg_memory_left(void);
// Whether this many bytes may be taken at once. Cheap for less than a MiB.
bool rg_memory_allows(int64_t bytes);
// The same for a short-lived piece of the host's memory: below 64 MiB it is always allowed.
bool rg_memory_allows_piece(int64_t bytes);
// Counts this many bytes as taken; false, and nothing counted, if they exceed what is left.
// rg_memory_give returns them.
bool rg_memory_take(int64_t bytes);
void rg_memory_give(int64_t bytes);
// Counts what another process took, negative for what it gave back, without a check.
void rg_memory_count(int64_t bytes);
// The bytes counted as taken.
int64_t rg_memory_taken(void);

// "5.2 GiB", "37 MiB", "64 KiB"
const char *rg_memory_text(int64_t bytes, char text[RG_MEMORY_TEXT]);

// Logs "BEGIN needs 5.2 GiB, and 3.1 GiB are free; --memory allows more, MEND needs less", or names
// what the user's limit leaves, and returns false.
bool rg_memory_refuse(const char *begin, int64_t bytes, const char *mend);

#endif
