// The files that `atlas` writes of cartoon's textures: the texels of the device's images, bit by
// bit, and how they look.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <dirent.h>
#include <math.h>
#include <unistd.h>

#include "core/image/files/io.h"
#include "harness/atlas/textures.h"
#include "tests/tools/expect.h"
#include "tests/tools/instance.h"

static char folder[] = "/tmp/raingauge-textures-XXXXXX";
static struct rg_texture_rows rows;
static struct rg_device *device;

static struct rg_instance *open_cartoon(const char *assignments)
{
    return instance_of(device, "cartoon", "", assignments, 16, 16);
}

// The texels of an image; the caller frees them.
static uint32_t *sampled(struct rg_instance *instance, const char *image, int layer, int level)
{
    const struct rg_asset *asset = rg_asset_find(instance, image);
    assert_non_null(asset);
    const size_t side = (size_t)asset->image->desc.width >> level;
    uint32_t *words = malloc(side * side * sizeof(*words));
    assert_true(words && rg_image_read(asset->image, layer, level, words));
    return words;
}

static struct rg_picture picture_of(const char *name, const char *ending)
{
    char path[128];
    struct rg_picture p;
    snprintf(path, sizeof(path), "%s/%s%s", folder, name, ending);
    assert_true(rg_picture_read(path, &p));
    return p;
}

static int byte_of(uint32_t word, int channel)
{
    return (int)(word >> 8 * channel & 255);
}

static double display(double linear)
{
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1 / 2.4) - 0.055;
}

// An EXR keeps halves, which hold 256 steps as 256 values.
static void expect_texels(const char *name, int level, const uint32_t *words)
{
    char ending[32];
    snprintf(ending, sizeof(ending), "-level-%d.exr", level);
    struct rg_picture p = picture_of(name, ending);
    assert_int_equal(p.channels, 4);
    for (int64_t i = 0; i < rg_picture_values(&p); i++)
        assert_int_equal(lround((double)p.texels[i] * 255), byte_of(words[i / 4], (int)(i % 4)));
    rg_picture_destroy(&p);
}

static void expect_looks(const char *name, const uint32_t *words)
{
    struct rg_picture p = picture_of(name, ".png");
    assert_int_equal(p.channels, 4);
    for (int64_t i = 0; i < rg_picture_values(&p); i++) {
        const double alpha = byte_of(words[i / 4], 3) / 255.0;
        const double part = byte_of(words[i / 4], (int)(i % 4)) / 255.0;
        const double due = i % 4 == 3 ? alpha : alpha > 0 ? display(fmin(part / alpha, 1)) : 0;
        const double found = i % 4 == 3 ? (double)p.texels[i] : display((double)p.texels[i]);
        assert_below(fabs(found - due) * 255, 0.51);
    }
    rg_picture_destroy(&p);
}

// Layers are in the order of the list.
static void files_have_what_the_rain_samples(void **state)
{
    (void)state;
    struct rg_instance *cartoon = open_cartoon("drops_s=0");
    for (int layer = 0; layer < 21; layer++) {
        for (int level = 0; level < rows.items[layer].levels; level++) {
            uint32_t *words = sampled(cartoon, "rain_textures", layer, level);
            expect_texels(rows.items[layer].name, level, words);
            if (!level)
                expect_looks(rows.items[layer].name, words);
            free(words);
        }
    }
    rg_instance_close(cartoon);
}

// Six tones lie in the channels of two layers, which share the fourth.
static void files_have_what_hatching_samples(void **state)
{
    (void)state;
    struct rg_instance *cartoon = open_cartoon("style=hatching drops_s=0");
    for (int tone = 0; tone < 6; tone++)
        for (int level = 0; level < 4; level++) {
            char ending[32];
            uint32_t *words = sampled(cartoon, "strokes", tone > 3, level);
            snprintf(ending, sizeof(ending), "-level-%d.exr", level);
            struct rg_picture p = picture_of(rows.items[21 + tone].name, ending);
            assert_int_equal(p.channels, 1);
            for (int64_t i = 0; i < rg_picture_values(&p); i++)
                assert_int_equal(lround((double)p.texels[i] * 255),
                                 byte_of(words[i], tone > 3 ? tone - 3 : tone));
            rg_picture_destroy(&p);
            free(words);
        }
    rg_instance_close(cartoon);
}

// No two textures are alike, and each is on the sheet: cells of 256 px, 12 px apart.
static void the_sheet_shows_each_texture(void **state)
{
    (void)state;
    struct rg_picture sheet = picture_of("sheet", ".png");
    double sums[27] = {0};
    assert_int_equal(sheet.width, 6 * 268 + 12);
    assert_int_equal(sheet.height, 5 * 268 + 12);
    for (int i = 0; i < 27; i++) {
        const int row = i < 3 ? 0 : 1 + (i - 3) / 6, column = i < 3 ? i : (i - 3) % 6;
        const float *ground = sheet.texels;
        for (int k = 0; k < 256 * 256; k++) {
            const int x = column * 268 + 12 + k % 256, y = row * 268 + 12 + k / 256;
            const float *texel = sheet.texels + (int64_t)sheet.channels * (y * sheet.width + x);
            sums[i] += fabs((double)(texel[0] - ground[0])) * (1 + k % 256);
        }
        assert_above(sums[i], 0);
        for (int other = 0; other < i; other++)
            assert_differs(sums[i], sums[other]);
    }
    rg_picture_destroy(&sheet);
}

static int make_files(void **state)
{
    (void)state;
    device = rg_device_open("cpu");
    return !device || !mkdtemp(folder) ||
           !rg_textures_make(rg_technique_find("cartoon"), folder, &rows);
}

static int remove_files(void **state)
{
    (void)state;
    DIR *opened = opendir(folder);
    for (struct dirent *entry; opened && (entry = readdir(opened));) {
        char path[512];
        snprintf(path, sizeof(path), "%s/%s", folder, entry->d_name);
        unlink(path);
    }
    return !opened || closedir(opened) || rmdir(folder) || !rg_device_close(device);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(files_have_what_the_rain_samples),
        cmocka_unit_test(files_have_what_hatching_samples),
        cmocka_unit_test(the_sheet_shows_each_texture),
    };
    return cmocka_run_group_tests(tests, make_files, remove_files);
}
