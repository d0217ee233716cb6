// Meshes from files: a box is the same in every format, and damaged files are refused in one line.
#include "tests/core/scene/mesh/rig.h"

#include <dirent.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/base/log.h"
#include "core/base/memory.h"
#include "core/scene/mesh/read.h"
#include "tests/tools/expect.h"

static const char *fuzz_folder; // the program's argument

static bool same_corner(const float *a, const float *b)
{
    return a[0] == b[0] && a[1] == b[1] && a[2] == b[2];
}

// Whether a mesh's face is this face of the box, whichever corner comes first. `turned` is for 3DS,
// whose z points up where our y does, and which Assimp turns.
static bool is_face(const struct rg_mesh *mesh, int face, int box_face, bool turned)
{
    float box[3][3];
    for (int k = 0; k < 3; k++) {
        const float *p = box_positions + 3 * box_indices[3 * box_face + k];
        box[k][0] = p[0];
        box[k][1] = turned ? p[2] : p[1];
        box[k][2] = turned ? -p[1] : p[2];
    }
    for (int first = 0; first < 3; first++) {
        bool same = true;
        for (int k = 0; k < 3; k++)
            same &= same_corner(mesh->positions + 3 * mesh->indices[3 * face + k],
                                box[(first + k) % 3]);
        if (same)
            return true;
    }
    return false;
}

static void test_one_box_in_every_format(void **state)
{
    (void)state;
    struct rg_mesh *plain =
        rg_mesh_create("box", BOX_VERTICES, BOX_FACES, box_positions, NULL, box_indices);
    check_mesh(plain);
    for (int i = 0; i < box_format_count; i++) {
        const bool turned = !strcmp(box_formats[i].name, "3DS");
        struct bytes file = {0};
        char name[32];
        box_formats[i].write(&file);
        snprintf(name, sizeof(name), "box.%s", box_formats[i].extension);
        struct rg_mesh *mesh = load_bytes(name, &file);
        assert_int_equal(mesh->face_count, BOX_FACES);
        for (int face = 0; face < BOX_FACES; face++)
            if (!is_face(mesh, face, face, turned))
                fail_msg("%s: face %d is another one", box_formats[i].name, face);
        if (!turned) { // Assimp makes 3DS's normals itself, by smoothing groups
            assert_int_equal(mesh->vertex_count, BOX_VERTICES);
            assert_memory_equal(mesh->normals, plain->normals, 3 * BOX_VERTICES * sizeof(float));
            assert_equals(mesh->hash, plain->hash);
        }
        rg_mesh_destroy(mesh);
    }
    rg_mesh_destroy(plain);
}

static void test_polygons_points_and_lines(void **state)
{
    (void)state;
    // A quad, a pentagon that bends inwards, a line, a point, and a vertex without a face.
    struct rg_mesh *mesh =
        load_text("polygons.obj", "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 1 0.5 0\nv 9 9 9\n"
                                  "f 1 2 3 4\nf 1 2 3 5 4\nl 1 3\np 2\n");
    assert_int_equal(mesh->face_count, 2 + 3);
    assert_int_equal(mesh->vertex_count, 5);
    for (int i = 0; i < mesh->vertex_count; i++)
        assert_equals(mesh->normals[3 * i + 2], 1.0f);
    rg_mesh_destroy(mesh);
}

static void test_normals_of_the_file_are_kept(void **state)
{
    (void)state;
    // Normals of length 2, of length 0 (absent), and not a number.
    struct rg_mesh *mesh =
        load_text("normals.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 2 0 0\nvn 0 0 0\n"
                                 "vn nan 0 0\nf 1//1 2//2 3//3\n");
    static const float expected[9] = {1, 0, 0, 0, 0, 1, 0, 0, 1};
    assert_memory_equal(mesh->normals, expected, sizeof(expected));
    rg_mesh_destroy(mesh);
}

