#include "backends/cpu/draw/bins.h"

#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"

// The most that a round's records take; its primitives without records, and its references, take
// about as much each.
#define MOST_BYTES ((size_t)128 << 20)

// Large tiles list more pixels before one repeats; many small tiles balance the load better.
enum { LEAST_SIDE_LOG2 = 6, WANTED_SIDE_LOG2 = 7, TILES_A_THREAD = 16, MOST_TILES = 4096 };
enum { BAND_LOG2 = 4 }; // rows of a band
enum { FIRST_ROOM = 1 << 16, MOST_PRIMS = 1 << 21, MOST_REFS = 1 << 23 };

// --- sorting a chunk's references by tile ---

bool cpu_sorter_grow(struct cpu_sorter *sorter)
{
    const int room = sorter->room ? 2 * sorter->room : FIRST_ROOM;
    int *tile = realloc(sorter->tile, (size_t)room * sizeof(*tile));
    if (tile)
        sorter->tile = tile;
    struct cpu_ref *ref = realloc(sorter->ref, (size_t)room * sizeof(*ref));
    if (ref)
        sorter->ref = ref;
    if (!tile || !ref)
        return false;
    sorter->room = room;
    return true;
}

void cpu_sorter_drop(struct cpu_sorter *sorter, int count)
{
    for (int i = count; i < sorter->count; i++)
        sorter->of_tile[sorter->tile[i]]--;
    sorter->count = count;
}

bool cpu_sorter_sort(struct cpu_sorter *sorter, struct cpu_bins *bins, int chunk)
{
    const int tiles = bins->tiling.across * bins->tiling.down;
    int *first = bins->firsts + chunk;
    const int begin = cpu_bins_refs(bins, sorter->count);
    const bool fits = begin >= 0;
    int place = fits ? begin : 0;
    for (int t = 0; t < tiles; t++) {
        const int count = fits ? sorter->of_tile[t] : 0;
        first[t * CPU_MOST_CHUNKS] = sorter->of_tile[t] = place;
        place += count;
    }
    first[tiles * CPU_MOST_CHUNKS] = place;
    for (int i = 0; fits && i < sorter->count; i++)
        bins->refs[sorter->of_tile[sorter->tile[i]]++] = sorter->ref[i];
    return fits;
}

// --- room for primitives and references ---

// Threads take room without waiting for each other. When it is full, the round ends.
static int take(int *taken, int count, int room, bool *full)
{
    const int first = __atomic_fetch_add(taken, count, __ATOMIC_RELAXED);
    if (count <= room && first <= room - count)
        return first;
    __atomic_store_n(full, true, __ATOMIC_RELAXED);
    return -1;
}

int cpu_bins_prims(struct cpu_bins *bins, int count)
{
    return take(&bins->prim_count, count, bins->prim_limit, &bins->full);
}

int cpu_bins_refs(struct cpu_bins *bins, int count)
{
    return take(&bins->ref_count, count, bins->ref_room, &bins->full);
}

// Replaces memory by another size; contents are not kept between rounds.
static void *renewed(void *held, size_t size)
{
    free(held);
    return rg_alloc_lines(size);
}

// Doubles the room if the last round lacked it.
static int wanted(int room, int asked_for, int most)
{
    int64_t more = room ? room : FIRST_ROOM;
    while (more < asked_for)
        more *= 2;
    return more < most ? (int)more : most;
}

static bool make_ref_room(struct cpu_bins *bins)
{
    const int refs = wanted(bins->ref_room, bins->ref_count, MOST_REFS);
    if (refs == bins->ref_room)
        return true;
    bins->refs = renewed(bins->refs, (size_t)refs * sizeof(*bins->refs));
    bins->ref_room = bins->refs ? refs : 0;
    return bins->refs != NULL;
}

static bool make_record_room(struct cpu_bins *bins, size_t size)
{
    if (size <= bins->record_room)
        return true;
    bins->records.of_items = renewed(bins->records.of_items, size);
    bins->record_room = bins->records.of_items ? size : 0;
    return bins->records.of_items != NULL;
}

