#include "harness/record/disk/stored.h"

#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "core/base/alloc.h"
#include "core/base/array.h"
#include "core/base/log.h"
#include "harness/record/disk/cells.h"
#include "harness/record/disk/document.h"
#include "harness/record/passport/key.h"

static const char mend[] = "name a file as `raingauge table -o` writes it";

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
        json_t *document = rg_document_next(path, text, size, &at, mend, why);
        struct rg_result *result =
            document && rg_document_unseal(path, document, false, why) ? add(stored) : NULL;
        const bool ok = result && rg_result_from_json(document, path, result, why) &&
                        rg_cells_are_whole(path, document, why);
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
    char *text = rg_document_load(path, &size, mend, why);
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

// `raingauge merge` names a machine's folder by its comparison key.
static int is_of_machine(const struct dirent *entry)
{
    return rg_key_is(entry->d_name);
}

typedef bool (*reader)(struct rg_stored *stored, const char *path);

// Reads what a folder has, by name. Returns the number of entries; -1, with one logged line, if one
// cannot be read.
static int read_entries(struct rg_stored *stored, const char *folder,
                        int (*is_read)(const struct dirent *entry), reader read)
{
    struct dirent **entries;
    const int count = scandir(folder, &entries, is_read, alphasort);
    bool ok = count >= 0 || rg_system_error(errno,
                                            "%s: %s; name a folder that `raingauge table "
                                            "-o` wrote to",
                                            folder, strerror(errno));
    for (int i = 0; i < count; i++) {
        char path[4096];
        const int length = snprintf(path, sizeof(path), "%s/%s", folder, entries[i]->d_name);
        ok = ok &&
             (length < (int)sizeof(path) ||
              rg_error("%.80s...: its name is too long; move it", path)) &&
             read(stored, path);
        free(entries[i]);
    }
    if (count >= 0)
        free(entries);
    return ok ? count : -1;
}

static bool is_folder(const char *path)
{
    struct stat found;
    return stat(path, &found) == 0 && S_ISDIR(found.st_mode);
}

static bool read_machine(struct rg_stored *stored, const char *path)
{
    return !is_folder(path) || read_entries(stored, path, holds_result, read_file) >= 0;
}

static bool read_folder(struct rg_stored *stored, const char *folder)
{
    const int files = read_entries(stored, folder, holds_result, read_file);
    return files >= 0 && read_entries(stored, folder, is_of_machine, read_machine) >= 0 &&
           (stored->count || rg_error("%s: holds no .json and no .journal; name a folder that "
                                      "`raingauge table -o` wrote to",
                                      folder));
}

bool rg_stored_read(struct rg_stored *stored, const char *path)
{
    return is_folder(path) ? read_folder(stored, path) : read_file(stored, path);
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
    json_t *document = rg_document_read(path, "remove it", why);
    const bool ok = document && rg_result_from_json(document, path, result, why);
    json_decref(document);
    return ok;
}
