#include "core/techniques/streaks_scene.h"

#include <math.h>
#include <string.h>

#include "core/alloc.h"
#include "core/log.h"
#include "core/techniques/streaks_scene_cull.h"
#include "kernels/streaks_city_shade_params.h"
#include "kernels/streaks_openness_grid.h"

enum { TEXTURE_LEVELS_MOST = 10, PAINTED_AT_ONCE = 8 };

struct streaks_scene {
    struct rg_device *device;
    struct city *city;
    struct rg_buf *faces, *surface_of, *surfaces;
    struct rg_buf *openness;
    struct rg_buf *block_words; // of the last draw
    struct rg_image *textures;
    struct rg_image *numbers; // of the last target's size
    struct rg_pass *draw, *shade;
    int levels;
    struct streaks_lamp *lamps;
    struct streaks_cull cull;
    bool *seen;       // by chunk: in the present draw
    uint32_t *blocks; // two words each
    struct streaks_scene_work work;
};

// --- textures ---

static int levels_of(int size)
{
    int levels = 1;
    while (size >> levels && levels < TEXTURE_LEVELS_MOST)
        levels++;
    return levels;
}

// A level of half the side, from texels of square roots of light.
static void halve(const uint32_t *from, int size, uint32_t *to)
{
    const int half = size / 2;
    for (int y = 0; y < half; y++) {
        for (int x = 0; x < half; x++) {
            const uint32_t *t = from + 2 * y * size + 2 * x;
            const uint32_t four[4] = {t[0], t[1], t[size], t[size + 1]};
            uint32_t texel = 0;
            for (int c = 0; c < 4; c++) {
                int sum = 0;
                for (int i = 0; i < 4; i++) {
                    const int v = (int)(four[i] >> 8 * c & 255);
                    sum += c < 3 ? v * v : v;
                }
                const float mean = (float)sum * 0.25f;
                texel |= (uint32_t)((c < 3 ? sqrtf(mean) : mean) + 0.5f) << 8 * c;
            }
            to[y * half + x] = texel;
        }
    }
}

// All levels of a texture, one after the other.
static void paint_levels(const struct city_painter *painter, int texture, int size, int levels,
                         uint32_t *texels)
{
    city_paint(painter, texture, texels);
    for (int level = 1; level < levels; level++) {
        halve(texels, size, texels + size * size);
        texels += size * size;
        size /= 2;
    }
}

static bool write_levels(struct streaks_scene *s, int texture, const uint32_t *texels)
{
    int size = s->city->texture_px;
    for (int level = 0; level < s->levels; level++) {
        if (!rg_image_write(s->textures, texture, level, texels))
            return false;
        texels += size * size;
        size = size > 1 ? size / 2 : 1;
    }
    return true;
}

static bool create_textures(struct streaks_scene *s)
{
    const struct city *city = s->city;
    const int size = city->texture_px;
    s->levels = levels_of(size);
    const struct rg_image_desc desc = {RG_RGBA8, size, size, city->texture_count, s->levels};
    const size_t room = (size_t)size * (size_t)size * 4 / 3 + 64;
    s->textures = rg_image_create(s->device, &desc, "scene's textures");
    uint32_t *texels =
        s->textures ? rg_alloc(PAINTED_AT_ONCE * room, sizeof(*texels), "textures") : NULL;
    struct city_painter *painter = texels ? city_painter_create(&city->settings) : NULL;
    bool ok = painter != NULL;
    for (int first = 0; ok && first < city->texture_count; first += PAINTED_AT_ONCE) {
        const int end = first + PAINTED_AT_ONCE < city->texture_count ? first + PAINTED_AT_ONCE
                                                                      : city->texture_count;
#pragma omp parallel for schedule(dynamic, 1)
        for (int i = first; i < end; i++)
            paint_levels(painter, i, size, s->levels, texels + (size_t)(i - first) * room);
        for (int i = first; ok && i < end; i++)
            ok = write_levels(s, i, texels + (size_t)(i - first) * room);
    }
    city_painter_destroy(painter);
    free(texels);
    return ok;
}

// --- opening ---

static struct rg_buf *filled(struct rg_device *device, const void *words, int64_t count,
                             const char *name)
{
    struct rg_buf *buf = rg_buf_create(device, 4 * count, name);
    if (buf && rg_buf_write(buf, 0, words, 4 * count))
        return buf;
    rg_buf_destroy(buf);
    return NULL;
}

static bool create_openness(struct streaks_scene *s)
{
    uint32_t *words = rg_alloc(STREAKS_OPEN_WORDS, sizeof(*words), "scene");
    if (words && city_openness(s->city, words))
        s->openness = filled(s->device, words, STREAKS_OPEN_WORDS, "openness to the sky");
    free(words);
    return s->openness;
}

