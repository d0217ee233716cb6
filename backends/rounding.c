#include "backends/rounding.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "backends/backend.h"
#include "core/base/alloc.h"
#include "core/base/require.h"
#include "kernels/probe/rough_params.h"

enum { COUNT = 65536, SIZE = COUNT * 4 };

struct operands {
    uint32_t first[COUNT], second[COUNT], result[COUNT];
};

// The objects that test a device's rounding.
struct question {
    struct rg_device *device;
    struct rg_buf *first, *second, *result;
    struct rg_pass *pass;
};

// A float with any significand and an exponent of 2^-30 to 2^30, so that all quotients are normal.
static uint32_t random_float(uint64_t *seed)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    const uint32_t word = (uint32_t)(*seed >> 32), exponent = 97 + (uint32_t)(*seed >> 8) % 60;
    return (word & 0x807fffffu) | (exponent << 23);
}

static void draw(struct operands *o)
{
    uint64_t seed = 0x7a1d;
    for (int i = 0; i < COUNT; i++) {
        o->first[i] = random_float(&seed);
        o->second[i] = random_float(&seed);
    }
}

static struct rg_buf *make_buf(struct rg_device *device, const char *name)
{
    struct rg_buf *buf = device->backend->buf_create(device, SIZE, name);
    if (buf) {
        buf->device = device;
        buf->size = SIZE;
        buf->name = name;
    }
    return buf;
}

static bool prepare(struct question *q, const struct operands *o)
{
    struct rg_device *device = q->device;
    const struct rg_backend *backend = device->backend;
    const struct rg_kernel *kernel = rg_kernel_find("probe_rough");
    bool ok = (q->first = make_buf(device, "first operands")) &&
              (q->second = make_buf(device, "second operands")) &&
              (q->result = make_buf(device, "results")) &&
              (q->pass = backend->pass_create(device, kernel));
    if (!ok)
        return false;
    q->pass->device = device;
    q->pass->kernel = kernel;
    return backend->buf_write(q->first, 0, o->first, SIZE) &&
           backend->buf_write(q->second, 0, o->second, SIZE);
}

static void finish(struct question *q)
{
    const struct rg_backend *backend = q->device->backend;
    struct rg_buf *const bufs[] = {q->first, q->second, q->result};
    backend->sync(q->device);
    if (q->pass)
        backend->pass_destroy(q->pass);
    for (int i = 0; i < 3; i++)
        if (bufs[i])
            backend->buf_destroy(bufs[i]);
}

static bool ask(struct question *q, bool roots, struct operands *o)
{
    const struct rg_backend *backend = q->device->backend;
    const struct probe_rough_params params = {roots};
    const struct rg_run run = {
        .params = &params,
        .slots = {[1].buf = q->first, [2].buf = q->second, [3].buf = q->result},
        .extent = {COUNT, 1, 1}};
    return backend->pass_run(q->pass, &run) && backend->buf_read(q->result, 0, o->result, SIZE);
}

static bool all_are_exact(const struct operands *o, bool roots)
{
    for (int i = 0; i < COUNT; i++) {
        float a, b, exact;
        memcpy(&a, &o->first[i], sizeof(a));
        memcpy(&b, &o->second[i], sizeof(b));
        exact = roots ? sqrtf(fabsf(a)) : a / b;
        if (memcmp(&o->result[i], &exact, sizeof(exact)) != 0)
            return false;
    }
    return true;
}

static bool ask_driver(struct rg_device *device, bool *is_rough)
{
    struct question q = {.device = device};
    struct operands *o = rg_alloc(1, sizeof(*o), "operands");
    if (!o)
        return false;
    draw(o);
    bool ok = prepare(&q, o);
    *is_rough = false;
    for (int roots = 0; ok && !*is_rough && roots < 2; roots++) {
        ok = ask(&q, roots, o);
        *is_rough = ok && !all_are_exact(o, roots);
    }
    finish(&q);
    free(o);
    return ok;
}

bool rg_rounding_settle(struct rg_device *device)
{
    struct rg_device_info *info = &device->info;
    const char *wanted = getenv("RG_ROUNDING");
    const bool own = wanted && !strcmp(wanted, "own"), driver = wanted && !strcmp(wanted, "driver");
    require(!wanted || !*wanted || own || driver, "RG_ROUNDING=%s: give own or driver, or unset it",
            wanted);
    if (!device->backend->rough || driver)
        return true;
    device->rounds = own;
    if (!own && info->tier != RG_T0 && !ask_driver(device, &device->rounds))
        return false;
    const size_t length = strlen(info->api);
    if (device->rounds)
        snprintf(info->api + length, sizeof(info->api) - length, ", own rounding");
    return true;
}
