// The numbers of faces and vertices that a file's header claims, read before parsing.
#define _GNU_SOURCE // memmem
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "core/scene/mesh/importer/importer.h"
#include "core/scene/mesh/mesh.h"

// Longer than any sensible header.
enum { HEADER_BYTES = 65536 };

struct claim {
    bool is_known, is_binding; // binding: a file with fewer faces is truncated
    int64_t vertices, faces;
};

// --- PLY ---

// Adds up the counts of the header's elements of any kind.
static int64_t read_elements(const char *header, struct claim *claim)
{
    static const char words[] = "\nelement ";
    int64_t sum = 0;
    for (const char *at = header; (at = strstr(at, words));) {
        at += strlen(words);
        const size_t name = strcspn(at, " \t\r\n");
        const int64_t count = strtoll(at + name, NULL, 10);
        if (count < 0 || count > RG_IMPORT_MAX_FILE_BYTES)
            return -1;
        sum += count;
        claim->vertices += name == 6 && !memcmp(at, "vertex", name) ? count : 0;
        claim->faces += name == 4 && !memcmp(at, "face", name) ? count : 0;
    }
    return sum;
}

static int64_t count_lines(const unsigned char *c, const unsigned char *end)
{
    int64_t lines = 0;
    for (bool blank = true; c < end; c++) {
        lines += blank && *c > ' ';
        blank = *c == '\n' || (blank && *c <= ' ');
    }
    return lines;
}

// Refuses headers without end, on which Assimp (5.2) loops, and truncated texts, whose last line it
// repeats.
static bool check_ply_header(struct import *import, const char *header)
{
    static const char *const words[] = {"ply",      "format ",  "comment",
                                        "obj_info", "element ", "property "};
    // Like Assimp, this skips any line before the first element. Assimp also accepts an element
    // after blanks, which is not counted here.
    bool in_elements = false;
    int number = 1;
    for (const char *line = header; *line; number++) {
        bool known = false;
        for (size_t i = 0; i < sizeof(words) / sizeof(words[0]); i++)
            known = known || !strncmp(line, words[i], strlen(words[i]));
        in_elements = in_elements || !strncmp(line, "element ", 8);
        const bool is_free = !in_elements && !(*line == ' ' || *line == '\t');
        if (!known && !is_free)
            return import_refuse(import, "line %d does not belong into its header; export it again",
                                 number);
        line += strcspn(line, "\n");
        line += *line == '\n';
    }
    return true;
}

static bool claim_of_ply(struct import *import, struct claim *claim)
{
    static const char end_words[] = "\nend_header";
    char header[HEADER_BYTES];
    const size_t bytes = import->size < HEADER_BYTES - 1 ? import->size : HEADER_BYTES - 1;
    memcpy(header, import->bytes, bytes);
    header[bytes] = 0;
    char *end = strstr(header, end_words);
    const char *rest = end ? end + strlen(end_words) : "";
    if (strncmp(header, "ply", 3) || rest[strspn(rest, " \t\r")] != '\n')
        return import_refuse(import, "does not begin with ply or has no end_header; copy or "
                                     "export it again");
    const unsigned char *body = import->bytes + (rest - header);
    *end = 0; // NOLINT: without `end` the rest is empty, and refused
    if (!check_ply_header(import, header))
        return false;
    if (strstr(header, "\nelement tristrips"))
        return import_refuse(import,
                             "holds strips of triangles, of which Assimp loses some; export "
                             "single triangles");
    const int64_t elements = read_elements(header, claim);
    if (elements < 0)
        return import_refuse(import, "its header does not count its elements; export it again");
    const bool is_text = strstr(header, "\nformat ascii ") != NULL;
    const unsigned char *file_end = import->bytes + import->size;
    const int64_t there = is_text ? count_lines(body, file_end) : file_end - body;
    *claim = (struct claim){true, true, claim->vertices, claim->faces};
    return import_check_count(import, claim->vertices, claim->faces) &&
           (there >= elements ||
            import_refuse(import,
                          "has %lld %s for the %lld elements of its header: it is cut "
                          "short; copy or export it again",
                          (long long)there, is_text ? "lines" : "bytes", (long long)elements));
}

// --- STL and OBJ ---

// Binary files may begin with "solid" like text ones, but their size matches their number of faces.
static bool claim_of_stl(struct import *import, struct claim *claim)
{
    uint32_t faces = 0;
    if (import->size >= 84)
        memcpy(&faces, import->bytes + 80, sizeof(faces));
    const bool is_text = import->size >= 5 && !memcmp(import->bytes, "solid", 5) &&
                         import->size != 84 + 50 * (uint64_t)faces;
    const size_t tail = import->size < 1024 ? import->size : 1024;
    if (is_text && !memmem(import->bytes + import->size - tail, tail, "endsolid", 8))
        return import_refuse(import, "does not end in endsolid: it is cut short; copy or export "
                                     "it again");
    if (!is_text && import->size >= 84)
        *claim = (struct claim){true, true, 3 * (int64_t)faces, faces};
    return true;
}

// OBJ has no header, but its lines can be counted: v is a vertex, f a face.
static bool count_of_obj(struct import *import, struct claim *claim)
{
    const unsigned char *c = import->bytes, *end = c + import->size;
    *claim = (struct claim){true, false, 0, 0};
    while (c && end - c >= 2) {
        claim->vertices += c[0] == 'v' && c[1] == ' ';
        claim->faces += c[0] == 'f' && c[1] == ' ';
        c = memchr(c, '\n', (size_t)(end - c));
        c = c ? c + 1 : NULL;
    }
    // A face may be indented or end in a tab; Assimp will notice if there are none.
    claim->faces = claim->faces ? claim->faces : 1;
    return true;
}

bool import_check_count(struct import *import, int64_t vertices, int64_t faces)
{
    if (faces > RG_MESH_MAX_FACES || vertices > 3 * RG_MESH_MAX_FACES)
        return import_refuse(import,
                             "%lld faces and %lld vertices would take %.0f MB; at most %d faces "
                             "are taken: decimate it first",
                             (long long)faces, (long long)vertices,
                             (double)faces * 12e-6 + (double)vertices * 24e-6, RG_MESH_MAX_FACES);
    if (faces < 1)
        return import_refuse(import, "no faces; a mesh needs at least one triangle (points and "
                                     "lines are left out)");
    return true;
}

bool import_check_claim(struct import *import, int64_t *faces)
{
    static const struct {
        const char *extension;
        bool (*claim)(struct import *, struct claim *);
    } formats[] = {{"ply", claim_of_ply}, {"stl", claim_of_stl}, {"obj", count_of_obj}};
    struct claim claim = {0};
    for (size_t i = 0; i < sizeof(formats) / sizeof(formats[0]); i++)
        if (!strcasecmp(import->extension, formats[i].extension) &&
            !formats[i].claim(import, &claim))
            return false;
    *faces = claim.is_binding ? claim.faces : -1;
    return !claim.is_known || import_check_count(import, claim.vertices, claim.faces);
}
