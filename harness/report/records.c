// Reads records from files: the kind of each, whether this program knows its format, and the parts
// that the page needs.
#include <dirent.h>
#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "core/base/log.h"
#include "harness/record/disk/document.h"
#include "harness/record/disk/stored.h"
#include "harness/report/page.h"

static const char mend[] = "name what a command wrote with --json or -o (docs/records.md)";

// Kinds of records, each with a field that no other kind has. The first match counts.
static const struct kind {
    const char *name, *field;
    json_type type;
} kinds[] = {
    {"table", "cells", JSON_ARRAY},         {"claims", "claims", JSON_ARRAY},
    {"gate", "gated", JSON_ARRAY},          {"baseline", "baseline", JSON_ARRAY},
    {"verify", "checks", JSON_ARRAY},       {"diff", "pairs", JSON_ARRAY},
    {"doctor", "warnings", JSON_ARRAY},     {"render", "file", JSON_STRING},
    {"bisect", "candidates", JSON_INTEGER},
};

static const char *kind_of(const json_t *document)
{
    for (size_t i = 0; i < sizeof(kinds) / sizeof(*kinds); i++) {
        const json_t *field = json_object_get(document, kinds[i].field);
        if (field && json_typeof(field) == kinds[i].type)
            return kinds[i].name;
    }
    return NULL;
}

bool rg_page_lacks_memory(const char *path)
{
    return rg_harness_error("%s: no memory for its page; name fewer records", path);
}

// Drops the first gate if there are too many.
static void drop_gate(struct rg_page *page)
{
    size_t i;
    json_t *record;
    if (++page->gates <= RG_PAGE_GATES)
        return;
    json_array_foreach(page->records, i, record)
    {
        if (!rg_page_is(record, "kind", "gate"))
            continue;
        json_array_remove(page->records, i);
        page->gates_left_out++;
        return;
    }
}

static bool append(struct rg_page *page, const char *kind, const char *path, json_t *document,
                   json_t *printed, json_t *machine)
{
    if (!page->records)
        page->records = json_array();
    json_t *record = json_pack("{ss so so so* so*}", "kind", kind, "file", rg_json_text(path),
                               "document", document, "printed", printed, "machine", machine);
    if (!strcmp(kind, "gate"))
        drop_gate(page);
    return (record && !json_array_append_new(page->records, record)) || rg_page_lacks_memory(path);
}

// --- tables ---

// Drops parts that the page does not show: it shows medians with their intervals, not each sample.
static void trim(json_t *document)
{
    size_t i;
    json_t *cell;
    json_array_foreach(json_object_get(document, "cells"), i, cell)
    {
        json_t *measured = json_object_get(cell, "measured");
        json_object_del(cell, "checksum");
        json_object_del(measured, "samples_ms");
        json_object_del(measured, "taken"); // of each sample, too
        json_object_del(measured, "passes_share");
    }
}

// Refuses a second measurement of a table on a machine, which would give a second verdict on each
// claim, and one of another length, whose verdicts cannot be compared.
static bool is_first(const struct rg_page *page, const char *path, const struct rg_result *result,
                     const char *machine)
{
    const char *length = result->full ? "full" : "quick";
    size_t i;
    json_t *record;
    json_array_foreach(page->records, i, record)
    {
        const json_t *document = json_object_get(record, "document");
        const char *file = json_string_value(json_object_get(record, "file"));
        if (!rg_page_is(document, "table", result->table))
            continue;
        if (rg_page_is(record, "machine", machine))
            return rg_error("%s: holds table '%s', which %s holds too; name one of them", path,
                            result->table, file);
        if (!rg_page_is(document, "length", length))
            return rg_error("%s: holds table '%s' measured %s, and %s does not; name one of them",
                            path, result->table, length, file);
    }
    return true;
}

static bool add_table(struct rg_page *page, const char *path, const struct rg_result *result)
{
    static const struct rg_claims_shown all = {0};
    char machine[RG_ORIGIN_NAME];
    const int origin = rg_origins_find(&page->outcomes.origins, result->passport);
    rg_origin_name(origin, machine);
    if (origin < 0 || !is_first(page, path, result, machine) ||
        !rg_claims_add(&page->outcomes, result, page->kept, &all))
        return false;
    json_t *document = rg_result_json(result);
    trim(document);
    return append(page, "table", path, document, rg_page_printed(result->table),
                  json_string(machine));
}

static bool add_tables(struct rg_page *page, const char *path)
{
    struct rg_stored stored = {0};
    bool ok = rg_stored_read(&stored, path);
    for (int i = 0; ok && i < stored.count; i++)
        ok = add_table(page, path, &stored.results[i]);
    rg_stored_free(&stored);
    return ok;
}

// --- other records ---

static void folder_of(const char *path, char folder[PATH_MAX])
{
    const char *slash = strrchr(path, '/');
    snprintf(folder, PATH_MAX, "%.*s", slash ? (int)(slash - path) + 1 : 1, slash ? path : ".");
}

