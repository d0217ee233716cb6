// Programs of our own that parse foreign bytes in a process of their own, so that a library that
// crashes, loops or is taken over harms nobody: run_caged.c starts one, shut.c is its side.
//
// The program has no environment, and these descriptors: 0 to 2 are /dev/null, RG_CAGE_REPLY takes
// the reply (memory that both share), RG_CAGE_FILE is the file, if one was given.
#ifndef RG_CORE_BASE_CAGE_CAGE_H
#define RG_CORE_BASE_CAGE_CAGE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { RG_CAGE_REPLY = 3, RG_CAGE_ALIVE, RG_CAGE_FILE };

// --- from outside ---

// What came of it. `reply` is -1 or a descriptor to close.
struct rg_caged {
    int reply, status;
    bool ended; // by itself: false when it had to be killed
};

// The path of such a program, beside the running one, installed, or in the build. False where it is
// not there; `path` is then the folder that was looked in.
bool rg_caged_find(const char *program, char *path, size_t size);

// Runs args[0] for up to `timeout_s`. `file` is the descriptor that it reads, -1: none; it stays
// the caller's. 0 or the errno; `caged` is set either way.
int rg_caged_run(const char *const args[], int file, int timeout_s, struct rg_caged *caged);

// Whether it ended well. `why` is else a sentence that blames `library`.
bool rg_caged_is_sound(const struct rg_caged *caged, const char *library, char *why, size_t size);

// --- from inside ---

// 0: not limited.
struct rg_cage_limits {
    int64_t cpu_s, memory_bytes, reply_bytes;
};

// Bounds what the process may take from now on, and ends it with its parent. Sanitizers' shadows
// take terabytes of addresses and time, so that memory has no bound there and time a wider one.
void rg_cage_limit(const struct rg_cage_limits *limits);

// From now on the process can reserve memory, read and write the descriptors that it has, and end:
// it opens nothing, starts nothing, and gains no privilege. False where the system refuses.
bool rg_cage_shut(void);

#endif
