#include "harness/compare/gate/cells/cells.h"

#include <ctype.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

#include "core/base/array.h"
#include "core/base/log.h"
#include "core/base/text/pair.h"
#include "core/base/text/place.h"
#include "core/base/files/lines.h"
#include "shaders/fixed/fixed.h"

enum { MAX_FRAMES = 100000 };

// Names appear in reports, file names and test filters, which limits their characters.
static bool is_name(const char *name)
{
    for (const char *c = name; *c; c++)
        if (!isalnum((unsigned char)*c) && !strchr("_.-/", *c))
            return false;
    return isalnum((unsigned char)*name) && strlen(name) < RG_GATE_NAME_SIZE;
}

static bool take_name(struct rg_gate_cell *cell, const char *name)
{
    if (!is_name(name))
        return rg_error("name '%.80s': write letters, digits and _ . - /, at most %d", name,
                        RG_GATE_NAME_SIZE - 1);
    snprintf(cell->name, sizeof(cell->name), "%s", name);
    return true;
}

static bool take_technique(struct rg_gate_cell *cell, const char *name)
{
    cell->subject.technique = rg_technique_find(name);
    return cell->subject.technique ||
           rg_error("technique '%.80s': unknown; `raingauge list techniques` prints them", name);
}

static bool take_size(struct rg_gate_cell *cell, const char *text)
{
    return rg_size_read(text, &cell->subject.width, &cell->subject.height) ||
           rg_error("size '%.80s': write WIDTHxHEIGHT of 1 to %d pixels, as in "
                    "128x96",
                    text, RG_MOST_PX);
}

static bool take_frames(struct rg_gate_cell *cell, const char *text)
{
    return (rg_int_read(text, &cell->frames) && cell->frames >= 0 && cell->frames <= MAX_FRAMES) ||
           rg_error("frames '%.80s': write a whole number of 0 to %d", text, MAX_FRAMES);
}

// Whether a later word in `rest` sets the same key as `assignment`.
static bool sets_key_of(const char *rest, const char *assignment)
{
    const size_t length = strcspn(assignment, "= ");
    for (; *rest; rest += strcspn(rest, " "), rest += strspn(rest, " "))
        if (strcspn(rest, "= ") == length && !strncmp(rest, assignment, length))
            return true;
    return false;
}

// Refuses a key that is set twice: the last value would count, but a reader would trust the first.
static bool has_keys_once(const char *assignments)
{
    const char *next;
    for (const char *one = assignments + strspn(assignments, " "); *one; one = next) {
        next = one + strcspn(one, " ");
        next += strspn(next, " ");
        if (sets_key_of(next, one))
            return rg_error("parameter '%.*s' stands twice; take one out", (int)strcspn(one, "= "),
                            one);
    }
    return true;
}

static bool take_settings(struct rg_gate_cell *cell, const char *assignments)
{
    void *settings = rg_settings_create(cell->subject.technique);
    cell->subject.settings = settings;
    if (!settings)
        return false;
    cell->assignments = strdup(assignments);
    for (char *c = cell->assignments; c && *c; c++)
        if (*c == '\t')
            *c = ' ';
    if (!cell->assignments)
        return rg_harness_error("no memory");
    return rg_params_set_all(cell->subject.technique->params, settings, cell->assignments) &&
           has_keys_once(cell->assignments);
}

static bool take_fields(struct rg_gate_cell *cell, char *text)
{
    char *technique = rg_line_cut(text), *size = rg_line_cut(technique);
    char *frames = rg_line_cut(size), *assignments = rg_line_cut(frames);
    if (!*frames)
        return rg_error("a line of fewer than four words; write NAME TECHNIQUE SIZE FRAMES "
                        "[KEY=VALUE]...");
    return take_name(cell, text) && take_technique(cell, technique) && take_size(cell, size) &&
           take_frames(cell, frames) && take_settings(cell, assignments);
}

const struct rg_gate_cell *rg_gate_cells_find(const struct rg_gate_cells *cells, const char *name)
{
    for (const struct rg_gate_cell *cell = cells->cells; cell < cells->cells + cells->count; cell++)
        if (!strcmp(cell->name, name))
            return cell;
    return NULL;
}

