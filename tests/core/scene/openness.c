// How much of the sky is seen beside an endless wall: geometry bounds it from both sides.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>

#include "core/scene/city/city.h"
#include "kernels/scenery/openness_grid.h"
#include "tests/tools/expect.h"

enum { SIDE = SCENERY_OPEN_SIDE, LEVELS = SCENERY_OPEN_LEVELS, MIDDLE = SIDE / 2, WAYS = 16 };

static const double WALL_M = 40, FAR_M = 1000, CELL_M = 4;

// The words of a city of these boxes; the caller frees them.
static uint32_t *words_of(struct city_box *boxes, int count)
{
    const struct city city = {.boxes = boxes, .box_count = count};
    uint32_t *words = malloc(SCENERY_OPEN_WORDS * sizeof(*words));
    assert_non_null(words);
    assert_true(city_openness(&city, words));
    return words;
}

// One of the four points of a word, 0 to 255.
static int point(const uint32_t *words, int x, int z, int level, int corner)
{
    return (int)(words[(level * SIDE + z) * SIDE + x] >> 8 * corner & 255);
}

static void a_field_is_open(void **state)
{
    (void)state;
    uint32_t *words = words_of(NULL, 0);
    for (int i = 0; i < SCENERY_OPEN_WORDS; i++)
        assert_int_equal(words[i], 0xffffffff);
    free(words);
}

// The part of the sky that a wall leaves open. Its foot is so many cells away along the shortest
// way; `extra` cells are added to each way.
static double open_beside(double cells, double extra, int level)
{
    double open = 0;
    for (int way = 0; way < WAYS; way++) {
        const double towards = cos(2 * M_PI * (way + 0.5) / WAYS);
        const double over_m = fmax(WALL_M - CELL_M * level, 0);
        const double slope = towards > 0 ? over_m / (CELL_M * (cells / towards + extra)) : 0;
        open += (1 - sin(atan(slope))) / WAYS;
    }
    return open;
}

// The city samples a way at each cell, up to 30; a sample stands for half a cell to each side. Thus
// it meets the wall half a cell early, or up to a cell later.
static void a_wall_hides_what_it_must(void **state)
{
    (void)state;
    const float low = (float)-FAR_M, high = (float)FAR_M, top = (float)WALL_M;
    struct city_box walls[4] = {{{0, 0, low}, {high, top, high}},
                                {{low, 0, low}, {0, top, high}},
                                {{low, 0, 0}, {high, top, high}},
                                {{low, 0, low}, {high, top, 0}}};
    static const int away[4][2] = {{-1, 0}, {1, 0}, {0, -1}, {0, 1}};
    for (int w = 0; w < 4; w++) {
        uint32_t *words = words_of(&walls[w], 1);
        for (int cells = 2; cells <= 5; cells++) {
            const int x = MIDDLE + cells * away[w][0], z = MIDDLE + cells * away[w][1];
            for (int level = 0; level < LEVELS; level++) {
                const double open = point(words, x, z, level, 0) / 255.0,
                             rounding = 0.5 / 255 + 1e-6;
                assert_at_least(open, open_beside(cells - 0.5, 0, level) - rounding);
                assert_at_most(open, open_beside(cells - 0.5, 1, level) + rounding);
                // A word holds its neighbours' points as well.
                for (int corner = 1; corner < 4; corner++)
                    assert_int_equal(point(words, x, z, level, corner),
                                     point(words, x + (corner & 1), z + (corner >> 1), level, 0));
            }
        }
        free(words);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_field_is_open),
        cmocka_unit_test(a_wall_hides_what_it_must),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
