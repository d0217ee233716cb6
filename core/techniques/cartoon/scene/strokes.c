// The textures of hatching: six tones of strokes on four levels (Praun et al., 2001). A tone's
// strokes also lie in all darker tones, and a level's in all finer levels, with the same width in
// texels. Tiles repeat, so that strokes wrap around.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "core/base/alloc.h"
#include "core/techniques/cartoon/instance.h"
#include "kernels/dialect/math.h"
#include "kernels/dialect/rng.h"

enum { SIZE_PX = CARTOON_TILE_PX, LEVELS = CARTOON_LEVELS, TONES = CARTOON_TONES, TRIES = 10 };
enum { MOST_STROKES = 4000 }; // of one tone

// The share of the paper that each tone covers, the darkest first.
static const double covers[TONES] = {0.72, 0.54, 0.39, 0.26, 0.15, 0.07};

// In units of a tile; `across`: it runs down the tile, not along it.
struct stroke {
    double x, y, length, slope, half_px;
    bool across;
};

// The ink of each level and tone, 0 to 1 a texel.
struct tones {
    float *ink[LEVELS][TONES];
};

static double chance(uint32_t stroke, uint32_t attempt, int which)
{
    const rg_uint4 r = rg_random(11, stroke, attempt, (uint)(which / 4));
    const uint words[4] = {r.x, r.y, r.z, r.w};
    return (double)rg_uniform(words[which % 4]);
}

// The darkest three tones also have strokes in the other direction.
static struct stroke stroke_of(uint32_t number, uint32_t attempt, int tone)
{
    return (struct stroke){
        .x = chance(number, attempt, 0),
        .y = chance(number, attempt, 1),
        .length = 0.14 + 0.22 * chance(number, attempt, 2),
        .slope = 0.05 * (2 * chance(number, attempt, 3) - 1),
        .half_px = 0.5 + 0.35 * chance(number, attempt, 4),
        .across = tone < 3 && chance(number, attempt, 5) < (tone ? 0.55 : 0.8),
    };
}

static double nearer(double a, double b)
{
    return a < b ? a : b;
}

// The ink of a stroke at a texel: thin at the stroke's ends, smooth at its sides.
static double ink_at(const struct stroke *s, int size, double along_px, double beside_px)
{
    const double length = s->length * size, end = nearer(along_px, length - along_px);
    const double half = s->half_px * nearer(1, 0.35 + 4 * end / length);
    const double covered = half + 0.5 - fabs(beside_px - s->slope * along_px);
    return end < 0 || covered < 0 ? 0 : nearer(covered, 1);
}

// Adds a stroke's ink to a level, or, unless `laid`, only returns how much it would add.
static double lay(const struct stroke *s, int size, float *ink, bool laid)
{
    const int x0 = (int)(s->x * size), y0 = (int)(s->y * size);
    const int length = (int)(s->length * size) + 1, wide = (int)(fabs(s->slope) * length) + 3;
    double added = 0;
    for (int i = 0; i <= length; i++) {
        for (int j = -wide; j <= wide; j++) {
            const int x = (x0 + (s->across ? j : i)) & (size - 1);
            const int y = (y0 + (s->across ? i : j)) & (size - 1);
            float *texel = ink + y * size + x;
            const float dark = (float)ink_at(s, size, i, j);
            if (dark <= *texel)
                continue;
            added += (double)dark - (double)*texel;
            if (laid)
                *texel = dark;
        }
    }
    return added / ((double)size * size);
}

// The one of several random strokes that covers most bare paper, so that strokes spread evenly.
static struct stroke best_of(const struct tones *t, int level, int tone, uint32_t number)
{
    struct stroke best = stroke_of(number, 0, tone);
    double most = -1;
    for (uint32_t attempt = 0; attempt < TRIES; attempt++) {
        const struct stroke s = stroke_of(number, attempt, tone);
        const double added = lay(&s, SIZE_PX >> level, t->ink[level][tone], false) / s.length;
        if (added > most) {
            most = added;
            best = s;
        }
    }
    return best;
}

static double mean_of(const float *ink, int size)
{
    double sum = 0;
    for (int i = 0; i < size * size; i++)
        sum += (double)ink[i];
    return sum / ((double)size * size);
}

