// Packing a small tree with the original database's names. Its pictures encode the place where they
// belong. Hard links share them between names: 7,500 names, 20 files.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <ftw.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/base/log.h"
#include "core/scene/atlas/cache.h"
#include "core/scene/atlas/cave/cave.h"
#include "core/scene/atlas/levels.h"
#include "core/techniques/streaks/instance.h"
#include "tests/core/scene/atlas/codes.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/logged.h"

enum { PATH_SIZE = 512 };

static char root[] = "/tmp/raingauge-cave-XXXXXX";

// The database's own heights at width 16; at other widths in proportion.
static const int heights[5] = {525, 494, 405, 272, 108};

static void in_root(char path[PATH_SIZE], const char *format, ...)
    __attribute__((format(printf, 2, 3)));

static void in_root(char path[PATH_SIZE], const char *format, ...)
{
    va_list args;
    va_start(args, format);
    const int length = snprintf(path, PATH_SIZE, "%s/", root);
    vsnprintf(path + length, (size_t)(PATH_SIZE - length), format, args);
    va_end(args);
}

// The code of a pixel tells its third of the picture, its view and its part.
static int code_of(int view, bool env, int row, int height)
{
    return 4000 * view + (env ? 30000 : 0) + 6000 * (row * 3 / height) + 100;
}

// The brighter half of a picture has this much more.
enum { BRIGHTER = 300 };

static void write_png(const char *path, int width, int height, int view, bool env, bool is_left)
{
    uint16_t *codes = malloc((size_t)(width * height) * sizeof(*codes));
    for (int r = 0; r < height; r++)
        for (int c = 0; c < width; c++)
            codes[r * width + c] = (uint16_t)(code_of(view, env, r, height) +
                                              ((c < width / 2) == is_left ? BRIGHTER : 0));
    write_codes(path, width, height, codes);
    free(codes);
}

static void make_folder(const char *format, ...) __attribute__((format(printf, 1, 2)));

static void make_folder(const char *format, ...)
{
    char name[PATH_SIZE], path[PATH_SIZE];
    va_list args;
    va_start(args, format);
    vsnprintf(name, sizeof(name), format, args);
    va_end(args);
    in_root(path, "%s", name);
    assert_int_equal(mkdir(path, 0700), 0);
}

static double factor_of(int view, int light, int phi, int oscillation)
{
    return 0.001 * (1 + oscillation + 10 * phi + 100 * light + 1000 * view);
}

static void write_factors(int view)
{
    char path[PATH_SIZE];
    in_root(path, "point_light_database/txt/dcam%02d_point_max.txt", 20 * view);
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    fprintf(file, "cv%d\n", 20 * view);
    for (int light = 0; light < 10; light++) {
        fprintf(file, "v%d\n", 20 * light - 90);
        for (int phi = light % 9 ? 0 : 8; phi < 9; phi++) { // the poles have one azimuth only
            fprintf(file, "h%d", 20 * phi + 10);
            for (int k = 0; k < 10; k++)
                fprintf(file, " %.6f", factor_of(view, light, phi, k));
            fprintf(file, "\r\n");
        }
    }
    assert_int_equal(fclose(file), 0);
}

static void link_view(int view, int size)
{
    char picture[PATH_SIZE], path[PATH_SIZE];
    const int height = (heights[view] * size + 8) / 16;
    make_folder("point_light_database/size%d/dcam%02d", size, 20 * view);
    in_root(picture, "picture%d-%d.png", size, view);
    write_png(picture, size, height, view, false, false);
    for (int light = 0; light < 10; light++)
        for (int phi = light % 9 ? 0 : 8; phi < 9; phi++)
            for (int k = 0; k < 10; k++) {
                in_root(path, "point_light_database/size%d/dcam%02d/cv%d_v%d_h%d_osc%d.png", size,
                        20 * view, 20 * view, 20 * light - 90, 20 * phi + 10, k);
                assert_int_equal(link(picture, path), 0);
            }
    in_root(picture, "env%d-%d.png", size, view);
    write_png(picture, size, height, view, true, false);
    for (int k = 0; k < 10; k++) {
        in_root(path, "env_light_database/size%d/cv%d_osc%d.png", size, 20 * view, k);
        assert_int_equal(link(picture, path), 0);
    }
}

static int setup(void **state)
{
    (void)state;
    char path[PATH_SIZE];
    rg_log_listen(log_last, NULL);
    if (!mkdtemp(root))
        return 1;
    make_folder("point_light_database");
    make_folder("env_light_database");
    make_folder("point_light_database/txt");
    make_folder("env_light_database/txt");
    for (int size = 8; size >= 4; size /= 2) {
        make_folder("point_light_database/size%d", size);
        make_folder("env_light_database/size%d", size);
        for (int view = 0; view < 5; view++)
            link_view(view, size);
    }
    in_root(path, "env_light_database/txt/normalized_env_max.txt");
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    for (int view = 0; view < 5; view++) {
        write_factors(view);
        fprintf(file, "cv%d", 20 * view);
        for (int k = 0; k < 10; k++)
            fprintf(file, " %g", 0.5 + view + 0.01 * k);
        fprintf(file, "\n");
    }
    return fclose(file);
}

