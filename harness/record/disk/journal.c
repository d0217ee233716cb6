#include "harness/record/disk/journal.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "harness/record/output.h"
#include "harness/record/disk/hold.h"
#include "harness/record/disk/seal.h"
#include "harness/record/disk/stored.h"

struct rg_journal {
    char folder[1536], name[RG_JOURNAL_NAME_SIZE], path[2048]; // "": no folder could be found
    struct rg_result held;                                     // the complete rows, and those in
                                                               // part
    bool has_file, is_followed;
    bool is_of_others; // the file belongs to another run
    bool is_broken;    // writing failed, which one logged line said
};

// --- reading ---

// The result's head without rows, which has all that decides its numbers. It owns nothing.
static struct rg_result head_of(const struct rg_result *result)
{
    struct rg_result head = *result;
    memset(head.rows, 0, sizeof(head.rows));
    head.resumed_rows = 0;
    return head;
}

static bool has_same_head(const struct rg_result *a, const struct rg_result *b)
{
    const struct rg_result head_a = head_of(a), head_b = head_of(b);
    json_t *json_a = rg_result_json(&head_a), *json_b = rg_result_json(&head_b);
    const bool same = json_equal(json_a, json_b);
    json_decref(json_a);
    json_decref(json_b);
    return same;
}

// Takes over the file's rows if its head equals this result's.
static void read_file(struct rg_journal *journal)
{
    char why[RG_WHY_SIZE];
    struct rg_result found = {0};
    if (access(journal->path, F_OK))
        return;
    if (!rg_stored_read_one(journal->path, &found, why)) {
        rg_warning("%s; the table begins anew", why);
        return;
    }
    journal->has_file = has_same_head(&found, &journal->held);
    if (journal->has_file) {
        memcpy(journal->held.rows, found.rows, sizeof(found.rows));
        memset(found.rows, 0, sizeof(found.rows));
    } else {
        journal->is_of_others = true;
        rg_info("%s: is of another build, machine, choice of devices or of rows; the table begins "
                "anew",
                journal->path);
    }
    rg_result_free(&found);
}

void rg_journal_name(const char *table, bool full, char name[RG_JOURNAL_NAME_SIZE])
{
    snprintf(name, RG_JOURNAL_NAME_SIZE, "%s-%s.journal", table, full ? "full" : "quick");
}

struct rg_journal *rg_journal_open(const struct rg_result *result, const char *folder, bool fresh,
                                   bool is_followed)
{
    struct rg_journal *j = rg_alloc(1, sizeof(*j), "journal");
    if (!j)
        return NULL;
    j->is_followed = is_followed;
    if (!folder)
        rg_state_folder(j->folder, sizeof(j->folder));
    else if (strlen(folder) < sizeof(j->folder))
        memcpy(j->folder, folder, strlen(folder) + 1);
    rg_journal_name(result->table, result->full, j->name);
    snprintf(j->path, sizeof(j->path), "%s/%s", j->folder, j->name);
    j->held = head_of(result);
    json_incref(j->held.passport);
    if (!fresh && *j->folder)
        read_file(j);
    return j;
}

bool rg_journal_is_of_others(const struct rg_journal *journal)
{
    return journal && journal->is_of_others;
}

static bool holds(const struct rg_journal *journal, int row)
{
    return journal && rg_result_has(&journal->held, row);
}

bool rg_journal_has(const struct rg_journal *journal, int row)
{
    return holds(journal, row) && rg_result_is_whole(&journal->held, row);
}

bool rg_journal_has_part(const struct rg_journal *journal, int row)
{
    return holds(journal, row) && !rg_result_is_whole(&journal->held, row);
}

static bool is_of_same(const struct rg_record *a, const struct rg_record *b)
{
    return !strcmp(a->set, b->set) && a->row_count == b->row_count &&
           a->published_count == b->published_count && !memcmp(a->row, b->row, sizeof(a->row)) &&
           !memcmp(a->published, b->published, sizeof(a->published));
}

