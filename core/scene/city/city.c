#include "core/scene/city/city.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <xxhash.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "core/scene/city/build.h"

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
    hash = XXH3_64bits_withSeed(f->corners, faces * SCENERY_FACE_WORDS * sizeof(float), hash);
    hash = XXH3_64bits_withSeed(f->surface_of, faces * sizeof(uint32_t), hash);
    return XXH3_64bits_withSeed(
        f->surfaces, (size_t)f->surface_count * SCENERY_SURFACE_WORDS * sizeof(uint32_t), hash);
}

// Turns the builder's faces into a city; NULL on failure.
static struct city *finish(struct city_builder *b)
{
    struct city *city = b->city;
    free(b->places);
    if (b->failed || !city_faces_sort(&city->faces)) {
        city_destroy(city);
        return NULL;
    }
    city->hash = hash_of(city);
    return city;
}

struct city *city_create(const struct city_settings *settings)
{
    struct city *city = rg_alloc(1, sizeof(*city), "city");
    if (!city)
        return NULL;
    struct city_builder b = {.settings = *settings, .city = city};
    city->settings = *settings;
    snprintf(city->name, sizeof(city->name), "%s city, seed %d",
             settings->size == CITY_FULL ? "full" : "small", settings->seed);
    city->texture_count = CITY_TEXTURES;
    city->texture_px = settings->size == CITY_FULL ? CITY_TEXTURE_PX : CITY_SMALL_TEXTURE_PX;
    city_build_streets(&b);
    city_build_furniture(&b);
    city_build_buildings(&b, settings->size == CITY_FULL ? CITY_TRIANGLES : CITY_SMALL_TRIANGLES);
    return finish(&b);
}

// --- a mesh instead of the city ---

// Keeps a mesh's buffers on a device below 128 MiB.
enum { MOST_MESH_FACES = 2500000, GROUND_TILES = 8 };

static void build_mesh(struct city_builder *b, const struct rg_mesh *mesh)
{
    const struct look grey = {0, SCENERY_KIND_WALL, 0, 0x808080u, 0};
    const double wide[3] = {(double)CITY_SIDE_M, (double)CITY_HEIGHT_M, (double)CITY_SIDE_M};
    double scale = INFINITY;
    for (int c = 0; c < 3; c++)
        if (mesh->high[c] > mesh->low[c])
            scale = fmin(scale, wide[c] / ((double)mesh->high[c] - (double)mesh->low[c]));
    for (int i = 0; i < mesh->face_count; i++) {
        point p[3];
        for (int k = 0; k < 3; k++) {
            const float *v = mesh->positions + 3 * (size_t)mesh->indices[3 * (size_t)i + (size_t)k];
            p[k].x = ((double)v[0] - ((double)mesh->low[0] + (double)mesh->high[0]) / 2) * scale;
            p[k].y = ((double)v[1] - (double)mesh->low[1]) * scale;
            p[k].z = ((double)v[2] - ((double)mesh->low[2] + (double)mesh->high[2]) / 2) * scale;
        }
        city_triangle(b, p[0], p[1], p[2], &grey);
    }
}

// The ground is cut into tiles, so that the planes from which depth is computed begin near their
// pixels.
static void build_ground(struct city_builder *b)
{
    const struct look ground = {0, SCENERY_KIND_PAVING, 0, 0x585858u, 0};
    const double side = (double)CITY_SIDE_M / GROUND_TILES, low = -(double)CITY_SIDE_M / 2;
    for (int i = 0; i < GROUND_TILES * GROUND_TILES; i++) {
        const double x = low + side * (i % GROUND_TILES), z = low + side * (i / GROUND_TILES);
        city_quad(b, (point){x, 0, z + side}, (point){x + side, 0, z + side},
                  (point){x + side, 0, z}, (point){x, 0, z}, &ground);
    }
}

struct city *city_of_mesh(const char *name)
{
    struct rg_mesh *mesh = rg_mesh_load(name);
    if (!mesh)
        return NULL;
    struct city *city = NULL;
    if (mesh->face_count > MOST_MESH_FACES)
        rg_error("%s: %d faces; a scene takes at most %d: decimate it first", name,
                 mesh->face_count, MOST_MESH_FACES);
    else
        city = rg_alloc(1, sizeof(*city), name);
    if (city) {
        struct city_builder b = {.city = city};
        snprintf(city->name, sizeof(city->name), "%s", mesh->name);
        city->is_mesh = true;
        city->texture_count = 1;
        city->texture_px = 1;
        build_mesh(&b, mesh);
        build_ground(&b);
        city = finish(&b);
    }
    rg_mesh_destroy(mesh);
    return city;
}
