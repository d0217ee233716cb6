#include "backends/cpu/draw.h"

#include <omp.h>

#include "backends/cpu/cpu.h"
#include "backends/cpu/draw/emit.h"
#include "core/base/alloc.h"
#include "core/base/log.h"
#include "kernels/dialect/draw/coverage.h"

// Chunks are large enough to be worth a thread, and small enough to balance the load.
enum { LEAST_CHUNK = 4 * CPU_BATCH, MOST_CHUNK = 64 * CPU_BATCH, CHUNKS_A_THREAD = 16 };

// Fewer pixels than this cost less than waking a thread.
enum { LEAST_PIXELS = 8192 };

struct drawing {
    struct cpu_emitter emitter; // copied for each thread, which adds its sorter
    int begin, end;             // items in the round
    int threads;
};

static int chunk_items(const struct drawing *d)
{
    const int share = (d->end - d->begin) / (d->threads * CHUNKS_A_THREAD);
    return rg_iclamp(share / CPU_BATCH * CPU_BATCH, LEAST_CHUNK, MOST_CHUNK);
}

// The first step of a round: makes primitives from the items of at most `most` chunks.
static void emit_items(const struct drawing *d, int most)
{
    struct cpu_bins *bins = d->emitter.bins;
    const int size = chunk_items(d);
    const int64_t wanted = ((int64_t)d->end - d->begin + size - 1) / size;
    const int chunks = wanted < most ? (int)wanted : most;
    for (int i = 0; i < chunks; i++)
        bins->chunks[i].begin = bins->chunks[i].end = d->begin + i * size;
#pragma omp parallel for schedule(dynamic, 1) num_threads(rg_imin(chunks, d->threads))
    for (int i = 0; i < chunks; i++) {
        struct cpu_emitter mine = d->emitter;
        mine.sorter = bins->sorters[omp_get_thread_num()];
        const int begin = bins->chunks[i].begin;
        cpu_emit(&mine, i, d->end - begin > size ? begin + size : d->end);
    }
    // If a chunk has items left for the next round, later chunks must wait, too.
    bins->chunk_count = 0;
    while (bins->chunk_count < chunks && bins->chunks[bins->chunk_count++].whole)
        ;
}

// The second step of a round: shades the tiles.
static void shade_tiles(const struct drawing *d)
{
    const struct cpu_bins *bins = d->emitter.bins;
    const int tiles = bins->tiling.across * bins->tiling.down;
    int64_t pixels = 0;
    for (int i = 0; i < bins->chunk_count; i++)
        pixels += bins->chunks[i].pixels;
#pragma omp parallel for schedule(dynamic, 1) num_threads(pixels < LEAST_PIXELS ? 1 : d->threads)
    for (int t = 0; t < tiles; t++)
        d->emitter.raster->shade(d->emitter.program, d->emitter.call, bins, t);
}

// The bytes of a primitive's record and of its lights' records.
static size_t record_bytes(const struct cpu_emitter *e)
{
    const size_t lights = e->program->light_size ? (size_t)e->program->lights(e->call) : 0;
    return e->program->record_size + lights * e->program->light_size;
}

static bool draw_rounds(struct drawing *d)
{
    struct cpu_bins *bins = d->emitter.bins;
    const rg_draw_state *draw = d->emitter.draw;
    int most = CPU_MOST_CHUNKS;
    while (d->begin < d->end) {
        if (!cpu_bins_prepare(bins, draw, record_bytes(&d->emitter), d->threads))
            return false;
        emit_items(d, most);
        if (bins->failed)
            return false;
        shade_tiles(d);
        const int done = bins->chunks[bins->chunk_count - 1].end;
        // A chunk alone in a round can use all memory.
        most = done > d->begin ? CPU_MOST_CHUNKS : 1;
        d->begin = done;
    }
    return true;
}

bool cpu_draw(struct cpu_device *device, const char *name, const struct cpu_program *program,
              const struct cpu_call *call)
{
    const rg_draw_state *draw = call->params;
    if (!device->bins)
        device->bins = rg_alloc(1, sizeof(*device->bins), name);
    if (!device->bins)
        return false;
    struct drawing d = {
        .emitter = {program, device->level->raster, call, draw, device->bins, NULL},
        .begin = draw->item_begin,
        .end = draw->item_end,
        .threads = omp_get_max_threads(),
    };
    return draw_rounds(&d) ||
           rg_harness_error("kernel '%s': no memory for the primitives that it draws; close other "
                            "programs, or draw fewer items",
                            name);
}

// The rest of this file counts a draw's work by plain loops. The drawing itself cannot count, since
// it skips early everything that covers nothing.

static rg_snapped corners_of(const struct cpu_items *items, int i)
{
    return (rg_snapped){
        items->x[0][i], items->y[0][i], items->x[1][i], items->y[1][i],
        items->x[2][i], items->y[2][i], items->x[3][i], items->y[3][i],
    };
}

static int64_t count_clipped(const struct cpu_program *program, const struct cpu_call *call,
                             int item)
{
    const rg_draw_state *draw = call->params;
    rg_snapped parts[CPU_MOST_PARTS];
    const int count = program->clip(call, item, parts);
    int64_t fragments = 0;
    for (int k = 0; k < count; k++)
        fragments += rg_covered_pixels(*draw, parts[k], program->corners);
    return fragments;
}

// Returns the first item after the batch.
static int count_batch(const struct cpu_program *program, const struct cpu_call *call, int begin,
                       struct rg_counts *counts)
{
    const rg_draw_state *draw = call->params;
    struct cpu_items items;
    const int next = program->items(call, begin, draw->item_end, &items);
    for (int i = 0; i < items.count; i++) {
        counts->records += items.fate[i] != RG_FATE_DEAD;
        if (items.fate[i] == RG_FATE_WHOLE)
            counts->fragments += rg_covered_pixels(*draw, corners_of(&items, i), program->corners);
        else if (items.fate[i] == RG_FATE_CLIP)
            counts->fragments += count_clipped(program, call, items.item[i]);
    }
    return next;
}

void cpu_count(const struct cpu_program *program, const struct cpu_call *call,
               struct rg_counts *counts)
{
    const rg_draw_state *draw = call->params;
    counts->records = counts->fragments = 0;
    for (int i = draw->item_begin; i < draw->item_end;)
        i = count_batch(program, call, i, counts);
}
