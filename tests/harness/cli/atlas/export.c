// The files that `atlas -o` writes hold the atlas: texels, factors, and sheets of them for people.
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
#include "core/image/files/io.h"
#include "core/scene/atlas/levels.h"
#include "harness/commands/drawing/atlas/export.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/folder.h"

// The layer that is looked at; the others are black.
enum { LAYER = 3, WIDE = 720, HIGH = 901, ENV_WIDE = 8, GAP = 12 };

static struct rg_atlas *atlas;

static float factor_of(int view, int cell)
{
    return 0.001f * (float)(1 + (17 * view + 7 * cell) % 50);
}

static void fill(enum rg_atlas_part part, int layer)
{
    const struct rg_atlas_image *image = &atlas->images[part];
    const size_t texels = rg_atlas_image_texels(image) / (size_t)image->layers;
    uint16_t *to = image->texels + (size_t)layer * texels;
    for (size_t i = 0; i < texels; i++) // a half holds all of these
        to[i] = rg_half_of((float)((i * 5 + i / 101) % 64) / 64);
}

static int make_atlas(void **state)
{
    atlas = rg_atlas_allocate(RG_ATLAS_SMALL);
    if (!atlas || make_folder(state))
        return -1;
    fill(RG_ATLAS_POINT, LAYER);
    fill(RG_ATLAS_ENV, LAYER);
    fill(RG_ATLAS_SPLASH, 44);
    for (int view = 0; view < RG_ATLAS_VIEWS; view++) {
        atlas->env_factor[LAYER][view] = 0.5f / (float)(1 + view);
        for (int cell = 0; cell < RG_ATLAS_CELLS; cell++)
            (&atlas->point_factor[LAYER][view][0][0])[cell] = factor_of(view, cell);
    }
    return !rg_atlas_export(atlas, folder);
}

static int remove_atlas(void **state)
{
    rg_atlas_destroy(atlas);
    return remove_whole_folder(state);
}

static struct rg_picture picture_of(const char *name)
{
    char path[128];
    struct rg_picture picture;
    snprintf(path, sizeof(path), "%s/%s", folder, name);
    assert_true(rg_picture_read(path, &picture));
    assert_int_equal(picture.channels, 1);
    return picture;
}

// --- texels and factors ---

static void expect_level(const char *name, enum rg_atlas_part part, int layer, int level)
{
    const struct rg_atlas_image *image = &atlas->images[part];
    const uint16_t *texels = rg_atlas_texels(atlas, part, layer, level);
    struct rg_picture picture = picture_of(name);
    assert_int_equal(picture.width, image->width >> level ? image->width >> level : 1);
    assert_int_equal(picture.height, image->height >> level ? image->height >> level : 1);
    for (int64_t i = 0; i < rg_picture_values(&picture); i++)
        assert_equals(picture.texels[i], rg_half_value(texels[i]));
    rg_picture_destroy(&picture);
}

static void texels_are_written_as_they_are(void **state)
{
    (void)state;
    expect_level("point-03-level-00.exr", RG_ATLAS_POINT, 3, 0);
    expect_level("point-03-level-02.exr", RG_ATLAS_POINT, 3, 2);
    expect_level("point-09-level-01.exr", RG_ATLAS_POINT, 9, 1);
    expect_level("env-03-level-01.exr", RG_ATLAS_ENV, 3, 1);
    expect_level("env-03-level-09.exr", RG_ATLAS_ENV, 3, 9);
    expect_level("splash-44-level-02.exr", RG_ATLAS_SPLASH, 44, 2);
    expect_level("splash-44-level-05.exr", RG_ATLAS_SPLASH, 44, 5);
}

// Each with its angles: elevations from -90 degrees in steps of 20, azimuths from 10.
static void factors_are_listed_by_angles(void **state)
{
    (void)state;
    const struct {
        const char *angles;
        float factor;
    } due[] = {{"env,3,0,,", 0.5f},
               {"env,3,80,,", 0.1f},
               {"env,2,80,,", 0},
               {"point,3,0,-90,10", factor_of(0, 0)},
               {"point,3,40,-70,30", factor_of(2, 1 * RG_ATLAS_PHIS + 1)},
               {"point,3,80,90,170", factor_of(4, 9 * RG_ATLAS_PHIS + 8)}};
    static char text[1 << 18];
    char path[128], line[64];
    snprintf(path, sizeof(path), "%s/factors.csv", folder);
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    text[fread(text, 1, sizeof(text) - 1, file)] = 0;
    fclose(file);
    assert_ptr_equal(strstr(text, "image,oscillation,theta_view_deg,theta_light_deg,"
                                  "phi_light_deg,factor\n"),
                     text);
    for (size_t i = 0; i < sizeof(due) / sizeof(due[0]); i++) {
        snprintf(line, sizeof(line), "\n%s,%.9g\n", due[i].angles, (double)due[i].factor);
        if (!strstr(text, line))
            fail_msg("factors.csv lacks %s", line);
    }
}

