#include "tests/core/scene/mesh/rig.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/base/log.h"
#include "tests/core/scene/mesh/fault.h"
#include "tests/tools/expect.h"

// --- the box ---

const float box_positions[3 * BOX_VERTICES] = {-1, -2, -3, 2, -2, -3, -1, 4, -3, 2, 4, -3,
                                               -1, -2, 8,  2, -2, 8,  -1, 4, 8,  2, 4, 8};
const uint32_t box_indices[3 * BOX_FACES] = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                                             2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};

void put_bytes(struct bytes *file, const void *data, size_t size)
{
    assert_at_most(file->size + size, sizeof(file->data));
    memcpy(file->data + file->size, data, size);
    file->size += size;
}

void put_text(struct bytes *file, const char *format, ...)
{
    char text[4096];
    va_list args;
    va_start(args, format);
    const int length = vsnprintf(text, sizeof(text), format, args);
    va_end(args);
    assert_between(length, 0, sizeof(text) - 1);
    put_bytes(file, text, (size_t)length);
}

static void put_u16(struct bytes *file, unsigned int value)
{
    const uint16_t word = (uint16_t)value;
    put_bytes(file, &word, sizeof(word));
}

static void put_u32(struct bytes *file, size_t value)
{
    const uint32_t word = (uint32_t)value;
    put_bytes(file, &word, sizeof(word));
}

static void put_vertices(struct bytes *file, const char *before)
{
    for (int i = 0; i < BOX_VERTICES; i++)
        put_text(file, "%s%g %g %g\n", before, (double)box_positions[3 * i],
                 (double)box_positions[3 * i + 1], (double)box_positions[3 * i + 2]);
}

static void put_faces(struct bytes *file, const char *before, uint32_t first)
{
    for (int i = 0; i < BOX_FACES; i++)
        put_text(file, "%s%u %u %u\n", before, box_indices[3 * i] + first,
                 box_indices[3 * i + 1] + first, box_indices[3 * i + 2] + first);
}

static void write_obj(struct bytes *file)
{
    put_text(file, "# a box\nmtllib absent.mtl\no box\nusemtl absent\n");
    put_vertices(file, "v ");
    put_faces(file, "f ", 1);
}

static void write_off(struct bytes *file)
{
    put_text(file, "OFF\n# a box\n%d %d 0\n\n# corners\n", BOX_VERTICES, BOX_FACES);
    put_vertices(file, "");
    put_text(file, "# faces\n");
    put_faces(file, "3 ", 0);
}

static void put_ply_header(struct bytes *file, const char *format)
{
    put_text(file,
             "ply\nformat %s 1.0\nelement vertex %d\nproperty float x\nproperty float y\n"
             "property float z\nelement face %d\nproperty list uchar int vertex_indices\n"
             "end_header\n",
             format, BOX_VERTICES, BOX_FACES);
}

static void write_ply(struct bytes *file)
{
    put_ply_header(file, "ascii");
    put_vertices(file, "");
    put_faces(file, "3 ", 0);
}

static void write_binary_ply(struct bytes *file)
{
    put_ply_header(file, "binary_little_endian");
    put_bytes(file, box_positions, sizeof(box_positions));
    for (int i = 0; i < BOX_FACES; i++) {
        put_bytes(file, "\3", 1);
        put_bytes(file, box_indices + 3 * i, 3 * sizeof(uint32_t));
    }
}

static const float *corner(int i)
{
    return box_positions + 3 * box_indices[i];
}

// The normal of a face: -z, -z, z, z, -y, -y, y, y, -x, -x, x, x.
static void find_facet_normal(int face, float normal[3])
{
    for (int c = 0; c < 3; c++)
        normal[c] = c == 2 - face / 4 ? (float)(face / 2 % 2 * 2 - 1) : 0.0f;
}

