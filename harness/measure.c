#include "harness/measure.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/image/compare.h"
#include "core/alloc.h"
#include "core/log.h"
#include "harness/clock.h"
#include "harness/frame.h"
#include "kernels/rng.h"

enum { MAX_WARM_UP_SAMPLES = 20, MIN_WARM_UP_SAMPLES = 3, PASS_FRAMES = 10 };

const char *rg_cell_status_name(enum rg_cell_status status)
{
    static const char *const names[] = {"ok", "fail", "error"};
    return names[status];
}

static bool end_cell(struct rg_cell *cell, enum rg_cell_status status, const char *detail)
{
    cell->status = status;
    snprintf(cell->detail, sizeof(cell->detail), "%s", detail);
    return false;
}

static bool run_frames(struct rg_cell *cell, int frames)
{
    bool ok = true;
    for (int i = 0; ok && i < frames; i++)
        ok = cell->technique->step(cell->instance) && cell->technique->draw(cell->instance);
    return ok && rg_device_sync(cell->device);
}

// --- preparing: open, check, warm up ---

static bool open_cell(struct rg_cell *cell)
{
    const double start = rg_now_ms();
    cell->instance =
        cell->technique->create(cell->device, cell->settings, cell->width, cell->height);
    if (!cell->instance || !rg_device_sync(cell->device))
        return end_cell(cell, RG_CELL_ERROR, rg_last_error());
    const double opened = rg_now_ms();
    if (!run_frames(cell, 1))
        return end_cell(cell, RG_CELL_ERROR, rg_last_error());
    cell->create_ms = opened - start;
    cell->first_frame_ms = rg_now_ms() - opened;
    return true;
}

// Whether an image holds tier T1, which other drivers than the software ones are held to.
static bool holds_t1(struct rg_cell *cell, const struct rg_expected *expected, const void *texels)
{
    struct rg_picture picture = {0};
    struct rg_comparison comparison = {0};
    const struct rg_picture *dry = expected->dry.texels ? &expected->dry : NULL;
    bool ok = rg_frame_picture(cell->instance, texels, &picture) &&
              rg_compare(&expected->picture, "cpu:reference", &picture, cell->device->info.name,
                         dry, &(struct rg_compare_options){0}, &comparison);
    bool holds = ok && comparison.tiers.t1.holds;
    if (!holds)
        end_cell(cell, ok ? RG_CELL_FAIL : RG_CELL_ERROR,
                 ok ? comparison.tiers.t1.why : rg_last_error());
    rg_comparison_destroy(&comparison);
    rg_picture_destroy(&picture);
    return holds;
}

static bool agrees(struct rg_cell *cell, const struct rg_expected *expected, const void *texels)
{
    if (!memcmp(expected->texels, texels, expected->size))
        return true;
    if (!cell->device->info.software)
        return holds_t1(cell, expected, texels);
    return end_cell(cell, RG_CELL_FAIL,
                    "its image differs from cpu:reference's (T0); `raingauge diff` shows where");
}

static bool check_image(struct rg_cell *cell, const struct rg_expected *expected)
{
    if (!run_frames(cell, RG_CHECK_FRAMES - 1))
        return end_cell(cell, RG_CELL_ERROR, rg_last_error());
    cell->counter_count = cell->instance->counter_count;
    memcpy(cell->counters, cell->instance->counters, sizeof(cell->counters));
    cell->fact_count = cell->instance->fact_count;
    memcpy(cell->facts, cell->instance->facts, sizeof(cell->facts));
    size_t size;
    void *texels = rg_frame_read(cell->instance, &size);
    bool ok = texels && size == expected->size ? agrees(cell, expected, texels)
                                               : end_cell(cell, RG_CELL_ERROR, rg_last_error());
    free(texels);
    return ok;
}

static double time_frames(struct rg_cell *cell, int frames)
{
    const double start = rg_now_ms();
    if (!run_frames(cell, frames))
        end_cell(cell, RG_CELL_ERROR, rg_last_error());
    return (rg_now_ms() - start) / frames;
}

// Until two frames in a row take the same time to 10 %: drivers go on compiling for a while.
static void warm_up(struct rg_cell *cell)
{
    double before = time_frames(cell, 1);
    for (int i = 1; i < MAX_WARM_UP_SAMPLES && cell->status == RG_CELL_OK; i++) {
        const double now = time_frames(cell, 1);
        if (i >= MIN_WARM_UP_SAMPLES && fabs(now - before) <= 0.1 * before)
            break;
        before = now;
    }
}

void rg_cell_prepare(struct rg_cell *cell, const struct rg_expected *expected)
{
    cell->status = RG_CELL_OK;
    if (open_cell(cell) && check_image(cell, expected))
        warm_up(cell);
}

// --- measuring ---

