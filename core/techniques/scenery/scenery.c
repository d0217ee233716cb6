#include "core/techniques/scenery/scenery.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "core/techniques/scenery/cull.h"
#include "core/techniques/scenery/made.h"
#include "kernels/dialect/image/format.h"
#include "kernels/scenery/city_shade_params.h"

struct scenery {
    struct rg_device *device;
    const struct scenery_made *made;
    struct rg_buf *block_words; // of the last draw
    struct rg_image *numbers;   // of the target's size
    struct rg_pass *draw, *shade;
    struct scenery_cull cull;
    bool *seen;       // by chunk: in the last draw
    uint32_t *blocks; // two words each
    struct scenery_work work;
};

// --- opening ---

void scenery_put(struct scenery *s)
{
    if (!s)
        return;
    rg_pass_destroy(s->draw);
    rg_pass_destroy(s->shade);
    rg_buf_destroy(s->block_words);
    rg_image_destroy(s->numbers);
    if (s->made)
        scenery_made_put(s->device, s->made);
    free(s->seen);
    free(s->blocks);
    free(s);
}

static bool create_blocks(struct scenery *s)
{
    const struct city *city = s->made->city;
    const struct city_faces *f = &city->faces;
    int blocks = 0;
    for (int i = 0; i < f->chunk_count; i++)
        blocks += (f->chunks[i].count + SCENERY_BLOCK_FACES - 1) / SCENERY_BLOCK_FACES;
    s->cull.faces = f;
    s->cull.box_count = city->box_count;
    s->cull.boxes = city->boxes;
    s->seen = rg_alloc((size_t)f->chunk_count, sizeof(*s->seen), "scene");
    s->blocks = rg_alloc((size_t)blocks, 2 * sizeof(*s->blocks), "scene");
    s->block_words = rg_buf_create(s->device, (int64_t)blocks * 8, "blocks of faces");
    return s->seen && s->blocks && s->block_words;
}

struct scenery *scenery_get(struct rg_device *device, const struct scenery_settings *settings)
{
    struct scenery *s = rg_alloc(1, sizeof(*s), "scene");
    if (!s)
        return NULL;
    s->device = device;
    if ((s->made = scenery_made_get(device, settings)) && create_blocks(s) &&
        (s->draw = rg_pass_create(device, "streaks_city")) &&
        (s->shade = rg_pass_create(device, "streaks_city_shade")))
        return s;
    scenery_put(s);
    return NULL;
}

const struct city *scenery_city(const struct scenery *s)
{
    return s->made->city;
}

int scenery_lamps(const struct scenery *s, const struct city_lamp **lamps)
{
    *lamps = s->made->city->lamps;
    return s->made->city->lamp_count;
}

struct rg_buf *scenery_surfaces(const struct scenery *s)
{
    return s->made->surfaces;
}

struct scenery_work scenery_last(const struct scenery *s)
{
    return s->work;
}

// --- drawing ---

// The blocks of the chunks that are seen; returns how many. All that is known of a block's words is
// in kernels/scenery/city_params.h.
static int list_blocks(struct scenery *s)
{
    const struct city_faces *f = &s->made->city->faces;
    int blocks = 0;
    for (int i = 0; i < f->chunk_count; i++) {
        const struct city_chunk *chunk = &f->chunks[i];
        for (int k = 0; s->seen[i] && k < chunk->count; k += SCENERY_BLOCK_FACES) {
            const int rest = chunk->count - k;
            s->blocks[2 * blocks] = (uint32_t)(chunk->first + k);
            s->blocks[2 * blocks + 1] =
                (uint32_t)(rest < SCENERY_BLOCK_FACES ? rest : SCENERY_BLOCK_FACES);
            blocks++;
        }
    }
    return blocks;
}

