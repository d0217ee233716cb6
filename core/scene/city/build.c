#include "core/scene/city/build.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

#include "core/base/array.h"
#include "core/base/log.h"
#include "kernels/dialect/mesh/normal.h"
#include "kernels/dialect/rng.h"

#define DEFAULT_TILE_M 4.0

double city_chance(const struct city_builder *b, uint32_t what, uint32_t which, uint32_t k)
{
    return (double)rg_uniform(rg_random((uint)b->settings.seed, which, k, what).x);
}

// Makes room for one more element; false, once logged, when memory runs out.
static bool grow(struct city_builder *b, void *array, int count, int64_t *room, size_t size)
{
    b->failed = b->failed || !rg_array_fit(array, room, (int64_t)count + 1, size, "city");
    return !b->failed;
}

// --- surfaces ---

static bool is_level(point n)
{
    return fabs(n.y) > (double)SCENERY_LEVEL_Y;
}

// The texture coordinates of a surface aligned with the world: seen from outside, u runs to the
// right and v down.
static struct mapping on_world(point n, double tile_m)
{
    return (struct mapping){1 / tile_m, is_level(n) ? 1 / tile_m : -1 / tile_m, 0, 0, false};
}

// A scale rounded to whole steps, and the part of a texture that it then starts at.
static uint32_t scale_of(double scale)
{
    return (uint32_t)(int)lrint(scale * (double)SCENERY_SCALE_STEPS) & 0xffffu;
}

static uint32_t offset_of(double scale, double from)
{
    const double steps = (double)SCENERY_SCALE_STEPS, stepped = rint(scale * steps) / steps;
    const double at = -stepped * from;
    return (uint32_t)(int)lrint((at - floor(at)) * 65536) & 0xffffu;
}

// How wet a kind of ground gets, 0 to 3.
static uint32_t wetness_of(int kind)
{
    return kind == SCENERY_KIND_ASPHALT ? 3 : kind == SCENERY_KIND_PAVING ? 2 : 0;
}

// Packs 8-bit r, g and b into 5, 6 and 5 bits.
static uint32_t tint_of(uint32_t tint)
{
    const uint32_t r = tint & 255, g = tint >> 8 & 255, b = tint >> 16 & 255;
    return (r * 31 + 127) / 255 | (g * 63 + 127) / 255 << 5 | (b * 31 + 127) / 255 << 11;
}

static void make_words(const struct look *look, point n, const struct mapping *m,
                       uint32_t words[SCENERY_SURFACE_WORDS])
{
    words[SCENERY_SCALES] = scale_of(m->scale_u) | scale_of(m->scale_v) << 16;
    words[SCENERY_OFFSETS] = offset_of(m->scale_u, m->from_u) | offset_of(m->scale_v, m->from_v)
                                                                    << 16;
    words[SCENERY_NORMAL] = mesh_normal_pack(v3_make((float)n.x, (float)n.y, (float)n.z)) |
                            wetness_of(look->kind) << 30;
    words[SCENERY_LOOK] = (uint32_t)look->texture | (uint32_t)look->kind << SCENERY_KIND_BIT |
                          (uint32_t)m->turned << SCENERY_TURNED_BIT |
                          (uint32_t)look->glow << SCENERY_GLOW_BIT |
                          tint_of(look->tint ? look->tint : 0xffffffu) << SCENERY_TINT_BIT;
}

static uint32_t *words_of(struct city_builder *b, int surface)
{
    return b->city->faces.surfaces + (size_t)surface * SCENERY_SURFACE_WORDS;
}

// The hash table's entry of a surface, or the free entry for it.
static int place_of(struct city_builder *b, const uint32_t *words)
{
    const size_t size = SCENERY_SURFACE_WORDS * sizeof(*words);
    int place = (int)(XXH3_64bits(words, size) & (uint64_t)(b->place_room - 1));
    while (b->places[place] && memcmp(words_of(b, b->places[place] - 1), words, size) != 0)
        place = (place + 1) & (b->place_room - 1);
    return place;
}

static bool grow_places(struct city_builder *b)
{
    struct city_faces *f = &b->city->faces;
    if (2 * f->surface_count < b->place_room)
        return true;
    free(b->places);
    b->place_room = b->place_room ? 2 * b->place_room : 8192;
    b->places = calloc((size_t)b->place_room, sizeof(*b->places));
    if (!b->places) {
        b->failed = true;
        return rg_harness_error("city: no memory for its surfaces; close other programs");
    }
    for (int i = 0; i < f->surface_count; i++)
        b->places[place_of(b, words_of(b, i))] = i + 1;
    return true;
}

uint32_t city_surface(struct city_builder *b, const struct look *look, point n,
                      const struct mapping *mapping)
{
    struct city_faces *f = &b->city->faces;
    const struct mapping world = on_world(n, look->tile_m > 0 ? look->tile_m : DEFAULT_TILE_M);
    uint32_t words[SCENERY_SURFACE_WORDS];
    make_words(look, n, mapping ? mapping : &world, words);
    if (b->failed || !grow_places(b) ||
        !grow(b, &f->surfaces, f->surface_count, &b->surface_room, sizeof(words)))
        return 0;
    const int place = place_of(b, words);
    if (!b->places[place]) {
        memcpy(words_of(b, f->surface_count), words, sizeof(words));
        b->places[place] = ++f->surface_count;
    }
    return (uint32_t)b->places[place] - 1;
}

