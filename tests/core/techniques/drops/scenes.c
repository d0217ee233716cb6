#include "tests/core/techniques/drops/scenes.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/oracle/drops/map.h"
#include "tests/oracle/drops/particles.h"

const struct scene scenes[] = {
    {"a drop on a dry pane", "", 6, {{0, 60, 16.1, 2.3, 0, 0}}, {{0}}},
    {"a drop that follows another's trail",
     "",
     8,
     {{0, 30, 16.1, 3.3, 0, 0}},
     {{9, 34, 8, 4, 30, 0.4}}},
    {"a drop that follows a trail to its left",
     "",
     8,
     {{0, 30, 16.1, 3.3, 0, 0}},
     {{9, 26, 8, 4, 30, 0.4}}},
    {"water to both sides, the right one higher",
     "smooth=off erode=off",
     3,
     {{0, 30, 16.1, 3.3, 0, 0}},
     {{9, 26, 8, 4, 30, 0.2}, {10, 34, 8, 4, 30, 0.3}}},
    {"drops that run off the edges",
     "",
     5,
     {{0, 40, 2.1, 10.2, -300, 100}, {0, 40, 33.9, 10.2, 300, 100}, {0, 90, 18.1, 18.2, 0, 300}},
     {{0}}},
    {"three that merge, with momentum",
     "critical_mass_mg=100",
     4,
     {{0, 12, 14.2, 10.3, 0, 0},
      {0, 17, 16.5, 11.1, 0, 0},
      {0, 9, 18.4, 10.6, 0, 0},
      {0, 8, 30.2, 16.4, 0, 0}},
     {{0}}},
    {"two that are as low",
     "critical_mass_mg=100",
     4,
     {{0, 12, 14.2, 10.3, 0, 0}, {0, 12, 16.2, 10.3, 0, 0}},
     {{0}}},
    {"a running drop and one at rest",
     "",
     8,
     {{0, 50, 16.2, 4.3, 20, 200}, {0, 15, 17.1, 12.4, 0, 0}},
     {{0}}},
    {"kin stay apart, and a stranger joins them",
     "critical_mass_mg=100",
     2,
     {{0, 12, 10.2, 10.3, 0, 0},
      {1, 12, 12.4, 10.4, 0, 0},
      {0, 9, 24.2, 10.3, 0, 0},
      {3, 9, 26.1, 10.9, 0, 0},
      {0, 8, 22.2, 9.7, 0, 0}},
     {{0}}},
    {"a child that outlives its parent's merging",
     "critical_mass_mg=30",
     6,
     {{0, 29, 16.2, 10.3, 0, 0}, {0, 8, 14.0, 10.0, 0, 0}, {1, 12, 18.9, 12.4, 0, 0}},
     {{0}}},
    {"water of no drop",
     "smooth=off erode=off critical_mass_mg=100",
     3,
     {{0, 12, 10.2, 10.3, 0, 0}},
     {{9, 22, 15, 8, 9, 0.9},
      {10, 40, 10, 5, 6, 0.7},
      {11, 45, 10, 5, 6, 0.7},
      {12, 60, 2, 3, 3, 0.7}}},
    {"water that flattens and thins",
     "",
     12,
     {{0, 3, 31.1, 5.2, 0, 0}},
     {{0, 0, 0, 12, 9, 0.45}, {0, 60, 30, 12, 14, 0.49}, {11, 28, 5, 12, 28, 3.3}}},
    {"water that only flattens",
     "erode=off",
     4,
     {{0, 3, 31.1, 5.2, 0, 0}},
     {{0, 0, 0, 12, 9, 0.45}, {0, 60, 30, 12, 14, 0.49}, {11, 28, 5, 12, 28, 3.3}}},
    {"water that only thins",
     "smooth=off",
     3,
     {{0, 3, 31.1, 5.2, 0, 0}},
     {{0, 0, 0, 12, 9, 0.45}, {0, 60, 30, 12, 14, 0.49}, {11, 28, 5, 12, 28, 3.3}}},
    {"two that run side by side",
     "merge=off",
     4,
     {{0, 60, 14.1, 3.3, 0, 0}, {0, 40, 22.2, 3.1, 0, 0}},
     {{0}}},
    {"waters that lie over each other",
     "merge=off",
     3,
     {{0, 8, 14.1, 8.3, 0, 0}, {0, 18, 15.2, 8.1, 0, 0}},
     {{0}}},
    {"water at the pane's edge draws",
     "smooth=off erode=off",
     2,
     {{0, 30, 1.3, 4.3, 0, 0}},
     {{9, 0, 8, 2, 30, 0.3}, {10, 2, 8, 6, 30, 0.2}}},
    {"a drop that leaves in its first substep",
     "smooth=off erode=off",
     2,
     {{0, 40, 1.2, 4.2, 0, 600}},
     {{9, 0, 8, 2, 30, 0.3}}},
    {"drops that are removed",
     "remove_s=0.04",
     5,
     {{0, 18, 10.1, 8.2, 0, 0}, {0, 12, 25.2, 8.1, 0, 0}},
     {{0}}},
    {"two of which one lies straight below",
     "critical_mass_mg=100",
     3,
     {{0, 12, 14.1, 8.3, 0, 0}, {0, 12, 14.1, 10.8, 0, 0}},
     {{0}}},
    {"water as wide as two tiles",
     "smooth=off erode=off",
     2,
     {{0, 12, 10.1, 9.3, 0, 0}},
     {{9, 0, 20, 64, 20, 0.9}}},
    {"two pairs side by side",
     "critical_mass_mg=100",
     3,
     {{0, 12, 2.1, 8.3, 0, 0},
      {0, 11, 4.2, 8.4, 0, 0},
      {0, 12, 11.2, 8.3, 0, 0},
      {0, 10, 13.2, 8.2, 0, 0}},
     {{0}}},
    {"a drop over two tiles, in one of which others merge",
     "critical_mass_mg=100",
     4,
     {{0, 18, 4.1, 8, 0, 0}, {0, 12, 10.1, 12.3, 0, 0}, {0, 12, 12.3, 12.3, 0, 0}},
     {{0}}},
    {"a running drop and one beside its way",
     "",
     3,
     {{0, 40, 16.2, 4.3, 60, 200}, {0, 15, 19.5, 14.5, 0, 0}},
     {{0}}},
    {"a drop that runs aside into one at rest",
     "substeps=1 smooth=off erode=off",
     4,
     {{0, 40, 12.2, 4.3, 60, 200}, {0, 15, 21.2, 10.5, 0, 0}},
     {{0, 27, 4, 30, 40, 0.3}, {2, 34, 14, 10, 8, 0.6}}},
    {"a steep pane",
     "tilt_deg=50",
     6,
     {{0, 60, 16.1, 2.3, 0, 0}, {0, 22, 30.1, 2.3, 40, 40}},
     {{0}}},
    // The film loses two cells a step: first columns 29 and 30, then 31 and 32; column 32 is in
    // another tile.
    {"a film as low as stays wet, which ends before a tile's last cell",
     "",
     6,
     {{0, 3, 35.1, 20.2, 0, 0}},
     {{9, 29, 0, 43, 44, 41.0 / 4096}}},
    // Columns 32 to 63 are a tile. Only from above is the water in row 23 one with the rest.
    {"water that hangs from whole rows of a tile, when its drop merges",
     "smooth=off erode=off critical_mass_mg=100",
     3,
     {{0, 12, 20.1, 8.3, 0, 0}, {0, 11, 22.2, 8.4, 0, 0}},
     {{1, 32, 14, 32, 9, 0.6}, {1, 40, 23, 6, 6, 0.5}}},
    {0},
};