// Two nodes place one mesh: rotated and enlarged, and mirrored.
static void test_nodes_place_meshes(void **state)
{
    (void)state;
    static const float triangle[18] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0, 0, 1};
    struct bytes file = {0};
    put_text(&file,
             "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0,1]}],"
             "\"nodes\":[{\"children\":[2],\"translation\":[10,0,0]},"
             "{\"mesh\":0,\"scale\":[-1,1,1]},"
             "{\"mesh\":0,\"scale\":[2,2,2],\"rotation\":[0,0.70710678,0,0.70710678]}],"
             "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"NORMAL\":1}}]}],"
             "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,"
             "\"type\":\"VEC3\",\"min\":[0,0,0],\"max\":[1,1,0]},"
             "{\"bufferView\":0,\"byteOffset\":36,\"componentType\":5126,\"count\":3,"
             "\"type\":\"VEC3\"}],\"bufferViews\":[{\"buffer\":0,\"byteLength\":72}],"
             "\"buffers\":[{\"uri\":\"nodes.bin\",\"byteLength\":72}]}");
    char buffer[256];
    snprintf(buffer, sizeof(buffer), "%s", in_folder("nodes.bin"));
    write_file(buffer, triangle, sizeof(triangle));
    struct rg_mesh *mesh = load_bytes("nodes.gltf", &file);
    unlink(buffer);
    // Rotated about y by 90 degrees: x goes to -z, z to x. Then mirrored, with its corners in
    // reverse.
    static const float expected[18] = {10, 0, 0, 10, 0, -2, 10, 2, 0, 0, 1, 0, -1, 0, 0, 0, 0, 0};
    assert_int_equal(mesh->face_count, 2);
    for (int i = 0; i < 6; i++) {
        const uint32_t vertex = mesh->indices[i];
        for (int c = 0; c < 3; c++) {
            assert_below(fabsf(mesh->positions[3 * vertex + (uint32_t)c] - expected[3 * i + c]),
                         1e-5f);
            assert_below(
                fabsf(mesh->normals[3 * vertex + (uint32_t)c] - (float)(c == (i < 3 ? 0 : 2))),
                1e-6f);
        }
    }
    rg_mesh_destroy(mesh);
    expect_bytes_refused("nodes.gltf", &file, "nodes.bin");
}

static void test_the_hash_is_the_geometrys(void **state)
{
    (void)state;
    static const char *const text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    struct rg_mesh *mesh = load_text("a.obj", text), *again = load_text("b.obj", text);
    struct rg_mesh *moved = load_text("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1.0000001 0\nf 1 2 3\n");
    struct rg_mesh *turned = load_text("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 3 2 1\n");
    // XXH3 of nine floats and the indices 0, 1, 2, by the program xxhsum.
    assert_equals(mesh->hash, UINT64_C(0xa28a642a01fc25be));
    assert_equals(again->hash, mesh->hash);
    assert_differs(moved->hash, mesh->hash);
    assert_differs(turned->hash, mesh->hash);
    rg_mesh_destroy(mesh);
    rg_mesh_destroy(again);
    rg_mesh_destroy(moved);
    rg_mesh_destroy(turned);
}

// --- what is refused ---

static void test_what_is_no_file(void **state)
{
    (void)state;
    expect_refused(in_folder("absent.obj"), "No such file");
    expect_refused("/dev/null", "not a regular file");
    char path[256];
    snprintf(path, sizeof(path), "%s", in_folder("folder.obj"));
    assert_int_equal(mkdir(path, 0700), 0);
    expect_refused(path, "folder");
    rmdir(path);
    snprintf(path, sizeof(path), "%s", in_folder("pipe.obj"));
    assert_int_equal(mkfifo(path, 0600), 0);
    expect_refused(path, "not a regular file");
    unlink(path);
    expect_text_refused("empty.obj", "", "is empty");
    snprintf(path, sizeof(path), "%s", in_folder("large.obj"));
    write_file(path, "", 0);
    assert_int_equal(truncate(path, ((off_t)1 << 30) + 1), 0);
    expect_refused(path, "1073741825 bytes; at most 1073741824");
    unlink(path);
}

// The memory to read a file is checked against the limit before the read.
static void test_no_memory_to_read_it(void **state)
{
    (void)state;
    char path[256];
    snprintf(path, sizeof(path), "%s", in_folder("zeroes.ply"));
    write_file(path, "", 0);
    assert_int_equal(truncate(path, 20 << 20), 0);
    rg_memory_allow(((int64_t)80 << 20) - 1);
    expect_refused(path, "zeroes.ply needs 80 MiB, and 80 MiB of --memory are left");
    rg_memory_allow((int64_t)80 << 20);
    listen_now();
    assert_null(rg_mesh_read(path, NULL)); // for another reason
    assert_null(strstr(lines.last, "--memory"));
    rg_memory_allow((int64_t)64 << 30);
    unlink(path);
}

static void test_what_is_no_mesh(void **state)
{
    (void)state;
    expect_text_refused("text.obj", "Dear reader,\nthis is a letter.\n", "");
    expect_text_refused("text.ply", "Dear reader,\n", "does not begin with ply");
    expect_text_refused("text.stl", "Dear reader,\n", "Assimp cannot read it");
    expect_text_refused("text.off", "Dear reader,\n", "does not begin with OFF");
    expect_text_refused("text.gltf", "Dear reader,\n", "Assimp cannot read it");
    expect_text_refused("text.xyzzy", "Dear reader,\n", "use a sound OBJ, PLY, STL");
    expect_text_refused("noextension.", "Dear reader,\n", "Assimp cannot read it");
}

