// A page on which this process notes what it is doing, for another process to read: when a driver
// crashes or hangs, its caller can no longer say so.
#ifndef RG_CORE_BASE_DOING_H
#define RG_CORE_BASE_DOING_H

#include <stdatomic.h>
#include <stdint.h>

// A page that both processes map. Only the process that does the work writes it.
struct rg_doing {
    _Atomic uint64_t count;      // of operations begun; it stands still while a driver hangs
    char what[120];              // "running pass 'flow_blur'"; may be torn while it is written
    char queued[400];            // "'flow_blur', 'flow_move'": kernels queued since the last wait
    _Atomic int64_t taken_bytes; // memory counted (core/base/memory.h) after the last call
};

// Makes rg_doing_begin and the others write to `page` from now on; NULL: nowhere. The page must
// outlive all such calls.
void rg_doing_share(struct rg_doing *page);

// Notes what begins: "running pass", and the name of its object, "" for none. It costs two copies
// of short texts, and nothing while no page is shared.
void rg_doing_begin(const char *what, const char *name);

// Notes that a kernel was queued. Drivers compile and run it when they like, so that it may bring
// them down only when somebody waits; until then it counts as queued.
void rg_doing_run(const char *kernel);
// Notes that all queued kernels have ended.
void rg_doing_waited(void);

#endif