bool rg_journal_take(const struct rg_journal *journal, struct rg_result *result, int row)
{
    if (!holds(journal, row))
        return false;
    struct rg_place at;
    for (at = rg_result_start_row(row); rg_result_next_in_row(result, &at);)
        if (!is_of_same(rg_result_at(result, at), rg_result_at(&journal->held, at)))
            return false;
    for (at = rg_result_start_row(row); rg_result_next_in_row(result, &at);) {
        struct rg_record *record = rg_result_at(result, at);
        const struct rg_device_info device = record->device; // a file does not store its limits
        *record = *rg_result_at(&journal->held, at);
        record->device = device;
    }
    return true;
}

// --- writing ---

// Whether measuring a cell can be continued: it needs at least one sample.
static bool is_begun(const struct rg_result *result, const struct rg_record *record)
{
    return record->outcome != RG_OK || record->sample_count || result->is_of_textures;
}

// Whether a row is worth keeping: an error may have passed by the next run.
static bool is_worth_keeping(const struct rg_result *result, int row)
{
    bool worth = rg_result_has(result, row);
    for (struct rg_place at = rg_result_start_row(row);
         worth && rg_result_next_in_row(result, &at);) {
        const struct rg_record *record = rg_result_at(result, at);
        worth = is_begun(result, record) && !rg_outcome_is_broken(record->outcome) &&
                !rg_outcome_is_broken(record->truth_error.outcome);
    }
    return worth;
}

static bool write_file(struct rg_journal *j)
{
    if (!*j->folder) {
        rg_warning("%s: no folder for it, so that an interrupted run begins anew; set "
                   "XDG_STATE_HOME, or write into a folder with -o",
                   j->name);
        return false;
    }
    json_t *document = rg_result_json(&j->held);
    const bool is_sealed = document && rg_seal(document);
    char *text = is_sealed ? json_dumps(document, RG_JSON_FLAGS | JSON_COMPACT) : NULL;
    const bool ok = text && rg_output_write(j->folder, j->name, text);
    free(text);
    json_decref(document);
    return ok;
}

static void hold_row(struct rg_journal *j, const struct rg_result *result, int row)
{
    if (!is_worth_keeping(result, row) || !rg_result_add_row(&j->held, row))
        return;
    for (struct rg_place at = rg_result_start_row(row); rg_result_next_in_row(result, &at);)
        *rg_result_at(&j->held, at) = *rg_result_at(result, at);
}

static bool is_whole(const struct rg_result *result)
{
    bool whole = true;
    for (int row = result->first_row; whole && row <= result->last_row; row++)
        whole = !rg_result_wants(result, row) ||
                (rg_result_has(result, row) && rg_result_is_whole(result, row));
    return whole;
}

void rg_journal_add(struct rg_journal *j, const struct rg_result *result, int first, int last)
{
    for (int row = first; j && row <= last; row++)
        hold_row(j, result, row);
    // A table that is complete is printed now; only if that fails is its journal kept.
    if (j && (j->is_followed || !is_whole(result)))
        rg_journal_keep(j);
}

void rg_journal_keep(struct rg_journal *j)
{
    if (!j || j->is_broken)
        return;
    j->is_broken = !write_file(j);
    j->has_file = j->has_file || !j->is_broken; // an earlier version of the file stays
}

const char *rg_journal_path(const struct rg_journal *journal)
{
    return journal && journal->has_file ? journal->path : NULL;
}

void rg_journal_remove(struct rg_journal *journal)
{
    if (rg_journal_path(journal) && unlink(journal->path) && errno != ENOENT)
        rg_warning("%s: cannot be removed: %s", journal->path, strerror(errno));
}

void rg_journal_close(struct rg_journal *journal)
{
    if (!journal)
        return;
    rg_result_free(&journal->held);
    free(journal);
}
