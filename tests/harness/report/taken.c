// The pictures that a page takes from a record's folder: which of them, with which bytes, and how
// they are called.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <webp/decode.h>

#include "core/image/files/io.h"
#include "harness/report/page.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/folder.h"

// A picture without symmetry; `shade` is the share of its light.
static void write_picture(const char *name, int width, int height, float shade)
{
    char path[128];
    struct rg_picture picture;
    snprintf(path, sizeof(path), "%s/%s", folder, name);
    assert_true(rg_picture_create(&picture, width, height, 3, path));
    for (int64_t i = 0; i < rg_picture_values(&picture); i++)
        picture.texels[i] = shade * (float)(i % 7) / 7;
    assert_true(rg_picture_write(path, &picture, &(struct rg_write_options){.full_float = true}));
    rg_picture_destroy(&picture);
}

static bool has(const struct rg_page *page, const char *name)
{
    return json_object_get(page->files, name) != NULL;
}

// Takes the pictures of a document, whose quotation marks are single ones.
static void take(struct rg_page *page, const char *text)
{
    char copy[1024];
    snprintf(copy, sizeof(copy), "%s", text);
    for (char *c = copy; *c; c++)
        *c = *c == '\'' ? '"' : *c;
    json_t *document = json_loads(copy, 0, NULL);
    assert_non_null(document);
    assert_true(rg_page_add_pictures(page, folder, document));
    json_decref(document);
}

// --- bytes ---

// Decodes base64; returns the number of bytes.
static size_t decode(const char *text, uint8_t *bytes)
{
    static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    size_t count = 0;
    assert_int_equal(strlen(text) % 4, 0);
    for (; *text; text += 4) {
        uint32_t word = 0;
        int known = 0;
        for (int i = 0; i < 4; i++) {
            const char *digit = text[i] == '=' ? NULL : strchr(digits, text[i]);
            assert_true(digit || (i > 1 && text[i] == '='));
            word = word << 6 | (digit ? (uint32_t)(digit - digits) : 0);
            known += digit != NULL;
        }
        for (int i = 0; i < known - 1; i++)
            bytes[count++] = (uint8_t)(word >> (16 - 8 * i));
    }
    return count;
}

// Pictures of many sizes, so that each number of bytes that is left at the end occurs: all codes
// come back.
static void pictures_are_kept_to_the_last_code(void **state)
{
    (void)state;
    static uint8_t bytes[1 << 16];
    for (int side = 1; side <= 24; side++) {
        struct rg_page page = {0};
        int width = 0, height = 0;
        write_picture("a.png", side, side + 1, 1);
        take(&page, "{'file': 'a.png'}");
        const char *digest = json_string_value(json_object_get(page.files, "a.png"));
        const char *text = json_string_value(json_object_get(page.pictures, digest));
        assert_memory_equal(text, "data:image/webp;base64,", 23);
        const size_t size = decode(text + 23, bytes);
        assert_equals(page.picture_bytes, size);
        uint8_t *texels = WebPDecodeRGBA(bytes, size, &width, &height);
        assert_int_equal(width, side);
        assert_int_equal(height, side + 1);
        // Codes of sevenths of the light of white.
        static const int codes[7] = {0, 106, 146, 175, 199, 220, 238};
        for (int i = 0; i < 4 * width * height; i++)
            assert_int_equal(texels[i], i % 4 == 3 ? 255 : codes[(i / 4 * 3 + i % 4) % 7]);
        WebPFree(texels);
        rg_page_free(&page);
    }
}

// Pictures without room are counted, and are no files of the page; one that the page has already
// takes no room.
static void a_page_has_room_for_so_many(void **state)
{
    (void)state;
    struct rg_page page = {0};
    write_picture("a.png", 4, 4, 1);
    write_picture("b.png", 4, 4, 0.5f);
    write_picture("c.png", 4, 4, 1);
    take(&page, "{'file': 'a.png'}");
    page.picture_bytes = RG_PAGE_PICTURES;
    take(&page, "{'file': 'b.png'}");
    take(&page, "{'file': 'c.png'}");
    assert_true(has(&page, "a.png") && !has(&page, "b.png") && has(&page, "c.png"));
    assert_int_equal(page.left_out, 1);
    assert_equals(page.picture_bytes, RG_PAGE_PICTURES);
    assert_int_equal(json_object_size(page.pictures), 1);
    rg_page_free(&page);
}

// A file that has moved is found by its name, in the record's folder. Linear light is shown as a
// PNG of the same picture is, and is the same picture.
static void pictures_are_found_by_their_names(void **state)
{
    (void)state;
    static const char *const names[] = {"in/a.png", "/nonexistent/a.png", "in/a.exr"};
    struct rg_page page = {0};
    write_picture("a.png", 5, 4, 1);
    write_picture("a.exr", 5, 4, 1);
    write_picture("b.png", 5, 4, 0.5f);
    for (int i = 0; i < 3; i++) {
        char document[64];
        snprintf(document, sizeof(document), "{'file': '%s'}", names[i]);
        take(&page, document);
        assert_true(has(&page, names[i]));
    }
    assert_int_equal(json_object_size(page.pictures), 1);
    take(&page, "{'file': 'b.png'}");
    assert_int_equal(json_object_size(page.pictures), 2);
    assert_int_equal(json_object_size(page.files), 4);
    rg_page_free(&page);
}

// --- clips ---

