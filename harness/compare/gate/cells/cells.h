// The cells of a gate: short pieces of work, each a technique with its settings and a picture's
// size, in a text file. docs/expectations.md has the format.
#ifndef RG_HARNESS_COMPARE_GATE_CELLS_CELLS_H
#define RG_HARNESS_COMPARE_GATE_CELLS_CELLS_H

#include "core/techniques/technique.h"

enum { RG_GATE_NAME_SIZE = 64, RG_GATE_CELLS = 4096 };

struct rg_gate_cell {
    char name[RG_GATE_NAME_SIZE]; // "streaks/rain"; no two have the same
    const struct rg_technique *technique;
    void *settings;    // checked, with all defaults; owned
    char *assignments; // "key=value key=value" as they stand in the file; owned
    int width, height; // px
    int frames;        // simulated before the picture that is compared
    int line;          // in the file, from 1
};

struct rg_gate_cells {
    int64_t count, room;
    struct rg_gate_cell *cells; // in the order of their lines
};

// Reads a file of cells; NULL: those that are built in. False, and one logged line "FILE:LINE:
// what; mend", where it is refused or names no cell. The caller calls rg_gate_cells_free in either
// case.
bool rg_gate_cells_read(const char *path, struct rg_gate_cells *cells);
// The same of a text in memory.
bool rg_gate_cells_of(const char *name, const char *text, size_t size, struct rg_gate_cells *cells);
// The cell of this name; NULL where there is none.
const struct rg_gate_cell *rg_gate_cells_find(const struct rg_gate_cells *cells, const char *name);
void rg_gate_cells_free(struct rg_gate_cells *cells);

// Digests, which equal things have equal.
enum { RG_DIGEST_SIZE = 17 };

// XXH3 in 16 hexadecimal digits.
void rg_digest_of(const void *bytes, size_t size, char digest[RG_DIGEST_SIZE]);
// Of all that a cell is: technique, size, frames and every parameter, those by default too.
void rg_digest_of_cell(const struct rg_gate_cell *cell, char digest[RG_DIGEST_SIZE]);

// The text of those that are built in, to begin a file of one's own with.
extern const char rg_gate_cells_text[];

#endif
