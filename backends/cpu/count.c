// Counts what a draw comes to, by plain loops. The drawing itself cannot tell, since it leaves out
// early what covers nothing.
#include "backends/backend.h"
#include "backends/cpu/draw.h"
#include "kernels/dialect/draw/coverage.h"

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

static void count_batch(const struct cpu_program *program, const struct cpu_call *call, int begin,
                        int count, struct rg_counts *counts)
{
    const rg_draw_state *draw = call->params;
    struct cpu_items items;
    program->items(call, begin, count, &items);
    for (int i = 0; i < count; i++) {
        counts->records += items.fate[i] != RG_FATE_DEAD;
        if (items.fate[i] == RG_FATE_WHOLE)
            counts->fragments += rg_covered_pixels(*draw, corners_of(&items, i), program->corners);
        else if (items.fate[i] == RG_FATE_CLIP)
            counts->fragments += count_clipped(program, call, begin + i);
    }
}

void cpu_count(const struct cpu_program *program, const struct cpu_call *call,
               struct rg_counts *counts)
{
    const rg_draw_state *draw = call->params;
    counts->records = counts->fragments = 0;
    for (int i = draw->item_begin; i < draw->item_end; i += CPU_BATCH)
        count_batch(program, call, i, rg_imin(draw->item_end - i, CPU_BATCH), counts);
}
