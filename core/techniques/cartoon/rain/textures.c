// The rain's textures: layers of an image with levels, and the boxes around their opaque parts.
#include <math.h>
#include <stdio.h>

#include "core/techniques/cartoon/rain/rain.h"
#include "core/techniques/cartoon/rain/strokes.h"
#include "kernels/dialect/image/format.h"

enum {
    SIDE_PX = 64,
    LEVELS = 7,
    LAYERS = CARTOON_DROP_TEXTURES + CARTOON_PATTERNS * CARTOON_FRAMES
};

struct box {
    float left, top, right, bottom;
};

static void paint(int layer, rgba *texels)
{
    struct strokes s;
    const int splash = layer - CARTOON_DROP_TEXTURES;
    if (splash < 0)
        strokes_of_drop(&s, layer);
    else
        strokes_of_splash(&s, splash / CARTOON_FRAMES, splash % CARTOON_FRAMES);
    strokes_paint(&s, SIDE_PX, texels);
}

// Halves a picture; each texel is the mean of four.
static void shrink(rgba *texels, int px)
{
    for (int i = 0; i < px * px; i++) {
        const rgba *a = texels + i / px * 2 * 2 * px + i % px * 2, *b = a + 2 * px;
        texels[i] = rg_rgba(
            (a[0].r + a[1].r + b[0].r + b[1].r) / 4, (a[0].g + a[1].g + b[0].g + b[1].g) / 4,
            (a[0].b + a[1].b + b[0].b + b[1].b) / 4, (a[0].a + a[1].a + b[0].a + b[1].a) / 4);
    }
}

// The box around opaque texels; filtering extends each texel to the centres of its neighbours.
static struct box box_of(const uint32_t *words, int px)
{
    int left = px, right = -1, top = px, bottom = -1;
    for (int i = 0; i < px * px; i++) {
        if (!(words[i] >> 24))
            continue;
        left = i % px < left ? i % px : left;
        right = i % px > right ? i % px : right;
        top = i / px < top ? i / px : top;
        bottom = i / px;
    }
    if (right < 0)
        return (struct box){0};
    const double over = 1.0 / px;
    return (struct box){(float)fmax((left - 0.5) * over, 0), (float)fmax((top - 0.5) * over, 0),
                        (float)fmin((right + 1.5) * over, 1),
                        (float)fmin((bottom + 1.5) * over, 1)};
}

// Names a layer: drops by weight, splashes by angle of impact and age.
static void name_of(int layer, char *name, size_t size)
{
    static const char *const weights[] = {"light", "middle", "heavy"};
    static const char *const patterns[] = {"steep", "aslant", "grazing"};
    const int splash = layer - CARTOON_DROP_TEXTURES;
    if (splash < 0)
        snprintf(name, size, "drop-%s", weights[layer]);
    else
        snprintf(name, size, "splash-%s-%d", patterns[splash / CARTOON_FRAMES],
                 splash % CARTOON_FRAMES + 1);
}

static bool make_layer(int layer, rg_take_texture *take, void *user)
{
    rgba texels[SIDE_PX * SIDE_PX];
    uint32_t words[SIDE_PX * SIDE_PX];
    char name[32];
    const int splash = layer - CARTOON_DROP_TEXTURES;
    struct rg_made_texture texture = {.name = name,
                                      .row = splash < 0 ? 0 : 1 + splash / CARTOON_FRAMES,
                                      .column = splash < 0 ? layer : splash % CARTOON_FRAMES,
                                      .is_paint = true,
                                      .words = words};
    bool ok = true;
    paint(layer, texels);
    name_of(layer, name, sizeof(name));
    for (int level = 0; ok && level < LEVELS; level++) {
        const int px = SIDE_PX >> level;
        if (level)
            shrink(texels, px);
        for (int i = 0; i < px * px; i++)
            words[i] = rg_unorm8(texels[i].r) | rg_unorm8(texels[i].g) << 8 |
                       rg_unorm8(texels[i].b) << 16 | rg_unorm8(texels[i].a) << 24;
        texture.level = level;
        texture.side_px = px;
        ok = take(user, &texture);
    }
    return ok;
}

bool cartoon_make_rain_textures(rg_take_texture *take, void *user)
{
    bool ok = true;
    for (int layer = 0; ok && layer < LAYERS; layer++)
        ok = make_layer(layer, take, user);
    return ok;
}

// The target of an upload: each texture goes to one layer of an image.
struct upload {
    struct rg_image *image;
    int taken;
    struct box boxes[LAYERS * LEVELS];
};

static bool upload(void *user, const struct rg_made_texture *t)
{
    struct upload *u = user;
    const int layer = u->taken / LEVELS;
    u->boxes[u->taken++] = box_of(t->words, t->side_px);
    return rg_image_write(u->image, layer, t->level, t->words);
}

int cartoon_add_textures(struct rg_instance *instance)
{
    const struct rg_image_desc desc = {RG_RGBA8, SIDE_PX, SIDE_PX, LAYERS, LEVELS};
    const struct rg_asset *asset = rg_add_image_of(instance, "rain_textures", &desc);
    struct upload to = {.image = asset ? asset->image : NULL};
    const bool ok = asset && cartoon_make_rain_textures(upload, &to);
    instance->has_failed |= !ok;
    rg_add_buf(instance, "boxes", LAYERS * LEVELS * 4, to.boxes);
    if (ok)
        rg_tell_texture(instance, "rain", asset->image, 0);
    return LEVELS;
}