// --- faces ---

static void put_corner(float *to, point p)
{
    to[0] = (float)p.x;
    to[1] = (float)p.y;
    to[2] = (float)p.z;
}

void city_quad_on(struct city_builder *b, const point corners[4], uint32_t surface)
{
    struct city_faces *f = &b->city->faces;
    int64_t room = b->face_room;
    if (!grow(b, &f->corners, f->face_count, &room, SCENERY_FACE_WORDS * sizeof(float)) ||
        !grow(b, &f->surface_of, f->face_count, &b->face_room, sizeof(uint32_t)))
        return;
    float *to = f->corners + (size_t)f->face_count * SCENERY_FACE_WORDS;
    for (int i = 0; i < 4; i++)
        put_corner(to + 3 * i, corners[i]);
    f->surface_of[f->face_count++] = surface;
    f->triangle_count += memcmp(to + 6, to + 9, 3 * sizeof(float)) ? 2 : 1;
}

void city_triangle_on(struct city_builder *b, const point c[3], uint32_t surface)
{
    city_quad_on(b, (const point[]){c[0], c[1], c[2], c[2]}, surface);
}

static point normal_of(point a, point b, point c)
{
    const point u = {b.x - a.x, b.y - a.y, b.z - a.z}, v = {c.x - a.x, c.y - a.y, c.z - a.z};
    const point n = {u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
    const double length = sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
    return length > 0 ? (point){n.x / length, n.y / length, n.z / length} : (point){0, 1, 0};
}

void city_quad(struct city_builder *b, point p0, point p1, point p2, point p3,
               const struct look *look)
{
    city_quad_on(b, (const point[]){p0, p1, p2, p3},
                 city_surface(b, look, normal_of(p0, p1, p2), NULL));
}

void city_triangle(struct city_builder *b, point p0, point p1, point p2, const struct look *look)
{
    city_triangle_on(b, (const point[]){p0, p1, p2},
                     city_surface(b, look, normal_of(p0, p1, p2), NULL));
}

void city_box(struct city_builder *b, point l, point h, int sides, const struct look *look)
{
    const point c[8] = {{l.x, l.y, l.z}, {h.x, l.y, l.z}, {l.x, h.y, l.z}, {h.x, h.y, l.z},
                        {l.x, l.y, h.z}, {h.x, l.y, h.z}, {l.x, h.y, h.z}, {h.x, h.y, h.z}};
    static const int corners[6][4] = {{0, 4, 6, 2}, {5, 1, 3, 7}, {0, 1, 5, 4},
                                      {6, 7, 3, 2}, {1, 0, 2, 3}, {4, 5, 7, 6}};
    for (int i = 0; i < 6; i++) {
        const int *k = corners[i];
        if (sides >> i & 1)
            city_quad(b, c[k[0]], c[k[1]], c[k[2]], c[k[3]], look);
    }
}

static point on_circle(double x, double y, double z, double radius, double turn)
{
    const double angle = 2 * M_PI * turn;
    return (point){x + radius * cos(angle), y, z - radius * sin(angle)};
}

void city_post(struct city_builder *b, double x, double z, double y0, double y1, double radius0,
               double radius1, int sides, const struct look *look)
{
    for (int i = 0; i < sides; i++) {
        const double t0 = (i + 0.5) / sides, t1 = (i + 1.5) / sides;
        const point p0 = on_circle(x, y0, z, radius0, t0), p1 = on_circle(x, y0, z, radius0, t1);
        const point p2 = on_circle(x, y1, z, radius1, t1), p3 = on_circle(x, y1, z, radius1, t0);
        if (radius1 > 0)
            city_quad(b, p0, p1, p2, p3, look);
        else
            city_triangle(b, p0, p1, p2, look);
        if (radius1 > 0 && i % 2 == 0 && sides % 2 == 0 && sides > 4) // the lid, in quads
            city_quad(b, p3, p2, on_circle(x, y1, z, radius1, t1 + 1.0 / sides), (point){x, y1, z},
                      look);
    }
    if (radius1 > 0 && sides == 4)
        city_quad(b, on_circle(x, y1, z, radius1, 0.125), on_circle(x, y1, z, radius1, 0.375),
                  on_circle(x, y1, z, radius1, 0.625), on_circle(x, y1, z, radius1, 0.875), look);
}

struct city_lamp *city_lamp_add(struct city_builder *b, enum city_lamp_kind kind, point at,
                                point direction)
{
    struct city *city = b->city;
    if (!grow(b, &city->lamps, city->lamp_count, &b->lamp_room, sizeof(*city->lamps)))
        return NULL;
    struct city_lamp *lamp = &city->lamps[city->lamp_count++];
    *lamp = (struct city_lamp){.kind = kind};
    put_corner(lamp->position, at);
    put_corner(lamp->direction, direction);
    return lamp;
}

void city_box_add(struct city_builder *b, point low, point high)
{
    struct city *city = b->city;
    if (!grow(b, &city->boxes, city->box_count, &b->box_room, sizeof(*city->boxes)))
        return;
    struct city_box *box = &city->boxes[city->box_count++];
    put_corner(box->low, low);
    put_corner(box->high, high);
}
