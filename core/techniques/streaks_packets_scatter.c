#include "core/techniques/streaks_packets_scatter.h"

#include <math.h>
#include <stdbool.h>

#include "kernels/rng.h"

enum {
    LEAF = 16,         // particles that are drawn one by one
    TASK = 1 << 17,    // particles that are worth a task of their own
    OSCILLATIONS = 10, // streaks of different drops (section 4.3.2)
    START_BITS = 20,   // what a float keeps beside an oscillation
    CHANCE_BITS = 53,  // of the chance of a half
    SPLITS = 1,
    PLACES = 2, // what random numbers are for
};

// A part of the plane: its first lattice point, how often the plane was halved, and its particles.
struct part {
    uint32_t x, y;
    int depth;
    int64_t first, count;
};

static int bits_x(const struct part *part)
{
    return STREAKS_LATTICE_BITS - part->depth / 2;
}

static int bits_y(const struct part *part)
{
    return STREAKS_LATTICE_BITS - (part->depth + 1) / 2;
}

// --- the lattice and the map's texels: a texel has whole lattice points, give or take one ---

static uint32_t texel_of(uint32_t lattice, int texels)
{
    return (uint32_t)((2 * (uint64_t)lattice + 1) * (uint64_t)texels >> (STREAKS_LATTICE_BITS + 1));
}

// The first lattice point of a texel.
static uint32_t edge_of(uint32_t texel, int texels)
{
    const uint64_t n = (uint64_t)texels;
    const uint64_t at = (uint64_t)texel << (STREAKS_LATTICE_BITS + 1);
    return at <= n ? 0 : (uint32_t)((at - n + 2 * n - 1) / (2 * n));
}

// A border between lattice points, 0 to 2^24, as a place among the texels.
static double texels_at(uint32_t lattice, int texels)
{
    if (lattice == 1u << STREAKS_LATTICE_BITS)
        return texels;
    const uint32_t texel = texel_of(lattice, texels);
    const uint32_t edge = edge_of(texel, texels);
    return texel + (double)(lattice - edge) / (edge_of(texel + 1, texels) - edge);
}

// The lattice point at a place in a texel.
static uint32_t lattice_at(double place, int texel, int texels)
{
    const uint32_t edge = edge_of((uint32_t)texel, texels);
    const uint32_t next = edge_of((uint32_t)texel + 1, texels);
    const uint32_t at = edge + (uint32_t)((place - texel) * (next - edge));
    return at < next ? at : next - 1;
}

static bool even(const struct streaks_scatter *scatter, const struct part *part)
{
    const struct rg_density *map = scatter->density;
    if (!map)
        return true;
    const uint32_t last_x = part->x + (1u << bits_x(part)) - 1;
    const uint32_t last_y = part->y + (1u << bits_y(part)) - 1;
    return texel_of(part->x, map->width) == texel_of(last_x, map->width) &&
           texel_of(part->y, map->height) == texel_of(last_y, map->height);
}

// A part as a rectangle of the map.
struct window {
    double left, top, right, bottom;
};

static struct window window_of(const struct rg_density *map, const struct part *part)
{
    return (struct window){texels_at(part->x, map->width), texels_at(part->y, map->height),
                           texels_at(part->x + (1u << bits_x(part)), map->width),
                           texels_at(part->y + (1u << bits_y(part)), map->height)};
}

static double mass(const struct rg_density *map, struct window w)
{
    return rg_density_mass(map, w.left, w.top, w.right, w.bottom);
}

// --- halving ---

static struct part half_of(const struct part *part, bool second)
{
    struct part half = *part;
    half.depth++;
    if (second && part->depth % 2)
        half.x += 1u << bits_x(&half);
    else if (second)
        half.y += 1u << bits_y(&half);
    return half;
}

// Ones among `count` random bits: the round-th that are drawn for this part.
static int64_t ones(const struct streaks_scatter *scatter, const struct part *part, int round,
                    int64_t count)
{
    int64_t sum = 0;
    for (int64_t done = 0; done < count; done += 128) {
        rg_uint4 counter = {part->x | (uint32_t)part->depth << STREAKS_LATTICE_BITS,
                            part->y | (uint32_t)round << STREAKS_LATTICE_BITS,
                            (uint32_t)(done / 128), 4 * scatter->field + SPLITS};
        rg_uint4 bits = rg_philox(counter, scatter->seed, 0);
        uint64_t words[2] = {bits.x | (uint64_t)bits.y << 32, bits.z | (uint64_t)bits.w << 32};
        for (int i = 0; i < 2; i++) {
            const int64_t left = count - done - 64 * i;
            if (left < 64)
                words[i] = left > 0 ? words[i] & (((uint64_t)1 << left) - 1) : 0;
            sum += __builtin_popcountll(words[i]);
        }
    }
    return sum;
}

// How many of `count` numbers in [0, 1) are below `chance`: all are compared with it at once, bit
// by bit, and those that have differed from it so far are decided. About two random bits a number.
static int64_t below(const struct streaks_scatter *scatter, const struct part *part, double chance)
{
    if (!(chance > 0))
        return 0;
    if (chance >= 1)
        return part->count;
    int64_t sum = 0, open = part->count;
    for (int round = 0; round < CHANCE_BITS && open && chance > 0; round++) {
        const int64_t low = ones(scatter, part, round, open); // their next bit is 0
        chance *= 2;
        if (chance >= 1) {
            chance -= 1;
            sum += low;
            open -= low;
        } else {
            open = low;
        }
    }
    return sum;
}

