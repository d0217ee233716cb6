// The journal of a gate's times, in the gate's folder. After an interruption or a kill the same
// command goes on from it, and loses only the launch that was under way.
//
// gate.journal is a sealed document. A course replays the same way from it, since its random draws
// depend on the launch's number alone. A document of other sides, cells, drivers, margin or another
// program does not belong to this gate, nor does a damaged one: the gate then begins anew and says
// so. A driver or build may be rebuilt under the same name, path and version, so each row also
// records which code ran.
#ifndef RG_HARNESS_COMPARE_GATE_SIDES_JOURNAL_H
#define RG_HARNESS_COMPARE_GATE_SIDES_JOURNAL_H

#include <jansson.h>

#include "harness/judge/course.h"

#define RG_GATE_JOURNAL  "gate.journal"
#define RG_GATE_LAUNCHES "launches.csv"

// Reads the folder's journal unless `fresh`, and says with how many launches the gate goes on.
// `key` holds all that the times depend on; the journal takes its reference. NULL, and one logged
// line, without memory.
struct rg_gate_journal *rg_gate_journal_open(const char *folder, json_t *key, bool fresh);
// Says which code runs a row now; call it before the row's launches. Drops times of other code,
// with one logged line.
void rg_gate_journal_expect(struct rg_gate_journal *journal, const char *name, const char *code);

// A launch's result for a row, whose name is unique among all gates of the folder. False: it is not
// in the journal.
bool rg_gate_journal_find(const struct rg_gate_journal *journal, const char *name, int launch,
                          struct rg_quads *quads);
void rg_gate_journal_add(struct rg_gate_journal *journal, const char *name, int launch,
                         const struct rg_quads *quads);
// Writes what was added, if possible.
void rg_gate_journal_save(struct rg_gate_journal *journal);

// The journal as CSV, one line per launch of a row, which the caller frees; "" if it is empty. NULL
// without memory.
char *rg_gate_journal_csv(const struct rg_gate_journal *journal);

// Writes and frees the journal; NULL: nothing. If the gate `is_done`, removes the file and leaves
// all launches in RG_GATE_LAUNCHES as CSV. False, and one logged line, if that cannot be written.
bool rg_gate_journal_close(struct rg_gate_journal *journal, bool is_done);

#endif