// Uneven, without ties, and the same for both.
static double affinity_at(int column, int row)
{
    return fmod(0.35 + 0.6180339887 * column + 0.7548776662 * row + 0.013 * column * row, 1);
}

static bool is_off(const struct scene *s, const char *name)
{
    const char *at = strstr(s->settings, name);
    return at && !strncmp(at + strlen(name), "=off", 4);
}

double scene_setting(const struct scene *s, const char *name, double otherwise)
{
    const char *at = strstr(s->settings, name);
    return at ? atof(at + strlen(name) + 1) : otherwise;
}

struct drops *scene_open(struct rg_device *device, const struct scene *s, const char *more)
{
    char text[256];
    snprintf(text, sizeof(text), "columns=%d rows=%d drops_s=0 meander_rad=0 residual=off %s %s",
             COLUMNS, ROWS, s->settings, more);
    struct drops *d = rig_open(device, text);
    float *affinity = rig_words(d, "affinity"), *height = rig_words(d, "height");
    uint32_t *ids = rig_words(d, "ids");
    for (int row = 0; row < ROWS; row++)
        for (int column = 0; column < COLUMNS; column++)
            affinity[drops_cell(d->params, column, row)] = (float)affinity_at(column, row);
    for (const struct puddle *p = s->puddles; p < s->puddles + 4; p++)
        for (int i = 0; i < p->columns * p->rows; i++) {
            const int at =
                drops_cell(d->params, p->column + i % p->columns, p->row + i / p->columns);
            height[at] = (float)p->height;
            ids[at] = p->id;
        }
    const char *const names[] = {"affinity", "height", "ids"};
    void *const words[] = {affinity, height, ids};
    for (int i = 0; i < 3; i++) {
        struct rg_buf *buf = rg_asset_find(&d->base, names[i])->buf;
        assert_true(rg_buf_write(buf, 0, words[i], (int64_t)buf->size));
        free(words[i]);
    }
    drops_drop all[MOST];
    int count = 0;
    for (const struct start *a = s->drops; a < s->drops + MOST && a->mg > 0; a++)
        all[count++] = (drops_drop){.parent = a->parent,
                                    .mass = (uint32_t)(a->mg * DROPS_QUANTA_MG),
                                    .x = (float)a->x,
                                    .y = (float)a->y,
                                    .vx = (float)a->vx,
                                    .vy = (float)a->vy};
    rig_put(d, all, count, 1);
    const uint32_t next = SCENE_NEXT_ID;
    assert_true(rg_buf_write(d->tally->buf, DROPS_NEXT_ID * 4, &next, sizeof(next)));
    return d;
}