// Of a clip a strip of at most 24 frames, evenly spaced, with both ends.
static void a_clip_is_a_strip(void **state)
{
    (void)state;
    static const struct {
        const char *document;
        int first, step, count;
    } cases[] = {{"{'file': 'f-%03d.png', 'frames': [10, 56]}", 10, 2, 24},
                 {"{'file': 'f-%03d.png', 'frames': [10, 33]}", 10, 1, 24},
                 {"{'file': 'f-%03d.png', 'frames': [10, 79]}", 10, 3, 24},
                 {"{'file': 'f-%03d.png', 'frames': [20, 24]}", 20, 1, 5},
                 {"{'file': 'f-%03d.png', 'frames': [33, 33]}", 33, 1, 1},
                 {"{'file': 'f-%03d.png', 'frames': [30, 20]}", 30, 1, 1},
                 {"{'file': 'f-014.png', 'frames': [10, 56]}", 14, 1, 1}};
    for (int frame = 10; frame < 80; frame++) {
        char name[16];
        snprintf(name, sizeof(name), "f-%03d.png", frame);
        write_picture(name, 2, 2, (float)frame / 80);
    }
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        struct rg_page page = {0};
        take(&page, cases[i].document);
        assert_int_equal(json_object_size(page.files), cases[i].count);
        for (int k = 0; k < cases[i].count; k++) {
            char name[16];
            snprintf(name, sizeof(name), "f-%03d.png", cases[i].first + k * cases[i].step);
            assert_true(has(&page, name));
        }
        rg_page_free(&page);
    }
}

// --- values ---

// The names beside the values that are kept by a file's name.
static void expect_values(const struct rg_page *page, const char *key, const char *const *names)
{
    const json_t *pictures = json_object_get(json_object_get(page->linear, key), "pictures");
    size_t count = 0;
    for (; names[count]; count++)
        assert_string_equal(
            json_string_value(json_object_get(json_array_get(pictures, count), "name")),
            names[count]);
    assert_int_equal(json_array_size(pictures), count);
}

// A diff's pictures are compared by their devices, and a gate's by its sides, beside whose
// pictures those of linear light stand.
static void values_are_those_of_sides(void **state)
{
    (void)state;
    struct rg_page page = {0};
    static const char *const made[] = {"x.exr",      "y.exr",      "z.exr",      "case-a.png",
                                       "case-b.png", "case-a.exr", "case-b.exr", "case-heat.png"};
    for (int i = 0; i < 8; i++)
        write_picture(made[i], 4, 4, 1 - 0.1f * (float)i);
    take(&page, "{'pictures': [{'device': 'cpu', 'file': 'x.exr'}, {'device': 'gone', 'file': "
                "'none.exr'}, {'device': 'gl', 'file': 'y.exr'}, {'device': 'vulkan', 'file': "
                "'z.exr'}]}");
    take(&page, "{'gated': [{'attachments': ['case-heat.png', 'case-a.png', 'case-b.png']}, "
                "{'attachments': ['case-a.png']}, {'attachments': []}]}");
    assert_int_equal(page.linear_count, 2);
    assert_int_equal(json_object_size(page.linear), 2);
    expect_values(&page, "x.exr", (const char *const[]){"cpu", "gl", "vulkan", NULL});
    expect_values(&page, "case-a.png", (const char *const[]){"A", "B", NULL});
    assert_true(has(&page, "x.exr") && has(&page, "z.exr") && has(&page, "case-heat.png"));
    assert_true(has(&page, "case-a.png") && has(&page, "case-b.png"));
    assert_false(has(&page, "none.exr") || has(&page, "case-a.exr"));
    page.linear_count = RG_PAGE_LINEAR;
    take(&page, "{'pictures': [{'device': 'cpu', 'file': 'y.exr'}, {'device': 'gl', 'file': "
                "'z.exr'}]}");
    assert_int_equal(json_object_size(page.linear), 2); // there is no room for more
    rg_page_free(&page);
}

// --- captions ---

// A caption is the paragraph below a picture that begins with a star, or else the picture's own
// words; behind it stands the paper's.
static void captions_stand_below_pictures(void **state)
{
    (void)state;
    static const struct {
        const char *text, *file, *caption, *printed;
    } cases[] = {{"\n![own words](a.png)\n", "a.png", "own words", NULL},
                 {"\n![own](a.png)\n\n**Fig. 1.** Red, `all` of\n  it.  \n\nMore.", "a.png",
                  "Fig. 1. Red, all of it.", NULL},
                 {"\n![own](in/a.png)\n\n> What the\n> paper *says* > all.\n\nMore.", "in/a.png",
                  "own", "What the paper says > all."},
                 {"\n![own](a.png)\n\n*b*\n\n> c", "a.png", "b", "c"},
                 {"\n![own](a.png)\n\nPlain words.\n\n*b*", "a.png", "own", NULL},
                 {"\n![](a.png)", "a.png", "", NULL},
                 {"an ![inline](a.png) picture", NULL, NULL, NULL},
                 {"\n![no end](a.png", NULL, NULL, NULL}};
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        struct rg_page page = {0};
        assert_true(rg_page_add_gallery(&page, folder, cases[i].text));
        assert_int_equal(json_array_size(page.gallery), cases[i].file != NULL);
        const json_t *shown = json_array_get(page.gallery, 0);
        const char *printed = json_string_value(json_object_get(shown, "printed"));
        if (cases[i].file)
            assert_true(rg_page_is(shown, "file", cases[i].file) &&
                        rg_page_is(shown, "caption", cases[i].caption));
        if (cases[i].printed)
            assert_string_equal(printed, cases[i].printed);
        else
            assert_null(printed);
        rg_page_free(&page);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pictures_are_kept_to_the_last_code),
        cmocka_unit_test(a_page_has_room_for_so_many),
        cmocka_unit_test(pictures_are_found_by_their_names),
        cmocka_unit_test(a_clip_is_a_strip),
        cmocka_unit_test(values_are_those_of_sides),
        cmocka_unit_test(captions_stand_below_pictures),
    };
    return cmocka_run_group_tests(tests, make_folder, remove_whole_folder);
}