static void write_stl(struct bytes *file)
{
    put_text(file, "solid box\n");
    for (int i = 0; i < 3 * BOX_FACES; i++) {
        float n[3];
        find_facet_normal(i / 3, n);
        if (i % 3 == 0)
            put_text(file, "facet normal %g %g %g\nouter loop\n", (double)n[0], (double)n[1],
                     (double)n[2]);
        put_text(file, "vertex %g %g %g\n", (double)corner(i)[0], (double)corner(i)[1],
                 (double)corner(i)[2]);
        if (i % 3 == 2)
            put_text(file, "endloop\nendfacet\n");
    }
    put_text(file, "endsolid box\n");
}

static void write_binary_stl(struct bytes *file)
{
    static const char header[80] = "a box";
    put_bytes(file, header, sizeof(header));
    put_u32(file, BOX_FACES);
    for (int i = 0; i < 3 * BOX_FACES; i++) {
        float normal[3];
        find_facet_normal(i / 3, normal);
        if (i % 3 == 0)
            put_bytes(file, normal, sizeof(normal));
        put_bytes(file, corner(i), 3 * sizeof(float));
        if (i % 3 == 2)
            put_u16(file, 0);
    }
}

// A glTF scene whose one buffer holds the positions, then the indices.
static void put_gltf(struct bytes *file, const char *buffer_uri)
{
    put_text(file,
             "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],"
             "\"nodes\":[{\"mesh\":0}],"
             "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1,"
             "\"material\":0}]}],"
             "\"materials\":[{\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0}}}],"
             "\"textures\":[{\"source\":0}],\"images\":[{\"uri\":\"absent.png\"}],"
             "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":%d,"
             "\"type\":\"VEC3\",\"min\":[-1,-2,-3],\"max\":[2,4,8]},"
             "{\"bufferView\":1,\"componentType\":5125,\"count\":%d,\"type\":\"SCALAR\"}],"
             "\"bufferViews\":[{\"buffer\":0,\"byteLength\":%zu},"
             "{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu}],"
             "\"buffers\":[{%s\"byteLength\":%zu}]}",
             BOX_VERTICES, 3 * BOX_FACES, sizeof(box_positions), sizeof(box_positions),
             sizeof(box_indices), buffer_uri, sizeof(box_positions) + sizeof(box_indices));
}

static void write_gltf(struct bytes *file)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    unsigned char buffer[sizeof(box_positions) + sizeof(box_indices)];
    char uri[400] = "\"uri\":\"data:application/octet-stream;base64,", *to = uri + strlen(uri);
    memcpy(buffer, box_positions, sizeof(box_positions));
    memcpy(buffer + sizeof(box_positions), box_indices, sizeof(box_indices));
    for (size_t i = 0; i < sizeof(buffer); i += 3) { // 240 bytes: no padding
        const unsigned int bits =
            (unsigned int)(buffer[i] << 16 | buffer[i + 1] << 8 | buffer[i + 2]);
        for (int shift = 18; shift >= 0; shift -= 6)
            *to++ = digits[bits >> shift & 63];
    }
    memcpy(to, "\",", 3);
    put_gltf(file, uri);
}

static void write_glb(struct bytes *file)
{
    struct bytes scene = {0};
    put_gltf(&scene, "");
    while (scene.size % 4)
        put_text(&scene, " ");
    const size_t buffer = sizeof(box_positions) + sizeof(box_indices);
    put_text(file, "glTF");
    put_u32(file, 2);
    put_u32(file, 12 + 8 + scene.size + 8 + buffer);
    put_u32(file, scene.size);
    put_text(file, "JSON");
    put_bytes(file, scene.data, scene.size);
    put_u32(file, buffer);
    put_bytes(file, "BIN", 4);
    put_bytes(file, box_positions, sizeof(box_positions));
    put_bytes(file, box_indices, sizeof(box_indices));
}