// Adds strokes to a tone of a level, and to all darker tones and finer levels, until it covers
// enough.
static void darken(const struct tones *t, int level, int tone)
{
    double mean = mean_of(t->ink[level][tone], SIZE_PX >> level);
    for (uint32_t i = 0; i < MOST_STROKES && mean < covers[tone]; i++) {
        const uint32_t number = (uint32_t)(level * TONES + tone) * MOST_STROKES + i;
        const struct stroke s = best_of(t, level, tone, number);
        for (int l = 0; l <= level; l++)
            for (int k = 0; k <= tone; k++) {
                const double added = lay(&s, SIZE_PX >> l, t->ink[l][k], true);
                mean += l == level && k == tone ? added : 0;
            }
    }
}

static uint32_t paper_of(const struct tones *t, int level, int tone, int texel)
{
    return (uint32_t)((1 - (double)t->ink[level][tone][texel]) * 255 + 0.5);
}

// Packs a texel's four tones, from `first` on, as bytes of paper; beyond the last tone is blank.
static uint32_t pack(const struct tones *t, int level, int first, int texel)
{
    uint32_t word = 0;
    for (int k = 0; k < 4; k++) {
        const int tone = first + k;
        word |= (tone < TONES ? paper_of(t, level, tone, texel) : 255) << 8 * k;
    }
    return word;
}

static bool write_level(const struct tones *t, int level, struct rg_image *image)
{
    const int texels = (SIZE_PX >> level) * (SIZE_PX >> level);
    uint32_t *words = rg_alloc((size_t)texels, sizeof(*words), "strokes");
    bool ok = words != NULL;
    for (int layer = 0; ok && layer < 2; layer++) {
        for (int i = 0; i < texels; i++)
            words[i] = pack(t, level, 3 * layer, i);
        ok = rg_image_write(image, layer, level, words);
    }
    free(words);
    return ok;
}

static bool make_tones(struct tones *t)
{
    bool ok = true;
    for (int level = 0; level < LEVELS; level++)
        for (int tone = 0; tone < TONES; tone++) {
            const size_t size = SIZE_PX >> level;
            t->ink[level][tone] = rg_alloc(size * size, sizeof(float), "strokes");
            ok = ok && t->ink[level][tone];
        }
    for (int level = LEVELS - 1; ok && level >= 0; level--)
        for (int tone = TONES - 1; tone >= 0; tone--)
            darken(t, level, tone);
    return ok;
}

static void free_tones(struct tones *t)
{
    for (int i = 0; i < LEVELS * TONES; i++)
        free(t->ink[i / TONES][i % TONES]);
}

void cartoon_add_strokes(struct cartoon *c)
{
    struct tones t = {0};
    const struct rg_asset *strokes = rg_add_image_of(
        &c->base, "strokes", &(struct rg_image_desc){RG_RGBA8, SIZE_PX, SIZE_PX, 2, LEVELS});
    bool ok = strokes && make_tones(&t);
    for (int level = 0; ok && level < LEVELS; level++)
        ok = write_level(&t, level, strokes->image);
    c->base.has_failed |= !ok;
    free_tones(&t);
}

// Hands over a tone's level; on a sheet, strokes lie under the three patterns of splashes.
static bool hand_over(const struct tones *t, int tone, int level, rg_take_texture *take, void *user)
{
    uint32_t words[SIZE_PX * SIZE_PX];
    char name[32];
    const int px = SIZE_PX >> level;
    snprintf(name, sizeof(name), "strokes-tone-%d", tone + 1);
    for (int i = 0; i < px * px; i++)
        words[i] = 0xff000000u | 0x010101u * paper_of(t, level, tone, i);
    return take(user, &(struct rg_made_texture){.name = name,
                                                .row = 1 + CARTOON_PATTERNS,
                                                .column = tone,
                                                .level = level,
                                                .side_px = px,
                                                .words = words});
}

bool cartoon_make_strokes(rg_take_texture *take, void *user)
{
    struct tones t = {0};
    bool ok = make_tones(&t);
    for (int i = 0; ok && i < LEVELS * TONES; i++)
        ok = hand_over(&t, i / LEVELS, i % LEVELS, take, user);
    free_tones(&t);
    return ok;
}
