// Meshes as editors and exporters leave them: texts that begin with a byte order mark, and glTF
// buffers with any name.
#include "tests/core/scene/mesh/rig.h"
#include "tests/tools/expect.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

// --- marks ---

// A text with a mark gives the same mesh as without. In OBJ Assimp took the mark as part of the
// first word and lost a vertex.
static void test_texts_with_a_mark(void **state)
{
    (void)state;
    static const char *const texts[] = {"OBJ", "OFF", "PLY", "STL", "glTF"};
    int found = 0;
    for (int i = 0; i < box_format_count; i++)
        for (size_t t = 0; t < COUNT_OF(texts); t++) {
            if (strcmp(box_formats[i].name, texts[t]))
                continue;
            struct bytes plain = {0}, marked = {0};
            char name[32];
            box_formats[i].write(&plain);
            put_text(&marked, "\xef\xbb\xbf");
            put_bytes(&marked, plain.data, plain.size);
            snprintf(name, sizeof(name), "box.%s", box_formats[i].extension);
            struct rg_mesh *mesh = load_bytes(name, &plain), *same = load_bytes(name, &marked);
            assert_equals(mesh->hash, same->hash);
            rg_mesh_destroy(mesh);
            rg_mesh_destroy(same);
            found++;
        }
    assert_int_equal(found, COUNT_OF(texts));
}

// An OBJ whose first line is a vertex: without it the mesh would be another.
static void test_a_mark_before_a_vertex(void **state)
{
    (void)state;
    static const char text[] = "\xef\xbb\xbfv 5 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 2 3 4\n";
    struct rg_mesh *mesh = load_text("first.obj", text), *plain = load_text("first.obj", text + 3);
    assert_equals(mesh->high[0], 5);
    assert_equals(mesh->hash, plain->hash);
    rg_mesh_destroy(mesh);
    rg_mesh_destroy(plain);
}

// --- buffers ---

static const float triangle[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};

// A triangle whose corners are in the file `uri`, as JSON writes it, after this many other buffers
// of four bytes.
static void put_triangle_behind(struct bytes *file, int others, const char *uri)
{
    put_text(file,
             "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],"
             "\"nodes\":[{\"mesh\":0}],"
             "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}],"
             "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,"
             "\"type\":\"VEC3\",\"min\":[0,0,0],\"max\":[1,1,0]}],"
             "\"bufferViews\":[{\"buffer\":%d,\"byteLength\":36}],"
             "\"buffers\":[%s{\"uri\":\"%s\",\"byteLength\":36}]}",
             others, others ? "{\"byteLength\":4}," : "", uri);
}

static void put_triangle(struct bytes *file, const char *uri)
{
    put_triangle_behind(file, 0, uri);
}

static void put_word(struct bytes *file, size_t value)
{
    const unsigned int word = (unsigned int)value;
    put_bytes(file, &word, 4);
}

// The same triangle in a GLB, whose own chunk is the first buffer.
static void put_glb(struct bytes *file, const char *uri)
{
    struct bytes scene = {0};
    put_triangle_behind(&scene, 1, uri);
    while (scene.size % 4)
        put_text(&scene, " ");
    put_text(file, "glTF");
    put_word(file, 2);
    put_word(file, 20 + scene.size + 12);
    put_word(file, scene.size);
    put_text(file, "JSON");
    put_bytes(file, scene.data, scene.size);
    put_word(file, 4);
    put_bytes(file, "BIN\0none", 8);
}

static const struct {
    const char *uri, *file; // as JSON writes it, and as the folder has it
} named[] = {
    {"plain.bin", "plain.bin"},
    {"no%20gap.bin", "no gap.bin"},
    {"%e5%b1%b1.bin", "\xe5\xb1\xb1.bin"},
    {"gr\\u00fcn.bin", "gr\xc3\xbcn.bin"},
    {"gr\xc3\xbcn.bin", "gr\xc3\xbcn.bin"},
    {"corners", "corners"},
    {"corners.f32", "corners.f32"},
    {"a \\\"b\\\".bin", "a \"b\".bin"},
    {"50%.bin", "50%.bin"},             // no code follows
    {"%41%42.bin", "%41%42.bin"},       // no AB.bin: some programs encode nothing
    {"a.bin\\u002epart", "a.bin.part"}, // more after .bin
    {".\\/here.bin", "here.bin"},
};

static void test_buffers_by_any_name(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT_OF(named); i++) {
        struct bytes text = {0}, binary = {0};
        char buffer[256];
        put_triangle(&text, named[i].uri);
        put_glb(&binary, named[i].uri);
        snprintf(buffer, sizeof(buffer), "%s", in_folder(named[i].file));
        write_file(buffer, triangle, sizeof(triangle));
        struct rg_mesh *mesh = load_bytes("named.gltf", &text);
        struct rg_mesh *same = load_bytes("named.glb", &binary);
        unlink(buffer);
        assert_int_equal(mesh->face_count, 1);
        assert_equals(mesh->high[0], 1);
        assert_equals(mesh->hash, same->hash);
        rg_mesh_destroy(mesh);
        rg_mesh_destroy(same);
    }
}

// The decoded name is tried first.
static void test_the_decoded_name_is_meant(void **state)
{
    (void)state;
    static const float other[9] = {0, 0, 0, 7, 0, 0, 0, 7, 0};
    struct bytes text = {0};
    char decoded[256], coded[256];
    put_triangle(&text, "%41.bin");
    snprintf(decoded, sizeof(decoded), "%s", in_folder("A.bin"));
    snprintf(coded, sizeof(coded), "%s", in_folder("%41.bin"));
    write_file(decoded, triangle, sizeof(triangle));
    write_file(coded, other, sizeof(other));
    struct rg_mesh *mesh = load_bytes("named.gltf", &text);
    assert_equals(mesh->high[0], 1);
    rg_mesh_destroy(mesh);
    unlink(decoded);
    unlink(coded);
}

// Only files beside the mesh's own are opened: not others, even if they exist.
static void test_other_places_are_refused(void **state)
{
    (void)state;
    char outside[256], uri[300];
    snprintf(outside, sizeof(outside), "%s", in_folder("outside.bin"));
    write_file(outside, triangle, sizeof(triangle));
    static const char *const before[] = {"", "file://", "http://localhost"};
    for (size_t i = 0; i < COUNT_OF(before); i++) {
        struct bytes text = {0};
        snprintf(uri, sizeof(uri), "%s%s", before[i], outside);
        put_triangle(&text, uri);
        expect_bytes_refused("named.gltf", &text, "could not open referenced file");
    }
    unlink(outside);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_texts_with_a_mark),
        cmocka_unit_test(test_a_mark_before_a_vertex),
        cmocka_unit_test(test_buffers_by_any_name),
        cmocka_unit_test(test_the_decoded_name_is_meant),
        cmocka_unit_test(test_other_places_are_refused),
    };
    return cmocka_run_group_tests_name("meshes by name", tests, make_folder, remove_folder);
}
