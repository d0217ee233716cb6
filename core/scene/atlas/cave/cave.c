#include "core/scene/atlas/cave/cave.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "core/base/alloc.h"
#include "core/scene/atlas/cave/factors.h"
#include "core/scene/atlas/cave/picture.h"
#include "core/scene/atlas/optics/drop.h"
#include "core/scene/atlas/levels.h"

// The database has the widths of levels 0 to 3.
enum { WIDTHS = 4, PATH_SIZE = 1024, SETS = RG_ATLAS_OSCILLATIONS * RG_ATLAS_VIEWS };

struct packing {
    const char *folder;
    struct rg_atlas *atlas;
    struct rg_cave_factors factors[RG_ATLAS_VIEWS];
    bool is_mirrored; // the light is on the left in the pictures
};

static bool is_file(const char *path)
{
    struct stat st;
    return !stat(path, &st) && S_ISREG(st.st_mode);
}

static void point_path(const struct packing *p, int oscillation, int view, int light, int phi,
                       int level, char path[PATH_SIZE])
{
    snprintf(path, PATH_SIZE, "%s/point_light_database/size%d/dcam%02d/cv%d_v%d_h%d_osc%d.png",
             p->folder, RG_ATLAS_CELL_PX >> level, 20 * view, 20 * view, 20 * light - 90,
             20 * phi + 10, oscillation);
}

// Packs a cell from one file for each of its levels.
static bool pack_cell(const struct packing *p, enum rg_atlas_part part, int oscillation, int view,
                      int column, const char paths[WIDTHS][PATH_SIZE], struct rg_cave_why *why)
{
    float *texels = malloc((size_t)(RG_ATLAS_CELL_PX * rg_atlas_row_height(0, 0)) * sizeof(float));
    bool good = texels || rg_cave_refuse(why, "%s: no memory to read it", paths[0]);
    for (int level = p->atlas->first_level; good && level < WIDTHS; level++) {
        good = rg_cave_read_picture(paths[level], RG_ATLAS_CELL_PX >> level,
                                    rg_atlas_row_height(view, level), p->is_mirrored, texels, why);
        if (good && level < WIDTHS - 1)
            rg_atlas_put_cell(p->atlas, part, oscillation, view, column, level, texels);
        else if (good)
            good = rg_atlas_put_cell_levels(p->atlas, part, oscillation, view, column, level,
                                            texels) ||
                   rg_cave_refuse(why, "%s: no memory to shrink it", paths[level]);
    }
    free(texels);
    return good;
}

// The azimuth under which a direction of light is stored: its own, or at the poles any that exists.
static int stored_phi(const struct packing *p, int oscillation, int view, int light, int phi)
{
    char path[PATH_SIZE];
    if (light != 0 && light != RG_ATLAS_LIGHTS - 1)
        return phi;
    for (int any = RG_ATLAS_PHIS - 1; any >= 0; any--) {
        point_path(p, oscillation, view, light, any, p->atlas->first_level, path);
        if (is_file(path) && p->factors[view].known[light][any])
            return any;
    }
    return RG_ATLAS_PHIS - 1;
}

static bool pack_point(const struct packing *p, int oscillation, int view, int cell,
                       struct rg_cave_why *why)
{
    const int light = cell / RG_ATLAS_PHIS;
    const int phi = stored_phi(p, oscillation, view, light, cell % RG_ATLAS_PHIS);
    char paths[WIDTHS][PATH_SIZE];
    for (int level = 0; level < WIDTHS; level++)
        point_path(p, oscillation, view, light, phi, level, paths[level]);
    if (!p->factors[view].known[light][phi])
        return rg_cave_refuse(why,
                              "%s/point_light_database/txt/dcam%02d_point_max.txt: no factors for "
                              "v%d h%d; copy the file again",
                              p->folder, 20 * view, 20 * light - 90, 20 * phi + 10);
    p->atlas->point_factor[oscillation][view][light][cell % RG_ATLAS_PHIS] =
        p->factors[view].factor[light][phi][oscillation] * RG_CAVE_POINT_SCALE;
    return pack_cell(p, RG_ATLAS_POINT, oscillation, view, cell, (const char(*)[PATH_SIZE])paths,
                     why);
}