// Programs with records of different size share the same memory.
static bool make_prim_room(struct cpu_bins *bins, size_t record_bytes)
{
    const int prims = wanted(bins->prim_room, bins->prim_count, MOST_PRIMS);
    if (prims != bins->prim_room) {
        bins->items = renewed(bins->items, (size_t)prims * sizeof(*bins->items));
        bins->corners = renewed(bins->corners, (size_t)prims * sizeof(*bins->corners));
        bins->prim_room = bins->items && bins->corners ? prims : 0;
    }
    bins->prim_limit = rg_imin(bins->prim_room, (int)(MOST_BYTES / record_bytes));
    bins->records.room = bins->prim_limit;
    return bins->prim_limit && make_record_room(bins, (size_t)bins->prim_limit * record_bytes);
}

static int divide(struct cpu_tiling *tiling, const rg_draw_state *draw, int log2_width,
                  int log2_height)
{
    const int width = 1 << log2_width, height = 1 << log2_height;
    *tiling = (struct cpu_tiling){log2_width, log2_height, (draw->width + width - 1) / width,
                                  (draw->height + height - 1) / height};
    return tiling->across * tiling->down;
}

static void choose_squares(struct cpu_tiling *tiling, const rg_draw_state *draw, int threads)
{
    int side = WANTED_SIDE_LOG2;
    while (side > LEAST_SIDE_LOG2 && divide(tiling, draw, side, side) < threads * TILES_A_THREAD)
        side--;
    while (divide(tiling, draw, side, side) > MOST_TILES)
        side++;
}

// An item alone draws each pixel once, and often reads images at the same place. Rows as long as
// the target let the processor foresee what is read next.
static void choose_bands(struct cpu_tiling *tiling, const rg_draw_state *draw)
{
    int width = LEAST_SIDE_LOG2;
    while (1 << width < draw->width)
        width++;
    int height = BAND_LOG2;
    while (divide(tiling, draw, width, height) > MOST_TILES)
        height++;
}

static void choose_tiles(struct cpu_tiling *tiling, const rg_draw_state *draw, int threads)
{
    if (draw->item_end - draw->item_begin == 1)
        choose_bands(tiling, draw);
    else
        choose_squares(tiling, draw, threads);
}

static bool make_chunks(struct cpu_bins *bins)
{
    const int tiles = bins->tiling.across * bins->tiling.down;
    if (tiles <= bins->tile_room)
        return true;
    bins->tile_room = 0;
    const size_t firsts = CPU_MOST_CHUNKS * ((size_t)tiles + 1);
    bins->chunks = renewed(bins->chunks, CPU_MOST_CHUNKS * sizeof(*bins->chunks));
    bins->firsts = renewed(bins->firsts, firsts * sizeof(*bins->firsts));
    if (!bins->chunks || !bins->firsts)
        return false;
    bins->tile_room = tiles;
    return true;
}

static bool make_sorters(struct cpu_bins *bins, int threads)
{
    if (bins->sorter_count < threads) {
        struct cpu_sorter **more = realloc(bins->sorters, (size_t)threads * sizeof(*more));
        if (!more)
            return false;
        bins->sorters = more;
    }
    for (; bins->sorter_count < threads; bins->sorter_count++) {
        struct cpu_sorter *sorter = rg_alloc_lines(sizeof(*sorter));
        if (!sorter)
            return false;
        memset(sorter, 0, sizeof(*sorter));
        bins->sorters[bins->sorter_count] = sorter;
        sorter->of_tile = malloc(MOST_TILES * sizeof(int));
    }
    for (int i = 0; i < threads; i++)
        if (!bins->sorters[i]->of_tile)
            return false;
    return true;
}

bool cpu_bins_prepare(struct cpu_bins *bins, const rg_draw_state *draw, size_t record_bytes,
                      int threads)
{
    choose_tiles(&bins->tiling, draw, threads);
    if (!make_ref_room(bins) || !make_prim_room(bins, record_bytes) || !make_chunks(bins) ||
        !make_sorters(bins, threads))
        return false;
    bins->prim_count = bins->ref_count = bins->chunk_count = 0;
    bins->full = bins->failed = false;
    return true;
}

void cpu_bins_destroy(struct cpu_bins *bins)
{
    if (!bins)
        return;
    for (int i = 0; i < bins->sorter_count; i++) {
        free(bins->sorters[i]->tile);
        free(bins->sorters[i]->ref);
        free(bins->sorters[i]->of_tile);
        free(bins->sorters[i]);
    }
    free(bins->sorters);
    free(bins->records.of_items);
    free(bins->items);
    free(bins->corners);
    free(bins->refs);
    free(bins->chunks);
    free(bins->firsts);
    free(bins);
}
