#include "harness/commands/drawing/atlas/export.h"

#include <stdio.h>
#include <stdlib.h>

#include "core/base/log.h"
#include "core/device/device.h"
#include "core/image/files/io.h"
#include "core/scene/atlas/levels.h"
#include "harness/record/output.h"

// Sheets of cells times their factors are scaled by this relative to the brightest cell, because
// most are a hundred times darker.
#define SHEET_EXPOSURE 4.0f

enum { PATH_SIZE = 2048, GAP = 12, ZOOM = 4, FRAMES_A_ROW = 7 };

const char *const rg_atlas_part_names[RG_ATLAS_PART_COUNT] = {"point", "env", "splash"};

struct rg_atlas_range rg_atlas_range(const float *factors, size_t count)
{
    struct rg_atlas_range range = {0, 0};
    for (size_t i = 0; i < count; i++) {
        const double factor = (double)factors[i];
        if (factor > 0 && (range.least <= 0 || factor < range.least))
            range.least = factor;
        range.largest = factor > range.largest ? factor : range.largest;
    }
    return range;
}

static bool write_factors(const struct rg_atlas *atlas, const char *folder)
{
    char *text = NULL;
    size_t size;
    FILE *out = open_memstream(&text, &size);
    if (!out)
        return rg_harness_error("%s/factors.csv: no memory to write it", folder);
    fprintf(out, "image,oscillation,theta_view_deg,theta_light_deg,phi_light_deg,factor\n");
    for (int k = 0; k < RG_ATLAS_OSCILLATIONS; k++) {
        for (int view = 0; view < RG_ATLAS_VIEWS; view++) {
            fprintf(out, "env,%d,%d,,,%.9g\n", k, 20 * view, (double)atlas->env_factor[k][view]);
            for (int cell = 0; cell < RG_ATLAS_CELLS; cell++)
                fprintf(out, "point,%d,%d,%d,%d,%.9g\n", k, 20 * view,
                        20 * (cell / RG_ATLAS_PHIS) - 90, 20 * (cell % RG_ATLAS_PHIS) + 10,
                        (double)(&atlas->point_factor[k][view][0][0])[cell]);
        }
    }
    const bool printed = fclose(out) == 0;
    const bool written = printed
                             ? rg_output_write(folder, "factors.csv", text)
                             : rg_harness_error("%s/factors.csv: no memory to write it", folder);
    free(text);
    return written;
}

static bool write_level(const struct rg_atlas *atlas, enum rg_atlas_part part, int layer, int level,
                        const char *folder)
{
    const struct rg_atlas_image *image = &atlas->images[part];
    char path[PATH_SIZE];
    snprintf(path, sizeof(path), "%s/%s-%02d-level-%02d.exr", folder, rg_atlas_part_names[part],
             layer, level);
    struct rg_picture picture;
    if (!rg_picture_create(&picture, rg_level_size(image->width, level),
                           rg_level_size(image->height, level), 1, path))
        return false;
    const uint16_t *texels = rg_atlas_texels(atlas, part, layer, level);
    for (int64_t i = 0; i < rg_picture_values(&picture); i++)
        picture.texels[i] = rg_half_value(texels[i]);
    const bool written = rg_picture_write(path, &picture, &(struct rg_write_options){0});
    rg_picture_destroy(&picture);
    return written;
}

// The level of the full size that sheets show, with 720 columns.
static int sheet_level(const struct rg_atlas *atlas)
{
    return 2 - atlas->first_level;
}

// Copies a view's row of cells to column x of a sheet, multiplied by the cells' factors if
// `scaled`.
static void draw_row(const struct rg_atlas *atlas, enum rg_atlas_part part, int layer, int view,
                     bool scaled, struct rg_picture *sheet, int x)
{
    const float *factors = part == RG_ATLAS_POINT ? &atlas->point_factor[layer][view][0][0]
                                                  : &atlas->env_factor[layer][view];
    const float *all = part == RG_ATLAS_POINT ? &atlas->point_factor[layer][0][0][0]
                                              : &atlas->env_factor[layer][0];
    const size_t count = RG_ATLAS_VIEWS * (part == RG_ATLAS_POINT ? RG_ATLAS_CELLS : 1);
    const float exposure = SHEET_EXPOSURE / (float)rg_atlas_range(all, count).largest;
    const int level = sheet_level(atlas);
    const int width = rg_level_size(atlas->images[part].width, level);
    const int first = rg_atlas_row_start(view, 2), rows = rg_atlas_row_height(view, 2);
    const uint16_t *texels = rg_atlas_texels(atlas, part, layer, level);
    for (int r = first; r < first + rows; r++) {
        for (int c = 0; c < width; c++) {
            const float factor = scaled ? factors[c / (RG_ATLAS_CELL_PX >> 2)] * exposure : 1;
            sheet->texels[r * sheet->width + x + c] = factor * rg_half_value(texels[r * width + c]);
        }
    }
}

