// Programs of our own that parse foreign bytes in a process of their own, so that a library that
// crashes, loops or is taken over harms nobody: run_caged.c starts one, shut.c is its side.
//
// The program has no environment but RG_CAGE_VARIABLE, and these descriptors: 0 to 2 are /dev/null,
// RG_CAGE_REPLY is a pipe that takes the reply, RG_CAGE_FILE is the file, if one was given.
#ifndef RG_CORE_BASE_CAGE_CAGE_H
#define RG_CORE_BASE_CAGE_CAGE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { RG_CAGE_REPLY = 3, RG_CAGE_FILE };

// The exit statuses of a program that does not read because the system gives it no cage, or too
// little memory.
enum { RG_CAGE_REFUSED = 77, RG_CAGE_NO_MEMORY };

// Set to "off", programs read without a cage where the system refuses one (seccomp).
#define RG_CAGE_VARIABLE "RG_CAGE"

// --- from outside ---

// What came of it.
struct rg_caged {
    char *reply; // what it handed back, which the caller frees; NULL: nothing
    size_t bytes;
    int status;
    bool ended;    // by itself: false when it had to be killed
    bool is_cut;   // it was killed because it handed back more than it may
    bool has_room; // for the reply in our memory: false when it was killed for that
};

// Why nothing came of it: the file is at fault, the machine gives its reader no cage, or raingauge
// lacks memory or a process for it.
enum rg_caged_end { RG_CAGED_SOUND, RG_CAGED_FILE, RG_CAGED_MACHINE, RG_CAGED_LACKING };

// The path of such a program, beside the running one, installed, or in the build. False where it is
// not there; `path` is then the folder that was looked in.
bool rg_caged_find(const char *program, char *path, size_t size);

// Runs args[0] for up to `timeout_s`, and takes at most `most_bytes` of a reply. `file` is the
// descriptor that it reads, -1: none; it stays the caller's. 0 or the errno of what the machine
// refused; `caged` is set either way.
int rg_caged_run(const char *const args[], int file, int timeout_s, int64_t most_bytes,
                 struct rg_caged *caged);

// How it ended. `why` is, unless it is sound, a sentence that blames `library`, or the machine.
enum rg_caged_end rg_caged_end(const struct rg_caged *caged, const char *library, char *why,
                               size_t size);

// --- from inside ---

// 0: not limited.
struct rg_cage_limits {
    int64_t cpu_s, memory_bytes;
};

// Bounds what the process may take from now on, and ends it with its parent. It writes no files.
// Sanitizers' shadows take terabytes of addresses and time, so that memory has no bound there and
// time a wider one.
void rg_cage_limit(const struct rg_cage_limits *limits);

// From now on the process can reserve memory, read and write the descriptors that it has, and end:
// it opens nothing, starts nothing, and gains no privilege. False where the system refuses that and
// the user has not said that it may read all the same: it ends with RG_CAGE_REFUSED.
bool rg_cage_shut(void);

// Hands back a part of the reply, behind what was handed back before. False where nobody takes it.
bool rg_cage_reply(const void *data, size_t bytes);

#endif
