#include "core/techniques/streaks/packets/part.h"

#include <math.h>

enum { CHANCE_BITS = 53 }; // precision of the probability of a half

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

// The place among the texels of a border between lattice points, 0 to 2^24.
static double texels_at(uint32_t lattice, int texels)
{
    if (lattice == 1u << STREAKS_LATTICE_BITS)
        return texels;
    const uint32_t texel = texel_of(lattice, texels);
    const uint32_t edge = edge_of(texel, texels);
    return texel + (double)(lattice - edge) / (edge_of(texel + 1, texels) - edge);
}

// The lattice point at a fractional place in a texel.
static uint32_t lattice_at(double place, int texel, int texels)
{
    const uint32_t edge = edge_of((uint32_t)texel, texels);
    const uint32_t next = edge_of((uint32_t)texel + 1, texels);
    const uint32_t at = edge + (uint32_t)((place - texel) * (next - edge));
    return at < next ? at : next - 1;
}

bool streaks_part_even(const struct streaks_scatter *scatter, const struct streaks_part *part)
{
    const struct rg_density *map = scatter->density;
    if (!map)
        return true;
    const uint32_t last_x = part->x + (1u << streaks_bits_x(part)) - 1;
    const uint32_t last_y = part->y + (1u << streaks_bits_y(part)) - 1;
    return texel_of(part->x, map->width) == texel_of(last_x, map->width) &&
           texel_of(part->y, map->height) == texel_of(last_y, map->height);
}

// A part as a rectangle of the map.
struct window {
    double left, top, right, bottom;
};

static struct window window_of(const struct rg_density *map, const struct streaks_part *part)
{
    return (struct window){texels_at(part->x, map->width), texels_at(part->y, map->height),
                           texels_at(part->x + (1u << streaks_bits_x(part)), map->width),
                           texels_at(part->y + (1u << streaks_bits_y(part)), map->height)};
}

static double mass(const struct rg_density *map, struct window w)
{
    return rg_density_mass(map, w.left, w.top, w.right, w.bottom);
}

// --- halving ---

static struct streaks_part half_of(const struct streaks_part *part, bool second)
{
    struct streaks_part half = *part;
    half.depth++;
    if (second && part->depth % 2)
        half.x += 1u << streaks_bits_x(&half);
    else if (second)
        half.y += 1u << streaks_bits_y(&half);
    return half;
}

// The number of ones among `count` random bits, in this part's round-th drawing.
static int64_t ones(const struct streaks_scatter *scatter, const struct streaks_part *part,
                    int round, int64_t count)
{
    int64_t sum = 0;
    for (int64_t done = 0; done < count; done += 128) {
        rg_uint4 counter = {part->x | (uint32_t)part->depth << STREAKS_LATTICE_BITS,
                            part->y | (uint32_t)round << STREAKS_LATTICE_BITS,
                            (uint32_t)(done / 128),
                            STREAKS_PURPOSES * scatter->field + STREAKS_SPLITS};
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

// How many of `count` uniform random numbers are below `chance`. Compares all of them bit by bit,
// until they differ from it, so that a number takes about two random bits.
static int64_t below(const struct streaks_scatter *scatter, const struct streaks_part *part,
                     double chance)
{
    if (!(chance > 0))
        return 0;
    if (chance >= 1)
        return part->count;
    int64_t sum = 0, open = part->count;
    for (int round = 0; round < CHANCE_BITS && open && chance > 0; round++) {
        const int64_t low = ones(scatter, part, round, open); // those whose next bit is 0
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

void streaks_part_halve(const struct streaks_scatter *scatter, const struct streaks_part *part,
                        struct streaks_part halves[2])
{
    double chance = 0.5;
    halves[0] = half_of(part, false);
    halves[1] = half_of(part, true);
    if (!streaks_part_even(scatter, part))
        chance = mass(scatter->density, window_of(scatter->density, &halves[0])) /
                 mass(scatter->density, window_of(scatter->density, part));
    halves[0].count = below(scatter, part, chance);
    halves[1].count = part->count - halves[0].count;
    halves[1].first = part->first + halves[0].count;
}

// --- a place in a part ---

// The place at which the density, summed from one side of a window across x or down y, reaches a
// share of the total. Finds the texel by bisection, then interpolates inside it.
static double reach(const struct rg_density *map, struct window w, bool down, double share,
                    int *texel)
{
    const double wanted = share * mass(map, w);
    double *const end = down ? &w.bottom : &w.right;
    const double begin = down ? w.top : w.left, whole = *end;
    int low = (int)begin, high = (int)ceil(whole) - 1; // the texel is in this range
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

// Finds first the row, then the column.
void streaks_part_place(const struct rg_density *map, const struct streaks_part *part,
                        rg_uint4 random, uint32_t *x, uint32_t *y)
{
    struct window w = window_of(map, part);
    int row, column;
    const double v = reach(map, w, true, random.y * 0x1p-32, &row);
    w.top = row;
    w.bottom = row + 1;
    const double u = reach(map, w, false, random.x * 0x1p-32, &column);
    *x = clamped(lattice_at(u, column, map->width), part->x, streaks_bits_x(part));
    *y = clamped(lattice_at(v, row, map->height), part->y, streaks_bits_y(part));
}
