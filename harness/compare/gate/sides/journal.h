// What a gate keeps of its times in the folder that it writes into, so that the same command goes
// on where it was interrupted, or killed: it loses no more than the launch that was under way.
//
// gate.journal is a sealed document. What follows from times in a course follows again when they
// come from there, for what a course draws depends on the number of the launch alone. A document of
// other sides, cells, drivers, margin or another program is no part of this gate, and neither is a
// damaged one: the gate begins anew, and says so. A driver or another build that was built anew
// meanwhile has the same name, path and version, so that each row has which code it ran.
#ifndef RG_HARNESS_COMPARE_GATE_SIDES_JOURNAL_H
#define RG_HARNESS_COMPARE_GATE_SIDES_JOURNAL_H

#include <jansson.h>

#include "harness/compare/gate/decide/course.h"

#define RG_GATE_JOURNAL  "gate.journal"
#define RG_GATE_LAUNCHES "launches.csv"

// Reads what the folder has, unless it is to be `fresh`; one line says what is gone on with. `key`:
// all that decides the times, whose reference is taken. NULL, and one logged line, without memory.
struct rg_gate_journal *rg_gate_journal_open(const char *folder, json_t *key, bool fresh);
// How many launches it had of all rows together.
int rg_gate_journal_count(const struct rg_gate_journal *journal);
// Says which code runs a row now, before its launches are asked for. Times that other code took are
// no part of this gate, and are dropped; one line says so.
void rg_gate_journal_expect(struct rg_gate_journal *journal, const char *name, const char *code);

// What a launch told of a row, whose name is unique in all gates of the folder. False: it is not
// kept.
bool rg_gate_journal_find(const struct rg_gate_journal *journal, const char *name, int launch,
                          struct rg_quads *quads);
void rg_gate_journal_add(struct rg_gate_journal *journal, const char *name, int launch,
                         const struct rg_quads *quads);
// Writes what was added, as far as it can.
void rg_gate_journal_save(struct rg_gate_journal *journal);

// It as CSV, a line a launch of a row, which the caller frees; "" where nothing was kept. NULL
// without memory.
char *rg_gate_journal_csv(const struct rg_gate_journal *journal);

// Writes it, and lets it go; NULL: there is none. Where the gate `is_done` it is removed, and what
// every launch told is left in RG_GATE_LAUNCHES as CSV. False, and one logged line, where that
// cannot be written.
bool rg_gate_journal_close(struct rg_gate_journal *journal, bool is_done);

#endif