static int remove_one(const char *path, const struct stat *st, int kind, struct FTW *place)
{
    (void)st;
    (void)kind;
    (void)place;
    return remove(path);
}

static int teardown(void **state)
{
    (void)state;
    return nftw(root, remove_one, 16, FTW_DEPTH | FTW_PHYS);
}

static void expect_cell(const struct rg_atlas *atlas, enum rg_atlas_part part, int layer, int view,
                        int column, int level, bool is_left)
{
    const int width = 8 >> level, rows = rg_atlas_row_height(view, level + 2);
    const int pitch = atlas->images[part].width >> level;
    const uint16_t *texels = rg_atlas_texels(atlas, part, layer, level) +
                             rg_atlas_row_start(view, level + 2) * pitch + column * width;
    for (int third = 0; third < 3; third++) {
        // In the middle of each third of the height, whatever height it was resampled to.
        const int r = (2 * third + 1) * rows / 6;
        const int dark = code_of(view, part == RG_ATLAS_ENV, 2 * third + 1, 6);
        for (int c = 0; c < width; c++) {
            const double wanted = (dark + ((c < width / 2) == is_left ? BRIGHTER : 0)) / 65535.0;
            const double texel = (double)rg_half_value(texels[r * pitch + c]);
            if (fabs(texel - wanted) > wanted * 6e-4)
                fail_msg("part %d, view %d, column %d, level %d, third %d: %g, expected %g", part,
                         view, column, level, third, texel, wanted);
        }
    }
}

static void test_packed(void **state)
{
    (void)state;
    struct rg_atlas *atlas = rg_cave_pack(root, RG_ATLAS_CAVE_SMALL, NULL);
    assert_non_null(atlas);
    for (int view = 0; view < 5; view++)
        for (int k = 0; k < 10; k++) {
            for (int cell = 0; cell < 90; cell += 7)
                for (int level = 0; level < 2; level++)
                    expect_cell(atlas, RG_ATLAS_POINT, k, view, cell, level, false);
            for (int level = 0; level < 2; level++)
                expect_cell(atlas, RG_ATLAS_ENV, k, view, 0, level, false);
            for (int cell = 0; cell < 90; cell++) {
                // At a pole the one azimuth serves all nine cells.
                const int light = cell / 9, phi = light % 9 ? cell % 9 : 8;
                const double wanted = factor_of(view, light, phi, k) * (double)RG_CAVE_POINT_SCALE;
                const double factor = (double)atlas->point_factor[k][view][light][cell % 9];
                assert_below(fabs(factor / wanted - 1), 1e-5);
            }
            const double wanted = (0.5 + view + 0.01 * k) / 0.5 / 42.5;
            assert_below(fabs((double)atlas->env_factor[k][view] / wanted - 1), 1e-5);
        }
    rg_atlas_destroy(atlas);
}

// A database with its light on the left is packed mirrored. The packer finds that from one picture.
static void test_mirrored(void **state)
{
    (void)state;
    char path[PATH_SIZE], kept[PATH_SIZE];
    in_root(path, "point_light_database/size8/dcam00/cv0_v10_h90_osc0.png");
    in_root(kept, "kept");
    assert_int_equal(rename(path, kept), 0);
    write_png(path, 8, (heights[0] * 8 + 8) / 16, 0, false, true);
    struct rg_atlas *atlas = rg_cave_pack(root, RG_ATLAS_CAVE_SMALL, NULL);
    assert_int_equal(unlink(path) | rename(kept, path), 0);
    assert_non_null(atlas);
    for (int level = 0; level < 2; level++) {
        expect_cell(atlas, RG_ATLAS_POINT, 3, 2, 40, level, true);
        expect_cell(atlas, RG_ATLAS_ENV, 3, 2, 0, level, true);
    }
    rg_atlas_destroy(atlas);
}

// Packing fails with one line, which names the file and the fault.
static void expect_refused(const char *named, const char *said)
{
    logged_lines = 0;
    assert_null(rg_cave_pack(root, RG_ATLAS_CAVE_SMALL, NULL));
    assert_int_equal(logged_lines, 1);
    if (!strstr(rg_last_error(), named) || !strstr(rg_last_error(), said))
        fail_msg("'%s' names no %s, or says nothing of '%s'", rg_last_error(), named, said);
}

static void replace(const char *name, const char *content, size_t length, const char *said)
{
    char path[PATH_SIZE], kept[PATH_SIZE];
    in_root(path, "%s", name);
    in_root(kept, "kept");
    assert_int_equal(rename(path, kept), 0);
    if (content) {
        FILE *file = fopen(path, "wb");
        assert_non_null(file);
        assert_int_equal(fwrite(content, 1, length, file), length);
        assert_int_equal(fclose(file), 0);
    }
    expect_refused(name, said);
    assert_int_equal(rename(kept, path), 0);
}

