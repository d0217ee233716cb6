// What a table that is being measured keeps on disk, so that the same command goes on where it was
// interrupted, or killed.
//
// A journal is one JSON file, TABLE-LENGTH.journal, in the folder of the results or, without one,
// in raingauge's folder of the user's state (XDG_STATE_HOME). It holds the rows that are whole, and
// a key: everything that decides the numbers (the table, its rows and settings, the length, the
// program, the passport). One whose key is another's counts for nothing, nor does one that is
// damaged. Journals are only ever lost, never trusted: without one, tables are measured whole.
#ifndef RG_HARNESS_RECORD_JOURNAL_H
#define RG_HARNESS_RECORD_JOURNAL_H

#include "harness/tables/table.h"

// Reads the journal of a run whose table, devices, rows and length are set. `folder`: of the
// results, or NULL. `fresh`: what is there is not read. `is_followed`: other tables come after this
// one, so that its last row is kept as well. NULL, with one logged line, when there is no folder or
// no memory for it: the functions below accept that.
struct rg_journal *rg_journal_open(const struct rg_table_run *run, const char *folder, bool fresh,
                                   bool is_followed);

bool rg_journal_has(const struct rg_journal *journal, int row);
// Sets a row's cells and groups to what the journal has of it. False when it has nothing.
bool rg_journal_take(struct rg_journal *journal, struct rg_table_run *run, int row);
// Keeps measured rows; not those with an error, which may have passed by the next run.
void rg_journal_add(struct rg_journal *journal, const struct rg_table_run *run, int first,
                    int last);
// Where its file is, if one has been written or read; else NULL.
const char *rg_journal_path(const struct rg_journal *journal);
// Removes its file: the table, and all that follow it, are done.
void rg_journal_remove(struct rg_journal *journal);
void rg_journal_close(struct rg_journal *journal);

#endif
