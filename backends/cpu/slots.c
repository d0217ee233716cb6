#include "backends/cpu/cpu.h"

struct cpu_call cpu_bind(const struct rg_kernel *kernel, const struct rg_run *run,
                         struct rg_notes *notes)
{
    struct cpu_call call = {
        .params = run->params,
        .begin = {run->origin.width, run->origin.height, run->origin.depth},
        .end = {run->origin.width + run->extent.width, run->origin.height + run->extent.height,
                run->origin.depth + run->extent.depth},
        .notes = notes,
    };
    if (run->draw)
        call.target = cpu_target_of(run->draw);
    for (int i = 0; i < kernel->slot_count; i++) {
        const struct rg_slot_info *slot = &kernel->slots[i];
        struct cpu_buf *buf = (struct cpu_buf *)run->slots[slot->slot].buf;
        struct cpu_image *image = (struct cpu_image *)run->slots[slot->slot].image;
        call.slots[slot->slot] =
            buf ? (struct cpu_slot){buf->data, (int)(buf->pub.size / (size_t)slot->element_size),
                                    NULL}
                : (struct cpu_slot){image->texels, image->words, &image->shape};
    }
    return call;
}
