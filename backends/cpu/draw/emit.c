#include "backends/cpu/draw/emit.h"

#include <string.h>

#include "kernels/dialect/draw/coverage.h"

// A chunk ends when it has more references than this.
enum { MOST_REFS = 1 << 18 };

static bool add_ref(struct cpu_sorter *sorter, int tile, struct cpu_ref ref)
{
    if (sorter->count == sorter->room && !cpu_sorter_grow(sorter))
        return false;
    sorter->tile[sorter->count] = tile;
    sorter->ref[sorter->count] = ref;
    sorter->count++;
    sorter->of_tile[tile]++;
    return true;
}

// The part of a mask of 8 x 8 pixels in columns [x0, x1) and rows [y0, y1), neither of which is
// empty.
static uint64_t cut_mask(uint64_t mask, int x0, int y0, int x1, int y1)
{
    const uint64_t columns = (UINT64_C(0xff) << x0) & (UINT64_C(0xff) >> (8 - x1));
    const uint64_t rows = (UINT64_MAX << 8 * y0) & (UINT64_MAX >> 8 * (8 - y1));
    return mask & rows & columns * UINT64_C(0x0101010101010101);
}

// Gives each tile under a mask its part of the mask.
static bool bin_cut(const struct cpu_emitter *e, int prim, uint64_t mask, int x, int y)
{
    const struct cpu_tiling *tiling = &e->bins->tiling;
    const int w = tiling->log2_width, h = tiling->log2_height;
    for (int ty = y >> h; ty <= (y + 7) >> h; ty++) {
        for (int tx = x >> w; tx <= (x + 7) >> w; tx++) {
            const int left = (tx << w) - x, top = (ty << h) - y;
            const uint64_t part = cut_mask(mask, rg_imax(left, 0), rg_imax(top, 0),
                                           rg_imin(left + (1 << w), 8), rg_imin(top + (1 << h), 8));
            if (part && !add_ref(e->sorter, ty * tiling->across + tx,
                                 (struct cpu_ref){prim, y << 16 | x, part}))
                return false;
        }
    }
    return true;
}

static bool bin_masks(const struct cpu_emitter *e, int shape, int prim)
{
    const struct cpu_shapes *shapes = &e->sorter->shapes;
    const struct cpu_tiling *tiling = &e->bins->tiling;
    const int w = tiling->log2_width, h = tiling->log2_height, x = shapes->x[shape];
    bool added = true;
    for (int i = 0; i < shapes->masks[shape]; i++) {
        const uint64_t mask = shapes->mask[i][shape];
        const int y = shapes->y[shape] + 8 * i;
        if (!mask)
            continue;
        if (x >> w == (x + 7) >> w && y >> h == (y + 7) >> h)
            added &= add_ref(e->sorter, (y >> h) * tiling->across + (x >> w),
                             (struct cpu_ref){prim, y << 16 | x, mask});
        else
            added &= bin_cut(e, prim, mask, x, y);
    }
    return added;
}

// Whether a pixel centre of the box may be inside an edge.
static bool reaches(rg_edge e, int x0, int y0, int x1, int y1)
{
    return rg_edge_at(e, e.dx < 0 ? x1 - 1 : x0, e.dy > 0 ? y1 - 1 : y0) > 0;
}

static bool triangle_reaches(const rg_triangle *t, int x0, int y0, int x1, int y1)
{
    return t->first_x < x1 && t->first_y < y1 && t->end_x > x0 && t->end_y > y0 &&
           reaches(t->a, x0, y0, x1, y1) && reaches(t->b, x0, y0, x1, y1) &&
           reaches(t->c, x0, y0, x1, y1);
}

// Adds references to the tiles that one of the shape's two triangles may cover.
static bool bin_corners(const struct cpu_emitter *e, const rg_snapped *c, int prim, int64_t *pixels)
{
    const struct cpu_tiling *tiling = &e->bins->tiling;
    const struct cpu_ref ref = {prim, -1, 0};
    const rg_triangle near = rg_triangle_make(*e->draw, c->x0, c->y0, c->x1, c->y1, c->x2, c->y2);
    const rg_triangle far = rg_triangle_make(*e->draw, c->x0, c->y0, c->x2, c->y2, c->x3, c->y3);
    const int w = tiling->log2_width, h = tiling->log2_height;
    const int first_x = rg_imin(near.first_x, far.first_x) >> w;
    const int first_y = rg_imin(near.first_y, far.first_y) >> h;
    const int last_x = (rg_imax(near.end_x, far.end_x) - 1) >> w;
    const int last_y = (rg_imax(near.end_y, far.end_y) - 1) >> h;
    for (int ty = first_y; ty <= last_y; ty++) {
        for (int tx = first_x; tx <= last_x; tx++) {
            const int x0 = tx << w, y0 = ty << h;
            const int x1 = (tx + 1) << w, y1 = (ty + 1) << h;
            if (!triangle_reaches(&near, x0, y0, x1, y1) && !triangle_reaches(&far, x0, y0, x1, y1))
                continue;
            if (!add_ref(e->sorter, ty * tiling->across + tx, ref))
                return false;
            *pixels += INT64_C(1) << (w + h - 2); // an estimate: a quarter of the tile
        }
    }
    return true;
}

static rg_snapped corners_at(const struct cpu_items *items, int place)
{
    return (rg_snapped){
        items->x[0][place], items->y[0][place], items->x[1][place], items->y[1][place],
        items->x[2][place], items->y[2][place], items->x[3][place], items->y[3][place],
    };
}

