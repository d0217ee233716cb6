#include "harness/record/disk/parts.h"

#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "harness/record/disk/document.h"
#include "harness/record/disk/seal.h"
#include "harness/record/named.h"
#include "harness/record/output.h"

enum { NAME = 64, MOST_SHARDS = 1 << 16 };

// --- writing ---

static void name_of(const char *kind, struct rg_shard shard, char name[NAME])
{
    snprintf(name, NAME, "%s-%d-of-%d.json", kind, shard.number, shard.count);
}

bool rg_part_write(const char *kind, struct rg_shard shard, json_t *document, json_t *of,
                   const char *folder)
{
    char name[NAME];
    name_of(kind, shard, name);
    json_t *part = json_pack("{si si so}", "number", shard.number, "count", shard.count, "of", of);
    const bool is_made =
        document && part && !json_object_set_new(document, "shard", part) && rg_seal(document);
    char *text = is_made ? json_dumps(document, JSON_INDENT(1) | RG_JSON_FLAGS) : NULL;
    const bool ok =
        text ? rg_output_write(folder, name, text)
             : rg_harness_error("%s/%s: no memory to write it; close other programs", folder, name);
    free(text);
    json_decref(document);
    return ok;
}

// --- one record ---

struct reading {
    struct rg_parts *parts;
    const char *kind;
    char first[2048]; // the file of parts->of
};

// The name of the first part in which two wholes differ; NULL if they do not.
static const char *difference(const json_t *a, const json_t *b)
{
    const char *name;
    json_t *value;
    json_object_foreach((json_t *)a, name, value)
    {
        if (!json_equal(value, json_object_get(b, name)))
            return name;
    }
    json_object_foreach((json_t *)b, name, value)
    {
        if (!json_object_get(a, name))
            return name;
    }
    return NULL;
}

static bool is_of_format(const json_t *document, const char *path)
{
    const json_int_t format = json_integer_value(json_object_get(document, "format"));
    return format <= RG_FORMAT_VERSION ||
           rg_error("%s: format is %d, and this raingauge reads %d; use a raingauge of its commit",
                    path, (int)format, RG_FORMAT_VERSION);
}

// Begins with the whole of the first record, or holds a record's against it.
static bool is_of_whole(struct reading *r, const json_t *of, int count, const char *path)
{
    struct rg_parts *parts = r->parts;
    if (!parts->of) {
        parts->documents = rg_alloc((size_t)count, sizeof(*parts->documents), "shards");
        parts->count = parts->missing = parts->documents ? count : 0;
        parts->of = of;
        snprintf(r->first, sizeof(r->first), "%s", path);
        return parts->documents;
    }
    const char *differs = count == parts->count ? difference(parts->of, of) : "number of shards";
    return !differs || rg_error("%s: its %s is not that of %s; name the records of one %s, or run "
                                "its shard again",
                                path, differs, r->first, r->kind);
}

// Takes over the document of a record.
static bool keep(struct reading *r, json_t *document, const char *path)
{
    const json_t *shard = json_object_get(document, "shard"), *of = json_object_get(shard, "of");
    const int number = (int)json_integer_value(json_object_get(shard, "number"));
    const int count = (int)json_integer_value(json_object_get(shard, "count"));
    if (!json_is_object(of) || number < 1 || number > count || count > MOST_SHARDS)
        return rg_error("%s: is no record of a shard; name what `raingauge %s --shard -o` wrote",
                        path, r->kind);
    if (!is_of_whole(r, of, count, path))
        return false;
    json_t **kept = &r->parts->documents[number - 1];
    if (*kept)
        rg_info("%s: shard %d is there twice, and this record is not taken", path, number);
    else
        *kept = json_incref(document);
    return true;
}

static bool take(struct reading *r, const char *path)
{
    static const char mend[] = "run its shard again";
    char why[RG_WHY_SIZE] = "";
    bool ok = true, is_alone;
    json_t *document = rg_document_first(path, &is_alone, mend, why);
    if (document && !is_alone)
        snprintf(why, sizeof(why), "%.200s: has more after its end; %s", path, mend);
    if (document && !*why && is_of_format(document, path) == false)
        ok = false;
    else if (*why || !document || !rg_document_unseal(path, document, true, why))
        rg_warning("%s", why);
    else
        ok = keep(r, document, path);
    json_decref(document);
    return ok;
}

// --- a folder ---

