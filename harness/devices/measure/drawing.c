#include "harness/devices/measure/drawing.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/device/device.h"
#include "harness/console/clock.h"
#include "kernels/dialect/image/format.h"
#include "kernels/raster/quads_params.h"

enum { WIDTH = 128, HEIGHT = RG_DRAWING_PIXELS / WIDTH, PANES = 48, MAX_WORDS = 4 };

static const enum rg_format formats[RG_DRAWING_FORMATS] = {RG_RGBA8, RG_RGBA16F, RG_RGBA32F};

// The images read back from a device.
struct result {
    uint32_t colour[RG_DRAWING_PIXELS * MAX_WORDS];
    float depth[RG_DRAWING_PIXELS];
};

// The test's objects on one device.
struct studio {
    struct rg_device *device;
    struct rg_pass *pass;
    struct rg_buf *panes;
};

static float random_within(uint32_t *seed, float low, float high)
{
    *seed = *seed * 1664525u + 1013904223u;
    return low + (high - low) * (float)(*seed >> 8) * 0x1p-24f;
}

static void fill(float panes[PANES * RASTER_QUAD_WORDS])
{
    uint32_t seed = 1;
    for (float *pane = panes; pane < panes + PANES * RASTER_QUAD_WORDS; pane += RASTER_QUAD_WORDS) {
        const float alpha = random_within(&seed, 0.2f, 1);
        pane[0] = random_within(&seed, -1, 1);
        pane[1] = random_within(&seed, -1, 1);
        pane[2] = random_within(&seed, 0.05f, 0.5f);
        pane[3] = random_within(&seed, 0.02f, 0.2f);
        pane[4] = random_within(&seed, 0, 6.28f);
        pane[5] = 1;
        pane[6] = random_within(&seed, 0, 1);
        for (int c = 0; c < 3; c++)
            pane[7 + c] = alpha * random_within(&seed, 0, 1);
        pane[10] = alpha;
    }
}

static bool open_studio(struct studio *studio, struct rg_device *device)
{
    float panes[PANES * RASTER_QUAD_WORDS];
    fill(panes);
    *studio = (struct studio){.device = device};
    return (studio->pass = rg_pass_create(device, "raster_quads")) &&
           (studio->panes = rg_buf_create_with(device, panes, sizeof(panes), "panes"));
}

static void close_studio(struct studio *studio)
{
    rg_buf_destroy(studio->panes);
    rg_pass_destroy(studio->pass);
}

// Draws overlapping panes that write depth, and then slightly rotated panes that add light where
// they are not hidden.
static bool draw_panes(const struct studio *studio, struct rg_draw *to)
{
    raster_quads_params params = {.aspect = (float)WIDTH / HEIGHT};
    const struct rg_run run = {
        .params = &params, .slots = {[1].buf = studio->panes}, .extent = {PANES, 1, 1}, .draw = to};
    const bool blends =
        studio->device->info.limits.formats[to->colour->desc.format].uses & RG_USE_BLEND;
    to->depth_mode = RG_DEPTH_WRITE;
    to->blend = blends ? RG_BLEND_OVER : RG_BLEND_OFF;
    if (!rg_pass_run(studio->pass, &run))
        return false;
    params.turned = 0.3f;
    to->depth_mode = RG_DEPTH_TEST;
    to->blend = blends ? RG_BLEND_ADD : RG_BLEND_OFF;
    return rg_pass_run(studio->pass, &run);
}

