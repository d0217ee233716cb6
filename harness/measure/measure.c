#include "harness/measure/measure.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "core/image/compare/compare.h"
#include "harness/console/clock.h"
#include "harness/console/interrupt.h"
#include "harness/frames/frame.h"
#include "kernels/dialect/rng.h"

enum {
    MAX_WARM_UP_FRAMES = 20,
    MIN_WARM_UP_FRAMES = 4,
    MOST_PASS_FRAMES = 10,
    LEAST_PASS_FRAMES = 2
};

// The run in which passes are told apart ends with the frame in which it has taken so long.
#define PASSES_MS 400
// A frame that takes longer feels nothing of what the cell before left in the caches.
#define LONG_FRAME_MS 100

bool rg_cell_end(struct rg_cell *cell, enum rg_outcome status, const char *detail)
{
    cell->status = status;
    snprintf(cell->detail, sizeof(cell->detail), "%s", detail);
    return false;
}

bool rg_cell_end_by_error(struct rg_cell *cell)
{
    return rg_cell_end(cell, rg_outcome_of_error(), rg_last_error());
}

static bool run_frames(struct rg_cell *cell, int frames)
{
    bool ok = true;
    for (int i = 0; ok && i < frames && !rg_interrupted(); i++)
        ok = cell->technique->step(cell->instance) && cell->technique->draw(cell->instance);
    return ok && rg_device_sync(cell->device);
}

static double time_frames(struct rg_cell *cell, int frames)
{
    const double start = rg_now_ms();
    if (!run_frames(cell, frames))
        rg_cell_end_by_error(cell);
    return (rg_now_ms() - start) / frames;
}

// --- preparing: open, check, warm up ---

static bool open_instance(struct rg_cell *cell)
{
    const double start = rg_now_ms();
    cell->instance =
        rg_instance_open(cell->technique, cell->device, cell->settings, cell->width, cell->height);
    if (!cell->instance || !rg_device_sync(cell->device))
        return rg_cell_end_by_error(cell);
    const double opened = rg_now_ms();
    if (!run_frames(cell, 1))
        return rg_cell_end_by_error(cell);
    cell->create_ms = opened - start;
    cell->first_frame_ms = rg_now_ms() - opened;
    return true;
}

bool rg_cell_open(struct rg_cell *cell)
{
    cell->status = RG_OK;
    if (!open_instance(cell))
        return false;
    cell->warm_frame_ms = cell->first_frame_ms;
    if (cell->check_frames > 1)
        cell->warm_frame_ms = time_frames(cell, cell->check_frames - 1);
    cell->counter_count = cell->instance->counter_count;
    memcpy(cell->counters, cell->instance->counters, sizeof(cell->counters));
    cell->fact_count = cell->instance->fact_count;
    memcpy(cell->facts, cell->instance->facts, sizeof(cell->facts));
    return cell->status == RG_OK;
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
    bool holds = ok && comparison.tiers.of[RG_T1].holds;
    if (!holds)
        rg_cell_end(cell, ok ? RG_FAIL : RG_ERROR,
                    ok ? comparison.tiers.of[RG_T1].why : rg_last_error());
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
    return rg_cell_end(cell, RG_FAIL,
                       "its image differs from cpu:reference's (T0); `raingauge diff` shows where");
}

bool rg_cell_check(struct rg_cell *cell, const struct rg_expected *expected)
{
    size_t size;
    void *texels = rg_frame_read(cell->instance, &size);
    const bool ok = texels && size == expected->size ? agrees(cell, expected, texels)
                                                     : rg_cell_end_by_error(cell);
    free(texels);
    return ok;
}

// Until two frames in a row take the same time to 10 %: drivers go on compiling for a while. The
// check frames have begun it.
bool rg_cell_warm_up(struct rg_cell *cell, const struct rg_measure_options *options)
{
    const double start = rg_now_ms();
    for (int i = 1; i <= MAX_WARM_UP_FRAMES && cell->status == RG_OK; i++) {
        const double before = cell->warm_frame_ms, now = time_frames(cell, 1);
        cell->warm_frame_ms = now;
        const bool settled = i >= MIN_WARM_UP_FRAMES && fabs(now - before) <= 0.1 * before;
        if (settled || rg_now_ms() - start > options->warm_up_ms)
            break;
    }
    return cell->status == RG_OK;
}

// --- measuring ---

// Whether a sample is preceded by a frame that is not timed: what the cell before left in the
// caches is not this one's business.
static bool needs_run_up(double frame_ms)
{
    return frame_ms < LONG_FRAME_MS;
}

