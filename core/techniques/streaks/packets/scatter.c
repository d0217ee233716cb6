#include "core/techniques/streaks/packets/scatter.h"

enum {
    LEAF = 16,         // particles that are placed one by one
    TASK = 1 << 17,    // particles that are worth a parallel task
    OSCILLATIONS = 10, // streaks of different drops (section 4.3.2)
    START_BITS = 20,   // bits of a start, which a float has left after an oscillation
};

// --- particles of one part ---

struct site {
    uint64_t code; // on the Morton curve
    uint32_t x, y;
    float packed; // oscillation + start
};

static uint64_t spread_bits(uint32_t bits)
{
    uint64_t b = bits;
    b = (b | b << 16) & 0x0000ffff0000ffffu;
    b = (b | b << 8) & 0x00ff00ff00ff00ffu;
    b = (b | b << 4) & 0x0f0f0f0f0f0f0f0fu;
    b = (b | b << 2) & 0x3333333333333333u;
    return (b | b << 1) & 0x5555555555555555u;
}

static struct site draw_site(const struct streaks_scatter *scatter, const struct streaks_part *part,
                             bool is_even, uint32_t number)
{
    const rg_uint4 random =
        rg_philox((rg_uint4){number, 0, 0, STREAKS_PURPOSES * scatter->field + STREAKS_PLACES},
                  scatter->seed, 0);
    struct site site = {.x = part->x, .y = part->y};
    if (is_even) {
        site.x += (uint32_t)((uint64_t)random.x >> (32 - streaks_bits_x(part)));
        site.y += (uint32_t)((uint64_t)random.y >> (32 - streaks_bits_y(part)));
    } else {
        streaks_part_place(scatter->density, part, random, &site.x, &site.y);
    }
    site.code = spread_bits(site.x) | spread_bits(site.y) << 1;
    site.packed = (float)rg_mul_hi(random.w, OSCILLATIONS) +
                  (float)(random.z >> (32 - START_BITS)) / (1 << START_BITS);
    return site;
}

// Places the particles of a part with at most LEAF.
static void fill(const struct streaks_scatter *scatter, const struct streaks_part *part,
                 struct site sites[LEAF])
{
    const bool is_even = streaks_part_even(scatter, part);
    for (int i = 0; i < part->count; i++) {
        const struct site site = draw_site(scatter, part, is_even, (uint32_t)(part->first + i));
        int at = i;
        for (; at > 0 && sites[at - 1].code > site.code; at--)
            sites[at] = sites[at - 1];
        sites[at] = site;
    }
}

static void write_sites(const struct streaks_scatter *scatter, const struct site *sites,
                        int64_t count, float *to)
{
    for (int64_t i = 0; i < count; i++, to += 3) {
        const double x = (2.0 * sites[i].x + 1) / (1 << (STREAKS_LATTICE_BITS + 1));
        const double y = (2.0 * sites[i].y + 1) / (1 << (STREAKS_LATTICE_BITS + 1));
        to[0] = (float)(x * scatter->size_x - 1);
        to[1] = (float)(y * scatter->size_y - 1);
        to[2] = sites[i].packed;
    }
}

// Writes many particles of one lattice point, which need no sorting.
static void write_heap(const struct streaks_scatter *scatter, const struct streaks_part *part,
                       float *particles)
{
    for (int64_t i = part->first; i < part->first + part->count; i++) {
        const struct site site = draw_site(scatter, part, true, (uint32_t)i);
        write_sites(scatter, &site, 1, particles + 3 * i);
    }
}

static void write_part(const struct streaks_scatter *scatter, struct streaks_part part,
                       float *particles)
{
    if (part.count == 0)
        return;
    if (part.count <= LEAF) {
        struct site sites[LEAF];
        fill(scatter, &part, sites);
        write_sites(scatter, sites, part.count, particles + 3 * part.first);
        return;
    }
    if (part.depth == STREAKS_DEEPEST) {
        write_heap(scatter, &part, particles);
        return;
    }
    struct streaks_part halves[2];
    streaks_part_halve(scatter, &part, halves);
    if (part.count > TASK) {
        const struct streaks_part first = halves[0];
#pragma omp task firstprivate(first)
        write_part(scatter, first, particles);
    } else {
        write_part(scatter, halves[0], particles);
    }
    write_part(scatter, halves[1], particles);
}

void streaks_scatter(const struct streaks_scatter *scatter, int64_t count, float *particles)
{
    const struct streaks_part whole = {.count = count};
#pragma omp parallel
#pragma omp single
    write_part(scatter, whole, particles);
}

// --- a quad-tree's leaves, counted without keeping particles ---

static int64_t sorted_quads(const struct site *sites, int count, int depth, int size)
{
    if (count == 0)
        return 0;
    if (depth % 2 == 0 && count <= size)
        return 1;
    if (depth == STREAKS_DEEPEST)
        return (count + size - 1) / size;
    int low = 0;
    while (low < count && !(sites[low].code >> (STREAKS_DEEPEST - 1 - depth) & 1))
        low++;
    return sorted_quads(sites, low, depth + 1, size) +
           sorted_quads(sites + low, count - low, depth + 1, size);
}

static void count_part(const struct streaks_scatter *scatter, struct streaks_part part, int size,
                       int64_t *leaves)
{
    if (part.count == 0)
        return;
    int64_t found = 0;
    if (part.depth % 2 == 0 && part.count <= size) {
        found = 1;
    } else if (part.depth == STREAKS_DEEPEST) {
        found = (part.count + size - 1) / size;
    } else if (part.count <= LEAF) {
        struct site sites[LEAF];
        fill(scatter, &part, sites);
        found = sorted_quads(sites, (int)part.count, part.depth, size);
    }
    if (found) {
#pragma omp atomic
        *leaves += found;
        return;
    }
    struct streaks_part halves[2];
    streaks_part_halve(scatter, &part, halves);
    if (part.count > TASK) {
        const struct streaks_part first = halves[0];
#pragma omp task firstprivate(first)
        count_part(scatter, first, size, leaves);
    } else {
        count_part(scatter, halves[0], size, leaves);
    }
    count_part(scatter, halves[1], size, leaves);
}

int64_t streaks_scatter_quads(const struct streaks_scatter *scatter, int64_t count, int size)
{
    const struct streaks_part whole = {.count = count};
    int64_t leaves = 0;
#pragma omp parallel
#pragma omp single
    count_part(scatter, whole, size, &leaves);
    return leaves;
}
