#include "harness/record/disk/document.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/files/file.h"
#include "harness/record/disk/seal.h"

// The largest results have some megabytes.
#define MOST_BYTES ((size_t)256 << 20)

// The contents of an open file, followed by a zero; NULL when memory runs out or reading fails.
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

char *rg_document_load(const char *path, size_t *size, const char *mend, char why[RG_WHY_SIZE])
{
    const char *reason;
    errno = 0;
    FILE *file = rg_file_open_text(path, &reason);
    char *text = file ? read_text(file, size) : NULL;
    if (!text)
        snprintf(why, RG_WHY_SIZE, "%.200s: cannot be read: %s; %s", path,
                 file ? strerror(errno ? errno : ENOMEM) : reason, mend);
    if (file)
        fclose(file);
    return text;
}

json_t *rg_document_next(const char *path, const char *text, size_t size, size_t *at,
                         const char *mend, char why[RG_WHY_SIZE])
{
    json_error_t error;
    json_t *document =
        json_loadb(text + *at, size - *at, JSON_REJECT_DUPLICATES | JSON_DISABLE_EOF_CHECK, &error);
    if (!document) {
        int line = error.line;
        for (const char *c = text; c < text + *at; c++)
            line += *c == '\n';
        snprintf(why, RG_WHY_SIZE, "%.200s: line %d is no JSON: %.120s; %s", path, line, error.text,
                 mend);
        return NULL;
    }
    *at += (size_t)error.position;
    *at += strspn(text + *at, " \t\r\n");
    return document;
}

json_t *rg_document_first(const char *path, bool *is_alone, const char *mend, char why[RG_WHY_SIZE])
{
    size_t size = 0, at = 0;
    char *text = rg_document_load(path, &size, mend, why);
    json_t *document = text ? rg_document_next(path, text, size, &at, mend, why) : NULL;
    *is_alone = at >= size;
    free(text);
    return document;
}

bool rg_document_unseal(const char *path, json_t *document, bool is_sealed, char why[RG_WHY_SIZE])
{
    const enum rg_sealed sealed = rg_unseal(document);
    if (sealed == RG_SEAL_WHOLE || (sealed == RG_SEAL_ABSENT && !is_sealed))
        return true;
    snprintf(why, RG_WHY_SIZE, "%.200s: %s", path,
             sealed == RG_SEAL_ABSENT
                 ? "has no checksum: it is another version's, or was not written by raingauge"
                 : "its checksum is wrong: it was changed or cut; measure it "
                   "again");
    return false;
}

json_t *rg_document_read(const char *path, const char *mend, char why[RG_WHY_SIZE])
{
    bool is_alone;
    json_t *document = rg_document_first(path, &is_alone, mend, why);
    bool ok = document && rg_document_unseal(path, document, true, why);
    if (ok && !is_alone) {
        snprintf(why, RG_WHY_SIZE, "%.200s: has more after its end; %s", path, mend);
        ok = false;
    }
    if (!ok)
        json_decref(document);
    return ok ? document : NULL;
}