// Whether a name is that of a record of this kind. Copies under way have other names.
static bool is_named(const char *kind, const char *name)
{
    const size_t length = strlen(kind);
    int number, count, end = 0;
    return !strncmp(name, kind, length) &&
           sscanf(name + length, "-%9d-of-%9d.json%n", &number, &count, &end) == 2 && end &&
           !name[length + (size_t)end];
}

static bool is_folder(const char *path)
{
    struct stat found;
    return stat(path, &found) == 0 && S_ISDIR(found.st_mode);
}

// Takes the records of a folder, and with `inner` those of the folders in it: services for CI keep
// a folder for each job.
static bool take_folder(struct reading *r, const char *folder, bool inner)
{
    struct dirent **entries;
    const int count = scandir(folder, &entries, NULL, alphasort);
    bool ok = count >= 0 ||
              rg_system_error(errno, "%s: %s; name a folder of records", folder, strerror(errno));
    for (int i = 0; i < count; i++) {
        const char *name = entries[i]->d_name;
        char path[2048];
        const bool fits = snprintf(path, sizeof(path), "%s/%s", folder, name) < (int)sizeof(path);
        if (ok && is_named(r->kind, name))
            ok = fits ? take(r, path) : rg_error("%.80s...: its name is too long; move it", path);
        else if (ok && inner && fits && *name != '.' && is_folder(path))
            ok = take_folder(r, path, false);
        free(entries[i]);
    }
    if (count >= 0)
        free(entries);
    return ok;
}

bool rg_parts_read(struct rg_parts *parts, const char *kind, const char *path)
{
    struct reading r = {.parts = parts, .kind = kind};
    if (access(path, F_OK))
        return rg_system_error(errno, "%s: %s; name a folder of records", path, strerror(errno));
    const bool ok = is_folder(path) ? take_folder(&r, path, true) : take(&r, path);
    for (int i = 0; ok && i < parts->count; i++)
        parts->missing -= parts->documents[i] != NULL;
    return ok;
}

char *rg_parts_lacking(const struct rg_parts *parts)
{
    const size_t room = (size_t)parts->count * RG_SHARD_NUMBER;
    bool *lacks = rg_alloc((size_t)parts->count, sizeof(*lacks), "shards");
    char *text = lacks ? rg_alloc(room, 1, "shards") : NULL;
    for (int i = 0; text && i < parts->count; i++)
        lacks[i] = !parts->documents[i];
    if (text)
        rg_shard_array(lacks, parts->count, text, room);
    free(lacks);
    return text;
}

// Whether a text has a piece at its beginning or behind a line's end, with a line's end behind it.
static bool has_piece(const char *text, const char *piece, size_t length)
{
    bool has = false;
    for (const char *at = text; !has && (at = strstr(at, piece)); at++)
        has = (at == text || at[-1] == '\n') && (at[length] == '\n' || !at[length]);
    return has;
}

// Adds a piece and a line's end to a text, unless it has it; a line cannot steer a terminal. False
// without memory.
static bool add_piece(char **text, const char *piece, size_t length, bool is_line)
{
    char *one = strndup(piece, length), *longer = NULL;
    const size_t before = strlen(*text);
    if (one && is_line) {
        rg_text_copy(one, length + 1, piece);
        length = strlen(one);
    }
    if (one && (!length || has_piece(*text, one, length)))
        longer = *text;
    else if (one && (longer = realloc(*text, before + length + 2)))
        snprintf(longer + before, length + 2, "%s\n", one);
    *text = longer ? longer : *text;
    free(one);
    return longer;
}

char *rg_parts_texts(const struct rg_parts *parts, const char *name, bool by_lines)
{
    char *all = rg_alloc(1, 1, "shards");
    bool ok = all;
    for (int i = 0; ok && i < parts->count; i++) {
        const char *text = json_string_value(json_object_get(parts->documents[i], name));
        while (ok && text && *text) {
            const size_t length = by_lines ? strcspn(text, "\n") : strlen(text);
            ok = add_piece(&all, text, length, by_lines);
            text += length + (text[length] == '\n');
        }
    }
    if (ok)
        return all;
    free(all);
    return rg_harness_error_null("shards: no memory for what their records tell");
}

void rg_parts_free(struct rg_parts *parts)
{
    for (int i = 0; i < parts->count; i++)
        json_decref(parts->documents[i]);
    free(parts->documents);
    *parts = (struct rg_parts){0};
}
