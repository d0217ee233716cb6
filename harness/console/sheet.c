#include "harness/console/sheet.h"

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"

// `array` with room for one element more; NULL, with the array as it was, without memory for it.
static void *grow(struct rg_grid *grid, void *array, int count, int *capacity, size_t size)
{
    if (count < *capacity)
        return array;
    const int wanted = *capacity ? *capacity * 2 : 16;
    void *grown = realloc(array, (size_t)wanted * size);
    if (!grown) {
        grid->incomplete = !rg_error("table '%s': no memory for %d rows", grid->title, wanted);
        return NULL;
    }
    *capacity = wanted;
    return grown;
}

int rg_grid_column(struct rg_grid *grid, const char *format, ...)
{
    const int column = grid->column_count;
    if (column == RG_GRID_COLUMNS) {
        grid->incomplete = !rg_error("table '%s': more than %d columns; raise RG_GRID_COLUMNS",
                                     grid->title, RG_GRID_COLUMNS);
        return column - 1;
    }
    va_list args;
    va_start(args, format);
    vsnprintf(grid->columns[column], sizeof(grid->columns[column]), format, args);
    va_end(args);
    return grid->column_count++;
}

char (*rg_grid_row(struct rg_grid *grid))[RG_GRID_CELL]
{
    void *cells =
        grow(grid, grid->cells, grid->row_count, &grid->row_capacity, sizeof(*grid->cells));
    if (!cells)
        return NULL;
    grid->cells = cells;
    memset(grid->cells[grid->row_count], 0, sizeof(*grid->cells));
    return grid->cells[grid->row_count++];
}

void rg_grid_note(struct rg_grid *grid, const char *format, ...)
{
    void *notes =
        grow(grid, grid->notes, grid->note_count, &grid->note_capacity, sizeof(*grid->notes));
    if (!notes)
        return;
    grid->notes = notes;
    char *note = NULL;
    size_t size;
    FILE *text = open_memstream(&note, &size);
    va_list args;
    va_start(args, format);
    const bool printed = text && vfprintf(text, format, args) >= 0;
    va_end(args);
    if (text && fclose(text) == 0 && printed) {
        grid->notes[grid->note_count++] = note;
        return;
    }
    grid->incomplete = !rg_error("table '%s': no memory for a note", grid->title);
    free(note);
}

void rg_grid_free(struct rg_grid *grid)
{
    for (int n = 0; n < grid->note_count; n++)
        free(grid->notes[n]);
    free(grid->cells);
    free(grid->notes);
}

// --- Markdown, with columns aligned for those who read it as text ---

// A column's width steps by so many characters, so that a digit more or less in a new measurement
// does not move what it has beside it.
enum { WIDTH_STEP = 8 };

static int width_of(const struct rg_grid *grid, int column)
{
    size_t widest = strlen(grid->columns[column]);
    for (int r = 0; r < grid->row_count; r++) {
        const size_t width = strlen(grid->cells[r][column]);
        widest = width > widest ? width : widest;
    }
    return (int)(widest + WIDTH_STEP - 1) / WIDTH_STEP * WIDTH_STEP;
}

static void print_md_row(FILE *out, const struct rg_grid *grid, const int *widths, int row)
{
    for (int c = 0; c < grid->column_count; c++)
        fprintf(out, c ? " %*s |" : "| %*s |", widths[c],
                row < 0 ? grid->columns[c] : grid->cells[row][c]);
    fprintf(out, "\n");
}

void rg_grid_print_md(const struct rg_grid *grid, FILE *out)
{
    int widths[RG_GRID_COLUMNS];
    for (int c = 0; c < grid->column_count; c++)
        widths[c] = width_of(grid, c);
    fprintf(out, "## %s\n\n", grid->title);
    print_md_row(out, grid, widths, -1);
    for (int c = 0; c < grid->column_count; c++) {
        fprintf(out, c ? "" : "|");
        for (int i = 0; i < widths[c] + 1; i++)
            fprintf(out, "-");
        fprintf(out, ":|");
    }
    fprintf(out, "\n");
    for (int r = 0; r < grid->row_count; r++)
        print_md_row(out, grid, widths, r);
    fprintf(out, "\n");
    for (int n = 0; n < grid->note_count; n++)
        fprintf(out, "- %s\n", grid->notes[n]);
}

// --- CSV: RFC 4180 ---

static void print_csv_cell(FILE *out, const char *text)
{
    if (!text[strcspn(text, ",\"\n")]) {
        fprintf(out, "%s", text);
        return;
    }
    fputc('"', out);
    for (; *text; text++)
        fprintf(out, *text == '"' ? "\"\"" : "%c", *text);
    fputc('"', out);
}

void rg_grid_print_csv(const struct rg_grid *grid, FILE *out)
{
    for (int r = -1; r < grid->row_count; r++) {
        for (int c = 0; c < grid->column_count; c++) {
            fprintf(out, c ? "," : "");
            print_csv_cell(out, r < 0 ? grid->columns[c] : grid->cells[r][c]);
        }
        fprintf(out, "\n");
    }
}

// --- LaTeX: a tabular in a table, needing no package ---

static void print_tex_text(FILE *out, const char *text)
{
    for (; *text; text++) {
        if (*text == '\\')
            fprintf(out, "\\textbackslash{}");
        else if (strchr("^~", *text))
            fprintf(out, "\\%c{}", *text);
        else
            fprintf(out, strchr("_%&#${}", *text) ? "\\%c" : "%c", *text);
    }
}

void rg_grid_print_tex(const struct rg_grid *grid, FILE *out)
{
    fprintf(out, "\\begin{table}\n\\caption{");
    print_tex_text(out, grid->title);
    fprintf(out, "}\n\\begin{tabular}{");
    for (int c = 0; c < grid->column_count; c++)
        fputc('r', out);
    fprintf(out, "}\n\\hline\n");
    for (int r = -1; r < grid->row_count; r++) {
        for (int c = 0; c < grid->column_count; c++) {
            fprintf(out, c ? " & " : "");
            print_tex_text(out, r < 0 ? grid->columns[c] : grid->cells[r][c]);
        }
        fprintf(out, r < 0 ? " \\\\\n\\hline\n" : " \\\\\n");
    }
    fprintf(out, "\\hline\n\\end{tabular}\n");
    for (int n = 0; n < grid->note_count; n++) {
        fprintf(out, "\n\\noindent ");
        print_tex_text(out, grid->notes[n]);
        fprintf(out, "\n");
    }
    fprintf(out, "\\end{table}\n");
}