static bool is_alone(const struct rg_gate_cells *cells, const struct rg_gate_cell *cell)
{
    const struct rg_gate_cell *first = rg_gate_cells_find(cells, cell->name);
    return first == cell ||
           rg_error("name '%s': line %d has it already; take another", cell->name, first->line);
}

static bool take_line(struct rg_gate_cells *cells, char *text, int line)
{
    if (cells->count == RG_GATE_CELLS)
        return rg_error("more than %d cells; split the file", RG_GATE_CELLS);
    if (!rg_array_fit(&cells->cells, &cells->room, cells->count + 1, sizeof(*cells->cells),
                      "cells"))
        return false;
    struct rg_gate_cell *cell = &cells->cells[cells->count++];
    *cell = (struct rg_gate_cell){.line = line};
    return take_fields(cell, rg_line_skip(text)) && is_alone(cells, cell);
}

// Takes the lines if they could be read, and frees them.
static bool take_lines(struct rg_gate_cells *cells, struct rg_lines *lines, bool are_read)
{
    char place[RG_LINES_PLACE], *text;
    bool ok = are_read;
    for (int64_t i = -1; ok && (text = rg_lines_next(lines, &i, place));) {
        rg_log_place(place);
        ok = take_line(cells, text, (int)i + 1);
        rg_log_place(NULL);
    }
    ok = ok && (cells->count || rg_error("%s: no cell in it; write NAME TECHNIQUE SIZE FRAMES "
                                         "[KEY=VALUE]... lines",
                                         lines->name));
    rg_lines_free(lines);
    return ok;
}

bool rg_gate_cells_of(const char *name, const char *text, size_t size, struct rg_gate_cells *cells)
{
    struct rg_lines lines;
    *cells = (struct rg_gate_cells){.count = 0};
    return take_lines(cells, &lines, rg_lines_of(name, text, size, &lines));
}

bool rg_gate_cells_read(const char *path, struct rg_gate_cells *cells)
{
    struct rg_lines lines;
    if (!path)
        return rg_gate_cells_of("built-in cells", rg_gate_cells_text, strlen(rg_gate_cells_text),
                                cells);
    *cells = (struct rg_gate_cells){.count = 0};
    return take_lines(cells, &lines, rg_lines_read(path, &lines));
}

void rg_gate_cells_free(struct rg_gate_cells *cells)
{
    for (int64_t i = 0; i < cells->count; i++) {
        free((void *)cells->cells[i].subject.settings);
        free(cells->cells[i].assignments);
    }
    free(cells->cells);
    *cells = (struct rg_gate_cells){.count = 0};
}

// --- digests ---

void rg_digest_of(const void *bytes, size_t size, char digest[RG_DIGEST_SIZE])
{
    snprintf(digest, RG_DIGEST_SIZE, "%016" PRIx64, (uint64_t)XXH3_64bits(bytes, size));
}

void rg_digest_of_cell(const struct rg_gate_cell *cell, char digest[RG_DIGEST_SIZE])
{
    const struct rg_param_table *table = cell->subject.technique->params;
    char line[RG_PATH_SIZE + 128], value[RG_PATH_SIZE];
    snprintf(line, sizeof(line), "%s %dx%d %d", cell->subject.technique->name, cell->subject.width,
             cell->subject.height, cell->frames);
    uint64_t hash = XXH3_64bits(line, strlen(line));
    for (int i = 0; i < table->count; i++) {
        rg_params_text(&table->rows[i], cell->subject.settings, value, sizeof(value));
        snprintf(line, sizeof(line), "%s=%s", table->rows[i].name, value);
        hash = XXH3_64bits_withSeed(line, strlen(line), hash);
    }
    snprintf(digest, RG_DIGEST_SIZE, "%016" PRIx64, hash);
}

const char *rg_gate_fixed_cell(int draw)
{
    static char names[RG_FIXED_MAX_DRAWS][RG_GATE_NAME_SIZE];
    snprintf(names[draw], RG_GATE_NAME_SIZE, "%s/%s", RG_GATE_FIXED, rg_fixed_draws[draw].feature);
    for (char *c = names[draw]; *c; c++)
        if (*c == ' ')
            *c = '-';
    return names[draw];
}
