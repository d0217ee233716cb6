// What this process is doing, where another process can see it: a driver that crashes or hangs
// takes along whoever called it, and cannot say in what.
#ifndef RG_CORE_BASE_DOING_H
#define RG_CORE_BASE_DOING_H

#include <stdatomic.h>
#include <stdint.h>

// A page that both processes map. It is only ever written by the one that does something.
struct rg_doing {
    _Atomic uint64_t count;      // of what was begun: it stands still while a driver hangs
    char what[120];              // "running pass 'flow_blur'"; may be torn while it is written
    char queued[400];            // "'flow_blur', 'flow_move'": kernels that nobody has waited for
    _Atomic int64_t taken_bytes; // of memory (core/base/memory.h), after the last call
};

// From now on rg_doing_begin writes there; NULL: nowhere. The page outlives all such calls.
void rg_doing_share(struct rg_doing *page);

// Says what begins: "running pass", and the name of its object, "" for none. It costs two copies of
// short texts, and nothing where nobody sees it.
void rg_doing_begin(const char *what, const char *name);

// Says that a kernel runs. Drivers compile and run it when they like, so that what they do of it
// may bring them down only where somebody waits: until then it is among those that are queued.
void rg_doing_run(const char *kernel);
// Says that all that ran has ended.
void rg_doing_waited(void);

#endif
