#include "harness/commands/drawing/atlas/textures.h"

#include <stdio.h>
#include <stdlib.h>

#include "core/base/log.h"
#include "core/image/files/io.h"
#include "core/image/srgb.h"
#include "harness/record/output.h"

enum { PATH_SIZE = 2048, CELL_PX = 256, GAP = 12, COLUMNS = 6, ROWS = 8 };

// The grey-blue of a wet wall, on which both water and ink are visible. Linear light.
static const float ground[3] = {0.13f, 0.17f, 0.22f};

struct writing {
    const char *folder;
    struct rg_picture sheet;
    int rows_used; // rows of the sheet in use
};

static float channel(uint32_t word, int i)
{
    return (float)(word >> 8 * i & 255) / 255;
}

// --- a texture's files ---

// Writes the texels: four channels of paint, or one of grey.
static bool write_texels(const struct rg_made_texture *t, const char *folder)
{
    char path[PATH_SIZE];
    struct rg_picture p;
    snprintf(path, sizeof(path), "%s/%s-level-%d.exr", folder, t->name, t->level);
    if (!rg_picture_create(&p, t->side_px, t->side_px, t->is_paint ? 4 : 1, path))
        return false;
    for (int64_t i = 0; i < rg_picture_values(&p); i++)
        p.texels[i] = channel(t->words[i / p.channels], (int)(i % p.channels));
    const bool written = rg_picture_write(path, &p, &(struct rg_write_options){0});
    rg_picture_destroy(&p);
    return written;
}

// Writes a PNG, whose colours are not premultiplied.
static bool write_looks(const struct rg_made_texture *t, const char *folder)
{
    char path[PATH_SIZE];
    struct rg_picture p;
    snprintf(path, sizeof(path), "%s/%s.png", folder, t->name);
    if (!rg_picture_create(&p, t->side_px, t->side_px, t->is_paint ? 4 : 1, path))
        return false;
    for (int64_t i = 0; i < rg_picture_values(&p); i++) {
        const uint32_t word = t->words[i / p.channels];
        const int k = (int)(i % p.channels);
        const float value = channel(word, k), alpha = channel(word, 3);
        if (t->is_paint)
            p.texels[i] = k == 3 || alpha <= 0 ? value : value / alpha;
        else
            p.texels[i] = (float)rg_srgb_decode((double)value);
    }
    const bool written = rg_picture_write(path, &p, &(struct rg_write_options){0});
    rg_picture_destroy(&p);
    return written;
}

// --- the sheet ---

static bool create_sheet(struct rg_picture *sheet)
{
    const int across = COLUMNS * (CELL_PX + GAP) + GAP, down = ROWS * (CELL_PX + GAP) + GAP;
    if (!rg_picture_create(sheet, across, down, 3, "sheet.png"))
        return false;
    for (int64_t i = 0; i < rg_picture_values(sheet); i++)
        sheet->texels[i] = ground[i % 3];
    return true;
}

// Draws a texture into its cell, scaled by a whole number.
static void lay(const struct rg_made_texture *t, struct rg_picture *sheet)
{
    const int left = t->column * (CELL_PX + GAP) + GAP, top = t->row * (CELL_PX + GAP) + GAP;
    const int zoom = CELL_PX / t->side_px;
    for (int i = 0; i < CELL_PX * CELL_PX; i++) {
        const int x = i % CELL_PX, y = i / CELL_PX;
        if (x / zoom >= t->side_px || y / zoom >= t->side_px)
            continue;
        const uint32_t word = t->words[y / zoom * t->side_px + x / zoom];
        float *to = sheet->texels + 3 * ((top + y) * sheet->width + left + x);
        for (int k = 0; k < 3; k++)
            to[k] = t->is_paint ? channel(word, k) + to[k] * (1 - channel(word, 3))
                                : (float)rg_srgb_decode((double)channel(word, k));
    }
}

static bool write_sheet(struct writing *w)
{
    char path[PATH_SIZE];
    snprintf(path, sizeof(path), "%s/sheet.png", w->folder);
    w->sheet.height = w->rows_used * (CELL_PX + GAP) + GAP;
    return rg_picture_write(path, &w->sheet, &(struct rg_write_options){0});
}

// --- all of them ---

static bool list(void *user, const struct rg_made_texture *t)
{
    struct rg_texture_rows *rows = user;
    if (!t->level && rows->count == RG_MAX_TEXTURE_ROWS)
        return rg_error("%s: one texture too many; %d is the most", t->name, RG_MAX_TEXTURE_ROWS);
    if (!t->level) {
        struct rg_texture_row *row = &rows->items[rows->count++];
        *row = (struct rg_texture_row){.side_px = t->side_px};
        snprintf(row->name, sizeof(row->name), "%s", t->name);
    }
    rows->items[rows->count - 1].levels = t->level + 1;
    return true;
}

static bool write(void *user, const struct rg_made_texture *t)
{
    struct writing *w = user;
    if (t->row >= ROWS || t->column >= COLUMNS || t->side_px > CELL_PX)
        return rg_error("%s: its place is beyond the sheet of %d x %d cells of %d px", t->name,
                        COLUMNS, ROWS, CELL_PX);
    if (!t->level)
        lay(t, &w->sheet);
    w->rows_used = t->row >= w->rows_used ? t->row + 1 : w->rows_used;
    return write_texels(t, w->folder) && (t->level || write_looks(t, w->folder));
}

static bool write_list(const struct rg_texture_rows *rows, const char *folder)
{
    char text[RG_MAX_TEXTURE_ROWS * 64] = "name,side_px,levels\n";
    size_t used = sizeof("name,side_px,levels\n") - 1;
    for (int i = 0; i < rows->count; i++)
        used +=
            (size_t)snprintf(text + used, sizeof(text) - used, "%s,%d,%d\n", rows->items[i].name,
                             rows->items[i].side_px, rows->items[i].levels);
    return rg_output_write(folder, "textures.csv", text);
}

bool rg_textures_make(const struct rg_technique *technique, const char *folder,
                      struct rg_texture_rows *rows)
{
    struct writing w = {.folder = folder};
    rows->count = 0;
    if (!technique->make_textures)
        return rg_error("technique '%s': it generates no textures; `raingauge atlas --help`",
                        technique->name);
    if (!technique->make_textures(list, rows))
        return false;
    if (!folder)
        return true;
    const bool good = write_list(rows, folder) && create_sheet(&w.sheet) &&
                      technique->make_textures(write, &w) && write_sheet(&w);
    rg_picture_destroy(&w.sheet);
    return good;
}
