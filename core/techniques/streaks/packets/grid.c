#include <math.h>
#include <stdlib.h>

#include "core/base/alloc.h"
#include "core/techniques/streaks/packets/inner.h"
#include "kernels/dialect/rng.h"

enum { CELL_STREAM = 1, BUCKET_FIELD = 1, PARTS = 65536 };

// The share of the rain that cells may displace: a grid of 12 x 12 displaces as much under the
// cone.
static const double MOST_DISPLACED = 0.0625;

// The step between density levels: 1/255 of the largest possible density, as in 8 bits, but at
// least one particle.
static double step_of(double full_cell)
{
    return fmax(1, full_cell / (STREAKS_LEVELS - 1));
}

int streaks_bucket_count(const struct streaks_grid *grid, int level)
{
    return (int)rint(level * grid->step);
}

// The mean density of a cell over all texels and parts of texels in it.
static double cell_density(const struct rg_density *map, const struct streaks_grid *grid,
                           int column, int row)
{
    const double wide = (double)map->width / grid->across, high = (double)map->height / grid->down;
    return rg_density_mass(map, column * wide, row * high, fmin((column + 1) * wide, map->width),
                           fmin((row + 1) * high, map->height)) /
           (wide * high);
}

// Whether a level is whole, up to rounding.
static bool is_whole(double level)
{
    return fabs(level - rint(level)) < 1e-6;
}

static bool fits(const struct rg_density *map, const struct streaks_grid *grid, double full_cell,
                 int size, int column, int row)
{
    const double level = cell_density(map, grid, column, row) * full_cell / grid->step;
    return rint((is_whole(level) ? rint(level) : ceil(level)) * grid->step) <= size;
}

// Whether every cell's bucket is within the packet size. `worst` is the density that failed for an
// earlier grid; it is tested first.
static bool all_fit(const struct rg_density *map, const struct streaks_grid *grid, double full_cell,
                    int size, double worst[2])
{
    const int column = (int)(worst[0] * grid->across), row = (int)(worst[1] * grid->down);
    if (!fits(map, grid, full_cell, size, column, row))
        return false;
    for (int y = 0; y < grid->down; y++)
        for (int x = 0; x < grid->across; x++)
            if (!fits(map, grid, full_cell, size, x, y)) {
                worst[0] = (x + 0.5) / grid->across;
                worst[1] = (y + 0.5) / grid->down;
                return false;
            }
    return true;
}

// The rain of a cell that falls at other places in it than the map says, in densities times texels.
static double displaced(const struct rg_density *map, const struct streaks_grid *grid, int column,
                        int row)
{
    const double wide = (double)map->width / grid->across, high = (double)map->height / grid->down;
    const double mean = cell_density(map, grid, column, row);
    const double left = column * wide, right = fmin(left + wide, map->width);
    const double top = row * high, bottom = fmin(top + high, map->height);
    double sum = 0;
    for (int y = (int)top; y < bottom; y++)
        for (int x = (int)left; x < right; x++)
            sum += fabs(rg_density_at(map, x, y) - mean) * (fmin(x + 1, right) - fmax(x, left)) *
                   (fmin(y + 1, bottom) - fmax(y, top));
    return sum / 2;
}

// Whether cells are small enough for the map: rain is nearly uniform within each. Sums are whole
// numbers, so that threads do not matter.
static bool is_fine(const struct rg_density *map, const struct streaks_grid *grid)
{
    const int64_t cells = (int64_t)grid->across * grid->down;
    int64_t sum = 0;
#pragma omp parallel for schedule(static) reduction(+ : sum)
    for (int64_t cell = 0; cell < cells; cell++)
        sum += llrint(displaced(map, grid, (int)(cell % grid->across), (int)(cell / grid->across)) *
                      PARTS);
    return (double)sum <= MOST_DISPLACED * PARTS * rg_density_mean(map) * map->width * map->height;
}

// Chooses this many cells, as square as possible. False if there are too many.
static bool set_cells(const struct streaks_packets *p, double particles_m2, int across, int down,
                      double *full_cell, struct streaks_grid *grid)
{
    if ((int64_t)across * down > STREAKS_MAX_CELLS)
        return false;
    grid->across = across;
    grid->down = down;
    *full_cell = particles_m2 * 4 * p->half_x_m * p->half_y_m / across / down;
    grid->step = step_of(*full_cell);
    return true;
}

static int next_multiple(int of, int from)
{
    return (from + of - 1) / of * of;
}

