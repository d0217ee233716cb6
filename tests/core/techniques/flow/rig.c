#include "tests/core/techniques/flow/rig.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "core/techniques/flow/instance.h"
#include "kernels/dialect/image/format.h"
#include "tests/tools/instance.h"

static const char *const cheap =
    "environment=sky environment_px=16 view=pane panes=mirror move=paper";

// Devices stay open from one rig to the next, since a driver compiles the kernels again for each.
static struct kept {
    char name[64];
    struct rg_device *device;
} kept[2];

static struct rg_device *device_named(const char *name)
{
    struct kept *one = kept[0].device && strcmp(kept[0].name, name) ? &kept[1] : &kept[0];
    if (!one->device) {
        snprintf(one->name, sizeof(one->name), "%s", name);
        one->device = rg_device_open(name);
    }
    assert_non_null(one->device);
    assert_string_equal(one->name, name);
    return one->device;
}

int rig_close_devices(void **state)
{
    (void)state;
    bool clean = true;
    for (int i = 0; i < 2; i++)
        clean = rg_device_close(kept[i].device) && clean;
    return clean ? 0 : -1;
}

void rig_open_sized(struct rig *rig, const char *device, const char *assignments, int width,
                    int height)
{
    struct flow_settings *settings = settings_of("flow", cheap, assignments);
    rig->settings = *settings;
    free(settings);
    rig->device = device_named(device);
    rig->width = width > 0 ? width : rig->settings.resolution_px * 3 / 2;
    rig->height = height > 0 ? height : rig->settings.resolution_px * 5 / 4;
    rig->instance = rg_instance_open(rg_technique_find("flow"), rig->device, &rig->settings,
                                     rig->width, rig->height);
    assert_non_null(rig->instance);
    const struct flow *flow = (const struct flow *)rig->instance;
    rig->size = flow->settings.resolution_px;
    rig->panes = flow->pane_count;
}

void rig_open(struct rig *rig, const char *device, const char *assignments)
{
    rig_open_sized(rig, device, assignments, 0, 0);
}

void rig_set(struct rig *rig, const char *assignments)
{
    struct flow *flow = (struct flow *)rig->instance;
    assert_true(rg_params_set_all(&flow_param_table, &flow->settings, assignments));
}

void rig_close(struct rig *rig)
{
    rg_instance_close(rig->instance);
}

void rig_step(struct rig *rig, int steps)
{
    for (int i = 0; i < steps; i++)
        assert_true(rig->instance->technique->step(rig->instance));
}

static size_t map_bytes(const struct rig *rig)
{
    return (size_t)rig->panes * (size_t)flow_map_length(rig->size) * sizeof(float);
}

static float *read_maps(const struct rig *rig)
{
    float *maps = malloc(map_bytes(rig));
    assert_true(rg_buf_read(rig->instance->state[0].asset->buf, 0, maps, (int64_t)map_bytes(rig)));
    return maps;
}

int rig_texel(const struct rig *rig, int pane, int x, int y)
{
    return (pane * rig->size + y) * rig->size + x;
}

static int64_t whole_droplets(float water, int pane, int x, int y)
{
    const double droplets = (double)water * 65536;
    const int64_t whole = (int64_t)droplets;
    if ((double)whole != droplets || whole < 0 || whole > 1 << 24)
        fail_msg("pane %d, texel (%d, %d) holds %.17g droplets", pane, x, y, droplets);
    return whole;
}

int64_t *rig_water(const struct rig *rig)
{
    const int n = rig->size, m = FLOW_MARGIN;
    float *maps = read_maps(rig);
    int64_t *water = malloc((size_t)(rig->panes * n * n) * sizeof(*water));
    for (int pane = 0; pane < rig->panes; pane++) {
        for (int y = -m; y < n + m; y++) {
            for (int x = -m; x < n + m; x++) {
                const int64_t droplets =
                    whole_droplets(maps[flow_pane_index(n, pane, x, y)], pane, x, y);
                if (flow_on_pane(n, x, y))
                    water[rig_texel(rig, pane, x, y)] = droplets;
                else if (droplets)
                    fail_msg("the margin of pane %d is wet at (%d, %d)", pane, x, y);
            }
        }
    }
    free(maps);
    return water;
}

