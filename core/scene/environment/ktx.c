#include "core/scene/environment/ktx.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

#include "core/base/files/file.h"
#include "core/base/log.h"
#include "core/scene/environment/cube.h"
#include "kernels/dialect/image/memory.h"

// The header of a KTX 1 file, after its 12 bytes of identifier, in the file's order.
struct ktx_header {
    uint32_t endianness, type, type_size, format, internal_format, base_internal_format;
    uint32_t width, height, depth, array_elements, faces, levels, key_value_bytes;
};

enum {
    KTX_SAME_ENDIAN = 0x04030201,
    GL_R11F_G11F_B10F_FORMAT = 0x8c3a,
    MAX_FACE_PX = 4096,
    MAX_KEY_VALUE_BYTES = 1 << 20
};

static const unsigned char identifier[12] = {0xab, 'K',  'T',  'X',  ' ',  '1',
                                             '1',  0xbb, '\r', '\n', 0x1a, '\n'};

static bool check_header(const char *path, const unsigned char *magic, const struct ktx_header *h)
{
    if (memcmp(magic, identifier, sizeof(identifier)))
        return rg_error("%s: not a KTX 1 file; convert it, or give an EXR or HDR image", path);
    if (h->endianness != KTX_SAME_ENDIAN)
        return rg_error("%s: a KTX file of the other byte order; write it little-endian", path);
    if (h->faces != 6 || h->array_elements || h->depth)
        return rg_error("%s: a KTX file of %u faces; a cube map has 6", path, h->faces);
    if (h->internal_format != GL_R11F_G11F_B10F_FORMAT)
        return rg_error("%s: texels of OpenGL format 0x%x; only R11F_G11F_B10F (0x8c3a) is read",
                        path, h->internal_format);
    if (h->width != h->height || h->width < 1 || h->width > MAX_FACE_PX)
        return rg_error("%s: faces of %ux%u texels; they must be square, 1 to %d", path, h->width,
                        h->height, MAX_FACE_PX);
    if (h->key_value_bytes > MAX_KEY_VALUE_BYTES)
        return rg_error("%s: damaged: %u bytes of key-value data", path, h->key_value_bytes);
    return true;
}

static void unpack(uint32_t texel, float light[3])
{
    rgba c = rg_load_RG11B10F(&texel, 0);
    light[0] = c.r;
    light[1] = c.g;
    light[2] = c.b;
}

static bool read_faces(FILE *file, struct rg_environment *environment)
{
    const int size = environment->size;
    uint32_t face_bytes;
    if (fread(&face_bytes, 4, 1, file) != 1 || face_bytes != (uint32_t)(size * size * 4))
        return false;
    uint32_t row[MAX_FACE_PX];
    for (int face = 0; face < 6; face++) {
        for (int y = 0; y < size; y++) {
            if (fread(row, 4, (size_t)size, file) != (size_t)size)
                return false;
            for (int x = 0; x < size; x++)
                unpack(row[x], rg_environment_texel(environment, face, x, y));
        }
    }
    return true;
}

static struct rg_environment *read_file(const char *path, FILE *file)
{
    unsigned char magic[12];
    struct ktx_header header;
    if (fread(magic, sizeof(magic), 1, file) != 1 || fread(&header, sizeof(header), 1, file) != 1)
        return rg_error_null("%s: too short for a KTX file; it is truncated or empty", path);
    if (!check_header(path, magic, &header))
        return NULL;
    struct rg_environment *environment = rg_environment_create((int)header.width);
    if (!environment)
        return NULL;
    if (fseek(file, (long)header.key_value_bytes, SEEK_CUR) || !read_faces(file, environment)) {
        rg_environment_destroy(environment);
        return rg_error_null("%s: truncated: it does not hold six faces of %ux%u texels", path,
                             header.width, header.height);
    }
    rg_environment_close_borders(environment);
    return environment;
}

struct rg_environment *rg_ktx_read(const char *path)
{
    const char *why;
    FILE *file = rg_file_open(path, &why);
    if (!file) {
        rg_system_error(errno, "%s: cannot be opened: %s", path, why);
        return NULL;
    }
    struct rg_environment *environment = read_file(path, file);
    fclose(file);
    return environment;
}
