#include "harness/record/disk/cells.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

static const char field[] = "checksum";
enum { DIGITS = 16 };

// --- the content of a checksum ---

// A number normalised for hashing, an integer if it is whole, because other programs write 28 for
// 28.0, and 1e-05 as 0.00001.
static json_t *settle_number(const json_t *real)
{
    char text[32];
    snprintf(text, sizeof(text), "%.*g", RG_NUMBER_DIGITS, json_real_value(real));
    return rg_number_json(strtod(text, NULL));
}

// A copy with all numbers normalised. The caller owns it.
static json_t *settle(const json_t *value)
{
    json_t *copy, *inner;
    const char *key;
    size_t i;
    if (json_is_real(value))
        return settle_number(value);
    if (json_is_array(value)) {
        copy = json_array();
        json_array_foreach(value, i, inner) json_array_append_new(copy, settle(inner));
        return copy;
    }
    if (!json_is_object(value))
        return json_incref((json_t *)value);
    copy = json_object();
    json_object_foreach((json_t *)value, key, inner) json_object_set_new(copy, key, settle(inner));
    return copy;
}

// Hashes a value and releases it. False when memory runs out.
static bool hash(json_t *value, uint64_t seed, uint64_t *found)
{
    json_t *settled = settle(value);
    char *text =
        json_dumps(settled, RG_JSON_FLAGS | JSON_COMPACT | JSON_ENCODE_ANY); // in its own order
    *found = text ? XXH3_64bits_withSeed(text, strlen(text), seed) : 0;
    const bool ok = text != NULL;
    free(text);
    json_decref(settled);
    json_decref(value);
    return ok;
}

// The fields before the cells, except derived ones. The caller owns it.
static json_t *head_of(const json_t *document)
{
    static const char *const others[] = {"cells", "shapes", "interrupted", field};
    json_t *head = json_copy((json_t *)document);
    for (size_t i = 0; i < sizeof(others) / sizeof(others[0]); i++)
        json_object_del(head, others[i]);
    return head;
}

// A cell's measurements, except values derived from samples, passes and facts. The caller owns it.
static json_t *measured_of(const json_t *cell)
{
    static const char *const made[] = {"fps",          "ms",    "ms_low",   "ms_high",
                                       "passes_share", "noise", "disturbed"};
    json_t *measured = json_copy(json_object_get(cell, "measured")), *fact;
    const char *name;
    for (size_t i = 0; i < sizeof(made) / sizeof(made[0]); i++)
        json_object_del(measured, made[i]);
    json_object_foreach(json_object_get(cell, "facts"), name, fact) json_object_del(measured, name);
    return measured;
}

// `head` is the hash of the fields before the cells.
static bool find_checksum(const json_t *cell, uint64_t head, char checksum[DIGITS + 1])
{
    uint64_t found;
    json_t *bare = json_copy((json_t *)cell);
    json_object_del(bare, field);
    if (json_object_get(cell, "measured"))
        json_object_set_new(bare, "measured", measured_of(cell));
    const bool ok = hash(bare, head, &found);
    snprintf(checksum, DIGITS + 1, "%016" PRIx64, found);
    return ok;
}

bool rg_cells_seal(json_t *document)
{
    char checksum[DIGITS + 1];
    uint64_t head;
    size_t i;
    json_t *cell;
    bool ok = hash(head_of(document), 0, &head);
    json_array_foreach(json_object_get(document, "cells"), i, cell) ok =
        ok && find_checksum(cell, head, checksum) &&
        !json_object_set_new(cell, field, json_string(checksum));
    return ok;
}

// --- faults ---

// The result of checking cells: counts, and the first cell whose checksum is missing or wrong.
struct found {
    size_t count, absent, wrong, first;
};

static bool look(const json_t *document, struct found *found)
{
    const json_t *cells = json_object_get(document, "cells");
    char checksum[DIGITS + 1];
    uint64_t head;
    bool ok = hash(head_of(document), 0, &head);
    *found = (struct found){.count = json_array_size(cells)};
    // Goes backwards, so that the first faulty cell remains.
    for (size_t i = found->count; ok && i-- > 0;) {
        const json_t *cell = json_array_get(cells, i), *kept = json_object_get(cell, field);
        ok = find_checksum(cell, head, checksum);
        if (json_is_string(kept) && !strcmp(json_string_value(kept), checksum))
            continue;
        found->absent += !kept;
        found->wrong += kept != NULL;
        found->first = i;
    }
    return ok;
}

// "cells[7] (row 2, paper, full, on cpu)".
static void name_cell(const json_t *cell, size_t i, char *text, size_t size)
{
    static const char *const names[] = {"work", "variant", "device"};
    const json_int_t row = json_integer_value(json_object_get(cell, "row_number"));
    size_t used = (size_t)snprintf(text, size, "cells[%zu] (row %d", i, (int)row);
    for (size_t k = 0; k < sizeof(names) / sizeof(names[0]) && used < size; k++) {
        char name[RG_NAME_SIZE];
        const char *found = json_string_value(json_object_get(cell, names[k]));
        rg_text_copy(name, sizeof(name), found ? found : "");
        if (*name)
            used += (size_t)snprintf(text + used, size - used, ", %s%s", k == 2 ? "on " : "", name);
    }
    if (used < size)
        snprintf(text + used, size - used, ")");
}

// Reports a document whose cells have changed since they were written.
static void tell(const char *path, const json_t *document, const struct found *found,
                 char why[RG_WHY_SIZE])
{
    const json_t *cell = json_array_get(json_object_get(document, "cells"), found->first);
    const char *what = json_object_get(cell, field)
                           ? "has a wrong checksum: it was changed, or is of another row, device "
                             "or machine"
                           : "has no checksum, and others have: it was put there later";
    char name[4 * RG_NAME_SIZE] = "";
    if (found->wrong == found->count)
        what = "what stands before its cells was changed, or each of them: no checksum is right";
    else
        name_cell(cell, found->first, name, sizeof(name));
    snprintf(why, RG_WHY_SIZE, "%.200s: %s%s%s; restore it, or measure the table again", path, name,
             *name ? " " : "", what);
}

bool rg_cells_are_whole(const char *path, const json_t *document, char why[RG_WHY_SIZE])
{
    struct found found;
    if (!look(document, &found)) {
        snprintf(why, RG_WHY_SIZE, "%.200s: no memory to check its cells; close other programs",
                 path);
        return false;
    }
    if (found.absent == found.count || (!found.wrong && !found.absent))
        return true;
    tell(path, document, &found, why);
    return false;
}