void rig_put(struct rig *rig, const int64_t *water)
{
    const int n = rig->size;
    float *maps = calloc(1, map_bytes(rig));
    for (int pane = 0; pane < rig->panes; pane++)
        for (int y = 0; y < n; y++)
            for (int x = 0; x < n; x++)
                maps[flow_pane_index(n, pane, x, y)] =
                    (float)((double)water[rig_texel(rig, pane, x, y)] / 65536);
    assert_true(rg_buf_write(rig->instance->state[0].asset->buf, 0, maps, (int64_t)map_bytes(rig)));
    free(maps);
}

int64_t rig_sum(const struct rig *rig)
{
    int64_t *water = rig_water(rig), sum = 0;
    for (int i = 0; i < rig->panes * rig->size * rig->size; i++)
        sum += water[i];
    free(water);
    return sum;
}

uint32_t rig_ledger(const struct rig *rig, int word)
{
    uint32_t words[FLOW_LEDGER_WORDS];
    assert_true(rg_buf_read(rig->instance->state[1].asset->buf, 0, words, sizeof(words)));
    return words[word];
}

double rig_sourced_mm3(struct rig *rig, int frames)
{
    uint32_t before = 0;
    int64_t sourced = 0;
    for (int frame = 0; frame <= frames; frame++) {
        const uint32_t now = rig_ledger(rig, FLOW_LEDGER_SOURCED);
        sourced += (uint32_t)(now - before);
        before = now;
        rig_step(rig, frame < frames);
    }
    return (double)sourced * rig_droplet_mm3(rig);
}

double rig_droplet_mm3(const struct rig *rig)
{
    const double texel_mm = rig->settings.pane_mm / rig->size;
    return texel_mm * texel_mm * rig_mm(rig, 1);
}

void rig_put_one(struct rig *rig, int x, int y, int64_t droplets)
{
    int64_t *water = calloc((size_t)(rig->panes * rig->size * rig->size), sizeof(*water));
    water[y * rig->size + x] = droplets;
    rig_put(rig, water);
    free(water);
}

double rig_mm(const struct rig *rig, int64_t droplets)
{
    return (double)droplets / 65536 * rig->settings.relief;
}

int64_t rig_droplets(const struct rig *rig, double mm)
{
    return (int64_t)(mm / rig->settings.relief * 65536);
}

void rig_put_drop(struct rig *rig, double x_mm, double y_mm, double radius_mm, double height_mm)
{
    const double texel_mm = rig->settings.pane_mm / rig->size;
    int64_t *water = calloc((size_t)(rig->panes * rig->size * rig->size), sizeof(*water));
    for (int i = 0; i < rig->size * rig->size; i++) {
        const double x = (i % rig->size + 0.5) * texel_mm - x_mm;
        const double y = ((double)(i / rig->size) + 0.5) * texel_mm - y_mm;
        const double inside = 1 - (x * x + y * y) / (radius_mm * radius_mm);
        water[i] = rig_droplets(rig, height_mm * sqrt(fmax(inside, 0)));
    }
    rig_put(rig, water);
    free(water);
}

void rig_expect(const struct rig *rig, int x, int y, int64_t droplets)
{
    int64_t *water = rig_water(rig);
    const int64_t found = water[y * rig->size + x];
    free(water);
    if (found != droplets)
        fail_msg("texel (%d, %d) holds %lld droplets, expected %lld", x, y, (long long)found,
                 (long long)droplets);
}

float *rig_draw(struct rig *rig)
{
    const int channels = rig->width * rig->height * 4;
    uint16_t *halves = malloc((size_t)channels * sizeof(*halves));
    float *light = malloc((size_t)channels * sizeof(*light));
    assert_true(rig->instance->technique->draw(rig->instance));
    assert_true(rg_image_read(rig->instance->target, 0, 0, halves));
    for (int i = 0; i < channels; i++)
        light[i] = rg_unpack_half(halves[i]);
    free(halves);
    return light;
}
