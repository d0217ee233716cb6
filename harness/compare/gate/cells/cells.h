// The cells of a gate, from a text file: short pieces of work, each a technique with settings and a
// picture's size. docs/expectations.md describes the format.
#ifndef RG_HARNESS_COMPARE_GATE_CELLS_CELLS_H
#define RG_HARNESS_COMPARE_GATE_CELLS_CELLS_H

#include "harness/devices/frames/subject.h"

enum { RG_GATE_NAME_SIZE = 64, RG_GATE_CELLS = 4096 };

struct rg_gate_cell {
    char name[RG_GATE_NAME_SIZE]; // "streaks/rain"; unique
    struct rg_subject subject;    // its settings, checked and with all defaults, are owned
    char *assignments;            // "key=value key=value" as written in the file; owned
    int frames;                   // simulated before the compared picture
    int line;                     // in the file, from 1
};

struct rg_gate_cells {
    int64_t count, room;
    struct rg_gate_cell *cells; // in the order of the file
};

// Reads a file of cells; NULL: the built-in ones. False, and one logged line "FILE:LINE: what;
// mend", if it is refused or names no cell. The caller calls rg_gate_cells_free in either case.
bool rg_gate_cells_read(const char *path, struct rg_gate_cells *cells);
// The same for a text in memory.
bool rg_gate_cells_of(const char *name, const char *text, size_t size, struct rg_gate_cells *cells);
// The cell of this name; NULL if there is none.
const struct rg_gate_cell *rg_gate_cells_find(const struct rg_gate_cells *cells, const char *name);
void rg_gate_cells_free(struct rg_gate_cells *cells);

// A device's fixed functions are cells of a gate too, each by its place in rg_fixed_draws:
// "fixed/mip-nearest". All of them together are RG_GATE_FIXED.
#define RG_GATE_FIXED "fixed"
const char *rg_gate_fixed_cell(int draw);

// Digests: equal for equal things.
enum { RG_DIGEST_SIZE = 17 };

// XXH3 in 16 hexadecimal digits.
void rg_digest_of(const void *bytes, size_t size, char digest[RG_DIGEST_SIZE]);
// Covers everything that defines a cell: technique, size, frames and all parameters, defaults too.
void rg_digest_of_cell(const struct rg_gate_cell *cell, char digest[RG_DIGEST_SIZE]);

// The text of the built-in cells, to begin one's own file with.
extern const char rg_gate_cells_text[];

#endif
