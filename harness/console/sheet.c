#include "harness/console/sheet.h"

#include <limits.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/array.h"
#include "core/base/log.h"
#include "core/base/text/wrap.h"

int rg_sheet_column(struct rg_sheet *sheet, const char *format, ...)
{
    const int column = sheet->column_count;
    if (column == RG_SHEET_COLUMNS) {
        sheet->incomplete = !rg_error("table '%s': more than %d columns; raise RG_SHEET_COLUMNS",
                                      sheet->title, RG_SHEET_COLUMNS);
        return column - 1;
    }
    va_list args;
    va_start(args, format);
    vsnprintf(sheet->columns[column], sizeof(sheet->columns[column]), format, args);
    va_end(args);
    return sheet->column_count++;
}

char (*rg_sheet_row(struct rg_sheet *sheet))[RG_SHEET_CELL]
{
    if (!rg_array_fit(&sheet->cells, &sheet->row_room, sheet->row_count + 1, sizeof(*sheet->cells),
                      "rows of a table")) {
        sheet->incomplete = true;
        return NULL;
    }
    memset(sheet->cells[sheet->row_count], 0, sizeof(*sheet->cells));
    return sheet->cells[sheet->row_count++];
}

void rg_sheet_note(struct rg_sheet *sheet, const char *format, ...)
{
    if (!rg_array_fit(&sheet->notes, &sheet->note_room, sheet->note_count + 1,
                      sizeof(*sheet->notes), "notes of a table")) {
        sheet->incomplete = true;
        return;
    }
    char *note = NULL;
    size_t size;
    FILE *text = open_memstream(&note, &size);
    va_list args;
    va_start(args, format);
    const bool printed = text && vfprintf(text, format, args) >= 0;
    va_end(args);
    if (text && fclose(text) == 0 && printed) {
        sheet->notes[sheet->note_count++] = note;
        return;
    }
    sheet->incomplete = !rg_harness_error("table '%s': no memory for a note", sheet->title);
    free(note);
}

void rg_sheet_free(struct rg_sheet *sheet)
{
    for (int n = 0; n < sheet->note_count; n++)
        free(sheet->notes[n]);
    free(sheet->cells);
    free(sheet->notes);
}

// --- Markdown, aligned for readers of plain text ---

// Column widths are multiples of this, so that a digit more or less in a new measurement does not
// shift the other columns.
enum { WIDTH_STEP = 8 };

static int width_of(const struct rg_sheet *sheet, int column)
{
    size_t widest = strlen(sheet->columns[column]);
    for (int r = 0; r < sheet->row_count; r++) {
        const size_t width = strlen(sheet->cells[r][column]);
        widest = width > widest ? width : widest;
    }
    const int step = sheet->width_step ? sheet->width_step : WIDTH_STEP;
    return ((int)widest + step - 1) / step * step;
}

int rg_sheet_width(const struct rg_sheet *sheet)
{
    int width = 1;
    for (int c = 0; c < sheet->column_count; c++)
        width += width_of(sheet, c) + 3;
    return width;
}

// Prints a cell, in a terminal colour if it has one, padded without colour.
static void print_md_cell(FILE *out, const char *code, int width, const char *text)
{
    const int length = (int)strlen(text);
    if (code)
        fprintf(out, "%*s%s%s\033[0m |", width - length + 1, "", code, text);
    else
        fprintf(out, " %*s |", width, text);
}

static void print_md_row(FILE *out, const struct rg_sheet *sheet, const int *widths, int row)
{
    fprintf(out, "|");
    for (int c = 0; c < sheet->column_count; c++) {
        const char *text = row < 0 ? sheet->columns[c] : sheet->cells[row][c];
        const bool is_painted = row >= 0 && sheet->paint; // a heading "error" is not painted
        print_md_cell(out, is_painted ? sheet->paint(text) : NULL, widths[c], text);
    }
    fprintf(out, "\n");
}

static void print_md_note(FILE *out, const char *note, int width)
{
    const char *next;
    for (const char *line = note; *line; line = next) {
        const int length = rg_wrap(line, width ? width - 2 : INT_MAX, &next);
        fprintf(out, "%s%.*s\n", line == note ? "- " : "  ", length, line);
    }
}

void rg_sheet_print_md(const struct rg_sheet *sheet, FILE *out)
{
    int widths[RG_SHEET_COLUMNS];
    for (int c = 0; c < sheet->column_count; c++)
        widths[c] = width_of(sheet, c);
    fprintf(out, "%.*s %s\n\n", sheet->level ? sheet->level : 2, "######", sheet->title);
    for (int n = 0; n < sheet->lead_count; n++)
        print_md_note(out, sheet->notes[n], sheet->note_width);
    fprintf(out, sheet->lead_count ? "\n" : "");
    print_md_row(out, sheet, widths, -1);
    for (int c = 0; c < sheet->column_count; c++) {
        fprintf(out, c ? "" : "|");
        for (int i = 0; i < widths[c] + 1; i++)
            fprintf(out, "-");
        fprintf(out, ":|");
    }
    fprintf(out, "\n");
    for (int r = 0; r < sheet->row_count; r++)
        print_md_row(out, sheet, widths, r);
    fprintf(out, sheet->note_count > sheet->lead_count || !sheet->level ? "\n" : "");
    for (int n = sheet->lead_count; n < sheet->note_count; n++)
        print_md_note(out, sheet->notes[n], sheet->note_width);
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

void rg_sheet_print_csv(const struct rg_sheet *sheet, FILE *out)
{
    for (int r = -1; r < sheet->row_count; r++) {
        for (int c = 0; c < sheet->column_count; c++) {
            fprintf(out, c ? "," : "");
            print_csv_cell(out, r < 0 ? sheet->columns[c] : sheet->cells[r][c]);
        }
        fprintf(out, "\n");
    }
}

// --- LaTeX: a tabular in a table, with the rules of booktabs ---

static void print_tex_text(FILE *out, const char *text)
{
    for (; *text; text++) {
        if (*text == '\\')
            fprintf(out, "\\textbackslash{}");
        else if (!strncmp(text, "+-", 2)) {
            fprintf(out, "$\\pm$");
            text++;
        } else if (strchr("^~", *text))
            fprintf(out, "\\%c{}", *text);
        else
            fprintf(out, strchr("_%&#${}", *text) ? "\\%c" : "%c", *text);
    }
}

void rg_sheet_print_tex(const struct rg_sheet *sheet, FILE *out)
{
    fprintf(out, "\\begin{table} %% \\usepackage{booktabs}\n\\caption{");
    print_tex_text(out, sheet->title);
    fprintf(out, "}\n\\centering\\footnotesize\n\\begin{tabular}{@{}");
    for (int c = 0; c < sheet->column_count; c++)
        fputc('r', out);
    fprintf(out, "@{}}\n\\toprule\n");
    for (int r = -1; r < sheet->row_count; r++) {
        for (int c = 0; c < sheet->column_count; c++) {
            fprintf(out, c ? " & " : "");
            print_tex_text(out, r < 0 ? sheet->columns[c] : sheet->cells[r][c]);
        }
        fprintf(out, r < 0 ? " \\\\\n\\midrule\n" : " \\\\\n");
    }
    fprintf(out, "\\bottomrule\n\\end{tabular}\n");
    for (int n = 0; n < sheet->note_count; n++) {
        fprintf(out, "\n\\noindent ");
        print_tex_text(out, sheet->notes[n]);
        fprintf(out, "\n");
    }
    fprintf(out, "\\end{table}\n");
}
