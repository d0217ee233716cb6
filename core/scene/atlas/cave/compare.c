#include "core/scene/atlas/cave/compare.h"

#include <math.h>
#include <stdlib.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "core/scene/atlas/cave/picture.h"
#include "core/scene/atlas/levels.h"

enum { PIXELS = RG_ATLAS_CELL_PX * 1050 };

struct work {
    const struct rg_atlas *atlas;
    struct rg_cave_factors point[RG_ATLAS_VIEWS];
    float env[RG_ATLAS_OSCILLATIONS][RG_ATLAS_VIEWS];
    bool knows_point[RG_ATLAS_VIEWS], knows_env;
    float theirs[PIXELS], ours[PIXELS];
};

// --- ours ---

// The oscillation that is the mirror image of another: drops swing to one side or the other.
static int mirror_of(int oscillation)
{
    static const int mirrors[RG_ATLAS_OSCILLATIONS] = {0, 1, 4, 3, 2, 5, 8, 7, 6, 9};
    return mirrors[oscillation];
}

static void read_cell(const struct rg_atlas *atlas, const struct rg_cave_found *f, int oscillation,
                      int level, bool mirrored, float *texels)
{
    const enum rg_atlas_part part = f->env ? RG_ATLAS_ENV : RG_ATLAS_POINT;
    const int own = level - atlas->first_level, width = RG_ATLAS_CELL_PX >> level;
    const int column = f->env ? 0 : (f->light * RG_ATLAS_PHIS + f->phi) * width;
    const int pitch = atlas->images[part].width >> own,
              height = rg_atlas_row_height(f->view, level);
    const uint16_t *image = rg_atlas_texels(atlas, part, oscillation, own);
    for (int r = 0; r < height; r++)
        for (int c = 0; c < width; c++)
            texels[r * width + c] =
                rg_half_value(image[(rg_atlas_row_start(f->view, level) + r) * pitch + column +
                                    (mirrored ? width - 1 - c : c)]);
}

// --- figures ---

// Correlates two pictures (Pearson). False if one of them is constant.
static bool correlate(const float *a, const float *b, int count, double *correlation)
{
    double sum_a = 0, sum_b = 0, aa = 0, bb = 0, ab = 0;
    for (int i = 0; i < count; i++) {
        sum_a += (double)a[i];
        sum_b += (double)b[i];
    }
    for (int i = 0; i < count; i++) {
        const double x = (double)a[i] - sum_a / count, y = (double)b[i] - sum_b / count;
        aa += x * x;
        bb += y * y;
        ab += x * y;
    }
    *correlation = aa > 0 && bb > 0 ? ab / sqrt(aa * bb) : 0;
    return aa > 0 && bb > 0;
}

static double mean_of(const float *texels, int count)
{
    double sum = 0;
    for (int i = 0; i < count; i++)
        sum += (double)texels[i];
    return sum / count;
}

static double factor_of(const struct work *w, const struct rg_cave_found *f)
{
    if (f->env)
        return w->knows_env ? (double)w->env[f->oscillation][f->view] : 0;
    return w->knows_point[f->view] && w->point[f->view].known[f->light][f->phi]
               ? (double)w->point[f->view].factor[f->light][f->phi][f->oscillation]
               : 0;
}

static double own_factor_of(const struct rg_atlas *atlas, const struct rg_cave_found *f)
{
    return (double)(f->env ? atlas->env_factor[f->oscillation][f->view]
                           : atlas->point_factor[f->oscillation][f->view][f->light][f->phi]);
}

static bool compare_one(struct work *w, const struct rg_cave_found *f, struct rg_cave_row *row,
                        struct rg_cave_why *why)
{
    int level = w->atlas->first_level;
    if (!rg_cave_read_any(f->path, f->view, &level, w->theirs, why))
        return false;
    const int count = (RG_ATLAS_CELL_PX >> level) * rg_atlas_row_height(f->view, level);
    *row = (struct rg_cave_row){.found = *f};
    for (int way = 0; way < RG_CAVE_WAYS; way++) {
        const bool swings = way == RG_CAVE_OTHER_SIDE || way == RG_CAVE_OTHER_DROP;
        const bool mirrored = way == RG_CAVE_MIRRORED || way == RG_CAVE_OTHER_SIDE;
        read_cell(w->atlas, f, swings ? mirror_of(f->oscillation) : f->oscillation, level, mirrored,
                  w->ours);
        row->flat |= !correlate(w->ours, w->theirs, count, &row->correlation[way]);
        if (way == RG_CAVE_AS_IT_IS)
            row->ours = mean_of(w->ours, count) * own_factor_of(w->atlas, f);
    }
    row->theirs = mean_of(w->theirs, count) * factor_of(w, f);
    row->ours = row->theirs > 0 ? row->ours : 0;
    return true;
}

// --- all ---

static bool read_factors(const struct rg_cave_files *files, struct work *w, struct rg_cave_why *why)
{
    for (int view = 0; view < RG_ATLAS_VIEWS; view++) {
        const char *path = files->point_factors[view];
        w->knows_point[view] = *path;
        if (*path && !rg_cave_point_factors(path, view, &w->point[view], why))
            return false;
    }
    w->knows_env = *files->env_factors;
    return !w->knows_env || rg_cave_env_factors(files->env_factors, w->env, why);
}

static bool compare_all(struct work *w, const struct rg_cave_files *files,
                        const struct rg_atlas_progress *progress,
                        struct rg_cave_comparison *comparison, struct rg_cave_why *why)
{
    for (int i = 0; i < files->count; i++) {
        if (!compare_one(w, &files->items[i], &comparison->rows[i], why))
            return false;
        if (progress)
            progress->tell(progress->user, i + 1, files->count);
    }
    return true;
}

bool rg_cave_compare(const char *folder, const struct rg_atlas *atlas,
                     const struct rg_atlas_progress *progress,
                     struct rg_cave_comparison *comparison)
{
    struct rg_cave_files files;
    struct rg_cave_why why;
    if (!rg_cave_find(folder, &files, &why))
        return rg_error("%s", why.text);
    struct work *w = rg_alloc(1, sizeof(*w), "streak database");
    *comparison = (struct rg_cave_comparison){
        files.count, rg_alloc((size_t)files.count, sizeof(*comparison->rows), "streak database")};
    bool good = w && comparison->rows;
    if (good) {
        w->atlas = atlas;
        good =
            (read_factors(&files, w, &why) && compare_all(w, &files, progress, comparison, &why)) ||
            rg_error("%s", why.text);
    }
    if (!good)
        free(comparison->rows);
    free(w);
    free(files.items);
    return good;
}

bool rg_cave_has_pictures(const char *folder)
{
    struct rg_cave_files files;
    struct rg_cave_why why;
    if (!rg_cave_find(folder, &files, &why))
        return rg_error("%s", why.text);
    free(files.items);
    return true;
}