// The city's lamps as streaks_lights takes them.
static bool take_lamps(struct streaks_scene *s)
{
    const struct city *city = s->city;
    s->lamps = rg_alloc((size_t)city->lamp_count, sizeof(*s->lamps), "scene");
    for (int i = 0; s->lamps && i < city->lamp_count; i++) {
        const struct city_lamp *lamp = &city->lamps[i];
        s->lamps[i].kind = lamp->kind == CITY_STREET_LAMP   ? STREAKS_STREET_LAMP
                           : lamp->kind == CITY_TRAFFIC_RED ? STREAKS_TRAFFIC_RED
                                                            : STREAKS_TRAFFIC_GREEN;
        memcpy(s->lamps[i].position_m, lamp->position, sizeof(lamp->position));
        memcpy(s->lamps[i].direction, lamp->direction, sizeof(lamp->direction));
    }
    return s->lamps;
}

static bool create_buffers(struct streaks_scene *s)
{
    const struct city_faces *f = &s->city->faces;
    const int64_t faces = f->face_count;
    int blocks = 0;
    for (int i = 0; i < f->chunk_count; i++)
        blocks += (f->chunks[i].count + STREAKS_BLOCK_FACES - 1) / STREAKS_BLOCK_FACES;
    s->seen = rg_alloc((size_t)f->chunk_count, sizeof(*s->seen), "scene");
    s->blocks = rg_alloc((size_t)blocks, 2 * sizeof(*s->blocks), "scene");
    s->cull.faces = f;
    s->cull.box_count = s->city->box_count;
    s->cull.boxes = s->city->boxes;
    return s->seen && s->blocks &&
           (s->block_words = rg_buf_create(s->device, (int64_t)blocks * 8, "blocks of faces")) &&
           (s->faces =
                filled(s->device, f->corners, faces * STREAKS_FACE_WORDS, "scene's faces")) &&
           (s->surface_of = filled(s->device, f->surface_of, faces, "faces' surfaces")) &&
           (s->surfaces =
                filled(s->device, f->surfaces, (int64_t)f->surface_count * STREAKS_SURFACE_WORDS,
                       "scene's surfaces"));
}

void streaks_scene_put(struct streaks_scene *s)
{
    if (!s)
        return;
    rg_pass_destroy(s->draw);
    rg_pass_destroy(s->shade);
    rg_buf_destroy(s->faces);
    rg_buf_destroy(s->surface_of);
    rg_buf_destroy(s->surfaces);
    rg_buf_destroy(s->openness);
    rg_buf_destroy(s->block_words);
    rg_image_destroy(s->textures);
    rg_image_destroy(s->numbers);
    city_destroy(s->city);
    free(s->lamps);
    free(s->seen);
    free(s->blocks);
    free(s);
}

struct streaks_scene *streaks_scene_get(struct rg_device *device,
                                        const struct streaks_scene_settings *settings)
{
    struct streaks_scene *s = rg_alloc(1, sizeof(*s), "scene");
    if (!s)
        return NULL;
    s->device = device;
    if ((s->city = city_create(&settings->city)) && create_buffers(s) && create_openness(s) &&
        take_lamps(s) && create_textures(s) && (s->draw = rg_pass_create(device, "streaks_city")) &&
        (s->shade = rg_pass_create(device, "streaks_city_shade")))
        return s;
    streaks_scene_put(s);
    return NULL;
}

const struct city_faces *streaks_scene_faces(const struct streaks_scene *s)
{
    return &s->city->faces;
}

int streaks_scene_lamps(const struct streaks_scene *s, const struct streaks_lamp **lamps)
{
    *lamps = s->lamps;
    return s->city->lamp_count;
}

uint64_t streaks_scene_hash(const struct streaks_scene *s)
{
    return s->city->hash;
}

struct rg_buf *streaks_scene_surfaces(const struct streaks_scene *s)
{
    return s->surfaces;
}

struct streaks_scene_work streaks_scene_last(const struct streaks_scene *s)
{
    return s->work;
}

// --- drawing ---

// The blocks of the chunks that are seen; returns how many. All that is known of a block's words is
// in kernels/streaks_city_params.h.
static int list_blocks(struct streaks_scene *s)
{
    const struct city_faces *f = &s->city->faces;
    int blocks = 0;
    for (int i = 0; i < f->chunk_count; i++) {
        const struct city_chunk *chunk = &f->chunks[i];
        for (int k = 0; s->seen[i] && k < chunk->count; k += STREAKS_BLOCK_FACES) {
            const int rest = chunk->count - k;
            s->blocks[2 * blocks] = (uint32_t)(chunk->first + k);
            s->blocks[2 * blocks + 1] =
                (uint32_t)(rest < STREAKS_BLOCK_FACES ? rest : STREAKS_BLOCK_FACES);
            blocks++;
        }
    }
    return blocks;
}

