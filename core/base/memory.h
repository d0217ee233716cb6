// How much memory may be taken: what large things ask before they take it.
//
// Devices that run on the CPU count their buffers and images here, as long as they live, and what
// processes have taken that work for this one is counted with it. What is taken on the host and is
// gone soon asks without being counted.
#ifndef RG_CORE_BASE_MEMORY_H
#define RG_CORE_BASE_MEMORY_H

#include <stdbool.h>
#include <stdint.h>

enum { RG_MEMORY_TEXT = 24 };

// Bytes that this machine can give without swapping (MemAvailable), or that the control groups
// around the process still allow, where that is less: their limit less what is held in them, but
// for files that the kernel drops first. 0: unknown.
int64_t rg_memory_available(void);
// The same of Linux' files below `root`.
int64_t rg_memory_available_under(const char *root);

// Allows so many bytes, where that is above 0, also to the processes that are started from here on,
// by the environment variable RG_MEMORY_BYTES. Until then it is what is available, less a tenth.
void rg_memory_allow(int64_t bytes);

// What a process may take in all that works for this one and has taken `theirs` of what is counted
// here, in bytes: that and what is left, where the user has chosen how much there is; 0 where it is
// to find out by itself.
int64_t rg_memory_grant(int64_t theirs);

// Bytes that may be taken in all: by the user's choice, or of what was free at first.
int64_t rg_memory_limit(void);
// Bytes that may still be taken: 0 or more.
int64_t rg_memory_left(void);
// Whether so many may be taken at once. Cheap for less than a MiB.
bool rg_memory_allows(int64_t bytes);
// The same of a piece that the host takes for a while: below 64 MiB nobody asks.
bool rg_memory_allows_piece(int64_t bytes);
// Takes them, or false: then nothing is taken. What was taken is given back with rg_memory_give.
bool rg_memory_take(int64_t bytes);
void rg_memory_give(int64_t bytes);
// Counts what another process took, below 0 what it gave back: nobody is asked.
void rg_memory_count(int64_t bytes);
// What is counted, in bytes.
int64_t rg_memory_taken(void);

// "5.2 GiB", "37 MiB", "64 KiB"
const char *rg_memory_text(int64_t bytes, char text[RG_MEMORY_TEXT]);

// Logs "BEGIN needs 5.2 GiB, and 3.1 GiB are free; --memory allows more, MEND needs less", or how
// much is left of what the user allows, and returns false.
bool rg_memory_refuse(const char *begin, int64_t bytes, const char *mend);

#endif
