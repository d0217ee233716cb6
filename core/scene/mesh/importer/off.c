// Rewrites OFF files as OBJ for Assimp. Its own reader of OFF (5.2) takes comments for data, clamps
// bad indices, loses polygons of ten corners and crashes on short files.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/scene/mesh/importer/importer.h"
#include "core/scene/mesh/mesh.h"

// The lines of a text without comments and blank lines; the byte at `end` is writable.
struct text {
    char *next, *end;
    int line; // number of the last one, from 1
};

// The next line, ended by a 0; NULL after the last.
static char *next_line(struct text *text)
{
    while (text->next < text->end) {
        char *line = text->next, *line_end = memchr(line, '\n', (size_t)(text->end - line));
        line_end = line_end ? line_end : text->end;
        *line_end = 0;
        text->next = line_end + 1;
        text->line++;
        line[strcspn(line, "#\r")] = 0;
        line += strspn(line, " \t");
        if (*line)
            return line;
    }
    return NULL;
}

// "OFF", with prefixes for vertices with texture coordinates, colours or normals, which are
// ignored; then the counts, on this line or the next.
static bool read_header(struct import *import, struct text *text, int64_t *vertices, int64_t *faces)
{
    char *line = next_line(text);
    if (line) {
        line += strspn(line, "STCN");
        if (strncmp(line, "OFF", 3) || strstr(line, "BINARY"))
            return import_refuse(import, "does not begin with OFF, or is not text in three "
                                         "dimensions; export it again");
        line += 3 + strspn(line + 3, " \t");
        line = *line ? line : next_line(text);
    }
    char *rest = line;
    *vertices = line ? strtoll(line, &rest, 10) : -1;
    *faces = line ? strtoll(rest, &rest, 10) : -1;
    if (*vertices < 0 || *faces < 0)
        return import_refuse(import, "line %d does not count vertices and faces; export it again",
                             text->line);
    return import_check_count(import, *vertices, *faces);
}

static bool copy_vertex(struct import *import, struct text *text, FILE *obj)
{
    double values[3];
    char *line = next_line(text);
    if (!line)
        return import_refuse(
            import, "ends within its vertices, at line %d; copy or export it again", text->line);
    for (int c = 0; c < 3; c++) {
        char *rest;
        values[c] = strtod(line, &rest);
        if (rest == line)
            return import_refuse(import, "line %d does not begin with three coordinates; repair it",
                                 text->line);
        line = rest;
    }
    fprintf(obj, "v %.17g %.17g %.17g\n", values[0], values[1], values[2]);
    return true;
}

static bool copy_face(struct import *import, struct text *text, int64_t vertices, FILE *obj)
{
    char *line = next_line(text), *rest = NULL;
    if (!line)
        return import_refuse(import, "ends within its faces, at line %d; copy or export it again",
                             text->line);
    const long corners = strtol(line, &rest, 10);
    const char *separator = corners > 2 ? "f " : NULL; // points and lines are dropped
    for (long i = 0; i < corners; i++) {
        line = rest;
        const long long index = strtoll(line, &rest, 10);
        if (rest == line)
            return import_refuse(import, "line %d has %ld of a face's %ld vertices; repair it",
                                 text->line, i, corners);
        if (index < 0 || index >= vertices)
            return import_refuse(import,
                                 "line %d names vertex %lld, but there are %lld, from 0 "
                                 "on; repair it",
                                 text->line, index, (long long)vertices);
        if (separator)
            fprintf(obj, "%s%lld", separator, index + 1);
        separator = separator ? " " : NULL;
    }
    if (separator)
        fputc('\n', obj);
    return true;
}

static bool copy(struct import *import, struct text *text, FILE *obj)
{
    int64_t vertices = 0, faces = 0;
    if (!read_header(import, text, &vertices, &faces))
        return false;
    for (int64_t i = 0; i < vertices; i++)
        if (!copy_vertex(import, text, obj))
            return false;
    for (int64_t i = 0; i < faces; i++)
        if (!copy_face(import, text, vertices, obj))
            return false;
    return true;
}

bool import_off_as_obj(struct import *import)
{
    char *result = NULL, *bytes = (char *)import->bytes;
    size_t size = 0;
    FILE *obj = open_memstream(&result, &size);
    struct text text = {bytes, bytes + import->size, 0};
    const bool copied = obj && copy(import, &text, obj);
    const bool closed = obj && !fclose(obj);
    if (!closed)
        import_refuse(import, "no memory to read it; decimate it first");
    if (!copied || !closed) {
        free(result);
        return false;
    }
    free(import->bytes);
    import->bytes = (unsigned char *)result;
    import->size = size;
    import_name(import, "off.obj");
    return true;
}
