// Programs of our own that parse foreign bytes in a process of their own, so that a library that
// crashes, loops or is taken over harms nothing else. run_caged.c starts them; they call shut.c.
//
// The program's environment holds only RG_CAGE_VARIABLE. Its descriptors 0 to 2 are /dev/null,
// RG_CAGE_REPLY is a pipe for the reply, and RG_CAGE_FILE is the file, if one was given.
#ifndef RG_CORE_BASE_CAGE_CAGE_H
#define RG_CORE_BASE_CAGE_CAGE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { RG_CAGE_REPLY = 3, RG_CAGE_FILE };

// Exit statuses of a program that read nothing: the system refused it a cage, or gave too little
// memory.
enum { RG_CAGE_REFUSED = 77, RG_CAGE_NO_MEMORY };

// Set to "off", it lets programs read without a cage where the system refuses one (seccomp).
#define RG_CAGE_VARIABLE "RG_CAGE"

// --- from outside ---

// The result of a caged program.
struct rg_caged {
    char *reply; // its reply, which the caller frees; NULL: nothing
    size_t bytes;
    int status;
    bool ended;    // it ended by itself; false when it had to be killed
    bool is_cut;   // it was killed because its reply was too long
    bool has_room; // our memory held the reply; false when it was killed for that
};

// Why nothing came of it: the file is at fault, the machine gives its reader no cage, or raingauge
// lacks memory or a process for it.
enum rg_caged_end { RG_CAGED_SOUND, RG_CAGED_FILE, RG_CAGED_MACHINE, RG_CAGED_LACKING };

// Runs args[0] for up to `timeout_s`, with a reply of up to `most_bytes`. `file` is the descriptor
// that it reads, which stays the caller's; -1: none. 0 or the errno of what the machine refused;
// `caged` is set either way.
int rg_caged_run(const char *const args[], int file, int timeout_s, int64_t most_bytes,
                 struct rg_caged *caged);

// The way in which a caged program ended. Unless that is RG_CAGED_SOUND, `why` gets a sentence that
// blames `library` or the machine.
enum rg_caged_end rg_caged_end(const struct rg_caged *caged, const char *library, char *why,
                               size_t size);

// --- from inside ---

// 0: unlimited.
struct rg_cage_limits {
    int64_t cpu_s, memory_bytes;
};

// Limits the process's resources from now on, forbids it to write files, and has it end with its
// parent. Under sanitizers, whose shadow memory takes terabytes of addresses, memory is unlimited
// and the time limit longer.
void rg_cage_limit(const struct rg_cage_limits *limits);

// From now on the process can reserve memory, read and write the descriptors that it has, and end:
// it opens nothing, starts nothing, and gains no privilege. False where the system refuses that and
// RG_CAGE_VARIABLE does not allow reading without: the program then ends with RG_CAGE_REFUSED.
bool rg_cage_shut(void);

// Appends to the reply. False where nobody takes it.
bool rg_cage_reply(const void *data, size_t bytes);

#endif