// Frames a sample, so that it lasts long enough to be timed well.
static void calibrate(struct rg_cell *cell, const struct rg_measure_options *options)
{
    const double ms = fmin(time_frames(cell, 2), time_frames(cell, 2));
    cell->frames_a_sample = (int)fmin(fmax(ceil(options->sample_ms / ms), 1), 100000);
    cell->samples_ms = rg_alloc((size_t)options->samples, sizeof(double), "samples");
    if (!cell->samples_ms)
        end_cell(cell, RG_CELL_ERROR, rg_last_error());
}

// Shuffled by the project's own generator, so that a run's order can be had again.
static void shuffle(int *order, int count, int round)
{
    for (int i = count - 1; i > 0; i--) {
        const uint bits = rg_random(1, (uint)i, (uint)round, 0).x;
        const int j = (int)(bits % (uint)(i + 1));
        const int kept = order[i];
        order[i] = order[j];
        order[j] = kept;
    }
}

static void take_sample(struct rg_cell *cell)
{
    time_frames(cell, 1); // what the cell before left in the caches is not this one's business
    cell->samples_ms[cell->sample_count++] = time_frames(cell, cell->frames_a_sample);
}

// False when the frames failed; a device without a timer is none of that.
static bool audit_timer(struct rg_cell *cell)
{
    int64_t begin, end;
    if (!rg_device_time(cell->device, &begin))
        return true;
    const double start = rg_now_ms();
    if (!run_frames(cell, cell->frames_a_sample))
        return false;
    const double wall_ms = rg_now_ms() - start;
    if (rg_device_time(cell->device, &end))
        cell->api_over_wall = (double)(end - begin) * 1e-6 / wall_ms;
    return true;
}

struct pass_clock {
    struct rg_cell *cell;
    double last_ms;
    bool ok;
};

// Where the time of a pass is kept.
static struct rg_cell_pass *pass_of(struct rg_cell *cell, const char *name)
{
    for (int i = 0; i < cell->pass_count; i++)
        if (!strcmp(cell->passes[i].name, name))
            return &cell->passes[i];
    if (cell->pass_count == RG_MAX_CELL_PASSES)
        return &cell->passes[RG_MAX_CELL_PASSES - 1];
    if (cell->pass_count == RG_MAX_CELL_PASSES - 1)
        name = "other";
    cell->passes[cell->pass_count] = (struct rg_cell_pass){name, 0};
    return &cell->passes[cell->pass_count++];
}

static void after_pass(const char *name, void *user)
{
    struct pass_clock *clock = user;
    clock->ok = rg_device_sync(clock->cell->device) && clock->ok;
    const double now = rg_now_ms();
    pass_of(clock->cell, name)->ms += (now - clock->last_ms) / PASS_FRAMES;
    clock->last_ms = now;
}

static bool measure_passes(struct rg_cell *cell)
{
    struct pass_clock clock = {cell, rg_now_ms(), true};
    cell->instance->after_pass = after_pass;
    cell->instance->user = &clock;
    const bool ok = run_frames(cell, PASS_FRAMES);
    cell->instance->after_pass = NULL;
    return ok && clock.ok;
}

static void finish(struct rg_cell *cell)
{
    double *sorted = rg_alloc((size_t)cell->sample_count, sizeof(double), "samples");
    if (!sorted) {
        end_cell(cell, RG_CELL_ERROR, rg_last_error());
        return;
    }
    memcpy(sorted, cell->samples_ms, (size_t)cell->sample_count * sizeof(double));
    cell->frame_ms = rg_median(sorted, cell->sample_count);
    free(sorted);
    if (!audit_timer(cell) || !measure_passes(cell))
        end_cell(cell, RG_CELL_ERROR, rg_last_error());
}

void rg_cells_measure(struct rg_cell *cells, int count, const struct rg_measure_options *options)
{
    int *order = rg_alloc((size_t)count, sizeof(int), "cells"), ready = 0;
    for (int i = 0; i < count; i++) {
        if (cells[i].status == RG_CELL_OK && !order)
            end_cell(&cells[i], RG_CELL_ERROR, rg_last_error());
        if (cells[i].status != RG_CELL_OK)
            continue;
        calibrate(&cells[i], options);
        order[ready++] = i;
    }
    for (int round = 0; round < options->samples; round++) {
        shuffle(order, ready, round);
        for (int i = 0; i < ready; i++)
            if (cells[order[i]].status == RG_CELL_OK)
                take_sample(&cells[order[i]]);
        if (options->progress)
            options->progress(round + 1, options->samples, options->user);
    }
    for (int i = 0; i < ready; i++)
        if (cells[order[i]].status == RG_CELL_OK)
            finish(&cells[order[i]]);
    free(order);
}

double rg_cell_passes_ms(const struct rg_cell *cell)
{
    double sum = 0;
    for (int i = 0; i < cell->pass_count; i++)
        sum += cell->passes[i].ms;
    return sum;
}

void rg_cell_close(struct rg_cell *cell)
{
    if (cell->instance)
        cell->technique->destroy(cell->instance);
    free(cell->samples_ms);
    cell->instance = NULL;
    cell->samples_ms = NULL;
}
