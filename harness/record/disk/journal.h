// The journal of a table that is being measured, from which the same command goes on after an
// interruption or a kill.
//
// A journal is a result with the complete rows, and with those that have some of their samples: one
// document of harness/record/schema/schema.h, TABLE-LENGTH.journal. It is in the folder of the
// results or, without one, in raingauge's folder of the user's state (XDG_STATE_HOME).
//
// A journal counts only if it agrees with the run in all that decides the numbers: the table, its
// rows and settings, the length, the passport with the program. A damaged one is ignored, too.
// Without a journal the whole table is measured.
#ifndef RG_HARNESS_RECORD_DISK_JOURNAL_H
#define RG_HARNESS_RECORD_DISK_JOURNAL_H

#include "harness/record/result.h"

// The name of a table's journal in its folder.
enum { RG_JOURNAL_NAME_SIZE = 128 };
void rg_journal_name(const char *table, bool full, char name[RG_JOURNAL_NAME_SIZE]);

// Reads the journal of a begun result that has no row yet. `folder`: the folder of the results, or
// NULL. `fresh`: an existing file is not read. `is_followed`: other tables come after this one, so
// that its last row is kept as well. NULL, with one logged line, without memory; the functions
// below accept that.
struct rg_journal *rg_journal_open(const struct rg_result *result, const char *folder, bool fresh,
                                   bool is_followed);

// Whether the existing file is another run's. The first row that is kept replaces it.
bool rg_journal_is_of_others(const struct rg_journal *journal);

// Whether it has a complete row, or some samples of each of its cells.
bool rg_journal_has(const struct rg_journal *journal, int row);
bool rg_journal_has_part(const struct rg_journal *journal, int row);
// Copies the journal's row, or a part of it, over the result's records, which only describe their
// cells. False if the journal has no such row.
bool rg_journal_take(const struct rg_journal *journal, struct rg_result *result, int row);
// Keeps measured rows, and those with some samples of each cell. Rows with an error are not kept,
// since it may have passed by the next run.
void rg_journal_add(struct rg_journal *journal, const struct rg_result *result, int first,
                    int last);
// Writes its content. Adding rows already does so, except for the last rows of the last table.
void rg_journal_keep(struct rg_journal *journal);
// The path of its file, if one has been written or read; else NULL.
const char *rg_journal_path(const struct rg_journal *journal);
// Removes its file: the table, and all that follow it, are done.
void rg_journal_remove(struct rg_journal *journal);
void rg_journal_close(struct rg_journal *journal);

#endif
