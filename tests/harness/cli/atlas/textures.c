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
#include <math.h>

#include "core/base/log.h"
#include "core/image/files/io.h"
#include "harness/commands/drawing/atlas/textures.h"
#include "tests/tools/expect.h"
#include "tests/tools/instance.h"
#include "tests/tools/process/folder.h"
#include "tests/tools/process/logged.h"

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
static int channel_of(int tone)
{
    return tone > 3 ? tone - 3 : tone;
}

// A picture of grey shows its codes as they are.
static void expect_grey(const char *name, const uint32_t *words, int channel)
{
    struct rg_picture p = picture_of(name, ".png");
    assert_int_equal(p.channels, 1);
    for (int64_t i = 0; i < rg_picture_values(&p); i++)
        assert_int_equal(lround(255 * display((double)p.texels[i])), byte_of(words[i], channel));
    rg_picture_destroy(&p);
}

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
                                 byte_of(words[i], channel_of(tone)));
            if (!level)
                expect_grey(rows.items[21 + tone].name, words, channel_of(tone));
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

// A texture's cell of the sheet: paint over the colour of a wet wall, or grey; each texel as often
// as 256 pixels have it.
static void expect_cell(const struct rg_picture *sheet, int number, const uint32_t *words,
                        int channel)
{
    static const double ground[] = {0.13, 0.17, 0.22};
    const bool is_paint = channel < 0;
    const int side = rows.items[number].side_px;
    const int row = number < 3 ? 0 : 1 + (number - 3) / 6,
              column = (number < 3 ? number : (number - 3) % 6);
    for (int i = 0; i < 256 * 256; i++) {
        const int x = i % 256, y = i / 256;
        const uint32_t word = words[y * side / 256 * side + x * side / 256];
        const int at = (row * 268 + 12 + y) * sheet->width + column * 268 + 12 + x;
        for (int c = 0; c < 3; c++) {
            const double paint =
                byte_of(word, c) / 255.0 + ground[c] * (1 - byte_of(word, 3) / 255.0);
            const double due = is_paint ? 255 * display(paint) : byte_of(word, channel);
            assert_below(fabs(255 * display((double)sheet->texels[sheet->channels * at + c]) - due),
                         0.51);
        }
    }
}

static void the_sheet_shows_textures_as_they_are(void **state)
{
    (void)state;
    struct rg_picture sheet = picture_of("sheet", ".png");
    struct rg_instance *cartoon = open_cartoon("style=hatching drops_s=0");
    for (int number = 0; number < 27; number++) {
        const int tone = number - 21;
        uint32_t *words = number < 21 ? sampled(cartoon, "rain_textures", number, 0)
                                      : sampled(cartoon, "strokes", tone > 3, 0);
        expect_cell(&sheet, number, words, number < 21 ? -1 : channel_of(tone));
        free(words);
    }
    rg_instance_close(cartoon);
    rg_picture_destroy(&sheet);
}

// --- other techniques ---

// As many textures of one texel as `made` says, the last of which is at this place.
static struct {
    int count, row, column, side_px;
} made;

static bool make_dots(rg_take_texture *take, void *user)
{
    static const uint32_t words[512 * 512];
    for (int i = 0; i < made.count; i++) {
        struct rg_made_texture t = {.name = "dot", .side_px = 1, .words = words};
        if (i == made.count - 1)
            t.row = made.row, t.column = made.column, t.side_px = made.side_px;
        if (!take(user, &t))
            return false;
    }
    return true;
}

// Lists hold 64 textures, and sheets have 8 rows of 6 cells of 256 pixels.
static void what_does_not_fit_is_refused(void **state)
{
    (void)state;
    static const struct rg_technique dots = {.name = "dots", .make_textures = make_dots},
                                     none = {.name = "none"};
    static const char beyond[] = "dot: its place is beyond the sheet of 6 x 8 cells of 256 px";
    static const struct {
        int count, row, column, side_px;
        bool is_written;
        const char *says; // NULL: it fits
    } cases[] = {
        {RG_MAX_TEXTURE_ROWS, 0, 0, 1, false, NULL},
        {RG_MAX_TEXTURE_ROWS + 1, 0, 0, 1, false, "dot: one texture too many; 64 is the most"},
        {1, 7, 5, 256, true, NULL},
        {1, 8, 0, 1, true, beyond},
        {1, 0, 6, 1, true, beyond},
        {1, 0, 0, 257, true, beyond}};
    struct rg_texture_rows of;
    rg_log_listen(log_last, NULL);
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        made.count = cases[i].count, made.row = cases[i].row;
        made.column = cases[i].column, made.side_px = cases[i].side_px;
        *logged = 0;
        assert_int_equal(
            rg_textures_make(&dots, cases[i].is_written ? in_folder("dots") : NULL, &of),
            !cases[i].says);
        assert_string_equal(logged, cases[i].says ? cases[i].says : "");
        assert_true(cases[i].says || of.count == cases[i].count);
    }
    assert_false(rg_textures_make(&none, NULL, &of));
    assert_string_equal(logged,
                        "technique 'none': it generates no textures; `raingauge atlas --help`");
    rg_log_listen(NULL, NULL);
}

static int make_files(void **state)
{
    device = rg_device_open("cpu");
    return !device || make_folder(state) || mkdir(in_folder("dots"), 0700) ||
           !rg_textures_make(rg_technique_find("cartoon"), folder, &rows);
}

static int remove_files(void **state)
{
    return remove_whole_folder(state) || !rg_device_close(device);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(files_have_what_the_rain_samples),
        cmocka_unit_test(files_have_what_hatching_samples),
        cmocka_unit_test(the_sheet_shows_each_texture),
        cmocka_unit_test(the_sheet_shows_textures_as_they_are),
        cmocka_unit_test(what_does_not_fit_is_refused),
    };
    return cmocka_run_group_tests(tests, make_files, remove_files);
}