void scene_open_model(struct oracle_drops *o, const struct scene *s)
{
    struct oracle_drops_settings settings = oracle_drops_defaults();
    settings.columns = COLUMNS;
    settings.rows = ROWS;
    settings.drops_a_step = settings.meander_rad = 0;
    settings.residual = false;
    settings.merge = !is_off(s, "merge");
    settings.smooth = !is_off(s, "smooth");
    settings.erode = !is_off(s, "erode");
    settings.critical_mass_mg = scene_setting(s, "critical_mass_mg", 20);
    settings.substeps = (int)scene_setting(s, "substeps", 4);
    settings.tilt_deg = scene_setting(s, "tilt_deg", 90);
    oracle_drops_open(o, &settings);
    for (int row = 0; row < ROWS; row++)
        for (int column = 0; column < COLUMNS; column++)
            o->affinity[row * COLUMNS + column] = affinity_at(column, row);
    for (const struct puddle *p = s->puddles; p < s->puddles + 4; p++)
        for (int i = 0; i < p->columns * p->rows; i++) {
            const int at = (p->row + i / p->columns) * COLUMNS + p->column + i % p->columns;
            o->height_mm[at] = p->height;
            o->id[at] = p->id;
        }
    oracle_drops_find_wet(o);
    for (const struct start *a = s->drops; a < s->drops + MOST && a->mg > 0; a++) {
        oracle_drops_add(o, a->x, ROWS * CELL_MM - a->y, a->mg);
        struct oracle_drop *drop = &o->drops[o->count - 1];
        drop->parent_id = a->parent;
        drop->vx_mm_s = a->vx;
        drop->vy_mm_s = -a->vy;
    }
    while (o->next_id < SCENE_NEXT_ID) // the puddles' owners, which no longer exist
        oracle_drops_end(o, &o->drops[oracle_drops_add(o, 1, 1, 1) - 1]);
    oracle_drops_clear_away(o);
}
