// The sides of faces, sorted so that those of one edge lie together: by their lower vertex by
// counting, and the few of one vertex among themselves.
#include <stdlib.h>
#include <string.h>

#include "core/scene/mesh/resize/resize.h"

static int compare(const void *a, const void *b)
{
    const struct rg_side *x = a, *y = b;
    if (x->key != y->key)
        return x->key < y->key ? -1 : 1;
    return x->corner < y->corner ? -1 : x->corner > y->corner;
}

// Most vertices have a few sides; the middle of a fan has thousands.
static void sort(struct rg_side *sides, uint32_t count)
{
    enum { FEW = 16 };
    if (count > FEW) {
        qsort(sides, count, sizeof(*sides), compare);
        return;
    }
    for (uint32_t i = 1; i < count; i++) {
        const struct rg_side side = sides[i];
        uint32_t at = i;
        for (; at > 0 && compare(&sides[at - 1], &side) > 0; at--)
            sides[at] = sides[at - 1];
        sides[at] = side;
    }
}

// The key of the side from a corner, or of a vertex with itself.
static uint64_t key_of(const uint32_t *indices, size_t corner)
{
    const uint32_t a = indices[corner];
    const uint32_t b = indices[corner % 3 == 2 ? corner - 2 : corner + 1];
    return rg_side_key(a, b);
}

static bool has_length(uint64_t key)
{
    return key >> 32 != (uint32_t)key;
}

size_t rg_resize_sides(const uint32_t *indices, int face_count, size_t vertex_count, uint32_t *ends,
                       struct rg_side *sides)
{
    const size_t corners = 3 * (size_t)face_count;
    memset(ends, 0, vertex_count * sizeof(*ends));
    for (size_t i = 0; i < corners; i++)
        ends[key_of(indices, i) >> 32] += has_length(key_of(indices, i));
    uint32_t sum = 0;
    for (size_t v = 0; v < vertex_count; v++) {
        const uint32_t count = ends[v];
        ends[v] = sum; // where the vertex's sides begin, until they are filled in
        sum += count;
    }
    for (size_t i = 0; i < corners; i++) {
        const uint64_t key = key_of(indices, i);
        if (has_length(key))
            sides[ends[key >> 32]++] = (struct rg_side){key, (uint32_t)i};
    }
    for (size_t v = 0; v < vertex_count; v++) {
        const uint32_t first = v ? ends[v - 1] : 0;
        sort(sides + first, ends[v] - first);
    }
    return sum;
}
