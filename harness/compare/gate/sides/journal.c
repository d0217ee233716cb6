#include "harness/compare/gate/sides/journal.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "harness/record/disk/document.h"
#include "harness/record/disk/seal.h"
#include "harness/record/output.h"

enum { FORMAT = 2 };

struct rg_gate_journal {
    char *folder, path[2048];
    json_t *document; // format, key, "codes": the code that ran each row, by name, and "rows": an
                      // object of arrays of launches, by name
    int had;          // number of launches in the file when it was opened
    bool is_changed, is_broken; // is_broken: it could not be written, which was logged
};

static json_t *rows_of(const struct rg_gate_journal *j)
{
    return json_object_get(j->document, "rows");
}

// --- a launch of a row: its number and its results ---

static json_t *launch_json(int number, const struct rg_quads *quads)
{
    return json_pack("[i, f, f, f, b]", number, quads->log, quads->a_ms, quads->b_ms,
                     quads->is_disturbed);
}

// Reads a launch. False if it is none.
static bool take_launch(json_t *launch, json_int_t *number, struct rg_quads *quads)
{
    int is_disturbed = 0;
    const bool ok = !json_unpack(launch, "[I, F, F, F, b!]", number, &quads->log, &quads->a_ms,
                                 &quads->b_ms, &is_disturbed);
    quads->is_disturbed = is_disturbed;
    return ok && *number >= 0 && quads->a_ms >= 0 && quads->b_ms > 0;
}

// --- the document ---

static bool begin_anew(struct rg_gate_journal *j, json_t *key)
{
    json_decref(j->document);
    j->document =
        json_pack("{s:i, s:O, s:{}, s:{}}", "format", FORMAT, "key", key, "codes", "rows");
    return j->document;
}

// Counts the launches of a document; -1 if it has anything else.
static int count_launches(json_t *document)
{
    const char *name;
    json_t *row, *launch;
    size_t i;
    struct rg_quads quads;
    json_int_t number;
    int count = 0;
    json_object_foreach(json_object_get(document, "rows"), name, row)
    {
        json_array_foreach(row, i, launch)
        {
            if (!take_launch(launch, &number, &quads))
                return -1;
            count++;
        }
    }
    const bool is_whole = json_is_object(json_object_get(document, "rows")) &&
                          json_is_object(json_object_get(document, "codes"));
    return is_whole ? count : -1;
}

// Takes over the folder's document if it belongs to this gate.
static void read_journal(struct rg_gate_journal *j, const json_t *key)
{
    char why[RG_WHY_SIZE];
    if (access(j->path, F_OK))
        return;
    json_t *found = rg_document_read(j->path, "remove it, and the gate begins anew", why);
    const json_t *format = json_object_get(found, "format");
    const int count = found ? count_launches(found) : -1;
    if (json_is_integer(format) && json_integer_value(format) != FORMAT) {
        rg_info("%s: has format %" JSON_INTEGER_FORMAT " of a gate's journal, and this is %d; the "
                "gate begins anew",
                j->path, json_integer_value(format), FORMAT);
    } else if (!found || count < 0) {
        rg_warning("%s: is damaged or no journal; the gate begins anew", j->path);
    } else if (!json_equal(json_object_get(found, "key"), key)) {
        rg_info("%s: is of another build, machine, choice of devices or of cells; the gate begins "
                "anew",
                j->path);
    } else {
        json_decref(j->document);
        j->document = json_incref(found);
        j->had = count;
    }
    json_decref(found);
}

static void let_go(struct rg_gate_journal *j)
{
    if (j) {
        json_decref(j->document);
        free(j->folder);
    }
    free(j);
}

struct rg_gate_journal *rg_gate_journal_open(const char *folder, json_t *key, bool fresh)
{
    struct rg_gate_journal *j = rg_alloc(1, sizeof(*j), "gate");
    if (!j || !(j->folder = strdup(folder)) || !begin_anew(j, key)) {
        rg_harness_error("gate: no memory for what is kept of it");
        json_decref(key);
        let_go(j);
        return NULL;
    }
    snprintf(j->path, sizeof(j->path), "%s/" RG_GATE_JOURNAL, folder);
    if (!fresh)
        read_journal(j, key);
    if (j->had)
        rg_info("%s: has times of %d launch%s of a gate that was interrupted, which goes on",
                folder, j->had, j->had == 1 ? "" : "es");
    json_decref(key);
    return j;
}

