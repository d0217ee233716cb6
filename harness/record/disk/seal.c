#include "harness/record/disk/seal.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

#include "harness/record/schema/schema.h"

static const char field[] = "checksum";
enum { DIGITS = 16 };

// Hashes the text with names in a fixed order, which is the same after reading the file.
static bool find_checksum(const json_t *document, char checksum[DIGITS + 1])
{
    char *text = json_dumps(document, RG_JSON_FLAGS | JSON_COMPACT | JSON_SORT_KEYS);
    if (!text)
        return false;
    snprintf(checksum, DIGITS + 1, "%016" PRIx64, (uint64_t)XXH3_64bits(text, strlen(text)));
    free(text);
    return true;
}

bool rg_seal(json_t *document)
{
    char checksum[DIGITS + 1];
    json_object_del(document, field);
    return find_checksum(document, checksum) &&
           !json_object_set_new(document, field, json_string(checksum));
}

enum rg_sealed rg_unseal(json_t *document)
{
    char checksum[DIGITS + 1];
    json_t *found = json_incref(json_object_get(document, field));
    if (!found)
        return RG_SEAL_ABSENT;
    json_object_del(document, field);
    const char *text = json_string_value(found);
    const bool same = text && find_checksum(document, checksum) && !strcmp(text, checksum);
    json_decref(found);
    return same ? RG_SEAL_WHOLE : RG_SEAL_BROKEN;
}