static bool draw_faces(struct scenery *s, struct rg_instance *instance, m4 to_clip,
                       const struct rg_draw *onto, enum rg_cull cull, bool everything)
{
    const scenery_city_params params = {to_clip};
    struct rg_draw draw = *onto;
    draw.blend = RG_BLEND_OFF;
    draw.depth_mode = RG_DEPTH_WRITE;
    draw.cull = cull;
    scenery_cull(&s->cull, to_clip, cull == RG_CULL_BACK, s->seen);
    for (int i = 0; everything && i < s->made->city->faces.chunk_count; i++)
        s->seen[i] = true;
    const int blocks = list_blocks(s);
    s->work = (struct scenery_work){.chunks = s->made->city->faces.chunk_count, .blocks = blocks};
    for (int i = 0; i < s->work.chunks; i++)
        s->work.chunks_drawn += s->seen[i] ? 1 : 0;
    if (!blocks)
        return true;
    return rg_buf_write(s->block_words, 0, s->blocks, (int64_t)blocks * 8) &&
           rg_instance_run(instance, s->draw,
                           &(struct rg_run){.params = &params,
                                            .slots = {[1].buf = s->made->faces,
                                                      [2].buf = s->made->surface_of,
                                                      [3].buf = s->block_words},
                                            .extent = {blocks * SCENERY_BLOCK_FACES, 1, 1},
                                            .draw = &draw});
}

bool scenery_depth(struct scenery *scene, struct rg_instance *instance, m4 to_clip,
                   const struct rg_draw *onto)
{
    struct rg_draw depth = *onto;
    depth.colour = NULL;
    return draw_faces(scene, instance, to_clip, &depth, RG_CULL_NONE, false);
}

bool scenery_numbers(struct scenery *scene, struct rg_instance *instance, m4 to_clip,
                     const struct rg_draw *onto)
{
    return draw_faces(scene, instance, to_clip, onto, RG_CULL_NONE, false);
}

static bool fit_numbers(struct scenery *s, const struct rg_image *target)
{
    const int width = target->desc.width, height = target->desc.height;
    if (s->numbers && s->numbers->desc.width == width && s->numbers->desc.height == height)
        return true;
    rg_image_destroy(s->numbers);
    s->numbers = rg_image_create(s->device, &(struct rg_image_desc){RG_RGBA8, width, height, 1, 1},
                                 "surfaces' numbers");
    return s->numbers;
}

// One step of Gauss and Jordan: column c of `rows` becomes that of the unit matrix. False where it
// cannot.
static bool eliminate(double rows[4][8], int c)
{
    int pivot = c;
    for (int r = c + 1; r < 4; r++)
        if (fabs(rows[r][c]) > fabs(rows[pivot][c]))
            pivot = r;
    const double by = rows[pivot][c];
    if (!(fabs(by) > 1e-12))
        return false;
    for (int k = 0; k < 8; k++) {
        const double swapped = rows[c][k];
        rows[c][k] = rows[pivot][k] / by;
        if (pivot != c)
            rows[pivot][k] = swapped;
    }
    for (int r = 0; r < 4; r++) {
        const double times = rows[r][c];
        for (int k = 0; r != c && k < 8; k++)
            rows[r][k] -= times * rows[c][k];
    }
    return true;
}

// From pixels and depth to the world: the matrix's inverse, behind the viewport's. In double
// precision, since far away all depends on the last digits.
static bool invert(const m4 *to_clip, int width, int height, m4 *from_pixel)
{
    const float m[16] = {to_clip->xx, to_clip->xy, to_clip->xz, to_clip->xw,
                         to_clip->yx, to_clip->yy, to_clip->yz, to_clip->yw,
                         to_clip->zx, to_clip->zy, to_clip->zz, to_clip->zw,
                         to_clip->wx, to_clip->wy, to_clip->wz, to_clip->ww};
    double rows[4][8] = {{0}};
    for (int i = 0; i < 16; i++)
        rows[i / 4][i % 4] = (double)m[i];
    for (int i = 0; i < 4; i++)
        rows[i][4 + i] = 1;
    for (int c = 0; c < 4; c++)
        if (!eliminate(rows, c))
            return rg_error("scene: its matrix maps space to less; move the camera");
    float from[16];
    for (int i = 0; i < 4; i++) {
        const double x = rows[i][4], y = rows[i][5];
        from[4 * i] = (float)(x * 2 / width);
        from[4 * i + 1] = (float)(y * 2 / height);
        from[4 * i + 2] = (float)rows[i][6];
        from[4 * i + 3] = (float)(rows[i][7] - x - y);
    }
    memcpy(from_pixel, from, sizeof(from));
    return true;
}