static bool pack_set(const struct packing *p, int set, struct rg_cave_why *why)
{
    const int oscillation = set % RG_ATLAS_OSCILLATIONS, view = set / RG_ATLAS_OSCILLATIONS;
    for (int cell = 0; cell < RG_ATLAS_CELLS; cell++)
        if (!pack_point(p, oscillation, view, cell, why))
            return false;
    char paths[WIDTHS][PATH_SIZE];
    for (int level = 0; level < WIDTHS; level++)
        snprintf(paths[level], PATH_SIZE, "%s/env_light_database/size%d/cv%d_osc%d.png", p->folder,
                 RG_ATLAS_CELL_PX >> level, 20 * view, oscillation);
    return pack_cell(p, RG_ATLAS_ENV, oscillation, view, 0, (const char(*)[PATH_SIZE])paths, why);
}

static bool read_factors(struct packing *p, struct rg_cave_why *why)
{
    char path[PATH_SIZE];
    for (int view = 0; view < RG_ATLAS_VIEWS; view++) {
        snprintf(path, sizeof(path), "%s/point_light_database/txt/dcam%02d_point_max.txt",
                 p->folder, 20 * view);
        if (!rg_cave_point_factors(path, view, &p->factors[view], why))
            return false;
    }
    snprintf(path, sizeof(path), "%s/env_light_database/txt/normalized_env_max.txt", p->folder);
    if (!rg_cave_env_factors(path, p->atlas->env_factor, why))
        return false;
    const float front = p->atlas->env_factor[0][0];
    if (!(front > 0))
        return rg_cave_refuse(why, "%s: the first factor is 0; copy the file again", path);
    for (int k = 0; k < RG_ATLAS_OSCILLATIONS; k++)
        for (int view = 0; view < RG_ATLAS_VIEWS; view++)
            p->atlas->env_factor[k][view] *= (float)(1 / RG_DROP_FALL) / front;
    return true;
}

// Finds the light's side, which differs between copies of the database. A drop that does not
// oscillate is brightest on the side of a light at right angles to the view.
static bool find_side(struct packing *p, struct rg_cave_why *why)
{
    enum { OSCILLATION = 0, VIEW = 0, LIGHT = 5, PHI = 4 };
    const int level = p->atlas->first_level;
    const int width = RG_ATLAS_CELL_PX >> level, height = rg_atlas_row_height(VIEW, level);
    float *texels = malloc((size_t)(width * height) * sizeof(float));
    char path[PATH_SIZE];
    point_path(p, OSCILLATION, VIEW, LIGHT, PHI, level, path);
    const bool good = texels ? rg_cave_read_picture(path, width, height, false, texels, why)
                             : rg_cave_refuse(why, "%s: no memory to read it", path);
    p->is_mirrored = good && rg_cave_leaning(texels, width, height) > 0;
    free(texels);
    return good;
}

static bool pack_all(const struct packing *p, const struct rg_atlas_progress *progress,
                     struct rg_cave_why *why)
{
    int failed = 0, done = 0;
#pragma omp parallel for schedule(dynamic)
    for (int set = 0; set < SETS; set++) {
        struct rg_cave_why own;
        int stop;
#pragma omp atomic read
        stop = failed;
        const bool good = stop || pack_set(p, set, &own);
#pragma omp critical
        {
            if (!good && !failed)
                *why = own;
#pragma omp atomic update
            failed += !good;
            if (progress)
                progress->tell(progress->user, ++done, SETS);
        }
    }
    return !failed;
}

struct rg_atlas *rg_cave_pack(const char *folder, enum rg_atlas_size size,
                              const struct rg_atlas_progress *progress)
{
    struct rg_cave_why why = {"streak atlas: no memory to pack the database"};
    struct packing *p = rg_alloc(1, sizeof(*p), "streak database");
    if (!p)
        return NULL;
    p->folder = folder;
    p->atlas = rg_atlas_allocate(size);
    const bool good = p->atlas && read_factors(p, &why) && find_side(p, &why) &&
                      pack_all(p, progress, &why) && rg_atlas_finish(p->atlas);
    struct rg_atlas *atlas = p->atlas;
    free(p);
    if (good)
        return atlas;
    rg_atlas_destroy(atlas);
    return rg_error_null("%s", why.text);
}