static void test_strips(void **state)
{
    (void)state;
    expect_text_refused("strip.ply",
                        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\n"
                        "property float y\nproperty float z\nelement tristrips 1\n"
                        "property list int int vertex_indices\nend_header\n"
                        "0 0 0\n1 0 0\n0 1 0\n1 1 0\n4 0 1 2 3\n",
                        "strips of triangles");
}

static void test_no_faces(void **state)
{
    (void)state;
    expect_text_refused("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\np 1\nl 1 2\n", "no faces");
    expect_text_refused("zero.off", "OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n", "no faces");
    expect_text_refused("zero.ply",
                        "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\n"
                        "property float y\nproperty float z\nelement face 0\n"
                        "property list uchar int vertex_indices\nend_header\n0 0 0\n",
                        "no faces");
    static const struct bytes stl = {84, {0}};
    expect_bytes_refused("zero.stl", &stl, "no faces");
}

static void test_coordinates_that_are_none(void **state)
{
    (void)state;
    static const char *const rest = "v 1 0 0\nv 0 1 0\nf 1 2 3\n";
    char text[256];
    static const char *const values[][2] = {
        {"v nan 0 0", "vertex 0 of mesh 0 lies at (nan, 0, 0)"},
        {"v 0 inf 0", "vertex 0 of mesh 0 lies at (0, inf, 0)"},
        {"v 0 0 -1e30", "vertex 0 of mesh 0 lies at (0, 0, -1e+30)"},
        {"v 1e999 0 0", ""},
        {"v x y z", ""},
    };
    for (size_t i = 0; i < COUNT_OF(values); i++) {
        snprintf(text, sizeof(text), "%s\n%s", values[i][0], rest);
        expect_text_refused("value.obj", text, values[i][1]);
    }
    expect_text_refused("point.obj", "v 1 2 3\nv 1 2 3\nv 1 2 3\nf 1 2 3\n",
                        "all vertices lie at (1, 2, 3)");
}

static void test_indices_out_of_range(void **state)
{
    (void)state;
    static const char *const ply = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
                                   "property float y\nproperty float z\nelement face 1\n"
                                   "property list uchar int vertex_indices\nend_header\n"
                                   "0 0 0\n1 0 0\n0 1 0\n3 0 1 %s\n";
    static const char *const indices[] = {"3", "-1", "2147483647", "4294967295"};
    char text[512];
    for (size_t i = 0; i < COUNT_OF(indices); i++) {
        snprintf(text, sizeof(text), "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 %s%s\n",
                 *indices[i] == '-' ? "-" : "", *indices[i] == '3' ? "4" : indices[i]);
        if (*indices[i] != '-') // OBJ counts it from the end
            expect_text_refused("index.obj", text, "");
        snprintf(text, sizeof(text), "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 %s\n", indices[i]);
        expect_text_refused("index.off", text, "line 6 names vertex");
        snprintf(text, sizeof(text), ply, indices[i]);
        expect_text_refused("index.ply", text, "names vertex");
    }
}

// Fifty million faces, promised in a few bytes, are refused by the header before memory is taken.
static void test_fifty_million_faces(void **state)
{
    (void)state;
    static const char *const why = "50000000 faces and ";
    expect_text_refused("many.ply",
                        "ply\nformat binary_little_endian 1.0\nelement vertex 25000000\n"
                        "property float x\nproperty float y\nproperty float z\n"
                        "element face 50000000\nproperty list uchar int vertex_indices\n"
                        "end_header\n",
                        why);
    expect_text_refused("many.off", "OFF\n25000000 50000000 0\n", why);
    struct bytes stl = {0};
    const uint32_t faces = 50000000;
    static const char header[80];
    put_bytes(&stl, header, sizeof(header));
    put_bytes(&stl, &faces, sizeof(faces));
    expect_bytes_refused("many.stl", &stl, why);
    // Other numbers in a header.
    expect_text_refused("vertices.off", "OFF\n4000000000 1 0\n", "4000000000 vertices");
    expect_text_refused("negative.off", "OFF\n3 -1 0\n0 0 0\n", "line 2 does not count");
    expect_text_refused("endless.ply",
                        "ply\nformat ascii 1.0\nelement vertex 99999999999999999999\n"
                        "property float x\nelement face 1\nend_header\n",
                        "");
}

