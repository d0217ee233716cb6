#include "harness/compare/gate/run/kept.h"

#include <errno.h>
#include <inttypes.h>
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

struct rg_kept_times {
    char *folder, path[2048];
    json_t *document;           // format, key, "codes": which code a row ran, by its name, and
                                // "rows": an object of arrays of launches, by name
    int had;                    // launches that were there
    bool is_changed, is_broken; // it could not be written, which one logged line said
    // Of the source that is kept now.
    struct rg_quad_source source;
    const char *const *names;
    int launch;               // the course's
    bool is_launched, failed; // the source has launched it, or could not
};

// --- the document ---

static json_t *rows_of(const struct rg_kept_times *kept)
{
    return json_object_get(kept->document, "rows");
}

static bool begin_anew(struct rg_kept_times *kept, json_t *key)
{
    json_decref(kept->document);
    kept->document =
        json_pack("{s:i, s:O, s:{}, s:{}}", "format", FORMAT, "key", key, "codes", "rows");
    kept->had = 0;
    return kept->document;
}

static bool is_launch(const json_t *launch)
{
    bool ok = json_array_size(launch) == 5 && json_is_integer(json_array_get(launch, 0)) &&
              json_is_boolean(json_array_get(launch, 4));
    for (size_t i = 1; ok && i < 4; i++)
        ok = json_is_number(json_array_get(launch, i));
    return ok && json_integer_value(json_array_get(launch, 0)) >= 0 &&
           json_number_value(json_array_get(launch, 2)) >= 0 &&
           json_number_value(json_array_get(launch, 3)) > 0;
}

// Counts the launches of a document, -1 where it has something else.
static int count_launches(json_t *document)
{
    const char *name;
    json_t *row, *launch;
    size_t i;
    int count = 0;
    json_object_foreach(json_object_get(document, "rows"), name, row)
    {
        json_array_foreach(row, i, launch)
        {
            if (!is_launch(launch))
                return -1;
            count++;
        }
    }
    const bool is_whole = json_is_object(json_object_get(document, "rows")) &&
                          json_is_object(json_object_get(document, "codes"));
    return is_whole ? count : -1;
}

// Takes over the document of the folder, where it is this gate's.
static void read_kept(struct rg_kept_times *kept, const json_t *key)
{
    char why[RG_WHY_SIZE];
    if (access(kept->path, F_OK))
        return;
    json_t *found = rg_document_read(kept->path, "remove it, and the gate begins anew", why);
    const json_t *format = json_object_get(found, "format");
    const int count = found ? count_launches(found) : -1;
    if (json_is_integer(format) && json_integer_value(format) != FORMAT) {
        rg_info("%s: has format %" JSON_INTEGER_FORMAT " of a gate's journal, and this is %d; the "
                "gate begins anew",
                kept->path, json_integer_value(format), FORMAT);
    } else if (!found || count < 0) {
        rg_warning("%s: is damaged or no journal; the gate begins anew", kept->path);
    } else if (!json_equal(json_object_get(found, "key"), key)) {
        rg_info("%s: is of another build, machine, choice of devices or of cells; the gate begins "
                "anew",
                kept->path);
    } else {
        json_decref(kept->document);
        kept->document = json_incref(found);
        kept->had = count;
    }
    json_decref(found);
}

struct rg_kept_times *rg_kept_times_open(const char *folder, json_t *key, bool fresh)
{
    struct rg_kept_times *kept = rg_alloc(1, sizeof(*kept), "gate");
    const bool ok = kept && (kept->folder = strdup(folder)) && begin_anew(kept, key);
    if (ok) {
        snprintf(kept->path, sizeof(kept->path), "%s/" RG_GATE_JOURNAL, folder);
        if (!fresh)
            read_kept(kept, key);
    }
    json_decref(key);
    if (ok)
        return kept;
    if (kept) {
        free(kept->folder);
        free(kept);
    }
    rg_harness_error("gate: no memory for what is kept of it");
    return NULL;
}

int rg_kept_times_count(const struct rg_kept_times *kept)
{
    return kept->had;
}

void rg_kept_times_expect(struct rg_kept_times *kept, const char *name, const char *code)
{
    json_t *codes = json_object_get(kept->document, "codes");
    const char *was = json_string_value(json_object_get(codes, name));
    if (was && !strcmp(was, code))
        return;
    json_object_set_new(codes, name, json_string(code));
    if (!json_object_del(rows_of(kept), name))
        rg_info("%s: what is kept of %s was timed with other code; its times are taken anew",
                kept->path, name);
}

