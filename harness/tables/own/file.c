#include "harness/tables/own/file.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/base/array.h"
#include "core/base/log.h"
#include "core/base/text/pair.h"
#include "core/base/text/place.h"
#include "core/base/text/words.h"
#include "harness/tables/own/reading.h"
#include "harness/tables/papers/papers.h"

#define ENDING ".table"

enum { MOST_FRAMES = 100000 };

bool rg_own_is_file(const char *name)
{
    const size_t length = strlen(name), end = strlen(ENDING);
    return strchr(name, '/') || (length > end && !strcmp(name + length - end, ENDING));
}

static bool is_name(const char *text)
{
    for (const char *c = text; *c; c++)
        if (!islower((unsigned char)*c) && !isdigit((unsigned char)*c) && !strchr("-_.", *c))
            return false;
    return isalnum((unsigned char)*text) && strlen(text) < RG_NAME_SIZE - 8;
}

// --- lines ---

static bool take_size(struct rg_own *own, const char *text)
{
    struct rg_table *t = &own->table;
    return rg_size_read(text, &t->width, &t->height) ||
           rg_error("size '%.80s': write WIDTHxHEIGHT of 1 to %d pixels, as in 640x360", text,
                    RG_MOST_PX);
}

// "NAME TECHNIQUE WIDTHxHEIGHT"
static bool take_table(struct rg_own *own, char *text)
{
    char *technique = rg_line_cut(text), *size = rg_line_cut(technique);
    if (own->technique)
        return rg_error("table: stands twice; a file has one");
    if (!is_name(text) || rg_table_find(text))
        return rg_error("name '%.80s': write small letters, digits and - _ ., at most %d, and none "
                        "of a paper's tables",
                        text, RG_NAME_SIZE - 9);
    own->technique = rg_technique_find(technique);
    if (!own->technique)
        return rg_error("technique '%.80s': unknown; `raingauge list techniques` prints them",
                        technique);
    own->table = (struct rg_table){.id = text,
                                   .technique = own->technique->name,
                                   .about = "",
                                   .note = "",
                                   .is_own = true,
                                   .variants = {{"full", "", NULL}}};
    own->variant_count = 1;
    return (own->defaults = rg_settings_create(own->technique)) && take_size(own, size);
}

// "NAME KEY=VALUE..."
static bool take_variant(struct rg_own *own, char *text)
{
    char *set = rg_line_cut(text);
    if (own->variant_count == RG_TABLE_VARIANTS)
        return rg_error("more than %d variants; split the file", RG_TABLE_VARIANTS);
    if (!is_name(text) || rg_own_has_variant(own, text))
        return rg_error("variant '%.80s': write a new name of small letters, digits and - _ .",
                        text);
    own->table.variants[own->variant_count++] = (struct rg_table_variant){text, set, NULL};
    return rg_own_accepts(own, set);
}

static bool take_frames(struct rg_own *own, char *text)
{
    int *frames = &own->table.check_frames;
    return (rg_int_read(text, frames) && *frames >= 1 && *frames <= MOST_FRAMES) ||
           rg_error("frames '%.80s': write a whole number of 1 to %d", text, MOST_FRAMES);
}

static bool take_set(struct rg_own *own, char *text)
{
    own->grid.set = text;
    return rg_own_accepts(own, text);
}

static bool take_quick(struct rg_own *own, char *text)
{
    own->table.quick = text;
    return rg_own_accepts(own, text);
}

static bool take_truth(struct rg_own *own, char *text)
{
    own->table.truth = text;
    return rg_own_accepts(own, text);
}

static bool take_about(struct rg_own *own, char *text)
{
    own->table.about = text;
    return true;
}

static bool take_hardware(struct rg_own *own, char *text)
{
    own->table.hardware = text;
    return true;
}

static bool take_note(struct rg_own *own, char *text)
{
    own->table.note = text;
    return true;
}

static const struct {
    const char *word;
    bool (*take)(struct rg_own *own, char *text);
    bool may_repeat;
} kinds[] = {
    {"table", take_table, false},       {"about", take_about, false},
    {"set", take_set, false},           {"axis", rg_own_take_axis, true},
    {"row", rg_own_take_row, true},     {"variant", take_variant, true},
    {"hardware", take_hardware, false}, {"note", take_note, false},
    {"quick", take_quick, false},       {"truth", take_truth, false},
    {"frames", take_frames, false},     {"claim", rg_own_take_claim, true},
};
enum { KINDS = sizeof(kinds) / sizeof(kinds[0]) };