// The least and the largest above 0.
static void a_range_is_of_what_is_bright(void **state)
{
    (void)state;
    const float factors[] = {0, 3, 0.5f, 0, 2, -1}, dark[] = {0, 0};
    const struct rg_atlas_range range = rg_atlas_range(factors, 6), none = rg_atlas_range(dark, 2);
    assert_equals(range.least, 0.5);
    assert_equals(range.largest, 3);
    assert_equals(none.least, 0);
    assert_equals(none.largest, 0);
}

// --- sheets ---

// The code of light on a screen.
static double code_of(double light)
{
    const double seen = fmin(light, 1);
    return 255 * (seen <= 0.0031308 ? 12.92 * seen : 1.055 * pow(seen, 1 / 2.4) - 0.055);
}

// What a sheet shows at a place of one of its halves: point, a gap, env, and a gap.
static double sheet_at(int x, int y, bool is_scaled)
{
    // The rows of views, a quarter of those of the full size.
    static const int begins[] = {0, 262, 509, 712, 848};
    const bool is_env = x >= WIDE + GAP;
    const int width = is_env ? ENV_WIDE : WIDE, column = is_env ? x - WIDE - GAP : x;
    int view = RG_ATLAS_VIEWS - 1;
    if (column >= width)
        return 0.05;
    while (y < begins[view])
        view--;
    // The brightest cells of all views are four times as bright as the largest texel: 0.05 of a
    // point's factors, and 0.5 of env's.
    const double factor = is_env ? 0.5 / (1 + view) : (double)factor_of(view, column / 8);
    const uint16_t *texels =
        rg_atlas_texels(atlas, is_env ? RG_ATLAS_ENV : RG_ATLAS_POINT, LAYER, 0);
    return (is_scaled ? 4 * factor / (is_env ? 0.5 : 0.05) : 1) *
           (double)rg_half_value(texels[y * width + column]);
}

static void a_sheet_shows_cells_and_their_brightness(void **state)
{
    (void)state;
    const int half = WIDE + ENV_WIDE + 2 * GAP;
    struct rg_picture sheet = picture_of("sheet-03.png");
    assert_int_equal(sheet.width, 2 * half);
    assert_int_equal(sheet.height, HIGH);
    for (int y = 0; y < HIGH; y += 3)
        for (int x = 0; x < 2 * half; x++) {
            const double found = (double)sheet.texels[y * sheet.width + x];
            const double due = sheet_at(x % half, y, x >= half);
            if (fabs(code_of(found) - code_of(due)) > 0.51)
                fail_msg("x %d, y %d: %g, not %g", x, y, found, due);
        }
    rg_picture_destroy(&sheet);
}

// Seven frames a row, four times as large, 12 pixels apart.
static void splashes_are_shown_frame_by_frame(void **state)
{
    (void)state;
    struct rg_picture sheet = picture_of("splash.png");
    assert_int_equal(sheet.width, 7 * (4 * 48 + GAP) - GAP);
    assert_int_equal(sheet.height, 12 * (4 * 32 + GAP) - GAP);
    for (int y = 0; y < sheet.height; y++)
        for (int x = 0; x < sheet.width; x++) {
            const int column = x / (4 * 48 + GAP), row = y / (4 * 32 + GAP);
            const int u = x % (4 * 48 + GAP) / 4, v = y % (4 * 32 + GAP) / 4;
            const uint16_t *texels = rg_atlas_texels(atlas, RG_ATLAS_SPLASH, 7 * row + column, 0);
            const bool is_gap = u >= 48 || v >= 32;
            const double due = is_gap ? 0.05 : (double)rg_half_value(texels[v * 48 + u]);
            const double found = (double)sheet.texels[y * sheet.width + x];
            if (fabs(code_of(found) - code_of(due)) > 0.51)
                fail_msg("x %d, y %d: %g, not %g", x, y, found, due);
        }
    rg_picture_destroy(&sheet);
}

static void keep_quiet(enum rg_log_level level, const char *line, void *user)
{
    (void)level;
    (void)line;
    ++*(int *)user;
}

static void what_cannot_be_written_is_told(void **state)
{
    (void)state;
    int lines = 0;
    rg_log_listen(keep_quiet, &lines);
    assert_false(rg_atlas_export(atlas, "/proc/none/none"));
    rg_log_listen(NULL, NULL);
    assert_int_equal(lines, 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(texels_are_written_as_they_are),
        cmocka_unit_test(factors_are_listed_by_angles),
        cmocka_unit_test(a_range_is_of_what_is_bright),
        cmocka_unit_test(a_sheet_shows_cells_and_their_brightness),
        cmocka_unit_test(splashes_are_shown_frame_by_frame),
        cmocka_unit_test(what_cannot_be_written_is_told),
    };
    return cmocka_run_group_tests(tests, make_atlas, remove_atlas);
}
