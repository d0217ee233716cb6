#include "backends/cpu/cpu.h"

#include <omp.h>
#include <stdlib.h>

#include "backends/cpu/draw.h"
#include "core/base/alloc.h"
#include "core/base/log.h"

struct rg_pass *cpu_pass_create(struct rg_device *device, const struct rg_kernel *kernel)
{
    const struct cpu_level *level = ((struct cpu_device *)device)->level;
    const struct cpu_kernel *code = level->kernels[rg_kernel_index(kernel)];
    if (!code)
        return rg_error_null("kernel '%s': it packs the items of a program, which '%s' draws "
                             "unpacked; open the program",
                             kernel->name, device->info.name);
    struct cpu_pass *pass = rg_alloc(1, sizeof(*pass), kernel->name);
    if (!pass)
        return NULL;
    pass->code = code;
    return &pass->pub;
}

void cpu_pass_destroy(struct rg_pass *pass)
{
    free(pass);
}

// Runs items in order on the calling thread.
static bool run_in_order(struct cpu_pass *pass, const struct rg_run *run)
{
    struct rg_notes notes = {0};
    struct cpu_call call = cpu_bind(pass->pub.kernel, run, &notes);
    pass->code->run(&call);
    if (notes.slot)
        return rg_driver_error("kernel '%s': %s[%d] is out of range; it holds %d",
                               pass->pub.kernel->name, notes.slot, notes.index, notes.count);
    if (run->counts)
        *run->counts = (struct rg_counts){notes.records, notes.fragments, notes.fragments_kept,
                                          notes.texels_fetched};
    return true;
}

static int part(int64_t count, int index, int parts)
{
    return (int)(count * index / parts);
}

// A thread's block: a band of rows, or of layers or columns if there are fewer rows than blocks. It
// is the same in every pass of equal size, so that a core finds its own writes in its cache.
static struct cpu_call block(const struct cpu_call *call, const struct rg_extent *extent, int index,
                             int blocks)
{
    struct cpu_call mine = *call;
    if (extent->height >= blocks) {
        mine.begin.y = call->begin.y + part(extent->height, index, blocks);
        mine.end.y = call->begin.y + part(extent->height, index + 1, blocks);
    } else if (extent->depth >= blocks) {
        mine.begin.z = call->begin.z + part(extent->depth, index, blocks);
        mine.end.z = call->begin.z + part(extent->depth, index + 1, blocks);
    } else {
        mine.begin.x = call->begin.x + part(extent->width, index, blocks);
        mine.end.x = call->begin.x + part(extent->width, index + 1, blocks);
    }
    return mine;
}

// Fewer items than this cost less than waking a thread.
enum { MIN_ITEMS_A_THREAD = 4096 };

static bool run_parallel(struct cpu_pass *pass, const struct rg_run *run)
{
    struct cpu_call call = cpu_bind(pass->pub.kernel, run, NULL);
    int64_t items = (int64_t)run->extent.width * run->extent.height * run->extent.depth;
    int blocks = omp_get_max_threads();
    if (items / blocks < MIN_ITEMS_A_THREAD)
        blocks = items < MIN_ITEMS_A_THREAD ? 1 : (int)(items / MIN_ITEMS_A_THREAD);
    if (blocks == 1) {
        pass->code->run(&call);
        return true;
    }
#pragma omp parallel for schedule(static, 1) num_threads(blocks)
    for (int i = 0; i < blocks; i++) {
        struct cpu_call mine = block(&call, &run->extent, i, blocks);
        pass->code->run(&mine);
    }
    return true;
}

bool cpu_pass_run(struct rg_pass *pass, const struct rg_run *run)
{
    struct cpu_pass *cpu = (struct cpu_pass *)pass;
    struct cpu_device *device = (struct cpu_device *)pass->device;
    if (device->reference)
        return run_in_order(cpu, run);
    if (cpu->code->program) {
        const struct cpu_call call = cpu_bind(pass->kernel, run, NULL);
        if (run->counts)
            cpu_count(cpu->code->program, &call, run->counts);
        return cpu_draw(device, pass->kernel->name, cpu->code->program, &call);
    }
    return run_parallel(cpu, run);
}
