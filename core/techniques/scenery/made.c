// The parts of a scene on a device that instances share: faces, surfaces and textures.
#include "core/techniques/scenery/made.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/device/shared.h"
#include "kernels/scenery/openness_grid.h"

enum { TEXTURE_LEVELS_MOST = 10, PAINTED_AT_ONCE = 8 };

// --- textures ---

static int levels_of(int size)
{
    int levels = 1;
    while (size >> levels && levels < TEXTURE_LEVELS_MOST)
        levels++;
    return levels;
}

// Halves a level whose texels are square roots of light.
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

static bool write_levels(struct scenery_paint *s, const struct city *city, int texture,
                         const uint32_t *texels)
{
    int size = city->texture_px;
    for (int level = 0; level < s->levels; level++) {
        if (!rg_image_write(s->textures, texture, level, texels))
            return false;
        texels += size * size;
        size = size > 1 ? size / 2 : 1;
    }
    return true;
}

static bool create_textures(struct scenery_paint *s, const struct city *city)
{
    const int size = city->texture_px;
    s->levels = levels_of(size);
    const struct rg_image_desc desc = {RG_RGBA8, size, size, city->texture_count, s->levels};
    const size_t room = (size_t)size * (size_t)size * 4 / 3 + 64;
    s->textures = rg_image_create(s->device, &desc, "scene's textures");
    if (city->is_mesh) {
        const uint32_t white = 0xffffffu;
        return s->textures && rg_image_write(s->textures, 0, 0, &white);
    }
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
            ok = write_levels(s, city, i, texels + (size_t)(i - first) * room);
    }
    city_painter_destroy(painter);
    free(texels);
    return ok;
}

// --- buffers ---

static bool create_openness(struct scenery_paint *s, const struct city *city)
{
    uint32_t *words = rg_alloc(SCENERY_OPEN_WORDS, sizeof(*words), "scene");
    if (words && city_openness(city, words))
        s->openness =
            rg_buf_create_with(s->device, words, SCENERY_OPEN_WORDS * 4, "openness to the sky");
    free(words);
    return s->openness;
}

static bool create_buffers(struct scenery_made *s)
{
    struct rg_device *device = s->device;
    const struct city_faces *f = &s->city->faces;
    const int64_t corners = 4 * (int64_t)f->face_count * SCENERY_FACE_WORDS;
    const int64_t surfaces = 4 * (int64_t)f->surface_count * SCENERY_SURFACE_WORDS;
    return (s->faces = rg_buf_create_with(device, f->corners, corners, "scene's faces")) &&
           (s->surface_of = rg_buf_create_with(device, f->surface_of, 4 * (int64_t)f->face_count,
                                               "faces' surfaces")) &&
           (s->surfaces = rg_buf_create_with(device, f->surfaces, surfaces, "scene's surfaces"));
}

// --- making ---

static void destroy(void *thing)
{
    struct scenery_made *s = thing;
    rg_buf_destroy(s->faces);
    rg_buf_destroy(s->surface_of);
    rg_buf_destroy(s->surfaces);
    city_destroy(s->city);
    free(s);
}

static void *make(struct rg_device *device, const void *arg)
{
    const struct scenery_settings *settings = arg;
    struct scenery_made *s = rg_alloc(1, sizeof(*s), "scene");
    if (!s)
        return NULL;
    s->device = device;
    s->city = settings->model[0] ? city_of_mesh(settings->model) : city_create(&settings->city);
    if (s->city && create_buffers(s))
        return s;
    destroy(s);
    return NULL;
}

static void destroy_paint(void *thing)
{
    struct scenery_paint *s = thing;
    rg_buf_destroy(s->openness);
    rg_image_destroy(s->textures);
    free(s);
}

static void *make_paint(struct rg_device *device, const void *arg)
{
    const struct scenery_made *made = arg;
    struct scenery_paint *s = rg_alloc(1, sizeof(*s), "scene");
    if (!s)
        return NULL;
    s->device = device;
    if (create_openness(s, made->city) && create_textures(s, made->city))
        return s;
    destroy_paint(s);
    return NULL;
}

// Gets a part of `made`, or of its light, by the scene's name.
static void *get(struct rg_device *device, const struct scenery_settings *settings,
                 const struct rg_shared_kind *kind, const void *arg)
{
    char key[RG_PATH_SIZE + 64];
    if (settings->model[0])
        snprintf(key, sizeof(key), "mesh %s", settings->model);
    else
        snprintf(key, sizeof(key), "city %d %d", settings->city.seed, (int)settings->city.size);
    return rg_shared_get(device, key, kind, arg);
}

const struct scenery_made *scenery_made_get(struct rg_device *device,
                                            const struct scenery_settings *settings)
{
    static const struct rg_shared_kind kind = {"scene", make, destroy};
    return get(device, settings, &kind, settings);
}

const struct scenery_paint *scenery_paint_get(const struct scenery_made *made,
                                              const struct scenery_settings *settings)
{
    static const struct rg_shared_kind kind = {"scene's paint", make_paint, destroy_paint};
    return get(made->device, settings, &kind, made);
}

void scenery_made_put(struct rg_device *device, const struct scenery_made *made)
{
    rg_shared_put(device, (void *)(uintptr_t)made);
}

void scenery_paint_put(struct rg_device *device, const struct scenery_paint *paint)
{
    rg_shared_put(device, (void *)(uintptr_t)paint);
}