static void halve(const struct streaks_scatter *scatter, const struct part *part,
                  struct part halves[2])
{
    double chance = 0.5;
    halves[0] = half_of(part, false);
    halves[1] = half_of(part, true);
    if (!even(scatter, part))
        chance = mass(scatter->density, window_of(scatter->density, &halves[0])) /
                 mass(scatter->density, window_of(scatter->density, part));
    halves[0].count = below(scatter, part, chance);
    halves[1].count = part->count - halves[0].count;
    halves[1].first = part->first + halves[0].count;
}

// --- particles of one part ---

struct site {
    uint64_t code; // along the Morton curve
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

// Where the density summed from one side of a window reaches a share of its whole: across x, or
// down y. Looks for the texel by halving, then goes on evenly inside it.
static double reach(const struct rg_density *map, struct window w, bool down, double share,
                    int *texel)
{
    const double wanted = share * mass(map, w);
    double *const end = down ? &w.bottom : &w.right;
    const double begin = down ? w.top : w.left, whole = *end;
    int low = (int)begin, high = (int)ceil(whole) - 1; // the texel is one of these
    while (low < high) {
        const int middle = low + (high - low) / 2;
        *end = middle + 1;
        if (mass(map, w) > wanted)
            high = middle;
        else
            low = middle + 1;
    }
    const double left = fmax(low, begin), right = fmin(low + 1, whole);
    *end = left;
    const double before = mass(map, w);
    *end = right;
    const double inside = mass(map, w) - before;
    *texel = low;
    return left + (right - left) * (inside > 0 ? (wanted - before) / inside : 0.5);
}

static uint32_t clamped(uint32_t at, uint32_t low, int bits)
{
    const uint32_t high = low + (1u << bits) - 1;
    return at < low ? low : at > high ? high : at;
}

// A place in a part with more than one texel: first its row, then its column in the row's texels.
static void place_by_map(const struct rg_density *map, const struct part *part, rg_uint4 random,
                         struct site *site)
{
    struct window w = window_of(map, part);
    int row, column;
    const double y = reach(map, w, true, random.y * 0x1p-32, &row);
    w.top = row;
    w.bottom = row + 1;
    const double x = reach(map, w, false, random.x * 0x1p-32, &column);
    site->x = clamped(lattice_at(x, column, map->width), part->x, bits_x(part));
    site->y = clamped(lattice_at(y, row, map->height), part->y, bits_y(part));
}

static struct site draw_site(const struct streaks_scatter *scatter, const struct part *part,
                             bool is_even, uint32_t number)
{
    const rg_uint4 random =
        rg_philox((rg_uint4){number, 0, 0, 4 * scatter->field + PLACES}, scatter->seed, 0);
    struct site site = {.x = part->x, .y = part->y};
    if (is_even) {
        site.x += (uint32_t)((uint64_t)random.x >> (32 - bits_x(part)));
        site.y += (uint32_t)((uint64_t)random.y >> (32 - bits_y(part)));
    } else {
        place_by_map(scatter->density, part, random, &site);
    }
    site.code = spread_bits(site.x) | spread_bits(site.y) << 1;
    site.packed = (float)rg_mul_hi(random.w, OSCILLATIONS) +
                  (float)(random.z >> (32 - START_BITS)) / (1 << START_BITS);
    return site;
}

// Of at most LEAF particles.
static void fill(const struct streaks_scatter *scatter, const struct part *part,
                 struct site sites[LEAF])
{
    const bool is_even = even(scatter, part);
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

// Many particles on one lattice point, which need no sorting.
static void write_heap(const struct streaks_scatter *scatter, const struct part *part,
                       float *particles)
{
    for (int64_t i = part->first; i < part->first + part->count; i++) {
        const struct site site = draw_site(scatter, part, true, (uint32_t)i);
        write_sites(scatter, &site, 1, particles + 3 * i);
    }
}

static void write_part(const struct streaks_scatter *scatter, struct part part, float *particles)
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
    struct part halves[2];
    halve(scatter, &part, halves);
    if (part.count > TASK) {
        const struct part first = halves[0];
#pragma omp task firstprivate(first)
        write_part(scatter, first, particles);
    } else {
        write_part(scatter, halves[0], particles);
    }
    write_part(scatter, halves[1], particles);
}

void streaks_scatter(const struct streaks_scatter *scatter, int64_t count, float *particles)
{
    const struct part whole = {.count = count};
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

static void count_part(const struct streaks_scatter *scatter, struct part part, int size,
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
    struct part halves[2];
    halve(scatter, &part, halves);
    if (part.count > TASK) {
        const struct part first = halves[0];
#pragma omp task firstprivate(first)
        count_part(scatter, first, size, leaves);
    } else {
        count_part(scatter, halves[0], size, leaves);
    }
    count_part(scatter, halves[1], size, leaves);
}

int64_t streaks_scatter_quads(const struct streaks_scatter *scatter, int64_t count, int size)
{
    const struct part whole = {.count = count};
    int64_t leaves = 0;
#pragma omp parallel
#pragma omp single
    count_part(scatter, whole, size, &leaves);
    return leaves;
}
