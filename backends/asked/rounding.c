#include "backends/asked/rounding.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "backends/asked/question.h"
#include "core/base/alloc.h"
#include "core/base/log.h"
#include "kernels/probe/rough_params.h"

enum { COUNT = 65536, SIZE = COUNT * 4 };

struct operands {
    uint32_t first[COUNT], second[COUNT], result[COUNT];
};

enum { FIRST, SECOND, RESULT }; // buffers of the question

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

static bool prepare(struct rg_question *q, const struct operands *o)
{
    return rg_question_buf(q, FIRST, o->first, SIZE, "first operands") &&
           rg_question_buf(q, SECOND, o->second, SIZE, "second operands") &&
           rg_question_buf(q, RESULT, NULL, SIZE, "results") && rg_question_pass(q, "probe_rough");
}

static bool ask(struct rg_question *q, bool roots, struct operands *o)
{
    const struct rg_backend *backend = q->device->backend;
    const struct probe_rough_params params = {roots};
    const struct rg_run run = {
        .params = &params,
        .slots = {[1].buf = q->bufs[FIRST], [2].buf = q->bufs[SECOND], [3].buf = q->bufs[RESULT]},
        .extent = {COUNT, 1, 1}};
    return backend->pass_run(q->pass, &run) &&
           backend->buf_read(q->bufs[RESULT], 0, o->result, SIZE);
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
    struct rg_question q = {.device = device};
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
    rg_question_end(&q);
    free(o);
    return ok;
}

bool rg_rounding_settle(struct rg_device *device)
{
    const char *wanted = getenv("RG_ROUNDING");
    const bool own = wanted && !strcmp(wanted, "own"), driver = wanted && !strcmp(wanted, "driver");
    require(!wanted || !*wanted || own || driver, "RG_ROUNDING=%s: give own or driver, or unset it",
            wanted);
    if (!device->backend->rough || driver)
        return true;
    device->rounds = own;
    if (!own && device->info.tier != RG_T0 && !ask_driver(device, &device->rounds))
        return false;
    if (device->rounds)
        rg_question_note(device, "own rounding");
    return true;
}
