// What a table that is being measured keeps on disk, so that the same command goes on where it was
// interrupted, or killed.
//
// A journal is the result of the rows that are whole, and of those that have some of their samples,
// one document of harness/record/schema/schema.h, in the file TABLE-LENGTH.journal in the folder of
// the results or, without one, in raingauge's folder of the user's state (XDG_STATE_HOME). A
// journal is ignored unless it agrees with the run in all that decides the numbers: the table, its
// rows and settings, the length, the passport with the program. A damaged one is ignored, too.
// Without a journal the table is measured whole.
#ifndef RG_HARNESS_RECORD_DISK_JOURNAL_H
#define RG_HARNESS_RECORD_DISK_JOURNAL_H

#include "harness/record/result.h"

// The name of a table's journal in its folder.
enum { RG_JOURNAL_NAME_SIZE = 128 };
void rg_journal_name(const char *table, bool full, char name[RG_JOURNAL_NAME_SIZE]);

// Reads the journal of a result that was begun and has no row yet. `folder`: of the results, or
// NULL. `fresh`: what is there is not read. `is_followed`: other tables come after this one, so
// that its last row is kept as well. NULL, with one logged line, when there is no folder or no
// memory for it: the functions below accept that.
struct rg_journal *rg_journal_open(const struct rg_result *result, const char *folder, bool fresh,
                                   bool is_followed);

// Whether the file there is another run's, which the first row that is kept replaces.
bool rg_journal_is_of_others(const struct rg_journal *journal);

// Whether it has a whole row, or some samples of each of its cells.
bool rg_journal_has(const struct rg_journal *journal, int row);
bool rg_journal_has_part(const struct rg_journal *journal, int row);
// Copies what the journal has of a row, or a part of it, over its records, which say what they are
// of and nothing else. False when it has nothing of these.
bool rg_journal_take(const struct rg_journal *journal, struct rg_result *result, int row);
// Keeps measured rows, and those with some samples of each cell; not those with an error, which may
// have passed by the next run.
void rg_journal_add(struct rg_journal *journal, const struct rg_result *result, int first,
                    int last);
// Writes what it holds, as is done anyway but for the last rows of a table that no other follows.
void rg_journal_keep(struct rg_journal *journal);
// Where its file is, if one has been written or read; else NULL.
const char *rg_journal_path(const struct rg_journal *journal);
// Removes its file: the table, and all that follow it, are done.
void rg_journal_remove(struct rg_journal *journal);
void rg_journal_close(struct rg_journal *journal);

#endif