static bool bin_shape(const struct cpu_emitter *e, struct cpu_chunk *chunk, int shape, int prim,
                      bool plain)
{
    const struct cpu_shapes *shapes = &e->sorter->shapes;
    const int named = prim | (plain ? CPU_PLAIN : 0);
    if (shapes->cover[shape] == CPU_COVERS_MASK) {
        chunk->pixels += 8;
        return bin_masks(e, shape, named);
    }
    e->bins->corners[prim] = corners_at(&e->sorter->items, shapes->place[shape]);
    return bin_corners(e, &e->bins->corners[prim], named, &chunk->pixels);
}

// Makes primitives of the shapes that cover pixels.
static bool take_shapes(const struct cpu_emitter *e, struct cpu_chunk *chunk)
{
    struct cpu_shapes *shapes = &e->sorter->shapes;
    struct cpu_bins *bins = e->bins;
    int which[CPU_PLACES], item[CPU_PLACES], count = 0;
    uint8_t plain[CPU_PLACES];
    if (!shapes->count)
        return true;
    e->raster->cover(e->draw, &e->sorter->items, shapes);
    for (int i = 0; i < shapes->count; i++) {
        which[count] = i;
        item[count] = shapes->item[i];
        count += shapes->cover[i] != CPU_COVERS_NONE ? 1 : 0;
    }
    shapes->count = 0;
    const int first = count ? cpu_bins_prims(bins, count) : 0;
    if (first < 0)
        return false;
    e->program->records(e->call, item, count, bins->records, first, plain);
    memcpy(bins->items + first, item, (size_t)count * sizeof(*item));
    for (int i = 0; i < count; i++) {
        if (!bin_shape(e, chunk, which[i], first + i, plain[i])) {
            __atomic_store_n(&bins->failed, true, __ATOMIC_RELAXED);
            return false;
        }
    }
    return true;
}

static void add_shape(struct cpu_shapes *shapes, int place, int item)
{
    shapes->place[shapes->count] = place;
    shapes->item[shapes->count] = item;
    shapes->count++;
}

static void put_part(struct cpu_items *items, int place, const rg_snapped *part)
{
    items->x[0][place] = part->x0;
    items->y[0][place] = part->y0;
    items->x[1][place] = part->x1;
    items->y[1][place] = part->y1;
    items->x[2][place] = part->x2;
    items->y[2][place] = part->y2;
    items->x[3][place] = part->x3;
    items->y[3][place] = part->y3;
}

// Processes a batch with items to be clipped.
static bool take_clipped(const struct cpu_emitter *e, struct cpu_chunk *chunk)
{
    struct cpu_items *items = &e->sorter->items;
    struct cpu_shapes *shapes = &e->sorter->shapes;
    int place = CPU_BATCH;
    for (int i = 0; i < items->count; i++) {
        const int item = items->item[i];
        if (items->fate[i] == RG_FATE_WHOLE)
            add_shape(shapes, i, item);
        if (items->fate[i] != RG_FATE_CLIP)
            continue;
        rg_snapped parts[CPU_MOST_PARTS];
        const int part_count = e->program->clip(e->call, item, parts);
        if (place + part_count > CPU_PLACES) {
            if (!take_shapes(e, chunk))
                return false;
            place = CPU_BATCH;
        }
        for (int k = 0; k < part_count; k++) {
            put_part(items, place, &parts[k]);
            add_shape(shapes, place++, item);
        }
    }
    return take_shapes(e, chunk);
}

// Takes a batch of the items before `end`; false, with none taken, if room or memory is lacking.
static bool take_batch(const struct cpu_emitter *e, struct cpu_chunk *chunk, int end)
{
    struct cpu_items *items = &e->sorter->items;
    struct cpu_shapes *shapes = &e->sorter->shapes;
    shapes->count = 0;
    const int next = e->program->items(e->call, chunk->end, end, items);
    int whole = 0, clipped = 0;
    for (int i = 0; i < items->count; i++) {
        shapes->place[whole] = i;
        shapes->item[whole] = items->item[i];
        whole += items->fate[i] != RG_FATE_DEAD ? 1 : 0;
        clipped |= items->fate[i] & RG_FATE_CLIP;
    }
    shapes->count = clipped != 0 ? 0 : whole;
    if (clipped != 0 ? !take_clipped(e, chunk) : !take_shapes(e, chunk))
        return false;
    chunk->end = next;
    return true;
}

void cpu_emit(const struct cpu_emitter *e, int index, int end)
{
    struct cpu_bins *bins = e->bins;
    struct cpu_sorter *sorter = e->sorter;
    struct cpu_chunk *chunk = &bins->chunks[index];
    const int tiles = bins->tiling.across * bins->tiling.down;
    memset(sorter->of_tile, 0, (size_t)tiles * sizeof(*sorter->of_tile));
    sorter->count = 0;
    chunk->pixels = 0;
    while (chunk->end < end && sorter->count < MOST_REFS &&
           !__atomic_load_n(&bins->full, __ATOMIC_RELAXED)) {
        const int before = sorter->count;
        if (!take_batch(e, chunk, end)) {
            cpu_sorter_drop(sorter, before);
            break;
        }
    }
    if (!cpu_sorter_sort(sorter, bins, index))
        chunk->end = chunk->begin;
    chunk->whole = chunk->end == end;
}