// Chooses the coarsest grid whose buckets fit packets. If its cells are too large for the map,
// halves them along each side, again and again, down to texels or parts of texels. Returns the
// particles of a cell at density 1, or 0 if there would be too many cells.
static double choose_cells(const struct streaks_packets *p, const struct rg_density *map,
                           double particles_m2, struct streaks_grid *grid)
{
    const double ratio = p->half_y_m / p->half_x_m;
    double worst[2] = {0.5, 0.5}, full_cell;
    int step = 1;
    for (int longer = 1;; longer += step) {
        const int across = ratio <= 1 ? longer : (int)fmax(1, rint(longer / ratio));
        const int down = ratio <= 1 ? (int)fmax(1, rint(longer * ratio)) : longer;
        if (!set_cells(p, particles_m2, across, down, &full_cell, grid))
            return 0;
        if (!all_fit(map, grid, full_cell, p->settings.packet_size, worst))
            continue;
        if (is_fine(map, grid))
            return full_cell;
        if (across >= map->width && down >= map->height)
            return set_cells(p, particles_m2, next_multiple(map->width, across),
                             next_multiple(map->height, down), &full_cell, grid)
                       ? full_cell
                       : 0;
        step = longer;
    }
}

static rg_uint4 cell_random(uint32_t seed, int64_t cell)
{
    return rg_random(seed, (uint32_t)cell, 0, CELL_STREAM);
}

double streaks_cell_turn(uint32_t seed, int64_t cell)
{
    return (double)rg_uniform(cell_random(seed, cell).y);
}

// Rounds a level up or down at random, so that all cells together hold the map's amount.
static int level_of(double level, uint32_t seed, int64_t cell)
{
    if (is_whole(level))
        return (int)rint(level);
    return (int)floor(level + (double)rg_uniform(cell_random(seed, cell).x));
}

bool streaks_grid_plan(const struct streaks_packets *packets, const struct rg_density *density,
                       double densest_m3, struct streaks_grid *grid)
{
    const double particles_m2 = densest_m3 * packets->settings.local_height_m;
    const double full_cell = choose_cells(packets, density, particles_m2, grid);
    if (!(full_cell > 0)) {
        grid->across = grid->down = 0;
        return false;
    }
    const int64_t cells = (int64_t)grid->across * grid->down;
    grid->levels = rg_alloc((size_t)cells, 1, "rain: the grid's cells");
    if (!grid->levels)
        return false;
    int64_t cells_of[STREAKS_LEVELS] = {0};
#pragma omp parallel for schedule(static) reduction(+ : cells_of[:STREAKS_LEVELS])
    for (int64_t cell = 0; cell < cells; cell++) {
        const int column = (int)(cell % grid->across), row = (int)(cell / grid->across);
        const double density_here = cell_density(density, grid, column, row);
        const int level =
            level_of(density_here * full_cell / grid->step, packets->settings.seed, cell);
        grid->levels[cell] = (uint8_t)(level < STREAKS_LEVELS ? level : STREAKS_LEVELS - 1);
        cells_of[grid->levels[cell]]++;
    }
    for (int level = 0; level < STREAKS_LEVELS; level++)
        grid->cells_of[level] = cells_of[level];
    return true;
}

int streaks_grid_buckets(const struct streaks_grid *grid)
{
    int used = 0;
    for (int level = 1; level < STREAKS_LEVELS; level++)
        used += grid->cells_of[level] > 0;
    return used;
}

int64_t streaks_grid_total(const struct streaks_grid *grid)
{
    int64_t total = 0;
    for (int level = 1; level < STREAKS_LEVELS; level++)
        total += grid->cells_of[level] * streaks_bucket_count(grid, level);
    return total;
}

int64_t streaks_grid_slots(const struct streaks_grid *grid)
{
    int64_t slots = 0;
    for (int level = 1; level < STREAKS_LEVELS; level++)
        if (grid->cells_of[level] > 0)
            slots += streaks_padded(streaks_bucket_count(grid, level));
    return slots;
}

bool streaks_grid_build(struct streaks_packets *packets)
{
    struct streaks_grid *grid = &packets->grid;
    packets->slots = streaks_grid_slots(grid);
    packets->particles = rg_alloc((size_t)packets->slots, 12, "rain: particles");
    if (!packets->particles)
        return false;
    int64_t first = 0;
    for (int level = 1; level < STREAKS_LEVELS; level++) {
        if (grid->cells_of[level] == 0)
            continue;
        const int count = streaks_bucket_count(grid, level);
        grid->buckets[level] = (struct streaks_packet){.first = first, .count = count};
        streaks_scatter(&(struct streaks_scatter){.seed = packets->settings.seed,
                                                  .field = BUCKET_FIELD + (uint32_t)level,
                                                  .size_x = 2.0 / grid->across,
                                                  .size_y = 2.0 / grid->down},
                        count, packets->particles + 3 * first);
        packets->info.stored_particles += count;
        first += streaks_padded(count);
    }
    return true;
}