// OBJ has no header, so that lines of faces are counted. Twelve million, eight bytes each.
static void test_too_many_faces_without_a_header(void **state)
{
    (void)state;
    enum { LINE = 8, BLOCK = 10000, FACES = 12000000 };
    static char block[BLOCK * LINE];
    for (int i = 0; i < BLOCK; i++)
        memcpy(block + LINE * i, "f 1 2 3\n", LINE);
    const char *path = in_folder("many.obj");
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    fputs("v 0 0 0\nv 1 0 0\nv 0 1 0\n", file);
    for (int i = 0; i < FACES; i += BLOCK)
        fwrite(block, 1, sizeof(block), file);
    assert_int_equal(fclose(file), 0);
    expect_refused(path, "12000000 faces and 3 vertices would take 144 MB; at most 10000000");
    unlink(path);
}

#define PLY_ELEMENTS                                                                               \
    "element vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 2\n"     \
    "property list uchar int vertex_indices\nend_header\n"
#define PLY_BODY "0 0 0\n1 0 0\n0 1 0\n1 1 0\n3 0 1 2\n3 1 3 2\n"

// Assimp passes over any line before the elements, but not over an indented element, which our
// count would miss.
static void test_free_lines_of_a_ply_header(void **state)
{
    (void)state;
    struct rg_mesh *plain = load_text("plain.ply", "ply\nformat ascii 1.0\n" PLY_ELEMENTS PLY_BODY);
    struct rg_mesh *mesh =
        load_text("free.ply", "ply\nformat ascii 1.0\nauthor somebody\n\n"
                              "of an element of surprise\n" PLY_ELEMENTS PLY_BODY);
    assert_int_equal(mesh->face_count, 2);
    assert_equals(mesh->hash, plain->hash);
    rg_mesh_destroy(mesh);
    rg_mesh_destroy(plain);
    expect_text_refused("indented.ply",
                        "ply\nformat ascii 1.0\n element vertex 2\n" PLY_ELEMENTS PLY_BODY,
                        "line 3 does not belong into its header");
    expect_text_refused("indented.ply",
                        "ply\nformat ascii 1.0\n\telement vertex 2\n" PLY_ELEMENTS PLY_BODY,
                        "line 3 does not belong into its header");
}

static void test_half_a_file(void **state)
{
    (void)state;
    expect_text_refused("cut.off", "OFF\n4 2 0\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n3 0 1 2\n",
                        "ends within its faces, at line 7");
    expect_text_refused("cut.off", "OFF 4 2 0\n0 0 0 255 0 0\n1 0", "line 3 does not begin");
    expect_text_refused("cut.off", "OFF 4 2 0\n0 0 0\n", "ends within its vertices, at line 2");
    expect_text_refused("cut.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1", "line 6 has 2 of");
    expect_text_refused("cut.ply",
                        "ply\nformat ascii 1.0\nelement vertex 4\nprope vertex 4\nend_header\n",
                        "line 4 does not belong into its header");
    expect_text_refused("cut.stl",
                        "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n"
                        "vertex 0 1 0\nendloop\nendfacet\n",
                        "does not end in endsolid");
    expect_text_refused("cut.ply",
                        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\n"
                        "property float y\nproperty float z\nelement face 2\n"
                        "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n"
                        "0 1 0\n1 1 0\n3 0 1 2\n",
                        "has 5 lines for the 6 elements");
}

// --- any damage ---

// A file loads or is refused. It logs at most one line, and a loaded mesh keeps its promises.
static void expect_sound(const char *name, const struct bytes *file)
{
    const char *path = in_folder(name);
    write_file(path, file->data, file->size);
    listen_now();
    struct rg_mesh *mesh = rg_mesh_load(path);
    rg_log_listen(NULL, NULL);
    unlink(path);
    if (lines.count != (mesh ? 0 : 1))
        fail_msg("%s: %d lines, the last: %s", name, lines.count, lines.last);
    if (mesh)
        check_mesh(mesh);
    rg_mesh_destroy(mesh);
}

// The seeds and findings of the fuzzers.
static void test_the_corpus(void **state)
{
    (void)state;
    char name[1024];
    snprintf(name, sizeof(name), "%s/corpus", fuzz_folder);
    DIR *corpus = opendir(name);
    assert_non_null(corpus);
    int files = 0;
    for (struct dirent *entry; (entry = readdir(corpus));) {
        if (entry->d_name[0] == '.')
            continue;
        char path[1024];
        struct bytes file = {0};
        snprintf(path, sizeof(path), "%s/corpus/%s", fuzz_folder, entry->d_name);
        FILE *stream = fopen(path, "rb");
        assert_non_null(stream);
        file.size = fread(file.data, 1, sizeof(file.data), stream);
        fclose(stream);
        expect_sound(entry->d_name, &file);
        files++;
    }
    closedir(corpus);
    assert_at_least(files, 5);
}