static bool draw(const struct studio *studio, enum rg_format format, struct result *result)
{
    const uint32_t black[MAX_WORDS] = {0};
    const float farthest = 1;
    const struct rg_image_desc coloured = {format, WIDTH, HEIGHT, 1, 1};
    const struct rg_image_desc deep = {RG_D32F, WIDTH, HEIGHT, 1, 1};
    struct rg_image *colour =
        rg_image_create_with(studio->device, &coloured, black, "drawn colour");
    struct rg_image *depth = rg_image_create_with(studio->device, &deep, &farthest, "drawn depth");
    struct rg_draw to = {.colour = colour, .depth = depth};
    const bool ok = colour && depth && draw_panes(studio, &to) &&
                    rg_image_read(colour, 0, 0, result->colour) &&
                    rg_image_read(depth, 0, 0, result->depth);
    rg_image_destroy(depth);
    rg_image_destroy(colour);
    return ok;
}

// --- comparing ---

static float value_of(const struct result *result, enum rg_format format, int i)
{
    const uint8_t *bytes = (const uint8_t *)result->colour;
    const uint16_t *halves = (const uint16_t *)(const void *)result->colour;
    float value;
    if (format == RG_RGBA8)
        return (float)bytes[i] / 255;
    if (format == RG_RGBA16F)
        return rg_unpack_half(halves[i]);
    memcpy(&value, &result->colour[i], sizeof(value));
    return value;
}

static bool is_alike(const struct result *a, const struct result *b, enum rg_format format,
                     int pixel, enum rg_tier tier)
{
    const size_t size = (size_t)rg_format_size(format), at = (size_t)pixel * size;
    if (!memcmp((const char *)a->colour + at, (const char *)b->colour + at, size) &&
        !memcmp(&a->depth[pixel], &b->depth[pixel], sizeof(float)))
        return true;
    bool alike = tier != RG_T0 && fabsf(a->depth[pixel] - b->depth[pixel]) < 1e-5f;
    for (int c = 0; alike && c < 4; c++) {
        const float due = value_of(a, format, 4 * pixel + c);
        alike = fabsf(value_of(b, format, 4 * pixel + c) - due) <= 2.0f / 255 * fmaxf(due, 1);
    }
    return alike;
}

// Draws twice, so that times do not include compiling.
static bool check_format(const struct studio *studio, const struct studio *truth,
                         enum rg_format format, struct result results[2],
                         struct rg_drawing *drawing)
{
    struct rg_drawn *drawn = &drawing->formats[drawing->count];
    if (!draw(truth, format, &results[0]) || !draw(studio, format, &results[1]))
        return false;
    const double start_ms = rg_now_ms();
    if (!draw(studio, format, &results[1]))
        return false;
    drawing->ms += rg_now_ms() - start_ms;
    *drawn = (struct rg_drawn){.format = format};
    for (int i = 0; i < RG_DRAWING_PIXELS; i++)
        drawn->differing +=
            !is_alike(&results[0], &results[1], format, i, studio->device->info.tier);
    drawing->count++;
    return true;
}

static bool check_formats(struct rg_device *device, struct rg_device *reference,
                          struct result results[2], struct rg_drawing *drawing)
{
    struct studio studio, truth = {NULL};
    bool ok = open_studio(&studio, device) && open_studio(&truth, reference);
    for (int i = 0; ok && i < RG_DRAWING_FORMATS; i++)
        if (device->info.limits.formats[formats[i]].uses & RG_USE_DRAW)
            ok = check_format(&studio, &truth, formats[i], results, drawing);
    close_studio(&studio);
    close_studio(&truth);
    return ok;
}

bool rg_drawing_check(struct rg_device *device, struct rg_drawing *drawing)
{
    *drawing = (struct rg_drawing){0};
    if (*device->info.limits.no_draws)
        return true;
    struct rg_device *reference = rg_device_open("cpu:reference");
    struct result *results = rg_alloc(2, sizeof(*results), "drawing");
    const bool ok = reference && results && check_formats(device, reference, results, drawing);
    free(results);
    return rg_device_close(reference) && ok;
}

bool rg_drawn_is_well(const struct rg_drawn *drawn, enum rg_tier tier)
{
    return drawn->differing <= (tier == RG_T0 ? 0 : RG_DRAWING_PIXELS / 1000);
}
