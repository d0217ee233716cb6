#include "tests/core/techniques/drops/view/rig.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdlib.h>
#include <string.h>

#include "core/image/files/io.h"
#include "kernels/dialect/image/memory.h"

struct rg_picture view_draw(struct drops *d)
{
    struct rg_picture picture;
    assert_true(d->base.technique->draw(&d->base));
    assert_true(rg_frame_read_picture(&d->base, &picture));
    return picture;
}

const float *view_pixel(const struct rg_picture *picture, int x, int y)
{
    return picture->texels + ((int64_t)y * picture->width + x) * picture->channels;
}

void view_put_heights(struct drops *d, view_height_fn height, const void *user)
{
    float *map = rig_words(d, "height");
    const double l = d->settings.cell_mm;
    for (int row = 0; row < d->settings.rows; row++)
        for (int column = 0; column < d->settings.columns; column++)
            map[drops_cell(d->params, column, row)] =
                (float)height((column + 0.5) * l, (row + 0.5) * l, user);
    struct rg_buf *buf = rg_asset_find(&d->base, "height")->buf;
    assert_true(rg_buf_write(buf, 0, map, (int64_t)buf->size));
    free(map);
}

void view_write(const char *path, int width, int height, view_light_fn light, const void *user)
{
    struct rg_picture picture;
    assert_true(rg_picture_create(&picture, width, height, 3, "test"));
    memset(picture.texels, 0, (size_t)rg_picture_values(&picture) * sizeof(float));
    for (int y = 0; y < height; y++)
        for (int x = 0; x < width; x++)
            light(x, y, user, picture.texels + (y * width + x) * 3);
    assert_true(rg_picture_write(path, &picture, &(struct rg_write_options){.full_float = true}));
    rg_picture_destroy(&picture);
}

// --- the oracle ---

// All layers of a level as red, green and blue; the oracle keeps them.
static const float *read_level(struct view_oracle *o, struct rg_image *image, int level)
{
    const int width = rg_level_size(image->desc.width, level);
    const int height = rg_level_size(image->desc.height, level);
    const int texels = width * height, words = rg_format_size(image->desc.format) / 4;
    uint32_t *packed = malloc((size_t)(texels * words) * sizeof(*packed));
    float *light = malloc((size_t)(texels * image->desc.layers * 3) * sizeof(*light));
    assert_true(packed && light);
    for (int layer = 0; layer < image->desc.layers; layer++) {
        assert_true(rg_image_read(image, layer, level, packed));
        for (int i = 0; i < texels; i++) {
            const rgba c =
                words == 1 ? rg_load_RG11B10F(packed, i) : rg_load_RGBA16F(packed, 2 * i);
            float *to = light + (layer * texels + i) * 3;
            to[0] = c.r;
            to[1] = c.g;
            to[2] = c.b;
        }
    }
    free(packed);
    o->levels[o->level_count++] = light;
    return light;
}

static void read_outside(struct drops *d, struct view_oracle *o)
{
    struct rg_image *environment = rg_asset_find(&d->base, "environment")->image;
    struct rg_image *background = rg_asset_find(&d->base, "background")->image;
    struct pane_oracle *p = &o->pane;
    p->environment_levels = environment->desc.levels;
    for (int i = 0; i < p->environment_levels; i++)
        p->environment[i] = (struct light_cube){read_level(o, environment, i),
                                                rg_level_size(environment->desc.width, i)};
    p->background_levels = d->settings.background[0] ? background->desc.levels : 0;
    for (int i = 0; i < p->background_levels; i++)
        p->background[i] = (struct pane_picture){read_level(o, background, i),
                                                 rg_level_size(background->desc.width, i),
                                                 rg_level_size(background->desc.height, i)};
}

void view_oracle_of(struct drops *d, struct view_oracle *o)
{
    const struct drops_settings *s = &d->settings;
    *o = (struct view_oracle){.heights = malloc((size_t)(s->columns * s->rows) * sizeof(float))};
    float *map = rig_words(d, "height");
    assert_non_null(o->heights);
    for (int row = 0; row < s->rows; row++)
        memcpy(o->heights + row * s->columns, map + drops_cell(d->params, 0, row),
               (size_t)s->columns * sizeof(float));
    free(map);
    o->pane = (struct pane_oracle){
        .water = {o->heights, s->columns, s->rows, s->cell_mm},
        .width = d->base.target->desc.width,
        .height = d->base.target->desc.height,
        .rays = s->rays_px,
        .distance_mm = s->distance_mm,
        .index = s->refractive_index,
        .contact_mm = s->contact_mm,
        .tilt_deg = s->tilt_deg,
        .turn_deg = s->turn_deg,
        .background_mm = 1000 * s->background_m,
        .background_deg = s->background_deg,
    };
    read_outside(d, o);
}

void view_oracle_free(struct view_oracle *o)
{
    free(o->heights);
    for (int i = 0; i < o->level_count; i++)
        free(o->levels[i]);
}
