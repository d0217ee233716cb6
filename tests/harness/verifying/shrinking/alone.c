// A kernel of a native device alone: run.c of its folder reads images as the device's own samplers
// do, or draws the texels that items store, and finds that the driver leaves the same bits.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/compare/shrink/folder.h"
#include "tests/kernels/texels/filter/params.h"
#include "tests/kernels/texels/params.h"
#include "tests/tools/process/folder.h"

enum { SIDE = 16, LEVELS = 3, TEXELS = 16 * 16 + 8 * 8 + 4 * 4, READS = 256 };

static uint32_t noise(uint32_t i)
{
    i = (i ^ i >> 16) * 0x7feb352du;
    i = (i ^ i >> 15) * 0x846ca68bu;
    return i ^ i >> 16;
}

// How a kernel reads its image, and the elements that say where: up to this many of each.
static const struct row {
    const char *kernel, *manifest; // a part of the image's line in kernel.txt
    enum rg_format format;
    int layers, levels;
    float most[4];
    int params[3];
} rows[] = {
    {"test_filter_rgba8",
     "levels 3 view 5 filter 1 wrap 2 compare 0 ",
     RG_RGBA8,
     2,
     LEVELS,
     {1.5f, 1.5f, 1, 2},
     {TEST_FILTER_TRILINEAR, 0, 0}},
    {"test_tiled",
     "levels 3 view 5 filter 1 wrap 0 compare 0 ",
     RG_RGBA8,
     2,
     LEVELS,
     {3, 3, 1, 20},
     {SIDE, SIDE, LEVELS - 1}},
    {"test_cube",
     "levels 3 view 3 filter 1 wrap 2 compare 0 ",
     RG_RG11B10F,
     6,
     LEVELS,
     {1, 1, 1, 2},
     {SIDE, SIDE, LEVELS - 1}},
    {"test_compare", "levels 1 view 5 filter ", RG_D32F, 2, 1, {SIDE, SIDE, 1, 1}, {SIDE, SIDE, 0}},
};

static void fill(const struct row *row, struct rg_dispatched *d)
{
    const size_t texels = (size_t)row->layers * (row->levels > 1 ? TEXELS : SIDE * SIDE);
    uint32_t *words = calloc(texels, 4);
    float(*at)[4] = calloc(READS, sizeof(*at));
    void *left = calloc(READS, sizeof(*at));
    assert_true(words && at && left);
    for (uint32_t i = 0; i < texels; i++) {
        const float depth = (float)(noise(i) >> 24) / 256;
        words[i] = row->format == RG_RG11B10F ? 0x73814380u | (noise(i) & 0x07c1f83fu) : noise(i);
        if (row->format == RG_D32F)
            memcpy(&words[i], &depth, sizeof(depth));
    }
    for (uint32_t i = 0; i < READS * 4; i++) {
        const float part = (float)(noise(i + 0x10000) >> 8) * 0x1p-24f;
        const bool counts = i % 4 == 2 ? row->layers < 6 : i % 4 == 3 && row->layers == 6;
        at[i / 4][i % 4] = counts ? floorf(part * (row->most[i % 4] + 1)) : part * row->most[i % 4];
    }
    *d = (struct rg_dispatched){
        .kernel = rg_kernel_find(row->kernel), .was_kept = true, .extent = {READS, 1, 1}};
    assert_non_null(d->kernel);
    memcpy(d->params, row->params, (size_t)d->kernel->params_size);
    d->before[1] = (struct rg_contents){
        {row->format, SIDE, SIDE, row->layers, row->levels}, texels * 4, words};
    d->before[2] = (struct rg_contents){{0}, READS * sizeof(*at), at};
    d->before[3] = (struct rg_contents){{0}, READS * sizeof(*at), left};
}

static void expect_manifest(const char *path, const char *part)
{
    char text[4096] = "";
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    assert_true(fread(text, 1, sizeof(text) - 1, file) > 0);
    fclose(file);
    if (!strstr(text, part))
        fail_msg("no '%s' in\n%s", part, text);
}

// Writes the folder of a run with the device's own results, and builds and runs its program.
static void run_alone(struct rg_device *device, struct rg_dispatched *run, const char *libraries,
                      const char *manifest)
{
    char path[64], name[96], command[256];
    struct rg_culprit culprit = {.found = true, .items = READS, .of_items = READS};
    snprintf(path, sizeof(path), "%s/case", folder);
    snprintf(name, sizeof(name), "%s.kernel/kernel.txt", path);
    snprintf(command, sizeof(command),
             "cd %s.kernel && cc run.c %s -o ../run && ../run >&2 && rm ../run", path, libraries);
    assert_true(rg_dispatched_run(run, device));
    culprit.due = *run;
    assert_true(rg_kernel_folder_write(path, &culprit, "a note", device, device));
    expect_manifest(name, manifest);
    const int status = system(command);
    rg_kernel_folder_remove(path);
    if (status != 0)
        fail_msg("%s: status 0x%x", run->kernel->name, (unsigned)status);
    rg_culprit_free(&culprit);
}

static void kernels_that_sample_run_alone(void **state)
{
    struct rg_device *device = rg_device_open("vulkan:native");
    (void)state;
    if (!device && rg_failure_take().outcome == RG_UNSUPPORTED)
        skip();
    assert_non_null(device);
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++) {
        struct rg_dispatched run;
        fill(&rows[i], &run);
        run_alone(device, &run, "-lvulkan", rows[i].manifest);
    }
    assert_true(rg_device_close(device));
}

// Colours for the second layer of an image of halves, but for its left and its upper edge.
static void fill_texels(struct rg_dispatched *d)
{
    const int params[] = {SIDE, SIDE, 0};
    float *colours = calloc(2 * SIDE * SIDE * 4, sizeof(*colours));
    void *texels = calloc(2 * SIDE * SIDE, 8);
    assert_true(colours && texels);
    for (uint32_t i = 0; i < 2 * SIDE * SIDE * 4; i++)
        colours[i] = (float)(noise(i) >> 8) * 0x1p-24f;
    *d = (struct rg_dispatched){.kernel = rg_kernel_find("test_store_rgba16f"),
                                .was_kept = true,
                                .origin = {2, 1, 1},
                                .extent = {SIDE - 2, SIDE - 1, 1}};
    assert_non_null(d->kernel);
    memcpy(d->params, params, sizeof(params));
    d->before[1] = (struct rg_contents){{0}, 2 * SIDE * SIDE * 4 * sizeof(*colours), colours};
    d->before[2] =
        (struct rg_contents){{RG_RGBA16F, SIDE, SIDE, 2, 1}, (size_t)2 * SIDE * SIDE * 8, texels};
}

static void texels_are_drawn_alone(void **state)
{
    static const char *const apis[][2] = {{"gl:native", "-lEGL -lGL"},
                                          {"vulkan:native", "-lvulkan"}};
    int drawn = 0;
    (void)state;
    for (int i = 0; i < 2; i++) {
        struct rg_device *device = rg_device_open(apis[i][0]);
        struct rg_dispatched run;
        if (!device && rg_failure_take().outcome == RG_UNSUPPORTED)
            continue;
        assert_non_null(device);
        fill_texels(&run);
        run_alone(device, &run, apis[i][1],
                  "scissor 2 1 14 15 target 16 x 16 layer 1 level 0 points 0\n");
        assert_true(rg_device_close(device));
        drawn++;
    }
    if (!drawn)
        skip();
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(kernels_that_sample_run_alone),
                                       cmocka_unit_test(texels_are_drawn_alone)};
    return cmocka_run_group_tests_name("alone", tests, make_folder, remove_folder);
}
