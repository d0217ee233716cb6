#include "core/scene/city/city.h"

#include <stdlib.h>
#include <xxhash.h>

#include "core/alloc.h"
#include "core/scene/city/build.h"

const struct rg_camera city_first_camera = {
    .position = {-3.5f, 1.7f, 62.0f},
    .target = {4.0f, 11.0f, 0.0f},
    .up = {0, 1, 0},
    .angle_deg = 60,
    .near_plane = 0.2f,
    .far_plane = 1000,
};
const struct rg_camera city_second_camera = {
    .position = {5.0f, 6.0f, 172.0f},
    .target = {-2.0f, 20.0f, 0.0f},
    .up = {0, 1, 0},
    .angle_deg = 60,
    .near_plane = 0.2f,
    .far_plane = 1000,
};

void city_faces_free(struct city_faces *faces)
{
    free(faces->corners);
    free(faces->surface_of);
    free(faces->surfaces);
    free(faces->chunks);
    *faces = (struct city_faces){0};
}

void city_destroy(struct city *city)
{
    if (!city)
        return;
    city_faces_free(&city->faces);
    free(city->lamps);
    free(city->boxes);
    free(city);
}

static uint64_t hash_of(const struct city *city)
{
    const struct city_faces *f = &city->faces;
    const size_t faces = (size_t)f->face_count;
    uint64_t hash = XXH3_64bits(&city->settings, sizeof(city->settings));
    hash = XXH3_64bits_withSeed(f->corners, faces * STREAKS_FACE_WORDS * sizeof(float), hash);
    hash = XXH3_64bits_withSeed(f->surface_of, faces * sizeof(uint32_t), hash);
    return XXH3_64bits_withSeed(
        f->surfaces, (size_t)f->surface_count * STREAKS_SURFACE_WORDS * sizeof(uint32_t), hash);
}

struct city *city_create(const struct city_settings *settings)
{
    struct city *city = rg_alloc(1, sizeof(*city), "city");
    if (!city)
        return NULL;
    struct city_builder b = {.settings = *settings, .city = city};
    city->settings = *settings;
    city->texture_count = CITY_TEXTURES;
    city->texture_px = settings->size == CITY_FULL ? CITY_TEXTURE_PX : CITY_SMALL_TEXTURE_PX;
    city_build_streets(&b);
    city_build_furniture(&b);
    city_build_buildings(&b, settings->size == CITY_FULL ? CITY_TRIANGLES : CITY_SMALL_TRIANGLES);
    free(b.places);
    if (b.failed || !city_faces_sort(&city->faces)) {
        city_destroy(city);
        return NULL;
    }
    city->hash = hash_of(city);
    return city;
}
