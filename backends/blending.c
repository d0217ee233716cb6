#include "backends/blending.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "backends/backend.h"
#include "core/base/alloc.h"
#include "core/base/log.h"
#include "core/base/require.h"
#include "kernels/dialect/draw/blend.h"
#include "kernels/dialect/draw/clip.h"
#include "kernels/raster/quads_params.h"

enum { SIDE = 64, PANES = 64, TEXEL_WORDS = 4, TEXELS = SIDE * SIDE };

// A pane over whole pixels, x0 <= x < x1.
struct pane {
    int x0, y0, x1, y1;
    rgba colour;
};

// A pane as raster_quads packs it.
struct packed {
    rg_snapped corners;
    int item;
    rgba colour;
    float depth;
};

// The objects that test how a device blends.
struct question {
    struct rg_device *device;
    struct rg_pass *pass;
    struct rg_buf *quads, *prims, *args;
    struct pane panes[PANES];
    uint32_t due[TEXELS * TEXEL_WORDS], drawn[TEXELS * TEXEL_WORDS];
};

static const enum rg_format formats[] = {RG_RGBA8, RG_RGBA16F, RG_RGBA32F};

// --- panes ---

static float random_unit(uint32_t *seed)
{
    *seed = *seed * 1664525u + 1013904223u;
    return (float)(*seed >> 8) * 0x1p-24f;
}

// Makes random panes, from faint to opaque.
static void make_panes(struct pane panes[PANES])
{
    uint32_t seed = 1;
    for (struct pane *p = panes; p < panes + PANES; p++) {
        const float alpha = random_unit(&seed) * random_unit(&seed);
        p->x0 = (int)(random_unit(&seed) * SIDE / 2);
        p->y0 = (int)(random_unit(&seed) * SIDE / 2);
        p->x1 = SIDE / 2 + (int)(random_unit(&seed) * SIDE / 2);
        p->y1 = SIDE / 2 + (int)(random_unit(&seed) * SIDE / 2);
        p->colour = rg_rgba(alpha * random_unit(&seed), alpha * random_unit(&seed),
                            alpha * random_unit(&seed), alpha);
    }
}

// Writes a pane as the words of kernels/raster/quads_params.h, for devices that draw items.
static void fill_quad(const struct pane *p, float quad[RASTER_QUAD_WORDS])
{
    const float words[RASTER_QUAD_WORDS] = {(float)(p->x0 + p->x1) / SIDE - 1,
                                            (float)(p->y0 + p->y1) / SIDE - 1,
                                            (float)(p->x1 - p->x0) / (2 * SIDE),
                                            (float)(p->y1 - p->y0) / (2 * SIDE),
                                            0,
                                            0,
                                            0,
                                            p->colour.r,
                                            p->colour.g,
                                            p->colour.b,
                                            p->colour.a};
    memcpy(quad, words, sizeof(words));
}

static struct packed packed_of(const struct pane *p, int item)
{
    const int x0 = p->x0 * RG_SUBPIXELS, y0 = p->y0 * RG_SUBPIXELS, x1 = p->x1 * RG_SUBPIXELS,
              y1 = p->y1 * RG_SUBPIXELS;
    return (struct packed){{x0, y0, x1, y0, x1, y1, x0, y1}, item, p->colour, 0};
}

static void blend_in_c(struct question *q, enum rg_format format, enum rg_blend blend)
{
    const int words = rg_format_size(format) / 4;
    memset(q->due, 0, sizeof(q->due));
    for (const struct pane *p = q->panes; p < q->panes + PANES; p++)
        for (int y = p->y0; y < p->y1; y++)
            for (int x = p->x0; x < p->x1; x++) {
                const int at = (y * SIDE + x) * words;
                if (format == RG_RGBA8)
                    rg_blend_RGBA8(q->due, at, p->colour, (int)blend);
                else if (format == RG_RGBA16F)
                    rg_blend_RGBA16F(q->due, at, p->colour, (int)blend);
                else
                    rg_blend_RGBA32F(q->due, at, p->colour, (int)blend);
            }
}

// --- the device ---

static struct rg_buf *make_buf(struct rg_device *device, const void *words, size_t size,
                               const char *name)
{
    struct rg_buf *buf = device->backend->buf_create(device, size, name);
    if (!buf)
        return NULL;
    buf->device = device;
    buf->size = size;
    buf->name = name;
    if (device->backend->buf_write(buf, 0, words, size))
        return buf;
    device->backend->buf_destroy(buf);
    return NULL;
}

