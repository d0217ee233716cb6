// Sorts a scene's faces by place and direction, and cuts them into chunks.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/scene/city/city.h"
#include "kernels/dialect/mesh/normal.h"

// No chunk spans two cells: there are 16 x 16 x 16, or 4 x 4 x 4 for few faces.
enum { MANY_FACES = 100000, MANY_BITS = 4, FEW_BITS = 2 };
// Within a cell, faces are sorted by a finer grid.
enum { FINE_BITS = 10, PLACE_BITS = 3 * FINE_BITS };

static int cell_bits(const struct city_faces *f)
{
    return f->face_count > MANY_FACES ? MANY_BITS : FEW_BITS;
}

struct key {
    uint64_t order; // cell, then direction, then place within the cell
    int face;
};

static int compare_keys(const void *a, const void *b)
{
    const struct key *x = a, *y = b;
    if (x->order != y->order)
        return x->order < y->order ? -1 : 1;
    return x->face < y->face ? -1 : x->face > y->face;
}

static const float *corners_of(const struct city_faces *f, int face)
{
    return f->corners + (size_t)face * SCENERY_FACE_WORDS;
}

static uint32_t normal_of(const struct city_faces *f, int face)
{
    return f->surfaces[(size_t)f->surface_of[face] * SCENERY_SURFACE_WORDS + SCENERY_NORMAL] &
           0x3fffffffu; // masks off how wet it gets
}

static void add_bounds(const struct city_faces *f, int face, float low[3], float high[3])
{
    const float *c = corners_of(f, face);
    for (int i = 0; i < SCENERY_FACE_WORDS; i++) {
        low[i % 3] = rg_min(low[i % 3], c[i]);
        high[i % 3] = rg_max(high[i % 3], c[i]);
    }
}

static void empty_bounds(float low[3], float high[3])
{
    for (int c = 0; c < 3; c++) {
        low[c] = INFINITY;
        high[c] = -INFINITY;
    }
}

// Interleaves the bits of three coordinates.
static uint64_t interleave(const uint32_t at[3], int bits)
{
    uint64_t order = 0;
    for (int bit = bits - 1; bit >= 0; bit--)
        for (int c = 0; c < 3; c++)
            order = order << 1 | (at[c] >> bit & 1);
    return order;
}

static uint64_t order_of(const struct city_faces *f, int face)
{
    const float *p = corners_of(f, face);
    uint32_t at[3], cell[3];
    for (int c = 0; c < 3; c++) {
        const float middle = 0.25f * (p[c] + p[3 + c] + p[6 + c] + p[9 + c]);
        const float side = rg_max(f->high[c] - f->low[c], 1e-6f);
        const float share = (middle - f->low[c]) / side * (float)(1 << FINE_BITS);
        at[c] = (uint32_t)rg_min(rg_max(share, 0), (1 << FINE_BITS) - 1);
        cell[c] = at[c] >> (FINE_BITS - cell_bits(f));
    }
    const uint64_t places = UINT64_C(1) << PLACE_BITS;
    // Six directions; all others share a seventh class.
    static const float ways[6][3] = {{1, 0, 0},  {-1, 0, 0}, {0, 1, 0},
                                     {0, -1, 0}, {0, 0, 1},  {0, 0, -1}};
    // A leaf's stored normal is only for lighting; the face itself may point another way.
    const uint32_t look =
        f->surfaces[(size_t)f->surface_of[face] * SCENERY_SURFACE_WORDS + SCENERY_LOOK];
    uint64_t way = 6;
    for (int i = 0; i < 6 && scenery_kind(look) != SCENERY_KIND_LEAVES; i++)
        if (normal_of(f, face) == mesh_normal_pack(v3_make(ways[i][0], ways[i][1], ways[i][2])))
            way = (uint64_t)i;
    return (interleave(cell, cell_bits(f)) * 8 + way) * places + interleave(at, FINE_BITS);
}

static bool reorder(struct city_faces *f, const struct key *keys)
{
    const size_t count = (size_t)f->face_count, size = SCENERY_FACE_WORDS * sizeof(float);
    float *corners = rg_alloc(count, size, "scene");
    uint32_t *surface_of = corners ? rg_alloc(count, sizeof(*surface_of), "scene") : NULL;
    if (!surface_of) {
        free(corners);
        return false;
    }
    for (size_t i = 0; i < count; i++) {
        memcpy(corners + i * SCENERY_FACE_WORDS, corners_of(f, keys[i].face), size);
        surface_of[i] = f->surface_of[keys[i].face];
    }
    free(f->corners);
    free(f->surface_of);
    f->corners = corners;
    f->surface_of = surface_of;
    return true;
}

// Begins a chunk with face i.
static struct city_chunk *begin_chunk(struct city_faces *f, int i, uint64_t cell_and_way)
{
    struct city_chunk *chunk = &f->chunks[f->chunk_count++];
    const v3 n = mesh_normal_unpack(normal_of(f, i));
    const bool alike = cell_and_way % 8 < 6;
    *chunk = (struct city_chunk){.first = i};
    empty_bounds(chunk->low, chunk->high);
    if (alike) {
        chunk->normal[0] = n.x;
        chunk->normal[1] = n.y;
        chunk->normal[2] = n.z;
    }
    return chunk;
}

// Ends a chunk when the cell or direction changes, or when it is full.
static void cut(struct city_faces *f, const struct key *keys)
{
    struct city_chunk *chunk = NULL;
    for (int i = 0; i < f->face_count; i++) {
        const uint64_t cell_and_way = keys[i].order >> PLACE_BITS;
        if (!chunk || chunk->count == CITY_CHUNK_FACES ||
            cell_and_way != keys[i - 1].order >> PLACE_BITS)
            chunk = begin_chunk(f, i, cell_and_way);
        chunk->count++;
        add_bounds(f, i, chunk->low, chunk->high);
    }
}

bool city_faces_sort(struct city_faces *f)
{
    struct key *keys = rg_alloc((size_t)f->face_count, sizeof(*keys), "scene");
    empty_bounds(f->low, f->high);
    for (int i = 0; i < f->face_count; i++)
        add_bounds(f, i, f->low, f->high);
    for (int i = 0; keys && i < f->face_count; i++)
        keys[i] = (struct key){order_of(f, i), i};
    bool ok = keys != NULL;
    if (ok) {
        qsort(keys, (size_t)f->face_count, sizeof(*keys), compare_keys);
        int most = 1 + f->face_count / CITY_CHUNK_FACES;
        for (int i = 1; i < f->face_count; i++)
            most += keys[i].order >> PLACE_BITS != keys[i - 1].order >> PLACE_BITS ? 1 : 0;
        f->chunk_count = 0;
        f->chunks = rg_alloc((size_t)most + 1, sizeof(*f->chunks), "scene");
        ok = f->chunks && reorder(f, keys);
    }
    if (ok)
        cut(f, keys);
    free(keys);
    return ok;
}
