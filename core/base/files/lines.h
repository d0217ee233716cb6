// A text file as lines with their positions.
#ifndef RG_CORE_BASE_FILES_LINES_H
#define RG_CORE_BASE_FILES_LINES_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct rg_line {
    char *text;    // without its line end and trailing blanks
    size_t at;     // position of its first byte in `raw`
    size_t length; // in `raw`, with its end
};

struct rg_lines {
    char *name; // of the file
    char *raw;  // the bytes as read
    size_t size;
    int64_t count, room;
    struct rg_line *lines;
    char *texts; // memory of the lines' texts
};

// Reads a file of up to 64 MiB; lines end in LF or CR LF, the last one may have no end. False, and
// one logged line with file and line, if it cannot be read or has a control character other than a
// tab. The caller calls rg_lines_free in either case.
bool rg_lines_read(const char *path, struct rg_lines *lines);
// The same for a text in memory, which is copied. `name` is the file's name in messages.
bool rg_lines_of(const char *name, const char *text, size_t size, struct rg_lines *lines);
void rg_lines_free(struct rg_lines *lines);

// The next line after number `at`, from -1 on, that is neither blank nor a comment, and its place
// for messages, "FILE:LINE". NULL: none is left.
enum { RG_LINES_PLACE = 440 };
char *rg_lines_next(const struct rg_lines *lines, int64_t *at, char place[RG_LINES_PLACE]);
// Whether a line is blank or a comment, whose first character after blanks is a #.
bool rg_line_is_empty(const struct rg_line *line);
// Skips blanks.
char *rg_line_skip(char *text);
// Ends the first word and returns the text after the blanks that follow it.
char *rg_line_cut(char *text);

#endif
