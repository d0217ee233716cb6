#include "backends/asked/blending.h"

#include <stdlib.h>
#include <string.h>

#include "backends/asked/question.h"
#include "core/base/alloc.h"
#include "core/base/log.h"
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

enum { QUADS, PRIMS, ARGS }; // buffers of the question

// The panes, and what they look like: as a loop in C has them, and as the device drew them.
struct trial {
    struct rg_question asked;
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

static void blend_in_c(struct trial *t, enum rg_format format, enum rg_blend blend)
{
    const int words = rg_format_size(format) / 4;
    memset(t->due, 0, sizeof(t->due));
    for (const struct pane *p = t->panes; p < t->panes + PANES; p++)
        for (int y = p->y0; y < p->y1; y++)
            for (int x = p->x0; x < p->x1; x++) {
                const int at = (y * SIDE + x) * words;
                if (format == RG_RGBA8)
                    rg_blend_RGBA8(t->due, at, p->colour, (int)blend);
                else if (format == RG_RGBA16F)
                    rg_blend_RGBA16F(t->due, at, p->colour, (int)blend);
                else
                    rg_blend_RGBA32F(t->due, at, p->colour, (int)blend);
            }
}

// --- the device ---

static bool prepare(struct trial *t)
{
    const uint32_t args[5] = {6 * PANES, 1, 0, 0, PANES};
    float quads[PANES * RASTER_QUAD_WORDS];
    struct packed prims[PANES];
    make_panes(t->panes);
    for (int i = 0; i < PANES; i++) {
        fill_quad(&t->panes[i], quads + i * RASTER_QUAD_WORDS);
        prims[i] = packed_of(&t->panes[i], i);
    }
    return rg_question_buf(&t->asked, QUADS, quads, sizeof(quads), "panes") &&
           rg_question_buf(&t->asked, PRIMS, prims, sizeof(prims), "packed panes") &&
           rg_question_buf(&t->asked, ARGS, args, sizeof(args), "panes to draw") &&
           rg_question_pass(&t->asked, "raster_quads");
}

static bool draw(struct trial *t, struct rg_image *target, enum rg_blend blend)
{
    const struct rg_backend *backend = t->asked.device->backend;
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
    struct rg_buf *const *bufs = t->asked.bufs;
    const struct rg_draw to = {.colour = target, .blend = blend};
    const struct rg_packed packed = {.prims = bufs[PRIMS], .args = bufs[ARGS], .capacity = PANES};
    const struct rg_run run = {.params = &call,
                               .slots = {[1].buf = bufs[QUADS]},
                               .extent = {PANES, 1, 1},
                               .draw = &to,
                               .packed = &packed};
    return backend->pass_run(t->asked.pass, &run) && backend->image_read(target, 0, 0, t->drawn);
}

static bool ask(struct trial *t, enum rg_format format, enum rg_blend blend, bool *is_exact)
{
    static const uint32_t black[TEXEL_WORDS] = {0};
    const struct rg_backend *backend = t->asked.device->backend;
    const struct rg_image_desc desc = {format, SIDE, SIDE, 1, 1};
    struct rg_image *target =
        backend->image_create(t->asked.device, &desc, "panes over each other");
    if (!target)
        return false;
    target->device = t->asked.device;
    target->desc = desc;
    target->name = "panes over each other";
    const bool ok = backend->image_clear(target, black) && draw(t, target, blend);
    backend->sync(t->asked.device);
    backend->image_destroy(target);
    blend_in_c(t, format, blend);
    *is_exact = ok && !memcmp(t->due, t->drawn, (size_t)TEXELS * (size_t)rg_format_size(format));
    return ok;
}

static bool ask_driver(struct rg_device *device, bool *is_exact)
{
    struct trial *t = rg_alloc(1, sizeof(*t), "panes");
    if (!t)
        return false;
    t->asked.device = device;
    bool ok = prepare(t);
    *is_exact = true;
    for (size_t f = 0; ok && f < sizeof(formats) / sizeof(formats[0]); f++)
        for (enum rg_blend blend = RG_BLEND_OVER; ok && *is_exact && blend <= RG_BLEND_ADD; blend++)
            if (device->info.limits.formats[formats[f]].uses & RG_USE_BLEND)
                ok = ask(t, formats[f], blend, is_exact);
    rg_question_end(&t->asked);
    free(t);
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
    const char *wanted = getenv("RG_BLENDING");
    const bool program = wanted && !strcmp(wanted, "program"),
               driver = wanted && !strcmp(wanted, "driver");
    require(!wanted || !*wanted || program || driver,
            "RG_BLENDING=%s: give driver or program, or unset it", wanted);
    if (!device->backend->can_blend || driver || *device->info.limits.no_draws)
        return true;
    if (!decide(device, program))
        return false;
    if (device->blends)
        rg_question_note(device, "own blending");
    return true;
}