static bool prepare(struct question *q)
{
    const uint32_t args[5] = {6 * PANES, 1, 0, 0, PANES};
    float quads[PANES * RASTER_QUAD_WORDS];
    struct packed prims[PANES];
    const struct rg_kernel *kernel = rg_kernel_find("raster_quads");
    make_panes(q->panes);
    for (int i = 0; i < PANES; i++) {
        fill_quad(&q->panes[i], quads + i * RASTER_QUAD_WORDS);
        prims[i] = packed_of(&q->panes[i], i);
    }
    if (!(q->quads = make_buf(q->device, quads, sizeof(quads), "panes")) ||
        !(q->prims = make_buf(q->device, prims, sizeof(prims), "packed panes")) ||
        !(q->args = make_buf(q->device, args, sizeof(args), "panes to draw")) ||
        !(q->pass = q->device->backend->pass_create(q->device, kernel)))
        return false;
    q->pass->device = q->device;
    q->pass->kernel = kernel;
    return true;
}

static void finish(struct question *q)
{
    const struct rg_backend *backend = q->device->backend;
    struct rg_buf *const bufs[] = {q->quads, q->prims, q->args};
    backend->sync(q->device);
    if (q->pass)
        backend->pass_destroy(q->pass);
    for (int i = 0; i < 3; i++)
        if (bufs[i])
            backend->buf_destroy(bufs[i]);
}

static bool draw(struct question *q, struct rg_image *target, enum rg_blend blend)
{
    const struct rg_backend *backend = q->device->backend;
    const struct {
        rg_draw_state draw;
        raster_quads_params program;
    } call = {{.item_end = PANES,
               .capacity = PANES,
               .width = SIDE,
               .height = SIDE,
               .x1 = SIDE,
               .y1 = SIDE,
               .half_width = SIDE / 2,
               .half_height = SIDE / 2,
               .blend = (int)blend,
               .colour_format = (int)target->desc.format},
              {.aspect = 1}};
    const struct rg_draw to = {.colour = target, .blend = blend};
    const struct rg_packed packed = {.prims = q->prims, .args = q->args, .capacity = PANES};
    const struct rg_run run = {.params = &call,
                               .slots = {[1].buf = q->quads},
                               .extent = {PANES, 1, 1},
                               .draw = &to,
                               .packed = &packed};
    return backend->pass_run(q->pass, &run) && backend->image_read(target, 0, 0, q->drawn);
}

static bool ask(struct question *q, enum rg_format format, enum rg_blend blend, bool *is_exact)
{
    static const uint32_t black[TEXEL_WORDS] = {0};
    const struct rg_backend *backend = q->device->backend;
    const struct rg_image_desc desc = {format, SIDE, SIDE, 1, 1};
    struct rg_image *target = backend->image_create(q->device, &desc, "panes over each other");
    if (!target)
        return false;
    target->device = q->device;
    target->desc = desc;
    target->name = "panes over each other";
    const bool ok = backend->image_clear(target, black) && draw(q, target, blend);
    backend->sync(q->device);
    backend->image_destroy(target);
    blend_in_c(q, format, blend);
    *is_exact = ok && !memcmp(q->due, q->drawn, (size_t)TEXELS * (size_t)rg_format_size(format));
    return ok;
}

static bool ask_driver(struct rg_device *device, bool *is_exact)
{
    struct question *q = rg_alloc(1, sizeof(*q), "panes");
    if (!q)
        return false;
    q->device = device;
    bool ok = prepare(q);
    *is_exact = true;
    for (size_t f = 0; ok && f < sizeof(formats) / sizeof(formats[0]); f++)
        for (enum rg_blend blend = RG_BLEND_OVER; ok && *is_exact && blend <= RG_BLEND_ADD; blend++)
            if (device->info.limits.formats[formats[f]].uses & RG_USE_BLEND)
                ok = ask(q, formats[f], blend, is_exact);
    finish(q);
    free(q);
    return ok;
}

// --- deciding ---

static bool decide(struct rg_device *device, bool wanted)
{
    const char *word = "";
    const bool can = device->backend->can_blend(device, &word);
    bool is_exact = device->info.tier == RG_T0;
    if (wanted && !can)
        return rg_unsupported("device '%s': RG_BLENDING=program, and its driver has no %s; unset "
                              "RG_BLENDING",
                              device->info.name, word);
    if (!wanted && !is_exact && can && !ask_driver(device, &is_exact))
        return false;
    device->blends = wanted || (can && !is_exact);
    return true;
}

bool rg_blending_settle(struct rg_device *device)
{
    struct rg_device_info *info = &device->info;
    const char *wanted = getenv("RG_BLENDING");
    const bool program = wanted && !strcmp(wanted, "program"),
               driver = wanted && !strcmp(wanted, "driver");
    require(!wanted || !*wanted || program || driver,
            "RG_BLENDING=%s: give driver or program, or unset it", wanted);
    if (!device->backend->can_blend || driver || *info->limits.no_draws)
        return true;
    if (!decide(device, program))
        return false;
    const size_t length = strlen(info->api);
    if (device->blends)
        snprintf(info->api + length, sizeof(info->api) - length, ", own blending");
    return true;
}