static bool shade(struct scenery *s, struct rg_instance *instance, const struct scenery_view *view,
                  const struct scenery_look *look, const struct scenery_lights *lights)
{
    const struct rg_image_desc *d = &view->colour->desc;
    scenery_city_shade_params p = {
        .sky = look->sky,
        .eye_x = view->eye[0],
        .eye_y = view->eye[1],
        .eye_z = view->eye[2],
        .ambient = look->ambient,
        .bounced = look->bounced,
        .glow = look->glow,
        .wet = look->wet,
        .lights = lights->count,
        .texture_px = s->made->city->texture_px,
        .last_level = s->made->levels - 1,
    };
    if (!invert(&view->to_clip, d->width, d->height, &p.from_pixel))
        return false;
    p.pixel_m = sqrtf(p.from_pixel.xx * p.from_pixel.xx + p.from_pixel.yx * p.from_pixel.yx +
                      p.from_pixel.zx * p.from_pixel.zx);
    const struct rg_draw draw = {.colour = view->colour};
    return rg_instance_run(instance, s->shade,
                           &(struct rg_run){.params = &p,
                                            .slots = {[1].image = s->numbers,
                                                      [2].image = view->depth,
                                                      [3].buf = s->made->surfaces,
                                                      [4].image = s->made->textures,
                                                      [5].buf = lights->in_world,
                                                      [6].image = lights->shadows,
                                                      [7].buf = s->made->openness},
                                            .extent = {1, 1, 1},
                                            .draw = &draw});
}

bool scenery_draw(struct scenery *s, struct rg_instance *instance, const struct scenery_view *view,
                  const struct scenery_look *look, const struct scenery_lights *lights,
                  bool geometry)
{
    const float farthest = 1;
    const uint16_t sky[4] = {
        (uint16_t)rg_pack_half(look->sky.horizon_r), (uint16_t)rg_pack_half(look->sky.horizon_g),
        (uint16_t)rg_pack_half(look->sky.horizon_b), (uint16_t)rg_pack_half(1)};
    if (!rg_image_clear(view->depth, &farthest))
        return false;
    if (!geometry)
        return rg_image_clear(view->colour, sky);
    if (!fit_numbers(s, view->colour))
        return false;
    const struct rg_draw numbered = {.colour = s->numbers, .depth = view->depth};
    const enum rg_cull cull = s->made->city->is_mesh ? RG_CULL_NONE : RG_CULL_BACK;
    return draw_faces(s, instance, view->to_clip, &numbered, cull, view->everything) &&
           shade(s, instance, view, look, lights);
}

struct scenery_look scenery_day(void)
{
    return (struct scenery_look){
        .sky = {0.58f, 0.64f, 0.72f, 0.46f, 0.49f, 0.53f, 0.5f, 0.0016f},
        .ambient = 1.1f,
        .bounced = 0.2f,
        .glow = 0.25f,
        .wet = 1,
    };
}

struct scenery_look scenery_night(void)
{
    return (struct scenery_look){
        .sky = {0.016f, 0.020f, 0.030f, 0.058f, 0.048f, 0.042f, 0.6f, 0.0020f},
        .ambient = 1.3f,
        .bounced = 1.6f,
        .glow = 1.1f,
        .wet = 1,
    };
}