// Nested chunks; each begins with its kind and its size, which includes this head.
static void write_3ds(struct bytes *file)
{
    const size_t vertices = 8 + sizeof(box_positions), faces = 8 + 8 * BOX_FACES;
    const struct {
        unsigned int kind;
        size_t size;
    } chunks[] = {{0x4d4d, 6 + 6 + 6 + 4 + 6 + vertices + faces},
                  {0x3d3d, 6 + 6 + 4 + 6 + vertices + faces},
                  {0x4000, 6 + 4 + 6 + vertices + faces},
                  {0x4100, 6 + vertices + faces},
                  {0x4110, vertices},
                  {0x4120, faces}};
    for (size_t i = 0; i < COUNT_OF(chunks); i++) {
        put_u16(file, chunks[i].kind);
        put_u32(file, chunks[i].size);
        if (chunks[i].kind == 0x4000)
            put_bytes(file, "box", 4);
        if (chunks[i].kind == 0x4110) {
            put_u16(file, BOX_VERTICES);
            put_bytes(file, box_positions, sizeof(box_positions));
        }
    }
    put_u16(file, BOX_FACES);
    for (int i = 0; i < BOX_FACES; i++) {
        for (int k = 0; k < 3; k++)
            put_u16(file, box_indices[3 * i + k]);
        put_u16(file, 0);
    }
}

const struct box_format box_formats[] = {
    {"OBJ", "obj", write_obj},    {"OFF", "off", write_off},
    {"PLY", "ply", write_ply},    {"binary PLY", "ply", write_binary_ply},
    {"STL", "stl", write_stl},    {"binary STL", "stl", write_binary_stl},
    {"glTF", "gltf", write_gltf}, {"GLB", "glb", write_glb},
    {"3DS", "3ds", write_3ds},
};
const int box_format_count = COUNT_OF(box_formats);

// --- files ---

char folder[] = "/tmp/raingauge-mesh-XXXXXX";

int make_folder(void **state)
{
    (void)state;
    return mkdtemp(folder) ? 0 : -1;
}

int remove_folder(void **state)
{
    (void)state;
    return rmdir(folder);
}

const char *in_folder(const char *name)
{
    static char path[256];
    snprintf(path, sizeof(path), "%s/%s", folder, name);
    return path;
}

void write_file(const char *path, const void *data, size_t size)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(data, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

// --- lines ---

struct lines lines;

static void listen(enum rg_log_level level, const char *line, void *user)
{
    (void)level;
    (void)user;
    lines.count++;
    snprintf(lines.last, sizeof(lines.last), "%s", line);
}

void listen_now(void)
{
    lines = (struct lines){0};
    rg_log_listen(listen, NULL);
}

void expect_refused(const char *path, const char *why)
{
    listen_now();
    struct rg_mesh *mesh = rg_mesh_load(path);
    rg_log_listen(NULL, NULL);
    if (mesh || lines.count != 1 || !strstr(lines.last, path) || !strstr(lines.last, why))
        fail_msg("%s: %s, %d lines, the last: %s", path, mesh ? "loaded" : "refused", lines.count,
                 lines.last);
}

void expect_bytes_refused(const char *name, const struct bytes *file, const char *why)
{
    const char *path = in_folder(name);
    write_file(path, file->data, file->size);
    expect_refused(path, why);
    unlink(path);
}

void expect_text_refused(const char *name, const char *text, const char *why)
{
    struct bytes file = {0};
    put_text(&file, "%s", text);
    expect_bytes_refused(name, &file, why);
}

struct rg_mesh *load_bytes(const char *name, const struct bytes *file)
{
    const char *path = in_folder(name);
    write_file(path, file->data, file->size);
    listen_now();
    struct rg_mesh *mesh = rg_mesh_load(path);
    rg_log_listen(NULL, NULL);
    unlink(path);
    if (!mesh || lines.count)
        fail_msg("%s: %d lines, the last: %s", name, lines.count, lines.last);
    assert_string_equal(mesh->name, name);
    check_mesh(mesh);
    return mesh;
}

struct rg_mesh *load_text(const char *name, const char *text)
{
    struct bytes file = {0};
    put_text(&file, "%s", text);
    return load_bytes(name, &file);
}

void check_mesh(const struct rg_mesh *mesh)
{
    assert_non_null(mesh);
    const char *fault = mesh_fault(mesh);
    if (fault)
        fail_msg("%s: %s", mesh->name, fault);
}