// Frames a sample, so that it lasts long enough to be timed well, and the number of samples.
static void calibrate(struct rg_cell *cell, const struct rg_measure_options *options)
{
    double ms = cell->warm_frame_ms;
    if (ms < options->sample_ms)
        ms = fmin(time_frames(cell, 2), time_frames(cell, 2));
    cell->frames_a_sample = (int)fmin(fmax(ceil(options->sample_ms / ms), 1), 100000);
    const double sample_ms = ms * (cell->frames_a_sample + (needs_run_up(ms) ? 1 : 0));
    cell->wanted_samples = (int)fmin(
        fmax(floor(options->cell_ms / sample_ms), options->least_samples), options->most_samples);
    cell->samples_ms = rg_alloc((size_t)cell->wanted_samples, sizeof(double), "samples");
    if (!cell->samples_ms)
        rg_cell_end_by_error(cell);
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

// The last sample of a cell is timed by the API's own clock, too. A device may have none.
static void take_sample(struct rg_cell *cell)
{
    const bool is_last = cell->sample_count + 1 == cell->wanted_samples;
    int64_t begin, end;
    if (needs_run_up(cell->warm_frame_ms))
        time_frames(cell, 1);
    const bool has_begun = is_last && rg_device_time(cell->device, &begin);
    const double ms = time_frames(cell, cell->frames_a_sample);
    if (has_begun && rg_device_time(cell->device, &end))
        cell->api_over_wall = (double)(end - begin) * 1e-6 / (ms * cell->frames_a_sample);
    cell->samples_ms[cell->sample_count++] = ms;
}

// Whether a cell takes a sample in this round: its own are spread evenly over all rounds.
static bool takes_turn(const struct rg_cell *cell, int round, int rounds)
{
    const int before = (int)((int64_t)round * cell->wanted_samples / rounds);
    const int after = (int)(((int64_t)round + 1) * cell->wanted_samples / rounds);
    return cell->status == RG_OK && after > before;
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

static void after_stage(const struct rg_opened_stage *stage, void *user)
{
    struct pass_clock *clock = user;
    clock->ok = rg_device_sync(clock->cell->device) && clock->ok;
    const double now = rg_now_ms();
    pass_of(clock->cell, stage->row.kernel)->ms += now - clock->last_ms;
    clock->last_ms = now;
}

static bool measure_passes(struct rg_cell *cell)
{
    const double start = rg_now_ms();
    struct pass_clock clock = {cell, start, true};
    cell->instance->after_stage = after_stage;
    cell->instance->user = &clock;
    bool ok = true;
    while (ok && cell->pass_frames < MOST_PASS_FRAMES &&
           (cell->pass_frames < LEAST_PASS_FRAMES || rg_now_ms() - start < PASSES_MS)) {
        ok = run_frames(cell, 1);
        cell->pass_frames++;
    }
    cell->instance->after_stage = NULL;
    for (int i = 0; i < cell->pass_count; i++)
        cell->passes[i].ms /= cell->pass_frames;
    return ok && clock.ok;
}

bool rg_cell_summarise(struct rg_cell *cell)
{
    double *sorted = rg_alloc((size_t)cell->sample_count, sizeof(double), "samples");
    if (!sorted)
        return rg_cell_end_by_error(cell);
    memcpy(sorted, cell->samples_ms, (size_t)cell->sample_count * sizeof(double));
    cell->frame_ms = rg_median(sorted, cell->sample_count);
    free(sorted);
    return true;
}

static void finish(struct rg_cell *cell)
{
    if (rg_cell_summarise(cell) && !measure_passes(cell))
        rg_cell_end_by_error(cell);
}

// Calibrates the cells that can be measured, whose indices go into `order`. Returns their number.
static int calibrate_all(struct rg_cell *cells, int count, const struct rg_measure_options *options,
                         int *order)
{
    int ready = 0;
    for (int i = 0; i < count; i++) {
        if (cells[i].status != RG_OK)
            continue;
        calibrate(&cells[i], options);
        order[ready++] = i;
    }
    return ready;
}

void rg_cells_measure(struct rg_cell *cells, int count, const struct rg_measure_options *options)
{
    int *order = rg_alloc((size_t)count, sizeof(int), "cells"), rounds = 0;
    for (int i = 0; !order && i < count; i++)
        if (cells[i].status == RG_OK)
            rg_cell_end_by_error(&cells[i]);
    const int ready = order ? calibrate_all(cells, count, options, order) : 0;
    for (int i = 0; i < ready; i++)
        if (cells[order[i]].wanted_samples > rounds)
            rounds = cells[order[i]].wanted_samples;
    for (int round = 0; round < rounds && !rg_interrupted(); round++) {
        shuffle(order, ready, round);
        for (int i = 0; i < ready && !rg_interrupted(); i++)
            if (takes_turn(&cells[order[i]], round, rounds))
                take_sample(&cells[order[i]]);
        if (options->progress)
            options->progress(round + 1, rounds, options->user);
    }
    for (int i = 0; i < ready && !rg_interrupted(); i++)
        if (cells[order[i]].status == RG_OK)
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
        rg_instance_close(cell->instance);
    cell->instance = NULL;
}

void rg_cell_free(struct rg_cell *cell)
{
    rg_cell_close(cell);
    free(cell->samples_ms);
    cell->samples_ms = NULL;
}
