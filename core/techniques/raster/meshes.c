// The meshes of raster: models, the knot, and panes.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/scene/mesh/mesh.h"
#include "core/techniques/raster/raster.h"
#include "kernels/dialect/math.h"
#include "kernels/dialect/mesh/normal.h"
#include "kernels/dialect/rng.h"

static bool make_room(int vertices, int faces, struct raster_mesh *shape)
{
    *shape = (struct raster_mesh){.vertex_count = vertices, .face_count = faces};
    return (shape->positions = rg_alloc((size_t)vertices, 3 * sizeof(float), "positions")) &&
           (shape->normals = rg_alloc((size_t)vertices, sizeof(uint32_t), "normals")) &&
           (shape->indices = rg_alloc((size_t)faces, 3 * sizeof(uint32_t), "indices"));
}

void raster_mesh_free(struct raster_mesh *shape)
{
    free(shape->positions);
    free(shape->normals);
    free(shape->indices);
    *shape = (struct raster_mesh){0};
}

// Finds the distance of the farthest position from the middle of the bounds.
static void find_radius(struct raster_mesh *shape)
{
    double longest = 0, farthest = 0, middle[3];
    for (int c = 0; c < 3; c++) {
        longest = fmax(longest, (double)shape->high[c] - (double)shape->low[c]);
        middle[c] = ((double)shape->low[c] + (double)shape->high[c]) / 2;
    }
    for (int i = 0; i < shape->vertex_count; i++) {
        const float *p = shape->positions + 3 * (size_t)i;
        const double x = (double)p[0] - middle[0], y = (double)p[1] - middle[1],
                     z = (double)p[2] - middle[2];
        // No fmax here: gcc 12 fails to compile it for arm64, in vectors.
        const double away = x * x + y * y + z * z;
        farthest = away > farthest ? away : farthest;
    }
    shape->radius = sqrt(farthest) / (longest / 2);
}

// --- models ---

// Moves the mesh's arrays into the shape, which then owns them.
static bool take_mesh(struct rg_mesh *mesh, struct raster_mesh *shape)
{
    shape->vertex_count = mesh->vertex_count;
    shape->face_count = mesh->face_count;
    shape->normals = rg_mesh_pack_normals(mesh);
    if (!shape->normals)
        return false;
    shape->positions = mesh->positions;
    shape->indices = mesh->indices;
    mesh->positions = NULL;
    mesh->indices = NULL;
    memcpy(shape->low, mesh->low, sizeof(shape->low));
    memcpy(shape->high, mesh->high, sizeof(shape->high));
    snprintf(shape->name, sizeof(shape->name), "%s", mesh->name);
    shape->hash = mesh->hash;
    find_radius(shape);
    return true;
}

bool raster_mesh_load(const struct raster_settings *settings, struct raster_mesh *shape)
{
    *shape = (struct raster_mesh){0};
    struct rg_mesh *mesh = rg_mesh_load_faces(settings->model, settings->faces);
    const bool ok = mesh && take_mesh(mesh, shape);
    rg_mesh_destroy(mesh);
    return ok;
}

// --- the knot ---

struct point {
    double x, y, z;
};

static struct point plus(struct point a, double s, struct point b)
{
    return (struct point){a.x + s * b.x, a.y + s * b.y, a.z + s * b.z};
}

