#include "core/techniques/scenery/scenery.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "core/scene/matrix.h"
#include "core/techniques/scenery/cull.h"
#include "core/techniques/scenery/made.h"
#include "kernels/dialect/image/format.h"
#include "kernels/scenery/city_shade_params.h"

enum scenery_pass { FACES, SHADE, PASS_COUNT };

struct scenery {
    struct rg_instance *instance;
    const struct scenery_made *made;
    const struct scenery_paint *paint; // NULL: it is never lit
    int first_stage;
    // Assets that each draw sets: visible blocks, surface numbers of the target's size, and the
    // caller's objects.
    struct rg_asset *blocks, *numbers, *depths, *lights, *shadows;
    struct scenery_cull cull;
    bool *seen;            // by chunk, in the last draw
    uint32_t *block_words; // two for each block
    struct scenery_work work;
    scenery_city_params faces_params;
    scenery_city_shade_params shade_params;
};

// --- opening ---

void scenery_close(struct scenery *s)
{
    if (!s)
        return;
    if (s->paint)
        scenery_paint_put(s->instance->device, s->paint);
    if (s->made)
        scenery_made_put(s->instance->device, s->made);
    free(s->seen);
    free(s->block_words);
    free(s);
}

static bool make_blocks(struct scenery *s)
{
    const struct city *city = s->made->city;
    const struct city_faces *f = &city->faces;
    int blocks = 0;
    for (int i = 0; i < f->chunk_count; i++)
        blocks += (f->chunks[i].count + SCENERY_BLOCK_FACES - 1) / SCENERY_BLOCK_FACES;
    s->cull.faces = f;
    s->cull.box_count = city->box_count;
    s->cull.boxes = city->boxes;
    return (s->seen = rg_alloc((size_t)f->chunk_count, sizeof(*s->seen), "scene")) &&
           (s->block_words = rg_alloc((size_t)blocks, 2 * sizeof(*s->block_words), "scene")) &&
           (s->blocks = rg_add_room(s->instance, "scene.blocks", 2 * (int64_t)blocks));
}

static void lend(struct scenery *s)
{
    struct rg_instance *i = s->instance;
    rg_lend_buf(i, "scene.faces", s->made->faces);
    rg_lend_buf(i, "scene.surface_of", s->made->surface_of);
    rg_lend_buf(i, "scene.surfaces", s->made->surfaces);
    rg_lend_buf(i, "scene.openness", s->paint ? s->paint->openness : NULL);
    rg_lend_image(i, "scene.textures", s->paint ? s->paint->textures : NULL);
    s->numbers = rg_lend_image(i, "scene.numbers", NULL);
    s->depths = rg_lend_image(i, "scene.depths", NULL);
    s->lights = rg_lend_buf(i, "scene.lights", NULL);
    s->shadows = rg_lend_image(i, "scene.shadows", NULL);
}

#define AT(field) offsetof(struct scenery, field)

struct scenery *scenery_open(struct rg_instance *instance, const struct scenery_settings *settings)
{
    static const struct rg_stage stages[PASS_COUNT] = {
        [FACES] = {"streaks_city", .params = AT(faces_params)},
        [SHADE] = {"streaks_city_shade", .params = AT(shade_params)},
    };
    struct scenery *s = rg_alloc(1, sizeof(*s), "scene");
    if (!s)
        return NULL;
    s->instance = instance;
    if ((s->made = scenery_made_get(instance->device, settings)) && make_blocks(s) &&
        (settings->bare || (s->paint = scenery_paint_get(s->made, settings)))) {
        lend(s);
        s->first_stage = rg_open_stages(instance, stages, PASS_COUNT, s, "scene");
        if (s->first_stage >= 0)
            return s;
    }
    scenery_close(s);
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

// Lists the blocks of the visible chunks, and returns their number. kernels/scenery/city_params.h
// describes a block's words.
static int list_blocks(struct scenery *s)
{
    const struct city_faces *f = &s->made->city->faces;
    int blocks = 0;
    for (int i = 0; i < f->chunk_count; i++) {
        const struct city_chunk *chunk = &f->chunks[i];
        for (int k = 0; s->seen[i] && k < chunk->count; k += SCENERY_BLOCK_FACES) {
            const int rest = chunk->count - k;
            s->block_words[2 * blocks] = (uint32_t)(chunk->first + k);
            s->block_words[2 * blocks + 1] =
                (uint32_t)(rest < SCENERY_BLOCK_FACES ? rest : SCENERY_BLOCK_FACES);
            blocks++;
        }
    }
    return blocks;
}

static bool draw_faces(struct scenery *s, m4 to_clip, const struct rg_draw *onto, enum rg_cull cull,
                       bool everything)
{
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
    s->faces_params = (scenery_city_params){to_clip};
    return rg_buf_write(s->blocks->buf, 0, s->block_words, (int64_t)blocks * 8) &&
           rg_stage_onto(s->instance, s->first_stage + FACES, blocks * SCENERY_BLOCK_FACES, &draw);
}

bool scenery_depth(struct scenery *scene, m4 to_clip, const struct rg_draw *onto)
{
    struct rg_draw depth = *onto;
    depth.colour = NULL;
    return draw_faces(scene, to_clip, &depth, RG_CULL_NONE, false);
}

bool scenery_numbers(struct scenery *scene, m4 to_clip, const struct rg_draw *onto)
{
    return draw_faces(scene, to_clip, onto, RG_CULL_NONE, false);
}

static bool shade(struct scenery *s, const struct scenery_view *view,
                  const struct scenery_look *look, const struct scenery_lights *lights)
{
    const struct rg_image_desc *d = &view->colour->desc;
    scenery_city_shade_params *p = &s->shade_params;
    *p = (scenery_city_shade_params){
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
        .last_level = s->paint->levels - 1,
    };
    if (!rg_matrix_from_pixel(&view->to_clip, d->width, d->height, &p->from_pixel))
        return rg_error("scene: its matrix maps space to less; move the camera");
    p->pixel_m = sqrtf(p->from_pixel.xx * p->from_pixel.xx + p->from_pixel.yx * p->from_pixel.yx +
                       p->from_pixel.zx * p->from_pixel.zx);
    s->depths->image = view->depth;
    s->lights->buf = lights->in_world;
    s->shadows->image = lights->shadows;
    return rg_stage_onto(s->instance, s->first_stage + SHADE, 1,
                         &(struct rg_draw){.colour = view->colour});
}

bool scenery_draw(struct scenery *s, const struct scenery_view *view,
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
    const struct rg_image_desc *target = &view->colour->desc;
    if (!rg_make_image(s->instance, s->numbers,
                       &(struct rg_image_desc){RG_RGBA8, target->width, target->height, 1, 1}))
        return false;
    const struct rg_draw numbered = {.colour = s->numbers->image, .depth = view->depth};
    const enum rg_cull cull = s->made->city->is_mesh ? RG_CULL_NONE : RG_CULL_BACK;
    return draw_faces(s, view->to_clip, &numbered, cull, view->everything) &&
           shade(s, view, look, lights);
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
