#include "core/device/pass.h"

#include <stdlib.h>

#include "core/device/draw.h"
#include "core/device/grid.h"
#include "core/device/packing.h"

struct rg_pass *rg_pass_create(struct rg_device *device, const char *kernel)
{
    struct rg_pass *pass = rg_grid_create(device, kernel);
    if (!pass || !pass->kernel->draw || !rg_device_packs(device) || rg_packer_create(pass))
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

static bool give_code(struct rg_pass *pass,
                      void (*take)(const void *bytes, size_t size, void *user), void *user)
{
    const struct rg_backend *backend = pass->device->backend;
    size_t size = 0;
    void *bytes = NULL;
    const bool ok = !backend->pass_code || backend->pass_code(pass, &bytes, &size);
    if (bytes)
        take(bytes, size, user);
    free(bytes);
    return ok;
}

bool rg_pass_code(struct rg_pass *pass, void (*take)(const void *bytes, size_t size, void *user),
                  void *user)
{
    return give_code(pass, take, user) &&
           (!pass->packer || (give_code(pass->packer->count, take, user) &&
                              give_code(pass->packer->emit, take, user)));
}

bool rg_pass_run(struct rg_pass *pass, const struct rg_run *run)
{
    return pass->kernel->draw ? rg_draw_run(pass, run) : rg_grid_run(pass, run);
}