static bool write_sheet(const struct rg_atlas *atlas, int layer, const char *folder)
{
    char path[PATH_SIZE];
    snprintf(path, sizeof(path), "%s/sheet-%02d.png", folder, layer);
    const int level = sheet_level(atlas);
    const int point = rg_level_size(atlas->images[RG_ATLAS_POINT].width, level);
    const int env = rg_level_size(atlas->images[RG_ATLAS_ENV].width, level);
    const int half = point + env + 2 * GAP;
    struct rg_picture sheet;
    if (!rg_picture_create(&sheet, 2 * half, RG_ATLAS_HEIGHT_PX >> 2, 1, path))
        return false;
    for (int64_t i = 0; i < rg_picture_values(&sheet); i++)
        sheet.texels[i] = 0.05f;
    for (int side = 0; side < 2; side++) {
        for (int view = 0; view < RG_ATLAS_VIEWS; view++) {
            draw_row(atlas, RG_ATLAS_POINT, layer, view, side, &sheet, side * half);
            draw_row(atlas, RG_ATLAS_ENV, layer, view, side, &sheet, side * half + point + GAP);
        }
    }
    const bool written = rg_picture_write(path, &sheet, &(struct rg_write_options){0});
    rg_picture_destroy(&sheet);
    return written;
}

static void draw_frame(const struct rg_atlas *atlas, int layer, struct rg_picture *sheet)
{
    const struct rg_atlas_image *image = &atlas->images[RG_ATLAS_SPLASH];
    const uint16_t *texels = rg_atlas_texels(atlas, RG_ATLAS_SPLASH, layer, 0);
    const int left = layer % FRAMES_A_ROW * (image->width * ZOOM + GAP);
    const int top = layer / FRAMES_A_ROW * (image->height * ZOOM + GAP);
    for (int y = 0; y < image->height * ZOOM; y++)
        for (int x = 0; x < image->width * ZOOM; x++)
            sheet->texels[(top + y) * sheet->width + left + x] =
                rg_half_value(texels[y / ZOOM * image->width + x / ZOOM]);
}

static bool write_splashes(const struct rg_atlas *atlas, const char *folder)
{
    char path[PATH_SIZE];
    snprintf(path, sizeof(path), "%s/splash.png", folder);
    const struct rg_atlas_image *image = &atlas->images[RG_ATLAS_SPLASH];
    struct rg_picture sheet;
    if (!rg_picture_create(&sheet, FRAMES_A_ROW * (image->width * ZOOM + GAP) - GAP,
                           image->layers / FRAMES_A_ROW * (image->height * ZOOM + GAP) - GAP, 1,
                           path))
        return false;
    for (int64_t i = 0; i < rg_picture_values(&sheet); i++)
        sheet.texels[i] = 0.05f;
    for (int layer = 0; layer < image->layers; layer++)
        draw_frame(atlas, layer, &sheet);
    const bool written = rg_picture_write(path, &sheet, &(struct rg_write_options){0});
    rg_picture_destroy(&sheet);
    return written;
}

bool rg_atlas_export(const struct rg_atlas *atlas, const char *folder)
{
    bool good = write_factors(atlas, folder);
    for (int layer = 0; good && layer < RG_ATLAS_OSCILLATIONS; layer++)
        good = write_sheet(atlas, layer, folder);
    good = good && write_splashes(atlas, folder);
    for (int part = 0; part < RG_ATLAS_PART_COUNT; part++)
        for (int layer = 0; layer < atlas->images[part].layers; layer++)
            for (int level = 0; good && level < atlas->images[part].levels; level++)
                good = write_level(atlas, part, layer, level, folder);
    return good;
}
