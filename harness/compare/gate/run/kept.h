// Times of a gate that are kept on disk as they are taken, so that the same command goes on where
// it was interrupted, or killed: it loses no more than the launch that was under way.
//
// What is kept is a sealed document of the folder that a gate writes into, gate.journal. What
// follows from times in a course follows again when they come from there, for what a course draws
// depends on the number of the launch alone. A document of other sides, cells, drivers, margin or
// another program is no part of this gate, and neither is a damaged one: the gate begins anew, and
// says so. A driver or another build that was built anew meanwhile has the same name, path and
// version, so that each row has which code it ran.
#ifndef RG_HARNESS_COMPARE_GATE_RUN_KEPT_H
#define RG_HARNESS_COMPARE_GATE_RUN_KEPT_H

#include <jansson.h>

#include "harness/compare/gate/decide/course.h"

#define RG_GATE_JOURNAL "gate.journal"

// Reads what the folder has, unless it is to be `fresh`. `key`: all that decides the times, whose
// reference is taken. NULL, and one logged line, without memory.
struct rg_kept_times *rg_kept_times_open(const char *folder, json_t *key, bool fresh);
// How many launches it had of all rows together.
int rg_kept_times_count(const struct rg_kept_times *kept);
// Says which code runs a row now, before its source is asked for. Times that other code took are no
// part of this gate, and are dropped; one line says so.
void rg_kept_times_expect(struct rg_kept_times *kept, const char *name, const char *code);

// A source that gives what is kept first, and then what `source` gives, and keeps it. `names`: of
// the rows, unique in all gates of the folder. Both outlive what is returned, which lasts until
// this is called again.
struct rg_quad_source rg_kept_times_source(struct rg_kept_times *kept,
                                           const struct rg_quad_source *source,
                                           const char *const *names);

// What was kept as CSV, a line a launch of a row, which the caller frees; "" where nothing was.
// NULL without memory.
char *rg_kept_times_csv(const struct rg_kept_times *kept);

// Writes what is kept, and lets it go. `is_done`: the gate is over, and its document is removed.
void rg_kept_times_close(struct rg_kept_times *kept, bool is_done);

#endif