static bool take_line(struct rg_own *own, char *text, bool seen[KINDS])
{
    struct rg_nearest nearest = {0};
    char *rest = rg_line_cut(text);
    int kind = 0;
    while (kind < KINDS && strcmp(kinds[kind].word, text) != 0)
        rg_nearest_try(&nearest, text, kinds[kind++].word);
    if (kind == KINDS)
        return rg_error("'%.80s': no line begins so; the nearest is '%s'", text, nearest.name);
    if (kind && !own->technique)
        return rg_error("%s: write 'table NAME TECHNIQUE WIDTHxHEIGHT' above it", text);
    if (!*rest)
        return rg_error("%s: nothing follows it", text);
    if (seen[kind] && !kinds[kind].may_repeat)
        return rg_error("%s: stands twice; take one out", text);
    seen[kind] = true;
    return kinds[kind].take(own, rest);
}

static bool take_lines(struct rg_own *own)
{
    char place[RG_LINES_PLACE], *text;
    bool seen[KINDS] = {false}, ok = true;
    for (int64_t i = -1; ok && (text = rg_lines_next(&own->lines, &i, place));) {
        rg_log_place(place);
        ok = take_line(own, rg_line_skip(text), seen);
        rg_log_place(NULL);
    }
    return ok;
}

// --- the whole ---

// Gives variants their columns of printed rates. A column of a rate belongs to a variant.
static bool name_rates(struct rg_own *own)
{
    for (int c = 0; c < own->printed_count; c++) {
        const char *column = own->printed[c];
        const char *variant = !strcmp(column, "fps")        ? own->table.variants[0].name
                              : !strncmp(column, "fps_", 4) ? column + 4
                                                            : NULL;
        for (int v = 0; variant && v < own->variant_count; v++)
            if (!strcmp(own->table.variants[v].name, variant))
                own->table.variants[v].fps = column;
        if (variant && !rg_own_has_variant(own, variant))
            return rg_error("%s: rows have '%s', and no variant is named '%s'", own->lines.name,
                            column, variant);
    }
    return !own->printed_count || own->table.hardware ||
           rg_error("%s: rows have printed values; say on which machine, by a line 'hardware ...'",
                    own->lines.name);
}

static bool add_columns(struct rg_own *own)
{
    struct rg_table *table = &own->table;
    if (table->key_count + own->printed_count > RG_TABLE_VALUES)
        return rg_error("%s: more than %d parameters and printed values a row", own->lines.name,
                        RG_TABLE_VALUES);
    for (int c = 0; c < own->printed_count; c++) {
        table->columns[table->key_count + c] = own->printed[c];
        for (int row = 0; row < table->row_count; row++)
            own->grid.rows[row].values[table->key_count + c] = own->values[row][c];
    }
    return true;
}

static bool finish(struct rg_own *own)
{
    const struct rg_table *made = &own->grid.table;
    struct rg_table *table = &own->table;
    if (!rg_own_rows(own))
        return rg_error("%s: has no row; write 'row KEY=VALUE' or 'axis KEY=VALUE,VALUE' lines",
                        own->lines.name);
    rg_log_place(own->lines.name);
    const bool is_made = rg_grid_make(&own->grid, own->technique);
    rg_log_place(NULL);
    if (!is_made)
        return false;
    memcpy(table->columns, made->columns, sizeof(table->columns));
    table->key_count = made->key_count;
    table->names = made->names;
    table->has_choices = made->has_choices;
    table->row_count = made->row_count;
    table->rows = made->rows;
    return name_rates(own) && add_columns(own);
}

// Makes room in the lists of all tables and of all claims, which end with an empty element.
static bool make_known(const struct rg_own *own)
{
    static const struct rg_table **tables;
    static struct rg_claim *claims;
    static int64_t table_room, claim_room;
    int64_t table_count = 0, claim_count = 0;
    while (rg_tables[table_count])
        table_count++;
    while (rg_claims[claim_count].table)
        claim_count++;
    const bool are_ours = tables != NULL;
    if (!rg_array_fit(&tables, &table_room, table_count + 2, sizeof(*tables), "tables") ||
        !rg_array_fit(&claims, &claim_room, claim_count + RG_OWN_CLAIMS, sizeof(*claims), "claims"))
        return false;
    if (!are_ours) {
        memcpy(tables, rg_tables, (size_t)table_count * sizeof(*tables));
        memcpy(claims, rg_claims, (size_t)claim_count * sizeof(*claims));
    }
    tables[table_count] = &own->table;
    tables[table_count + 1] = NULL;
    memcpy(claims + claim_count, own->claims, sizeof(own->claims));
    rg_tables = tables;
    rg_claims = claims;
    return true;
}

const struct rg_table *rg_own_read(const char *path)
{
    struct rg_own *own = rg_alloc(1, sizeof(*own), path);
    if (!own)
        return NULL;
    const bool ok =
        rg_lines_read(path, &own->lines) && take_lines(own) && finish(own) && make_known(own);
    free(own->defaults);
    if (ok)
        return &own->table; // which the lists point to from now on
    rg_lines_free(&own->lines);
    free(own);
    return NULL;
}
