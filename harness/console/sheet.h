// A table of text cells, printed as Markdown, CSV or LaTeX.
#ifndef RG_HARNESS_CONSOLE_SHEET_H
#define RG_HARNESS_CONSOLE_SHEET_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

enum { RG_SHEET_COLUMNS = 32, RG_SHEET_CELL = 512 };

// Columns of a page that a terminal shows whole.
enum { RG_PAGE_WIDTH = 110 };

struct rg_sheet {
    const char *title;
    int column_count;
    char columns[RG_SHEET_COLUMNS][RG_SHEET_CELL];
    int row_count;
    int64_t row_room;
    char (*cells)[RG_SHEET_COLUMNS][RG_SHEET_CELL]; // owned
    int note_count;
    int64_t note_room;
    char **notes;    // owned; printed below, in Markdown and LaTeX
    bool incomplete; // a row, column or note was lost, for which there is one logged line
    int level;       // of its heading in Markdown; 0: 2
    int width_step;  // a column's width steps by so many characters; 0: 8
    int note_width;  // lines of notes in Markdown are no wider; 0: a note is one line
    // The terminal's code that a cell's text is painted with, or NULL: none. NULL: nothing is.
    const char *(*paint)(const char *cell);
};

// Adds a column, before any row, and returns its index.
int rg_sheet_column(struct rg_sheet *sheet, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
// Adds a row of empty cells and returns them; NULL without memory for it.
char (*rg_sheet_row(struct rg_sheet *sheet))[RG_SHEET_CELL];
void rg_sheet_note(struct rg_sheet *sheet, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
void rg_sheet_free(struct rg_sheet *sheet);

// How wide its lines are in Markdown.
int rg_sheet_width(const struct rg_sheet *sheet);
void rg_sheet_print_md(const struct rg_sheet *sheet, FILE *out);
void rg_sheet_print_csv(const struct rg_sheet *sheet, FILE *out);
void rg_sheet_print_tex(const struct rg_sheet *sheet, FILE *out);

#endif
