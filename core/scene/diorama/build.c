#include "core/scene/diorama/build.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/base/array.h"
#include "kernels/dialect/math.h"
#include "kernels/dialect/rng.h"

// --- numbers ---

double chance(uint32_t what, uint32_t which)
{
    const uint seed = 5;
    return (double)rg_uniform(rg_random(seed, which, what, 0).x);
}

double sine(double turn_deg)
{
    return (double)rg_sin((float)(turn_deg * (M_PI / 180)));
}

double cosine(double turn_deg)
{
    return (double)rg_cos((float)(turn_deg * (M_PI / 180)));
}

// --- frames ---

static point along(const struct frame *f, point p)
{
    return (point){f->x.x * p.x + f->y.x * p.y + f->z.x * p.z,
                   f->x.y * p.x + f->y.y * p.y + f->z.y * p.z,
                   f->x.z * p.x + f->y.z * p.y + f->z.z * p.z};
}

static point placed(const struct frame *f, point p)
{
    const point d = along(f, p);
    return (point){f->origin.x + d.x, f->origin.y + d.y, f->origin.z + d.z};
}

static struct frame enter(struct builder *b, point at, point x, point y, point z)
{
    const struct frame was = b->frame;
    b->frame = (struct frame){placed(&was, at), along(&was, x), along(&was, y), along(&was, z)};
    return was;
}

struct frame builder_enter(struct builder *b, point at, double turn_deg, double size)
{
    const double s = sine(turn_deg) * size, c = cosine(turn_deg) * size;
    return enter(b, at, (point){c, 0, -s}, (point){0, size, 0}, (point){s, 0, c});
}

struct frame builder_tilt(struct builder *b, point at, double tilt_deg, double turn_deg)
{
    const struct frame was = builder_enter(b, at, turn_deg, 1);
    const double s = sine(tilt_deg), c = cosine(tilt_deg);
    enter(b, (point){0, 0, 0}, (point){c, s, 0}, (point){-s, c, 0}, (point){0, 0, 1});
    return was;
}

void builder_leave(struct builder *b, struct frame frame)
{
    b->frame = frame;
}

// --- faces ---

