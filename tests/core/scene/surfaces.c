// Surfaces of the city: where their textures lie, how wet they get, their tint; and chunks of
// made-up faces.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdlib.h>
#include <string.h>

#include "core/scene/city/build.h"
#include "tests/tools/expect.h"

static void begin(struct city_builder *b)
{
    memset(b, 0, sizeof(*b));
    b->city = calloc(1, sizeof(*b->city));
    assert_non_null(b->city);
}

static void end(struct city_builder *b)
{
    assert_false(b->failed);
    free(b->places);
    city_destroy(b->city);
}

static const uint32_t *words_of(const struct city_builder *b, uint32_t surface)
{
    return b->city->faces.surfaces + (size_t)surface * SCENERY_SURFACE_WORDS;
}

// 16 bits: signed for scales, unsigned for offsets.
static int scale(uint32_t word, int upper)
{
    return (int16_t)(word >> (upper ? 16 : 0) & 0xffff);
}

static int offset(uint32_t word, int upper)
{
    return (int)(word >> (upper ? 16 : 0) & 0xffff);
}

static const point east = {1, 0, 0}, up = {0, 1, 0};

// A texture is 4 m wide unless the look says otherwise, and its row 0 is its top. On walls v runs
// against y, on the ground along z.
static void test_upon_the_world(void **state)
{
    (void)state;
    struct city_builder b;
    const struct look brick = {.texture = 7}, tiles = {.texture = 7, .tile_m = 0.5};
    begin(&b);
    const uint32_t wall = city_surface(&b, &brick, east, NULL);
    const uint32_t ground = city_surface(&b, &brick, up, NULL);
    const uint32_t fine = city_surface(&b, &tiles, east, NULL);
    assert_int_equal(city_surface(&b, &brick, east, NULL), wall); // equal ones are shared
    assert_int_equal(b.city->faces.surface_count, 3);
    assert_int_equal(scale(words_of(&b, wall)[SCENERY_SCALES], 0), 8192 / 4);
    assert_int_equal(scale(words_of(&b, wall)[SCENERY_SCALES], 1), -8192 / 4);
    assert_int_equal(scale(words_of(&b, ground)[SCENERY_SCALES], 0), 8192 / 4);
    assert_int_equal(scale(words_of(&b, ground)[SCENERY_SCALES], 1), 8192 / 4);
    assert_int_equal(scale(words_of(&b, fine)[SCENERY_SCALES], 0), 8192 * 2);
    assert_int_equal(words_of(&b, wall)[SCENERY_OFFSETS], 0);
    end(&b);
}

// A texture is 0 where it begins: at 1 m and half a texture a metre, half a texture lies before it.
static void test_mapped(void **state)
{
    (void)state;
    struct city_builder b;
    const struct look look = {.texture = 3};
    const struct mapping mapping = {0.5, -0.25, 0.5, 1, true};
    begin(&b);
    const uint32_t *words = words_of(&b, city_surface(&b, &look, east, &mapping));
    assert_int_equal(scale(words[SCENERY_SCALES], 0), 4096);
    assert_int_equal(scale(words[SCENERY_SCALES], 1), -2048);
    assert_int_equal(offset(words[SCENERY_OFFSETS], 0), 65536 * 3 / 4);
    assert_int_equal(offset(words[SCENERY_OFFSETS], 1), 65536 / 4);
    assert_int_equal(words[SCENERY_LOOK] >> SCENERY_TURNED_BIT & 1, 1);
    end(&b);
}

static void test_looks(void **state)
{
    (void)state;
    static const struct {
        int kind;
        uint32_t wet;
    } kinds[] = {{SCENERY_KIND_WALL, 0},    {SCENERY_KIND_GLASS, 0},  {SCENERY_KIND_ROOF, 0},
                 {SCENERY_KIND_ASPHALT, 3}, {SCENERY_KIND_PAVING, 2}, {SCENERY_KIND_LEAVES, 0}};
    struct city_builder b;
    begin(&b);
    for (size_t i = 0; i < sizeof(kinds) / sizeof(kinds[0]); i++) {
        const struct look look = {9, kinds[i].kind, 0, 0x4080ff, 5};
        const uint32_t *words = words_of(&b, city_surface(&b, &look, up, NULL));
        assert_int_equal(words[SCENERY_NORMAL] >> 30, kinds[i].wet);
        assert_int_equal(words[SCENERY_LOOK] & 255, 9);
        assert_int_equal(scenery_kind(words[SCENERY_LOOK]), kinds[i].kind);
        assert_int_equal(words[SCENERY_LOOK] >> SCENERY_GLOW_BIT & 7, 5);
        // 255 of red, 128 of green and 64 of blue in 5, 6 and 5 bits.
        const uint32_t tint = words[SCENERY_LOOK] >> SCENERY_TINT_BIT;
        assert_int_equal(tint & 31, 31);
        assert_int_equal(tint >> 5 & 63, 32);
        assert_int_equal(tint >> 11, 8);
    }
    end(&b);
}

// A chunk has a normal if all its faces share it. Leaves have none, since they are lit as their
// crown.
static void test_ways(void **state)
{
    (void)state;
    for (int leaves = 0; leaves < 2; leaves++) {
        struct city_builder b;
        const struct look look = {.kind = leaves ? SCENERY_KIND_LEAVES : SCENERY_KIND_WALL};
        const point corners[4] = {{1, 0, 1}, {1, 0, 0}, {1, 1, 0}, {1, 1, 1}};
        begin(&b);
        city_quad_on(&b, corners, city_surface(&b, &look, east, NULL));
        assert_true(city_faces_sort(&b.city->faces));
        assert_int_equal(b.city->faces.chunk_count, 1);
        assert_equals(b.city->faces.chunks[0].normal[0], (leaves ? 0.0f : 1.0f));
        end(&b);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_upon_the_world),
        cmocka_unit_test(test_mapped),
        cmocka_unit_test(test_looks),
        cmocka_unit_test(test_ways),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