// A record's kind. NULL, with one logged line, if this program does not know it or its format.
static const char *admit(const char *path, const json_t *document)
{
    const json_t *format = json_object_get(document, "format");
    const char *kind = kind_of(document);
    if (!json_is_integer(format) || !kind)
        return rg_error_null("%s: is no record of raingauge; %s", path, mend);
    if (json_object_get(document, "shard"))
        return rg_error_null("%s: is the record of a shard; name what `raingauge %s --from --json` "
                             "makes of all of them",
                             path, kind);
    if (json_integer_value(format) != RG_FORMAT_VERSION)
        return rg_error_null("%s: is of format %" JSON_INTEGER_FORMAT
                             ", and this raingauge knows format %d; use the raingauge that wrote "
                             "it, or a newer one",
                             path, json_integer_value(format), RG_FORMAT_VERSION);
    return kind;
}

static bool add_document(struct rg_page *page, const char *path, json_t *document)
{
    char folder[PATH_MAX];
    const char *kind = admit(path, document);
    folder_of(path, folder);
    return kind && rg_page_add_pictures(page, folder, document) &&
           append(page, kind, path, json_incref(document), NULL, NULL);
}

static bool add_records(struct rg_page *page, const char *path)
{
    char why[RG_WHY_SIZE] = "";
    size_t size, at = 0;
    char *text = rg_document_load(path, &size, mend, why);
    bool ok = text, is_table = false;
    at = text ? strspn(text, " \t\r\n") : 0;
    do {
        json_t *document = ok ? rg_document_next(path, text, size, &at, mend, why) : NULL;
        is_table = document && json_is_array(json_object_get(document, "cells"));
        ok = document && (is_table || add_document(page, path, document));
        json_decref(document);
    } while (ok && !is_table && at < size);
    free(text);
    if (!ok && *why)
        rg_error("%s", why);
    return ok && (!is_table || add_tables(page, path));
}

bool rg_page_add_text(struct rg_page *page, const char *path, const char *text)
{
    char why[RG_WHY_SIZE] = "";
    size_t at = 0;
    json_t *document = rg_document_next(path, text, strlen(text), &at, mend, why);
    const bool ok = document ? add_document(page, path, document) : rg_error("%s", why);
    json_decref(document);
    return ok;
}

static bool add_markdown(struct rg_page *page, const char *path)
{
    char why[RG_WHY_SIZE] = "", folder[PATH_MAX];
    size_t size;
    char *text = rg_document_load(path, &size, "name a text that can be read", why);
    folder_of(path, folder);
    const bool ok = text ? rg_page_add_gallery(page, folder, text) : rg_error("%s", why);
    free(text);
    return ok;
}

// --- files and folders ---

static bool ends_in(const char *name, const char *end)
{
    const size_t length = strlen(name), end_length = strlen(end);
    return length > end_length && !strcmp(name + length - end_length, end);
}

static bool add_file(struct rg_page *page, const char *path)
{
    return ends_in(path, ".md") ? add_markdown(page, path) : add_records(page, path);
}

// Selects records, and the text that `figures -o` writes with its pictures. Other texts may be
// tables.
static int is_shown(const struct dirent *entry)
{
    return ends_in(entry->d_name, ".json") || !strcmp(entry->d_name, "figures.md");
}

// The same, and a machine's folder, as `merge` names it.
static int is_shown_outside(const struct dirent *entry)
{
    return is_shown(entry) || rg_key_is(entry->d_name);
}

static bool add_path(struct rg_page *page, const char *path, bool is_inner);

static bool add_folder(struct rg_page *page, const char *folder, bool is_inner)
{
    struct dirent **entries;
    const int count = scandir(folder, &entries, is_inner ? is_shown : is_shown_outside, alphasort);
    bool ok = count > 0;
    if (count < 0)
        rg_system_error(errno, "%s: %s; name a folder that can be read", folder, strerror(errno));
    else if (!count)
        rg_error("%s: holds no .json and no figures.md; %s", folder, mend);
    for (int i = 0; i < count; i++) {
        char path[PATH_MAX];
        const int length = snprintf(path, sizeof(path), "%s/%s", folder, entries[i]->d_name);
        ok = ok &&
             (length < (int)sizeof(path) ||
              rg_error("%.80s...: its name is too long; move it", path)) &&
             add_path(page, path, true);
        free(entries[i]);
    }
    if (count >= 0)
        free(entries);
    return ok;
}

static bool add_path(struct rg_page *page, const char *path, bool is_inner)
{
    struct stat found;
    return stat(path, &found) == 0 && S_ISDIR(found.st_mode) ? add_folder(page, path, is_inner)
                                                             : add_file(page, path);
}

bool rg_page_add(struct rg_page *page, const char *path)
{
    return add_path(page, path, false);
}

void rg_page_free(struct rg_page *page)
{
    json_decref(page->records);
    json_decref(page->pictures);
    json_decref(page->files);
    json_decref(page->linear);
    json_decref(page->gallery);
    rg_claims_free(&page->outcomes);
    *page = (struct rg_page){0};
}
