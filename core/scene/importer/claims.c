// What a file says about itself before it is parsed.
#include <stdlib.h>
#include <string.h>
#include <strings.h>

#include "core/scene/importer/importer.h"
#include "core/scene/mesh.h"

enum { HEADER_BYTES = 4096 };

struct claim {
    bool is_known, is_binding; // binding: a file with fewer faces is cut short
    int64_t vertices, faces;
};

// The start of the file as text that ends.
static void copy_header(const struct import *import, char header[HEADER_BYTES])
{
    const size_t bytes = import->size < HEADER_BYTES - 1 ? import->size : HEADER_BYTES - 1;
    memcpy(header, import->bytes, bytes);
    header[bytes] = 0;
}

// The number behind these words at the start of a line; 0 without them.
static int64_t number_after(const char *header, const char *words)
{
    const char *found = strstr(header, words);
    return found ? strtoll(found + strlen(words), NULL, 10) : 0;
}

static struct claim claim_of_ply(const struct import *import)
{
    char header[HEADER_BYTES];
    copy_header(import, header);
    char *end = strstr(header, "end_header");
    if (end)
        *end = 0;
    return (struct claim){end != NULL, end != NULL, number_after(header, "\nelement vertex "),
                          number_after(header, "\nelement face ")};
}

static struct claim claim_of_stl(const struct import *import)
{
    uint32_t faces;
    if (import->size < 84 || !memcmp(import->bytes, "solid", 5))
        return (struct claim){false, false, 0, 0};
    memcpy(&faces, import->bytes + 80, sizeof(faces));
    return (struct claim){true, true, 3 * (int64_t)faces, faces};
}

// OBJ promises nothing, but its lines can be counted: v is a vertex, f a face.
static struct claim count_of_obj(const struct import *import)
{
    struct claim claim = {true, false, 0, 0};
    const unsigned char *c = import->bytes, *end = c + import->size;
    while (c && end - c >= 2) {
        claim.vertices += c[0] == 'v' && c[1] == ' ';
        claim.faces += c[0] == 'f' && c[1] == ' ';
        c = memchr(c, '\n', (size_t)(end - c));
        c = c ? c + 1 : NULL;
    }
    // A face may be indented or end in a tab: Assimp will tell whether there are none.
    claim.faces = claim.faces ? claim.faces : 1;
    return claim;
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
        struct claim (*claim)(const struct import *);
    } formats[] = {{"ply", claim_of_ply}, {"stl", claim_of_stl}, {"obj", count_of_obj}};
    *faces = -1;
    for (size_t i = 0; i < sizeof(formats) / sizeof(formats[0]); i++) {
        if (strcasecmp(import->extension, formats[i].extension))
            continue;
        const struct claim claim = formats[i].claim(import);
        *faces = claim.is_binding ? claim.faces : -1;
        return claim.is_known ? import_check_count(import, claim.vertices, claim.faces) : true;
    }
    return true;
}
