#include "harness/record/disk/stored.h"

#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "core/base/alloc.h"
#include "core/base/array.h"
#include "core/base/file.h"
#include "core/base/log.h"
#include "harness/record/disk/seal.h"

// --- texts of documents ---

// The largest result has some megabytes.
#define MOST_BYTES ((size_t)256 << 20)

// What is in an open file, with a zero behind it; NULL without memory or where it cannot be read.
static char *read_text(FILE *file, size_t *size)
{
    char *text = NULL, piece[1 << 16];
    size_t length;
    FILE *out = open_memstream(&text, size);
    size_t left = MOST_BYTES;
    while (out && left && (length = fread(piece, 1, sizeof(piece), file)) > 0) {
        fwrite(piece, 1, length, out);
        left -= length < left ? length : left;
    }
    if (out && fclose(out) == 0 && left && !ferror(file))
        return text;
    if (!left)
        errno = EFBIG;
    free(text);
    return NULL;
}

static char *load(const char *path, size_t *size, char why[RG_WHY_SIZE])
{
    const char *reason;
    errno = 0;
    FILE *file = rg_file_open(path, &reason);
    char *text = file ? read_text(file, size) : NULL;
    if (!text)
        snprintf(why, RG_WHY_SIZE,
                 "%.200s: cannot be read: %s; name a file as `raingauge table -o` writes it", path,
                 file ? strerror(errno ? errno : ENOMEM) : reason);
    if (file)
        fclose(file);
    return text;
}

// The document that begins at `at`, which goes on behind it; NULL where there is none.
static json_t *next_document(const char *path, const char *text, size_t size, size_t *at,
                             char why[RG_WHY_SIZE])
{
    json_error_t error;
    json_t *document =
        json_loadb(text + *at, size - *at, JSON_REJECT_DUPLICATES | JSON_DISABLE_EOF_CHECK, &error);
    if (!document) {
        int line = error.line;
        for (const char *c = text; c < text + *at; c++)
            line += *c == '\n';
        snprintf(
            why, RG_WHY_SIZE,
            "%.200s: line %d is no JSON: %.120s; name a file as `raingauge table -o` writes it",
            path, line, error.text);
        return NULL;
    }
    *at += (size_t)error.position;
    *at += strspn(text + *at, " \t\r\n");
    return document;
}

// Results that were printed carry no checksum; journals do.
static bool check_seal(const char *path, json_t *document, bool is_journal, char why[RG_WHY_SIZE])
{
    const enum rg_sealed sealed = rg_unseal(document);
    if (sealed == RG_SEAL_WHOLE || (sealed == RG_SEAL_ABSENT && !is_journal))
        return true;
    snprintf(why, RG_WHY_SIZE, "%.200s: %s", path,
             sealed == RG_SEAL_ABSENT ? "has no checksum: it is another version's, or no journal"
                                      : "its checksum is wrong: it was changed or cut; measure it "
                                        "again");
    return false;
}

// --- a file, a folder ---

static struct rg_result *add(struct rg_stored *stored)
{
    if (!rg_array_fit(&stored->results, &stored->room, stored->count + 1, sizeof(*stored->results),
                      "results"))
        return NULL;
    struct rg_result *result = &stored->results[stored->count++];
    *result = (struct rg_result){0};
    return result;
}

static bool read_documents(struct rg_stored *stored, const char *path, const char *text,
                           size_t size, char why[RG_WHY_SIZE])
{
    size_t at = strspn(text, " \t\r\n");
    do {
        json_t *document = next_document(path, text, size, &at, why);
        struct rg_result *result =
            document && check_seal(path, document, false, why) ? add(stored) : NULL;
        const bool ok = result && rg_result_from_json(document, path, result, why);
        json_decref(document);
        if (ok)
            rg_result_drop_begun(result);
        if (!ok)
            return false;
    } while (at < size);
    return true;
}

static bool read_file(struct rg_stored *stored, const char *path)
{
    char why[RG_WHY_SIZE] = "";
    size_t size;
    char *text = load(path, &size, why);
    const bool ok = text && read_documents(stored, path, text, size, why);
    free(text);
    if (!ok && *why)
        rg_error("%s", why);
    return ok;
}

static bool ends_in(const char *name, const char *end)
{
    const size_t length = strlen(name), end_length = strlen(end);
    return length > end_length && !strcmp(name + length - end_length, end);
}

static int holds_result(const struct dirent *entry)
{
    return ends_in(entry->d_name, ".json") || ends_in(entry->d_name, ".journal");
}

static bool read_folder(struct rg_stored *stored, const char *folder)
{
    struct dirent **entries;
    const int count = scandir(folder, &entries, holds_result, alphasort);
    bool ok =
        count > 0 || (rg_error("%s: %s; name a folder that `raingauge table -o` wrote to", folder,
                               count ? strerror(errno) : "holds no .json and no .journal"),
                      false);
    for (int i = 0; i < count; i++) {
        char path[4096];
        const int length = snprintf(path, sizeof(path), "%s/%s", folder, entries[i]->d_name);
        ok = ok &&
             (length < (int)sizeof(path) ||
              rg_error("%.80s...: its name is too long; move it", path)) &&
             read_file(stored, path);
        free(entries[i]);
    }
    if (count >= 0)
        free(entries);
    return ok;
}

bool rg_stored_read(struct rg_stored *stored, const char *path)
{
    struct stat found;
    return stat(path, &found) == 0 && S_ISDIR(found.st_mode) ? read_folder(stored, path)
                                                             : read_file(stored, path);
}

void rg_stored_free(struct rg_stored *stored)
{
    for (int i = 0; i < stored->count; i++)
        rg_result_free(&stored->results[i]);
    free(stored->results);
    *stored = (struct rg_stored){0};
}

bool rg_stored_read_one(const char *path, struct rg_result *result, char why[RG_WHY_SIZE])
{
    size_t size, at = 0;
    char *text = load(path, &size, why);
    json_t *document = text ? next_document(path, text, size, &at, why) : NULL;
    const bool ok = document && check_seal(path, document, true, why) &&
                    rg_result_from_json(document, path, result, why);
    json_decref(document);
    free(text);
    return ok;
}