void builder_begin(struct builder *b, const char *name)
{
    *b = (struct builder){.name = name, .frame = {{0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
}

void builder_free(struct builder *b)
{
    free(b->corners);
    free(b->normals);
    free(b->materials);
    free(b->thin);
    *b = (struct builder){0};
}

static bool grow(struct builder *b)
{
    const int64_t faces = (int64_t)b->face_count + 1;
    b->has_failed =
        b->has_failed ||
        !rg_array_fit(&b->corners, &b->face_room, faces, 9 * sizeof(float), b->name) ||
        !rg_array_fit(&b->normals, &b->normal_room, faces, 9 * sizeof(float), b->name) ||
        !rg_array_fit(&b->materials, &b->material_room, faces, sizeof(uint32_t), b->name) ||
        !rg_array_fit(&b->thin, &b->thin_room, faces, sizeof(bool), b->name);
    return !b->has_failed;
}

void builder_face(struct builder *b, point p0, point p1, point p2, enum paint paint)
{
    if (!grow(b))
        return;
    const point corners[3] = {p0, p1, p2};
    for (int k = 0; k < 3; k++) {
        const point p = placed(&b->frame, corners[k]);
        const float xyz[3] = {(float)p.x, (float)p.y, (float)p.z};
        memcpy(b->corners + 9 * (size_t)b->face_count + 3 * (size_t)k, xyz, sizeof(xyz));
    }
    b->thin[b->face_count] = b->is_thin;
    b->materials[b->face_count++] = (uint32_t)paint;
}

void builder_quad(struct builder *b, point p0, point p1, point p2, point p3, enum paint paint)
{
    builder_face(b, p0, p1, p2, paint);
    builder_face(b, p0, p2, p3, paint);
}

// --- normals ---

// A corner of the part, for sorting by position.
struct corner {
    float at[3];
    int number; // 3 * the face + the corner in it
};

static int by_place(const void *a, const void *b)
{
    const struct corner *p = a, *q = b;
    for (int i = 0; i < 3; i++)
        if (p->at[i] != q->at[i])
            return p->at[i] < q->at[i] ? -1 : 1;
    return p->number - q->number;
}

// Twice a face's area along its normal.
static point face_vector(const float *c)
{
    const double ux = (double)c[3] - (double)c[0], uy = (double)c[4] - (double)c[1],
                 uz = (double)c[5] - (double)c[2], vx = (double)c[6] - (double)c[0],
                 vy = (double)c[7] - (double)c[1], vz = (double)c[8] - (double)c[2];
    return (point){uy * vz - uz * vy, uz * vx - ux * vz, ux * vy - uy * vx};
}

static double dot(point a, point b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

// Computes the normal of one of the corners at one position.
static void smooth(struct builder *b, const struct corner *corners, int count, int which,
                   double cos_crease)
{
    const point own = face_vector(b->corners + 9 * (size_t)(corners[which].number / 3));
    point sum = {0, 0, 0};
    for (int i = 0; i < count; i++) {
        const point v = face_vector(b->corners + 9 * (size_t)(corners[i].number / 3));
        if (i != which && dot(own, v) < cos_crease * sqrt(dot(own, own) * dot(v, v)))
            continue;
        sum = (point){sum.x + v.x, sum.y + v.y, sum.z + v.z};
    }
    const double length = sqrt(dot(sum, sum));
    float *normal = b->normals + 3 * (size_t)corners[which].number;
    normal[0] = (float)(sum.x / length);
    normal[1] = (float)(sum.y / length);
    normal[2] = (float)(sum.z / length);
}

void builder_end(struct builder *b, double crease_deg)
{
    const int count = 3 * (b->face_count - b->first), before = 3 * b->first;
    const double cos_crease = crease_deg >= 180 ? -2 : cosine(crease_deg);
    struct corner *corners =
        b->has_failed ? NULL : rg_alloc((size_t)count, sizeof(*corners), b->name);
    b->has_failed |= !corners;
    b->first = b->face_count;
    if (!corners)
        return;
    for (int i = 0; i < count; i++) {
        memcpy(corners[i].at, b->corners + 3 * (size_t)(before + i), sizeof(corners[i].at));
        corners[i].number = before + i;
    }
    qsort(corners, (size_t)count, sizeof(*corners), by_place);
    for (int i = 0, end; i < count; i = end) {
        for (end = i + 1; end < count && !memcmp(corners[end].at, corners[i].at, 12);)
            end++;
        for (int k = i; k < end; k++)
            smooth(b, corners + i, end - i, k - i, cos_crease);
    }
    free(corners);
}

// Appends the thin faces, or the others, to `to`.
static void copy_faces(const struct builder *from, bool thin, struct builder *to)
{
    for (int i = 0; i < from->face_count; i++) {
        const size_t face = 9 * (size_t)i, place = 9 * (size_t)to->face_count;
        if (from->thin[i] != thin || !grow(to))
            continue;
        memcpy(to->corners + place, from->corners + face, 9 * sizeof(float));
        memcpy(to->normals + place, from->normals + face, 9 * sizeof(float));
        to->thin[to->face_count] = thin;
        to->materials[to->face_count++] = from->materials[i];
    }
}

int builder_sort(struct builder *b)
{
    struct builder sorted = {.name = b->name, .has_failed = b->has_failed};
    copy_faces(b, false, &sorted);
    const int solid = sorted.face_count;
    copy_faces(b, true, &sorted);
    builder_free(b);
    *b = sorted;
    return solid;
}

struct rg_mesh *builder_mesh(const struct builder *b)
{
    if (b->has_failed)
        return NULL;
    const int corners = 3 * b->face_count;
    uint32_t *indices = rg_alloc((size_t)corners, sizeof(*indices), b->name);
    for (int i = 0; indices && i < corners; i++)
        indices[i] = (uint32_t)i;
    struct rg_mesh *mesh =
        indices ? rg_mesh_create(b->name, corners, b->face_count, b->corners, b->normals, indices)
                : NULL;
    free(indices);
    return mesh;
}
