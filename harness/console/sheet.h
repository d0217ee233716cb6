// A table of text cells, printed as Markdown, CSV or LaTeX.
#ifndef RG_HARNESS_CONSOLE_SHEET_H
#define RG_HARNESS_CONSOLE_SHEET_H

#include <stdbool.h>
#include <stdio.h>

enum { RG_GRID_COLUMNS = 32, RG_GRID_CELL = 96 };

struct rg_grid {
    const char *title;
    int column_count;
    char columns[RG_GRID_COLUMNS][RG_GRID_CELL];
    int row_count, row_capacity;
    char (*cells)[RG_GRID_COLUMNS][RG_GRID_CELL]; // owned
    int note_count, note_capacity;
    char **notes;    // owned; printed below, in Markdown and LaTeX
    bool incomplete; // what was added found no memory, which one logged line said
};

// Adds a column, before any row, and returns its index.
int rg_grid_column(struct rg_grid *grid, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
// Adds a row of empty cells and returns them; NULL without memory for it.
char (*rg_grid_row(struct rg_grid *grid))[RG_GRID_CELL];
void rg_grid_note(struct rg_grid *grid, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
void rg_grid_free(struct rg_grid *grid);

void rg_grid_print_md(const struct rg_grid *grid, FILE *out);
void rg_grid_print_csv(const struct rg_grid *grid, FILE *out);
void rg_grid_print_tex(const struct rg_grid *grid, FILE *out);

#endif