static uint32_t next_random(uint32_t *seed)
{
    *seed = *seed * 1664525u + 1013904223u;
    return *seed >> 8;
}

static void test_cut_and_changed_files(void **state)
{
    (void)state;
    enum { CUTS = 12, CHANGES = 12 };
    uint32_t seed = 1;
    for (int i = 0; i < box_format_count; i++) {
        struct bytes whole = {0}, damaged;
        char name[32];
        box_formats[i].write(&whole);
        snprintf(name, sizeof(name), "damaged.%s", box_formats[i].extension);
        for (int cut = 0; cut < CUTS; cut++) {
            damaged = whole;
            damaged.size = 1 + next_random(&seed) % (whole.size - 1);
            expect_sound(name, &damaged);
        }
        for (int change = 0; change < CHANGES; change++) {
            damaged = whole;
            for (int k = 0; k <= change % 4; k++)
                damaged.data[next_random(&seed) % whole.size] = (unsigned char)next_random(&seed);
            expect_sound(name, &damaged);
        }
    }
}

// --- the process ---

// Assimp 5.2 ends its process at this file. Later ones read it.
static void test_assimp_ends_its_process(void **state)
{
    (void)state;
    char path[1024];
    snprintf(path, sizeof(path), "%s/assimp/aborts.ply", fuzz_folder);
    struct rg_mesh *mesh = rg_mesh_load(path);
    const bool is_read = mesh;
    rg_mesh_destroy(mesh);
    if (is_read)
        skip();
    expect_refused(path, "Assimp crashed on it (Aborted)");
}

static void expect_lost(const char *script, const char *why)
{
    char path[256];
    snprintf(path, sizeof(path), "%s", in_folder("program"));
    write_file(path, script, strlen(script));
    assert_int_equal(chmod(path, 0700), 0);
    listen_now();
    assert_null(rg_mesh_read_by(path, 1, "the model", "unused", NULL));
    rg_log_listen(NULL, NULL);
    if (lines.count != 1 || !strstr(lines.last, "the model") || !strstr(lines.last, why))
        fail_msg("%d lines, the last: %s", lines.count, lines.last);
    unlink(path);
}

static void test_what_the_importer_may_do(void **state)
{
    (void)state;
    expect_lost("#!/bin/sh\nkill -SEGV $$\n", "crashed on it (Segmentation fault)");
    expect_lost("#!/bin/sh\nkill -XCPU $$\n", "did not come to an end");
    expect_lost("#!/bin/sh\nexec sleep 60\n", "did not come to an end");
    expect_lost("#!/bin/sh\nexit 7\n", "status 7");
    expect_lost("#!/bin/sh\nexit 0\n", "no reply");
    expect_lost("#!/bin/sh\necho noise; echo noise >&2; echo short >&3\n", "no reply");
    expect_lost("#!/bin/sh\nhead -c 600 /dev/zero >&3\n", "another version");
    expect_lost("#!/absent\n", "could not be started");
}

int main(int argc, char **argv)
{
    fuzz_folder = argc > 1 ? argv[1] : "tests/fuzz";
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_one_box_in_every_format),
        cmocka_unit_test(test_polygons_points_and_lines),
        cmocka_unit_test(test_normals_of_the_file_are_kept),
        cmocka_unit_test(test_nodes_place_meshes),
        cmocka_unit_test(test_the_hash_is_the_geometrys),
        cmocka_unit_test(test_what_is_no_file),
        cmocka_unit_test(test_no_memory_to_read_it),
        cmocka_unit_test(test_what_is_no_mesh),
        cmocka_unit_test(test_strips),
        cmocka_unit_test(test_no_faces),
        cmocka_unit_test(test_coordinates_that_are_none),
        cmocka_unit_test(test_indices_out_of_range),
        cmocka_unit_test(test_fifty_million_faces),
        cmocka_unit_test(test_too_many_faces_without_a_header),
        cmocka_unit_test(test_free_lines_of_a_ply_header),
        cmocka_unit_test(test_half_a_file),
        cmocka_unit_test(test_the_corpus),
        cmocka_unit_test(test_cut_and_changed_files),
        cmocka_unit_test(test_assimp_ends_its_process),
        cmocka_unit_test(test_what_the_importer_may_do),
    };
    return cmocka_run_group_tests_name("meshes from files", tests, make_folder, remove_folder);
}
