// A text file as lines that know where they stand.
#ifndef RG_HARNESS_COMPARE_GATE_TEXT_LINES_H
#define RG_HARNESS_COMPARE_GATE_TEXT_LINES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct rg_line {
    char *text;    // without its end and what is blank before that
    size_t at;     // of its first byte in `raw`
    size_t length; // in `raw`, with its end
};

struct rg_lines {
    char *name; // the file's
    char *raw;  // its bytes as they are
    size_t size;
    int64_t count, room;
    struct rg_line *lines;
    char *texts; // what the lines' texts lie in
};

// Reads a file of up to 64 MiB; line ends are LF or CR LF, and the last line may have none. False,
// and one logged line with the file and the line, where it cannot be read or has a control
// character other than a tab. The caller calls rg_lines_free in either case.
bool rg_lines_read(const char *path, struct rg_lines *lines);
// The same of a text in memory, which is copied. `name` stands for the file in messages.
bool rg_lines_of(const char *name, const char *text, size_t size, struct rg_lines *lines);
void rg_lines_free(struct rg_lines *lines);

// Whether a line says nothing: it is blank, or its first character that is not blank is a #.
bool rg_line_is_empty(const struct rg_line *line);
// Skips blanks.
char *rg_line_skip(char *text);
// Cuts the first word off: ends it, and returns what follows behind the blanks.
char *rg_line_cut(char *text);

#endif
