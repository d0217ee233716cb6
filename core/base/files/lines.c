#include "core/base/files/lines.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/base/array.h"
#include "core/base/files/file.h"
#include "core/base/log.h"
#include "core/base/text/mark.h"
#include "core/base/text/plain.h"

enum { MOST_BYTES = 64 << 20 };

static bool is_blank(char c)
{
    return c == ' ' || c == '\t';
}

char *rg_line_skip(char *text)
{
    while (is_blank(*text))
        text++;
    return text;
}

char *rg_line_cut(char *text)
{
    char *end = text + strcspn(text, " \t");
    char *rest = rg_line_skip(end);
    *end = 0;
    return rest;
}

bool rg_line_is_empty(const struct rg_line *line)
{
    const char *text = rg_line_skip(line->text);
    return !*text || *text == '#';
}

char *rg_lines_next(const struct rg_lines *lines, int64_t *at, char place[RG_LINES_PLACE])
{
    while (++*at < lines->count && rg_line_is_empty(&lines->lines[*at]))
        ;
    if (*at >= lines->count)
        return NULL;
    snprintf(place, RG_LINES_PLACE, "%.400s:%lld", lines->name, (long long)*at + 1);
    return lines->lines[*at].text;
}

static bool is_clean(const struct rg_lines *lines, const char *text, size_t length)
{
    for (size_t i = 0; i < length; i++)
        if (rg_control_at(text + i) >= 0 && text[i] != '\t')
            return rg_error("%s:%lld: control character 0x%02x in column %zu; take it out",
                            lines->name, (long long)lines->count + 1,
                            (unsigned)rg_control_at(text + i), i + 1);
    return true;
}

// Adds the line that begins at `at`. False if it is refused.
static bool add_line(struct rg_lines *lines, size_t at)
{
    char *text = lines->texts + at;
    const char *end = memchr(text, '\n', lines->size - at);
    size_t length = end ? (size_t)(end - text) : lines->size - at;
    const size_t whole = length + (end != NULL);
    length -= end && length > 0 && text[length - 1] == '\r';
    if (!is_clean(lines, text, length) ||
        !rg_array_fit(&lines->lines, &lines->room, lines->count + 1, sizeof(*lines->lines),
                      lines->name))
        return false;
    while (length > 0 && is_blank(text[length - 1]))
        length--;
    text[length] = 0;
    lines->lines[lines->count++] = (struct rg_line){text, at, whole};
    return true;
}

// Skips a byte order mark in the first line's text. `raw` keeps it, because the bytes may be
// written back.
static void skip_mark(struct rg_lines *lines)
{
    if (lines->count)
        lines->lines[0].text += rg_mark_bytes(lines->texts, lines->size);
}

static bool split(struct rg_lines *lines)
{
    for (size_t at = 0; at < lines->size;) {
        if (!add_line(lines, at))
            return false;
        at += lines->lines[lines->count - 1].length;
    }
    skip_mark(lines);
    return true;
}

bool rg_lines_of(const char *name, const char *text, size_t size, struct rg_lines *lines)
{
    *lines = (struct rg_lines){.size = size, .name = strdup(name)};
    lines->raw = rg_alloc(1, size + 1, name);
    lines->texts = rg_alloc(1, size + 1, name);
    if (!lines->name)
        return rg_harness_error("%s: no memory for its name; close other programs", name);
    if (!lines->raw || !lines->texts)
        return false;
    memcpy(lines->raw, text, size);
    memcpy(lines->texts, text, size);
    return split(lines);
}

// Reads the whole file into memory that the caller frees; NULL on failure.
static char *read_bytes(const char *path, FILE *in, size_t *size)
{
    char *bytes = NULL;
    int64_t room = 0;
    *size = 0;
    for (size_t got = 1; got > 0; *size += got) {
        if (*size > MOST_BYTES)
            rg_error("%s: longer than %d bytes; split it", path, MOST_BYTES);
        if (*size > MOST_BYTES ||
            !rg_array_fit(&bytes, &room, (int64_t)*size + BUFSIZ, 1, "a text file")) {
            free(bytes);
            return NULL;
        }
        got = fread(bytes + *size, 1, BUFSIZ, in);
    }
    if (ferror(in)) {
        rg_system_error(errno, "%s: %s; name a text file that can be read", path, strerror(errno));
        free(bytes);
        return NULL;
    }
    return bytes;
}

bool rg_lines_read(const char *path, struct rg_lines *lines)
{
    *lines = (struct rg_lines){.count = 0};
    const char *why;
    FILE *in = rg_file_open(path, &why);
    if (!in)
        return rg_system_error(errno, "%s: %s; name a text file that can be read", path, why);
    size_t size;
    char *bytes = read_bytes(path, in, &size);
    const bool ok = bytes && rg_lines_of(path, bytes, size, lines);
    free(bytes);
    fclose(in);
    return ok;
}

void rg_lines_free(struct rg_lines *lines)
{
    free(lines->name);
    free(lines->raw);
    free(lines->texts);
    free(lines->lines);
    *lines = (struct rg_lines){.count = 0};
}