#define POINT "point_light_database/size8/dcam40/cv40_v-10_h90_osc3.png"
#define TEXT  "point_light_database/txt/dcam60_point_max.txt"
#define ENV   "env_light_database/txt/normalized_env_max.txt"

static void test_refused(void **state)
{
    (void)state;
    char path[PATH_SIZE], bytes[4096];
    in_root(path, POINT);
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    const size_t length = fread(bytes, 1, sizeof(bytes), file);
    fclose(file);
    replace(POINT, NULL, 0, "");
    replace(POINT, "no picture", 10, "");
    replace(POINT, bytes, length / 2, "");
    replace("env_light_database/size4/cv0_osc9.png", bytes, length, "8 x 203 pixels");
    replace(TEXT, NULL, 0, "No such file");
    replace(TEXT, "cv60 v10 h10 1 2 3", 18, "line 1");
    replace(TEXT, "cv40\n", 5, "'cv40'");
    replace(TEXT, "cv60\nv10\nh10 1 2 3 4 5 6 7 8 9 nan", 34, "line 3: 'nan'");
    replace(TEXT, "cv60\nv10\nh20 1 2 3 4 5 6 7 8 9 10", 33, "'h20'");
    replace(TEXT, "cv60\nv10\nh10 1 2 3 4 5 6 7 8 9 10", 33, "no factors for v");
    replace(ENV, "cv0 1 1 1 1 1 1 1 1 1 1", 23, "no factors for cv20");
    replace(ENV, "", 0, "no factors for cv0");
    logged_lines = 0;
    assert_null(rg_cave_pack("/nonexistent", RG_ATLAS_CAVE, NULL));
    assert_int_equal(logged_lines, 1);
    assert_non_null(strstr(rg_last_error(), "/nonexistent/point_light_database/txt/dcam00"));
}

// --- what streaks draws with ---

static struct rg_instance *open_rain(struct rg_device *device)
{
    const struct rg_technique *technique = rg_technique_find("streaks");
    void *defaults = rg_settings_create(technique);
    void *settings = rg_settings_copy(technique, defaults,
                                      "atlas=cave-small city=small rain_width_m=50 rain_depth_m=50 "
                                      "depth_map_px=64 shadow_map_px=16 drops_m2_s=20");
    assert_non_null(settings);
    struct rg_instance *instance = rg_instance_open(technique, device, settings, 64, 36);
    free(settings);
    free(defaults);
    return instance;
}

// Loading joins the ends of a view's rows to each other; the texels in between stay.
static void expect_texels(const struct streaks *s, const struct rg_atlas *atlas)
{
    const struct rg_atlas_image *image = &atlas->images[RG_ATLAS_POINT];
    const int level = atlas->first_level + 1, pitch = image->width >> 1;
    uint16_t *texels = malloc((size_t)image->width * (size_t)image->height * sizeof(*texels));
    assert_non_null(texels);
    assert_true(rg_image_read(s->textures->points, 7, 1, texels));
    for (int view = 0; view < RG_ATLAS_VIEWS; view++) {
        const int rows = rg_atlas_row_height(view, level) / 3;
        const int first = (rg_atlas_row_start(view, level) + rows) * pitch;
        assert_above(rows, 2);
        assert_memory_equal(texels + first, rg_atlas_texels(atlas, RG_ATLAS_POINT, 7, 1) + first,
                            (size_t)(rows * pitch) * sizeof(*texels));
    }
    free(texels);
}

// Without a packed atlas one line names the command that packs it.
static void test_drawn_with(void **state)
{
    (void)state;
    char cache[PATH_SIZE], why[256];
    in_root(cache, "cache");
    assert_int_equal(setenv("XDG_CACHE_HOME", cache, 1), 0);
    struct rg_device *device = rg_device_open("cpu");
    assert_non_null(device);
    logged_lines = 0;
    assert_null(open_rain(device));
    assert_int_equal(logged_lines, 1);
    assert_non_null(strstr(rg_last_error(), "`raingauge atlas --quick --from DIR`"));

    struct rg_atlas *atlas = rg_cave_pack(root, RG_ATLAS_CAVE_SMALL, NULL);
    assert_non_null(atlas);
    assert_true(rg_atlas_cache_write(atlas, why));
    struct rg_instance *instance = open_rain(device);
    assert_non_null(instance);
    expect_texels((struct streaks *)instance, atlas);
    assert_int_equal(((struct streaks *)instance)->textures->first_level, 2);
    assert_true(instance->technique->step(instance) && instance->technique->draw(instance));
    rg_instance_close(instance);
    rg_atlas_destroy(atlas);
    assert_true(rg_device_close(device));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_packed),
        cmocka_unit_test(test_mirrored),
        cmocka_unit_test(test_refused),
        cmocka_unit_test(test_drawn_with),
    };
    return cmocka_run_group_tests(tests, setup, teardown);
}