static struct point cross(struct point a, struct point b)
{
    return (struct point){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static struct point unit(struct point a)
{
    const double length = sqrt(a.x * a.x + a.y * a.y + a.z * a.z);
    return (struct point){a.x / length, a.y / length, a.z / length};
}

// A point of a trefoil knot, which winds three times around the ring while it goes round twice.
static struct point on_knot(double t)
{
    const double out = 2 + cos(3 * t);
    return (struct point){out * cos(2 * t), out * sin(2 * t), sin(3 * t)};
}

// A point of the tube around the knot, and its outward direction. The tube is fluted, so that
// neighbouring triangles differ in brightness.
static struct point on_tube(double t, double around, struct point *out)
{
    const double step = 1e-4;
    const struct point centre = on_knot(t);
    const struct point along = unit(plus(on_knot(t + step), -1, on_knot(t - step)));
    const struct point beside = unit(cross(along, centre));
    const struct point above = cross(along, beside);
    *out =
        plus((struct point){beside.x * cos(around), beside.y * cos(around), beside.z * cos(around)},
             sin(around), above);
    return plus(centre, 0.55 + 0.04 * cos(9 * around + 30 * t), *out);
}

static void put_vertex(struct raster_mesh *shape, int i, struct point at, struct point out)
{
    const float position[3] = {(float)at.x, (float)at.y, (float)at.z};
    memcpy(shape->positions + 3 * (size_t)i, position, sizeof(position));
    shape->normals[i] = mesh_normal_pack(v3_make((float)out.x, (float)out.y, (float)out.z));
    for (int c = 0; c < 3; c++) {
        shape->low[c] = i ? fminf(shape->low[c], position[c]) : position[c];
        shape->high[c] = i ? fmaxf(shape->high[c], position[c]) : position[c];
    }
}

// The normal of the fluted tube, from finite differences.
static struct point tube_normal(double t, double around)
{
    const double step = 1e-4;
    struct point out;
    const struct point by_t =
        plus(on_tube(t + step, around, &out), -1, on_tube(t - step, around, &out));
    const struct point by_around =
        plus(on_tube(t, around + step, &out), -1, on_tube(t, around - step, &out));
    return unit(cross(by_around, by_t));
}

bool raster_mesh_knot(int triangles, struct raster_mesh *shape)
{
    const double turn = 2 * M_PI;
    const int around = (int)(sqrt(triangles / 2.0 / 8)), along = triangles / 2 / around;
    if (!make_room(around * along, 2 * around * along, shape))
        return false;
    for (int i = 0; i < along; i++) {
        for (int j = 0; j < around; j++) {
            const double t = turn * i / along, angle = turn * j / around;
            struct point out;
            const struct point at = on_tube(t, angle, &out);
            put_vertex(shape, i * around + j, at, tube_normal(t, angle));
            const uint32_t next_i = (uint32_t)(i + 1) % (uint32_t)along * (uint32_t)around;
            const uint32_t next_j = (uint32_t)(j + 1) % (uint32_t)around;
            const uint32_t here_i = (uint32_t)(i * around), here_j = (uint32_t)j;
            const uint32_t two[6] = {here_i + here_j, here_i + next_j, next_i + next_j,
                                     here_i + here_j, next_i + next_j, next_i + here_j};
            memcpy(shape->indices + 6 * ((size_t)i * (size_t)around + (size_t)j), two, sizeof(two));
        }
    }
    snprintf(shape->name, sizeof(shape->name), "knot");
    find_radius(shape);
    return true;
}

// --- quads ---

enum { PLACE_STREAM = 21, SHAPE_STREAM, COLOUR_STREAM };

// Sides are from half a thousandth of the target's height to all of it, evenly on a logarithmic
// scale; none is wider than long.
static void put_quad(float *quad, uint32_t seed, uint32_t i)
{
    const rg_uint4 place = rg_random(seed, i, 0, PLACE_STREAM);
    const rg_uint4 shape = rg_random(seed, i, 0, SHAPE_STREAM);
    const rg_uint4 colour = rg_random(seed, i, 0, COLOUR_STREAM);
    const float octaves = 11 * rg_uniform(shape.x), alpha = 0.1f + 0.5f * rg_uniform(colour.w);
    const float words[RASTER_QUAD_WORDS] = {
        2.2f * rg_uniform(place.x) - 1.1f,
        2.2f * rg_uniform(place.y) - 1.1f,
        rg_exp2(octaves - 12),
        rg_exp2(octaves * rg_uniform(shape.y) - 12),
        (float)(2 * M_PI) * rg_uniform(shape.z),
        2 * rg_uniform(shape.w) - 1,
        rg_uniform(place.z),
        alpha * rg_uniform(colour.x),
        alpha * rg_uniform(colour.y),
        alpha * rg_uniform(colour.z),
        alpha,
    };
    memcpy(quad, words, sizeof(words));
}

float *raster_quads_make(const struct raster_settings *settings)
{
    float *quads = rg_alloc((size_t)settings->quads, RASTER_QUAD_WORDS * sizeof(float), "quads");
    for (int i = 0; quads && i < settings->quads; i++)
        put_quad(quads + (size_t)i * RASTER_QUAD_WORDS, (uint32_t)settings->seed, (uint32_t)i);
    return quads;
}