void rg_gate_journal_expect(struct rg_gate_journal *j, const char *name, const char *code)
{
    json_t *codes = json_object_get(j->document, "codes");
    const char *was = json_string_value(json_object_get(codes, name));
    if (was && !strcmp(was, code))
        return;
    json_object_set_new(codes, name, json_string(code));
    if (!json_object_del(rows_of(j), name))
        rg_info("%s: what is kept of %s was timed with other code; its times are taken anew",
                j->path, name);
}

// Logs the first failure to write; the gate goes on without its journal.
void rg_gate_journal_save(struct rg_gate_journal *j)
{
    if (!j->is_changed || j->is_broken)
        return;
    char *text =
        rg_seal(j->document) ? json_dumps(j->document, RG_JSON_FLAGS | JSON_COMPACT) : NULL;
    j->is_broken = !text || !rg_output_write(j->folder, RG_GATE_JOURNAL, text);
    j->is_changed = false;
    free(text);
}

// --- its launches ---

bool rg_gate_journal_find(const struct rg_gate_journal *j, const char *name, int launch,
                          struct rg_quads *quads)
{
    json_t *found;
    size_t i;
    json_int_t number;
    json_array_foreach(json_object_get(rows_of(j), name), i, found)
    {
        if (take_launch(found, &number, quads) && number == launch)
            return true;
    }
    return false;
}

void rg_gate_journal_add(struct rg_gate_journal *j, const char *name, int launch,
                         const struct rg_quads *quads)
{
    json_t *launches = json_object_get(rows_of(j), name);
    if (!launches)
        json_object_set_new(rows_of(j), name, launches = json_array());
    json_array_append_new(launches, launch_json(launch, quads));
    j->is_changed = true;
}

// --- the end ---

// A launch of B alone, compared with a baseline, has no ratio and no time of A.
static void put_launch(const char *name, json_t *launch, FILE *file)
{
    struct rg_quads quads;
    json_int_t number;
    take_launch(launch, &number, &quads);
    fprintf(file, "\"");
    for (const char *c = name; *c; c++)
        fprintf(file, *c == '"' ? "\"\"" : "%c", *c);
    fprintf(file, "\",%" JSON_INTEGER_FORMAT ",", number);
    if (quads.a_ms > 0)
        fprintf(file, "%.9g,%.9g", quads.log, quads.a_ms);
    else
        fprintf(file, ",");
    fprintf(file, ",%.9g,%d\n", quads.b_ms, quads.is_disturbed);
}

char *rg_gate_journal_csv(const struct rg_gate_journal *j)
{
    char *text = NULL;
    size_t size = 0, i;
    const char *name;
    json_t *row, *launch;
    FILE *file = open_memstream(&text, &size);
    json_t *rows = file ? rows_of(j) : NULL;
    if (json_object_size(rows))
        fprintf(file, "case,launch,log_ratio,a_ms,b_ms,disturbed\n");
    json_object_foreach(rows, name, row)
    {
        json_array_foreach(row, i, launch)
        {
            put_launch(name, launch, file);
        }
    }
    if (file && fclose(file) == 0)
        return text;
    free(text);
    return rg_harness_error_null("gate: no memory for the launches; close other programs");
}

// Without launches, removes the file that an earlier gate may have left.
static bool write_launches(const struct rg_gate_journal *j)
{
    char path[sizeof(j->path)], *csv = rg_gate_journal_csv(j);
    bool ok = csv != NULL;
    snprintf(path, sizeof(path), "%s/" RG_GATE_LAUNCHES, j->folder);
    if (ok && *csv)
        ok = rg_output_write(j->folder, RG_GATE_LAUNCHES, csv);
    else if (ok)
        ok = !unlink(path) || errno == ENOENT ||
             rg_system_error(errno, "%s: cannot be removed: %s", path, strerror(errno));
    free(csv);
    return ok;
}

bool rg_gate_journal_close(struct rg_gate_journal *j, bool is_done)
{
    if (!j)
        return true;
    const bool ok = !is_done || write_launches(j);
    if (!is_done || !ok)
        rg_gate_journal_save(j);
    else if (unlink(j->path) && errno != ENOENT)
        rg_warning("%s: cannot be removed: %s", j->path, strerror(errno));
    let_go(j);
    return ok;
}