// What cannot be written is told once, and the gate goes on without.
static void save(struct rg_kept_times *kept)
{
    if (!kept->is_changed || kept->is_broken)
        return;
    char *text =
        rg_seal(kept->document) ? json_dumps(kept->document, RG_JSON_FLAGS | JSON_COMPACT) : NULL;
    kept->is_broken = !text || !rg_output_write(kept->folder, RG_GATE_JOURNAL, text);
    kept->is_changed = false;
    free(text);
}

// --- a source that is kept ---

static json_t *launch_of(const struct rg_kept_times *kept, int row)
{
    json_t *launches = json_object_get(rows_of(kept), kept->names[row]), *launch;
    size_t i;
    json_array_foreach(launches, i, launch)
    {
        if (json_integer_value(json_array_get(launch, 0)) == kept->launch)
            return launch;
    }
    return NULL;
}

static void add(struct rg_kept_times *kept, int row, const struct rg_quads *quads)
{
    json_t *launches = json_object_get(rows_of(kept), kept->names[row]);
    if (!launches) {
        launches = json_array();
        json_object_set_new(rows_of(kept), kept->names[row], launches);
    }
    json_array_append_new(launches, json_pack("[i, f, f, f, b]", kept->launch, quads->log,
                                              quads->a_ms, quads->b_ms, quads->is_disturbed));
    kept->is_changed = true;
}

static bool launch(int number, void *user)
{
    struct rg_kept_times *kept = user;
    save(kept);
    kept->launch = number;
    kept->is_launched = false;
    return true;
}

// Processes are started only where something has to be timed.
static bool is_launched(struct rg_kept_times *kept)
{
    if (!kept->is_launched && !kept->failed)
        kept->failed = !kept->source.launch(kept->launch, kept->source.user);
    kept->is_launched = !kept->failed;
    return kept->is_launched;
}

static bool take(int row, bool b_first, struct rg_quads *quads, void *user)
{
    struct rg_kept_times *kept = user;
    const json_t *found = launch_of(kept, row);
    if (found) {
        *quads = (struct rg_quads){.log = json_number_value(json_array_get(found, 1)),
                                   .a_ms = json_number_value(json_array_get(found, 2)),
                                   .b_ms = json_number_value(json_array_get(found, 3)),
                                   .is_disturbed = json_is_true(json_array_get(found, 4))};
        return true;
    }
    if (!is_launched(kept) || !kept->source.take(row, b_first, quads, kept->source.user))
        return false;
    add(kept, row, quads);
    return true;
}

static bool is_over(void *user)
{
    const struct rg_kept_times *kept = user;
    return kept->source.is_over && kept->source.is_over(kept->source.user);
}

struct rg_quad_source rg_kept_times_source(struct rg_kept_times *kept,
                                           const struct rg_quad_source *source,
                                           const char *const *names)
{
    kept->source = *source;
    kept->names = names;
    kept->failed = false;
    return (struct rg_quad_source){
        .launch = launch, .take = take, .is_over = is_over, .user = kept, .before = source->before};
}

// --- the end ---

// Of B alone, which is held against a baseline, there is no ratio and no time of A.
static void put_launch(const char *name, const json_t *launch, FILE *file)
{
    const double a_ms = json_number_value(json_array_get(launch, 2));
    fprintf(file, "\"");
    for (const char *c = name; *c; c++)
        fprintf(file, *c == '"' ? "\"\"" : "%c", *c);
    fprintf(file, "\",%" JSON_INTEGER_FORMAT ",", json_integer_value(json_array_get(launch, 0)));
    if (a_ms > 0)
        fprintf(file, "%.9g,%.9g", json_number_value(json_array_get(launch, 1)), a_ms);
    else
        fprintf(file, ",");
    fprintf(file, ",%.9g,%d\n", json_number_value(json_array_get(launch, 3)),
            json_is_true(json_array_get(launch, 4)));
}

char *rg_kept_times_csv(const struct rg_kept_times *kept)
{
    char *text = NULL;
    size_t size = 0, i;
    const char *name;
    json_t *row, *launch;
    FILE *file = open_memstream(&text, &size);
    if (!file)
        return rg_harness_error_null("gate: no memory for the launches; close other programs");
    if (json_object_size(rows_of(kept)))
        fprintf(file, "case,launch,log_ratio,a_ms,b_ms,disturbed\n");
    json_object_foreach(rows_of(kept), name, row)
    {
        json_array_foreach(row, i, launch)
        {
            put_launch(name, launch, file);
        }
    }
    if (fclose(file) == 0)
        return text;
    free(text);
    return NULL;
}

void rg_kept_times_close(struct rg_kept_times *kept, bool is_done)
{
    if (!kept)
        return;
    if (is_done && unlink(kept->path) && errno != ENOENT)
        rg_warning("%s: cannot be removed: %s", kept->path, strerror(errno));
    if (!is_done)
        save(kept);
    json_decref(kept->document);
    free(kept->folder);
    free(kept);
}