static bool draw_faces(struct streaks_scene *s, struct rg_instance *instance, m4 to_clip,
                       const struct rg_draw *onto, enum rg_cull cull)
{
    const streaks_city_params params = {to_clip};
    struct rg_draw draw = *onto;
    draw.blend = RG_BLEND_OFF;
    draw.depth_mode = RG_DEPTH_WRITE;
    draw.cull = cull;
    streaks_cull(&s->cull, to_clip, cull == RG_CULL_BACK, s->seen);
    const int blocks = list_blocks(s);
    s->work = (struct streaks_scene_work){.chunks = s->city->faces.chunk_count, .blocks = blocks};
    for (int i = 0; i < s->work.chunks; i++)
        s->work.chunks_drawn += s->seen[i] ? 1 : 0;
    if (!blocks)
        return true;
    return rg_buf_write(s->block_words, 0, s->blocks, (int64_t)blocks * 8) &&
           rg_instance_run(
               instance, s->draw,
               &(struct rg_run){
                   .params = &params,
                   .slots = {[1].buf = s->faces, [2].buf = s->surface_of, [3].buf = s->block_words},
                   .extent = {blocks * STREAKS_BLOCK_FACES, 1, 1},
                   .draw = &draw});
}

bool streaks_scene_depth(struct streaks_scene *scene, struct rg_instance *instance, m4 to_clip,
                         const struct rg_draw *onto)
{
    struct rg_draw depth = *onto;
    depth.colour = NULL;
    return draw_faces(scene, instance, to_clip, &depth, RG_CULL_NONE);
}

bool streaks_scene_numbers(struct streaks_scene *scene, struct rg_instance *instance, m4 to_clip,
                           const struct rg_draw *onto)
{
    return draw_faces(scene, instance, to_clip, onto, RG_CULL_NONE);
}

static bool fit_numbers(struct streaks_scene *s, const struct rg_image *target)
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

static bool shade(struct streaks_scene *s, struct rg_instance *instance,
                  const struct streaks_scene_view *view, const struct streaks_scene_look *look,
                  const struct streaks_lights *lights)
{
    const struct rg_image_desc *d = &view->colour->desc;
    streaks_city_shade_params p = {
        .sky = look->sky,
        .eye_x = view->eye[0],
        .eye_y = view->eye[1],
        .eye_z = view->eye[2],
        .ambient = look->ambient,
        .bounced = look->bounced,
        .glow = look->glow,
        .wet = look->wet,
        .lights = lights->count,
        .texture_px = s->city->texture_px,
        .last_level = s->levels - 1,
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
                                                      [3].buf = s->surfaces,
                                                      [4].image = s->textures,
                                                      [5].buf = lights->in_world,
                                                      [6].image = lights->shadows,
                                                      [7].buf = s->openness},
                                            .extent = {1, 1, 1},
                                            .draw = &draw});
}

bool streaks_scene_draw(struct streaks_scene *s, struct rg_instance *instance,
                        const struct streaks_scene_view *view,
                        const struct streaks_scene_look *look, const struct streaks_lights *lights,
                        bool geometry)
{
    const float farthest = 1;
    const struct rg_draw onto = {.colour = NULL, .depth = view->depth};
    if (!fit_numbers(s, view->colour) || !rg_image_clear(view->depth, &farthest))
        return false;
    struct rg_draw numbered = onto;
    numbered.colour = s->numbers;
    if (geometry && !draw_faces(s, instance, view->to_clip, &numbered, RG_CULL_BACK))
        return false;
    return shade(s, instance, view, look, lights);
}

struct streaks_scene_look streaks_scene_day(void)
{
    return (struct streaks_scene_look){
        .sky = {0.62f, 0.68f, 0.76f, 0.50f, 0.53f, 0.57f, 0.5f, 0.0022f},
        .ambient = 1.1f,
        .bounced = 0.12f,
        .glow = 0.35f,
        .wet = 1,
    };
}

struct streaks_scene_look streaks_scene_night(void)
{
    return (struct streaks_scene_look){
        .sky = {0.012f, 0.015f, 0.022f, 0.040f, 0.034f, 0.030f, 0.6f, 0.0022f},
        .ambient = 1.2f,
        .bounced = 0.4f,
        .glow = 1.2f,
        .wet = 1,
    };
}
