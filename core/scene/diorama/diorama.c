#include "core/scene/diorama/diorama.h"

#include <stdlib.h>

#include "core/base/alloc.h"
#include "core/scene/diorama/build.h"

const struct diorama_size diorama_sizes[DIORAMAS] = {
    [DIORAMA_CAR] = {"car", 6387, 9907},       [DIORAMA_HOUSE1] = {"house1", 8726, 14240},
    [DIORAMA_HOUSE2] = {"house2", 952, 1187},  [DIORAMA_TABLE] = {"table", 19016, 37372},
    [DIORAMA_PARK1] = {"park1", 5744, 10308},  [DIORAMA_PARK2] = {"park2", 25817, 48154},
    [DIORAMA_GROUND] = {"ground", 4601, 8180},
};

// A scene: its builder, the pebbles and blades that fill it up, its camera and its sky.
static const struct scene {
    void (*build)(struct builder *b);
    struct leftover leftover;
    struct diorama_view view;
    float sky[3], low_sky[3];
} scenes[DIORAMAS] = {
    [DIORAMA_CAR] = {build_car,
                     {{0, 0, 0}, 2.7, 4.3, 0.07, 0.3, PAINT_STONE, PAINT_MEADOW},
                     {{0, 0.75, 0}, 8.4, 38, 17, 36, 1},
                     {0.56f, 0.74f, 0.86f},
                     {0.90f, 0.93f, 0.90f}},
    [DIORAMA_HOUSE1] = {build_house1,
                        {{0, 0, 0.4}, 4.6, 6.2, 0.12, 0.4, PAINT_PALE_STONE, PAINT_MEADOW},
                        {{0, 2.45, 0}, 17, 33, 14, 32, 0.9},
                        {0.54f, 0.70f, 0.86f},
                        {0.95f, 0.90f, 0.82f}},
    [DIORAMA_HOUSE2] = {build_house2,
                        {{0, 0, 0.4}, 3.2, 4.6, 0.14, 0.4, PAINT_STONE, PAINT_MEADOW},
                        {{0, 1.8, 0}, 13, 30, 14, 32, 1},
                        {0.60f, 0.78f, 0.84f},
                        {0.94f, 0.93f, 0.84f}},
    [DIORAMA_TABLE] = {build_table,
                       {{0, 0, 0}, 1.6, 2.2, 0.03, 0.1, PAINT_PALE_STONE, PAINT_MEADOW},
                       {{0, 0.52, 0}, 4.3, 22, 25, 34, 0.9},
                       {0.80f, 0.74f, 0.82f},
                       {0.97f, 0.92f, 0.85f}},
    [DIORAMA_PARK1] = {build_park1,
                       {{0, 0, 0}, 3.0, 5.2, 0.09, 0.4, PAINT_PALE_STONE, PAINT_MEADOW},
                       {{0, 1.25, 0}, 13.2, 20, 19, 34, 0.85},
                       {0.55f, 0.75f, 0.86f},
                       {0.94f, 0.94f, 0.86f}},
    [DIORAMA_PARK2] = {build_park2,
                       {{0, 0, 0}, 4.6, 8.3, 0.1, 0.4, PAINT_PALE_STONE, PAINT_MEADOW},
                       {{0, 1.3, 0.4}, 17.5, 3, 21, 36, 0.7},
                       {0.55f, 0.72f, 0.88f},
                       {0.95f, 0.92f, 0.84f}},
    [DIORAMA_GROUND] = {build_ground,
                        {{0, 0, -0.3}, 0.9, 2.1, 0.05, 0.3, PAINT_STONE, PAINT_MEADOW},
                        {{0, 0.1, 0.1}, 4.9, 14, 31, 34, 1},
                        {0.66f, 0.80f, 0.80f},
                        {0.95f, 0.95f, 0.86f}},
};

void diorama_destroy(struct diorama *diorama)
{
    if (!diorama)
        return;
    rg_mesh_destroy(diorama->mesh);
    free(diorama->materials);
    free(diorama);
}

// Makes a diorama of the builder's faces; the builder keeps nothing.
static struct diorama *take(struct builder *b, const struct scene *scene)
{
    struct diorama *d = rg_alloc(1, sizeof(*d), b->name);
    if (!d)
        return NULL;
    diorama_paint(d);
    d->view = scene->view;
    for (int i = 0; i < 3; i++) {
        d->sky[i] = scene->sky[i];
        d->low_sky[i] = scene->low_sky[i];
    }
    d->solid_faces = builder_sort(b);
    d->mesh = builder_mesh(b);
    d->materials = b->materials;
    b->materials = NULL;
    if (d->mesh)
        return d;
    diorama_destroy(d);
    return NULL;
}

struct diorama *diorama_create(enum diorama_scene which)
{
    const struct scene *scene = &scenes[which];
    const struct diorama_size *size = &diorama_sizes[which];
    struct builder b;
    builder_begin(&b, size->name);
    scene->build(&b);
    struct diorama *d =
        fill(&b, &scene->leftover, size->vertices, size->faces) ? take(&b, scene) : NULL;
    builder_free(&b);
    return d;
}
