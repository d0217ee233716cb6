#include "tests/flow_rig.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static const char *const cheap = "environment=sky environment_px=16 view=pane panes=mirror";

static void set(struct flow_settings *settings, const char *assignments)
{
    char *copy = strdup(assignments), *rest = NULL;
    for (char *one = strtok_r(copy, " ", &rest); one; one = strtok_r(NULL, " ", &rest))
        assert_true(rg_params_set(&flow_param_table, settings, one));
    free(copy);
}

void rig_open(struct rig *rig, const char *device, const char *assignments)
{
    rg_params_reset(&flow_param_table, &rig->settings);
    set(&rig->settings, cheap);
    set(&rig->settings, assignments);
    rig->size = rig->settings.resolution_px;
    rig->device = rg_device_open(device, NULL);
    assert_non_null(rig->device);
    rig->width = rig->size * 3 / 2;
    rig->height = rig->size * 5 / 4;
    rig->instance =
        rg_technique_find("flow")->create(rig->device, &rig->settings, rig->width, rig->height);
    assert_non_null(rig->instance);
}

void rig_close(struct rig *rig)
{
    rig->instance->technique->destroy(rig->instance);
    assert_true(rg_device_close(rig->device));
}

void rig_step(struct rig *rig, int steps)
{
    for (int i = 0; i < steps; i++)
        assert_true(rig->instance->technique->step(rig->instance));
}

static float *read_map(const struct rig *rig)
{
    const size_t bytes = (size_t)flow_map_length(rig->size) * sizeof(float);
    float *map = malloc(bytes);
    assert_true(rg_buf_read(rig->instance->state[0].buf, 0, map, (int64_t)bytes));
    return map;
}

int64_t *rig_water(const struct rig *rig)
{
    const int n = rig->size, m = FLOW_MARGIN;
    float *map = read_map(rig);
    int64_t *water = malloc((size_t)n * (size_t)n * sizeof(*water));
    for (int y = -m; y < n + m; y++) {
        for (int x = -m; x < n + m; x++) {
            const double droplets = (double)map[flow_index(n, x, y)] * 65536;
            const int64_t whole = (int64_t)droplets;
            if ((double)whole != droplets || whole < 0)
                fail_msg("texel (%d, %d) holds %.17g droplets", x, y, droplets);
            if (flow_on_pane(n, x, y))
                water[y * n + x] = whole;
            else if (whole)
                fail_msg("the margin is wet at (%d, %d)", x, y);
        }
    }
    free(map);
    return water;
}

void rig_put(struct rig *rig, const int64_t *water)
{
    const int n = rig->size;
    float *map = calloc((size_t)flow_map_length(n), sizeof(*map));
    for (int y = 0; y < n; y++)
        for (int x = 0; x < n; x++)
            map[flow_index(n, x, y)] = (float)((double)water[y * n + x] / 65536);
    assert_true(rg_buf_write(rig->instance->state[0].buf, 0, map,
                             (int64_t)flow_map_length(n) * (int64_t)sizeof(*map)));
    free(map);
}

int64_t rig_sum(const struct rig *rig)
{
    int64_t *water = rig_water(rig), sum = 0;
    for (int i = 0; i < rig->size * rig->size; i++)
        sum += water[i];
    free(water);
    return sum;
}

uint32_t rig_ledger(const struct rig *rig, int word)
{
    uint32_t words[FLOW_LEDGER_WORDS];
    assert_true(rg_buf_read(rig->instance->state[1].buf, 0, words, sizeof(words)));
    return words[word];
}

void rig_put_one(struct rig *rig, int x, int y, int64_t droplets)
{
    int64_t *water = calloc((size_t)rig->size * (size_t)rig->size, sizeof(*water));
    water[y * rig->size + x] = droplets;
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
