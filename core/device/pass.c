#include "core/device/pass.h"

#include <stdlib.h>
#include <xxhash.h>

#include "core/device/draw.h"
#include "core/device/grid.h"
#include "core/device/packing.h"

struct rg_pass *rg_pass_create(struct rg_device *device, const char *kernel)
{
    struct rg_pass *pass = rg_grid_create(device, kernel);
    if (!pass || !pass->kernel->draw || !device->backend->packed || rg_packer_create(pass))
        return pass;
    rg_pass_destroy(pass);
    return NULL;
}

void rg_pass_destroy(struct rg_pass *pass)
{
    if (pass)
        rg_packer_destroy(pass);
    rg_grid_destroy(pass);
}

static void add_code(struct rg_pass *pass, struct rg_pass_code *code)
{
    size_t size = 0;
    void *bytes =
        pass->device->backend->pass_code ? pass->device->backend->pass_code(pass, &size) : NULL;
    if (bytes) {
        code->hash = XXH3_64bits_withSeed(bytes, size, code->hash);
        code->bytes += (int64_t)size;
    }
    free(bytes);
}

void rg_pass_code(struct rg_pass *pass, struct rg_pass_code *code)
{
    add_code(pass, code);
    if (pass->packer) {
        add_code(pass->packer->count, code);
        add_code(pass->packer->emit, code);
    }
}

bool rg_pass_run(struct rg_pass *pass, const struct rg_run *run)
{
    return pass->kernel->draw ? rg_draw_run(pass, run) : rg_grid_run(pass, run);
}
