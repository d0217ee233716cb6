// The textures of hatching: each tone's darkness; tiles that fit together; strokes of lighter tones
// and coarser levels, which recur in darker and finer ones.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>

#include "tests/core/techniques/cartoon/rig.h"
#include "tests/tools/expect.h"

enum { TONES = 7 }; // the last is blank

struct level {
    int size;
    uint32_t *words[2]; // one for each layer
};

// Paper of a tone, from 0 (ink) to 255, at whole texels; the texture repeats.
static int paper_at(const struct level *l, int x, int y, int tone)
{
    const int mask = l->size - 1;
    const uint32_t *words = l->words[tone < 4 ? 0 : 1];
    return (int)(words[(y & mask) * l->size + (x & mask)] >> 8 * (tone < 4 ? tone : tone - 3)) &
           255;
}

static void read_levels(struct cartoon *c, struct level levels[CARTOON_LEVELS])
{
    struct rg_image *image = rg_asset_find(&c->base, "strokes")->image;
    assert_int_equal(image->desc.levels, CARTOON_LEVELS);
    for (int i = 0; i < CARTOON_LEVELS; i++) {
        levels[i].size = CARTOON_TILE_PX >> i;
        for (int layer = 0; layer < 2; layer++) {
            levels[i].words[layer] = malloc(4 * (size_t)levels[i].size * (size_t)levels[i].size);
            assert_non_null(levels[i].words[layer]);
            assert_true(rg_image_read(image, layer, i, levels[i].words[layer]));
        }
    }
}

static void free_levels(struct level levels[CARTOON_LEVELS])
{
    for (int i = 0; i < CARTOON_LEVELS; i++)
        for (int layer = 0; layer < 2; layer++)
            free(levels[i].words[layer]);
}

static void check_darkness(const struct level *l)
{
    static const double due[TONES] = {0.72, 0.54, 0.39, 0.26, 0.15, 0.07, 0};
    const int texels = l->size * l->size;
    for (int tone = 0; tone < TONES; tone++) {
        double ink = 0;
        for (int i = 0; i < texels; i++)
            ink += 1 - paper_at(l, i % l->size, i / l->size, tone) / 255.0;
        // A level ends with the stroke that reaches its tone. One stroke covers most of the
        // smallest tiles, and strokes of coarser levels are there from the start.
        assert_above(ink / texels, due[tone] - 0.002);
        assert_below(ink / texels, due[tone] + 0.05);
    }
}

static void tones_are_nested(void **state)
{
    struct level levels[CARTOON_LEVELS];
    struct cartoon *c = rig_draw(*state, "style=hatching", 16, 16);
    read_levels(c, levels);
    for (int k = 0; k < CARTOON_LEVELS; k++) {
        const struct level *l = &levels[k];
        check_darkness(l);
        for (int i = 0; i < l->size * l->size; i++)
            for (int tone = 1; tone < TONES; tone++)
                assert_at_most(paper_at(l, i % l->size, i / l->size, tone - 1),
                               paper_at(l, i % l->size, i / l->size, tone));
    }
    free_levels(levels);
    rig_close(c);
}

// The finer level has each stroke as well: as wide in texels, and thus half as wide in the tile.
static void levels_are_nested(void **state)
{
    struct level levels[CARTOON_LEVELS];
    struct cartoon *c = rig_draw(*state, "style=hatching", 16, 16);
    read_levels(c, levels);
    for (int k = 1; k < CARTOON_LEVELS; k++) {
        const struct level *fine = &levels[k - 1], *coarse = &levels[k];
        for (int i = 0; i < coarse->size * coarse->size; i++) {
            const int x = i % coarse->size, y = i / coarse->size;
            int lightest = 255;
            for (int j = 0; j < 16; j++) {
                const int paper = paper_at(fine, 2 * x + j % 4 - 1, 2 * y + j / 4 - 1, 5);
                lightest = paper < lightest ? paper : lightest;
            }
            if (paper_at(coarse, x, y, 5) < 40)
                assert_below(lightest, 160);
        }
    }
    free_levels(levels);
    rig_close(c);
}

static void tiles_fit_together(void **state)
{
    struct level levels[CARTOON_LEVELS];
    struct cartoon *c = rig_draw(*state, "style=hatching", 16, 16);
    read_levels(c, levels);
    const struct level *l = &levels[0];
    for (int tone = 0; tone < 6; tone++) {
        double seam = 0, within = 0;
        for (int i = 0; i < l->size * l->size; i++) {
            const int x = i % l->size, y = i / l->size;
            const double step = abs(paper_at(l, x, y, tone) - paper_at(l, x - 1, y, tone)) +
                                abs(paper_at(l, y, x, tone) - paper_at(l, y, x - 1, tone));
            seam += x == 0 ? step : 0;
            within += x == 0 ? 0 : step / (l->size - 1);
        }
        assert_below(seam, 1.5 * within);
    }
    free_levels(levels);
    rig_close(c);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tones_are_nested),
        cmocka_unit_test(levels_are_nested),
        cmocka_unit_test(tiles_fit_together),
    };
    return rig_run(argc, argv, tests, sizeof(tests) / sizeof(tests[0]));
}
