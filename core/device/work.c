#include "core/device/work.h"

#include <string.h>

#include "core/base/alloc.h"
#include "kernels/dialect/draw/coverage.h"

// --- room ---

void rg_work_settle(struct rg_device *device)
{
    if (!device->backend->sync(device))
        device->work->has_failed = true;
}

void rg_room_count(struct rg_device *device)
{
    device->work->room = RG_ROOM_COUNTED;
    rg_log_hold(true);
}

// --- counting work ---

void rg_tally_begin(struct rg_device *device, struct rg_tally *tally)
{
    const struct rg_work *work = device->work;
    const int drawn = device->info.native ? -1 : 0; // only the driver knows what it draws of items
    *tally = (struct rg_tally){.runs = -work->runs,
                               .dispatches = -work->dispatches,
                               .items = -work->items,
                               .records = drawn,
                               .fragments = drawn,
                               .fragments_kept = -1,
                               .light_evaluations = drawn,
                               .texels_fetched = -1,
                               .bytes_written = -work->bytes_written,
                               .bytes_read = -work->bytes_read};
    device->work->tally = tally;
}

void rg_tally_end(struct rg_device *device)
{
    struct rg_work *work = device->work;
    struct rg_tally *tally = work->tally;
    tally->runs += work->runs;
    tally->dispatches += work->dispatches;
    tally->items += work->items;
    tally->bytes_written += work->bytes_written;
    tally->bytes_read += work->bytes_read;
    work->tally = NULL;
}

// --- primitives that were packed ---

// A packed primitive begins with its corners, then its item (kernels/dialect/draw/draw.h).
struct prim_head {
    rg_snapped corners;
    int item;
};

// Primitives of one item follow each other.
static void count_prim(struct rg_counts *counts, const struct rg_draw_info *draw,
                       const rg_draw_state *state, const unsigned char *prim, int *last_item)
{
    struct prim_head head;
    memcpy(&head, prim, sizeof(head));
    counts->records += head.item != *last_item;
    counts->fragments += rg_covered_pixels(*state, head.corners, draw->corners);
    *last_item = head.item;
}

// Reads the primitives in pieces. These bytes are not counted, because no technique asked for them.
static bool count_packed(struct rg_counts *counts, const struct rg_pass *pass,
                         const struct rg_run *run)
{
    enum { PIECE = 4096 };
    const struct rg_backend *backend = pass->device->backend;
    const struct rg_draw_info *draw = pass->kernel->draw;
    const rg_draw_state *state = run->params; // an rg_draw_call begins with it
    const size_t size = (size_t)draw->prim_size;
    uint32_t args[5];
    unsigned char *prims = rg_alloc(PIECE, size, pass->kernel->name);
    bool ok = prims && backend->buf_read(run->packed->args, 0, args, sizeof(args));
    const size_t count = ok ? args[4] : 0;
    int last_item = -1;
    counts->records = counts->fragments = 0;
    for (size_t first = 0; ok && first < count; first += PIECE) {
        const size_t some = count - first < PIECE ? count - first : PIECE;
        ok = backend->buf_read(run->packed->prims, first * size, prims, some * size);
        for (size_t i = 0; ok && i < some; i++)
            count_prim(counts, draw, state, prims + i * size, &last_item);
    }
    free(prims);
    return ok;
}

// --- counting a run ---

static int lights_of(const struct rg_kernel *kernel, const struct rg_run *run)
{
    int lights = 0;
    if (kernel->draw && kernel->draw->lights_at >= 0)
        memcpy(&lights, (const char *)run->params + sizeof(rg_draw_state) + kernel->draw->lights_at,
               sizeof(lights));
    return lights;
}

static void add(int64_t *sum, int64_t counted)
{
    if (rg_is_counted(counted))
        *sum = (rg_is_counted(*sum) ? *sum : 0) + counted;
}

bool rg_tally_run(struct rg_tally *tally, struct rg_pass *pass, const struct rg_run *run)
{
    struct rg_counts counts = {-1, -1, -1, -1};
    struct rg_run counted = *run;
    counted.counts = &counts;
    if (!pass->device->backend->pass_run(pass, &counted) ||
        (run->packed && !count_packed(&counts, pass, run)))
        return false;
    add(&tally->records, counts.records);
    add(&tally->fragments, counts.fragments);
    add(&tally->fragments_kept, counts.fragments_kept);
    add(&tally->texels_fetched, counts.texels_fetched);
    if (counts.fragments > 0)
        tally->light_evaluations += counts.fragments * lights_of(pass->kernel, run);
    return true;
}
