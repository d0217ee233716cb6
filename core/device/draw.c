#include "core/device/draw.h"

#include <assert.h>
#include <string.h>

#include "core/device/grid.h"
#include "core/device/limits.h"
#include "core/device/packing.h"
#include "core/device/targets.h"
#include "core/device/work.h"
#include "kernels/dialect/draw/blend.h"
#include "kernels/dialect/draw/state.h"

static_assert((int)RG_RGBA8_FORMAT == (int)RG_RGBA8 && (int)RG_RGBA16F_FORMAT == (int)RG_RGBA16F &&
                  (int)RG_RGBA32F_FORMAT == (int)RG_RGBA32F,
              "kernels/dialect/draw/state.h and backends/formats.h number formats alike");
static_assert((int)RG_DEPTH_IS_OFF == (int)RG_DEPTH_OFF &&
                  (int)RG_DEPTH_IS_TEST == (int)RG_DEPTH_TEST &&
                  (int)RG_DEPTH_IS_WRITE == (int)RG_DEPTH_WRITE,
              "kernels/dialect/draw/state.h and backends/backend.h number depth modes alike");
static_assert((int)RG_BLEND_IS_OFF == (int)RG_BLEND_OFF &&
                  (int)RG_BLEND_IS_OVER == (int)RG_BLEND_OVER &&
                  (int)RG_BLEND_IS_ADD == (int)RG_BLEND_ADD,
              "kernels/dialect/draw/blend.h and backends/backend.h number blends alike");

static void fill_state(const struct rg_draw *draw, rg_draw_state *state)
{
    *state = (rg_draw_state){
        .x0 = draw->x0,
        .y0 = draw->y0,
        .x1 = draw->x1,
        .y1 = draw->y1,
        .cull = draw->cull,
        .blend = draw->blend,
        .depth_mode = draw->depth_mode,
        .colour_format = draw->colour ? (int)draw->colour->desc.format : 0,
        .counted = rg_draw_counts(draw),
    };
    rg_target_size(draw, &state->width, &state->height);
    if (rg_target_is_whole(draw)) {
        state->x1 = state->width;
        state->y1 = state->height;
    }
    state->half_width = 0.5f * (float)state->width;
    state->half_height = 0.5f * (float)state->height;
}

// Packing passes and their writes are not counted, because no caller asked for them and other
// devices do without.
static void leave_out_packing(struct rg_work *work, const struct rg_work *asked)
{
    work->runs = asked->runs;
    work->items = asked->items;
    work->bytes_written = asked->bytes_written;
    work->bytes_read = asked->bytes_read;
}

// The items of a native device's draw: all, or those of as many queries as there are.
static int native_batch(const struct rg_run *run)
{
    const int64_t most = (int64_t)run->draw->items_a_query * RG_MAX_QUERIES;
    return most && most < run->extent.width ? (int)most : run->extent.width;
}

static void number_queries(struct rg_run *part, const rg_draw_state *state)
{
    const int whole = part->draw->items_a_query;
    if (!whole)
        return;
    part->queries = (state->item_end - state->item_begin + whole - 1) / whole;
    part->first_query = state->item_begin / whole;
}

bool rg_draw_run(struct rg_pass *pass, const struct rg_run *run)
{
    if (!rg_run_check(pass, run) || !rg_target_check(pass, run) ||
        !rg_limits_allow_draw(&pass->device->info, pass->kernel, run->draw))
        return false;
    rg_run_count(pass, run);
    const bool packed = rg_draw_packs(pass->device, run->draw);
    _Alignas(16) unsigned char call[RG_MAX_PARAMS_SIZE];
    rg_draw_state state;
    fill_state(run->draw, &state);
    memcpy(call + sizeof(state), run->params, (size_t)pass->kernel->params_size);
    struct rg_run part = *run;
    part.params = call;
    const struct rg_work asked = *pass->device->work;
    const int items = run->extent.width;
    const int whole = run->draw->items_a_query;
    const int batch =
        packed ? rg_packing_prepare(pass, items, whole, &state.capacity) : native_batch(run);
    for (int64_t done = 0; batch && done < items; done += batch) {
        state.item_begin = run->origin.width + (int)done;
        state.item_end = state.item_begin + (items - done < batch ? (int)(items - done) : batch);
        memcpy(call, &state, sizeof(state));
        number_queries(&part, &state);
        if (!(packed ? rg_packing_run(pass, &part, &state) : rg_dispatch(pass, &part)))
            return false;
    }
    leave_out_packing(pass->device->work, &asked);
    return batch != 0;
}
