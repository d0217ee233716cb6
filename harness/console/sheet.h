// A table of text cells, printed as Markdown, CSV or LaTeX.
#ifndef RG_HARNESS_CONSOLE_SHEET_H
#define RG_HARNESS_CONSOLE_SHEET_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

enum { RG_SHEET_COLUMNS = 32, RG_SHEET_CELL = 512 };

struct rg_sheet {
    const char *title;
    int column_count;
    char columns[RG_SHEET_COLUMNS][RG_SHEET_CELL];
    int row_count;
    int64_t row_room;
    char (*cells)[RG_SHEET_COLUMNS][RG_SHEET_CELL]; // owned
    int note_count;
    int64_t note_room;
    char **notes;    // owned; printed below the table, in Markdown and LaTeX
    int lead_count;  // the first so many notes stand above the table in Markdown
    bool incomplete; // memory for a row, column or note ran out, with one logged line
    int level;       // heading level in Markdown; 0: 2
    int width_step;  // column widths are multiples of this; 0: 8
    int note_width;  // width of notes' lines in Markdown; 0: each note is one line
    // The terminal's colour code for a cell's text, or NULL. The function itself may be NULL.
    const char *(*paint)(const char *cell);
};

// Adds a column, before any row, and returns its index.
int rg_sheet_column(struct rg_sheet *sheet, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
// Adds a row of empty cells and returns them; NULL when memory runs out.
char (*rg_sheet_row(struct rg_sheet *sheet))[RG_SHEET_CELL];
void rg_sheet_note(struct rg_sheet *sheet, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
void rg_sheet_free(struct rg_sheet *sheet);

// The width of its lines in Markdown.
int rg_sheet_width(const struct rg_sheet *sheet);
void rg_sheet_print_md(const struct rg_sheet *sheet, FILE *out);
void rg_sheet_print_csv(const struct rg_sheet *sheet, FILE *out);
void rg_sheet_print_tex(const struct rg_sheet *sheet, FILE *out);

#endif
