#include "core/scene/atlas/cave/find.h"

#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "core/scene/atlas/cave/picture.h"

enum { DEEPEST = 8 }; // depth of nested folders; also ends cycles of links

struct search {
    struct rg_cave_files *files;
    struct rg_cave_why *why;
    int room;
};

// The index of an angle among `count` angles, 20 degrees apart from `first` on; -1: none.
static int index_of(int angle, int first, int count)
{
    const int index = (angle - first) / 20;
    return angle >= first && (angle - first) % 20 == 0 && index < count ? index : -1;
}

// Reads a picture's identity from a file name; false if it is not one of the database's.
static bool read_name(const char *name, struct rg_cave_found *found)
{
    int view, light = -90, phi = 10, k, end = 0;
    found->env = sscanf(name, "cv%d_osc%d.png%n", &view, &k, &end) == 2 && end;
    if (!found->env &&
        (sscanf(name, "cv%d_v%d_h%d_osc%d.png%n", &view, &light, &phi, &k, &end) != 4 || !end))
        return false;
    found->oscillation = k;
    found->view = index_of(view, 0, RG_ATLAS_VIEWS);
    found->light = index_of(light, -90, RG_ATLAS_LIGHTS);
    found->phi = index_of(phi, 10, RG_ATLAS_PHIS);
    return !name[end] && k >= 0 && k < RG_ATLAS_OSCILLATIONS && found->view >= 0 &&
           found->light >= 0 && found->phi >= 0;
}

static bool add_picture(struct search *s, const char *name, const char *path)
{
    struct rg_cave_files *files = s->files;
    struct rg_cave_found found;
    if (!read_name(name, &found))
        return true;
    found.width = rg_cave_picture_width(path);
    if (files->count == s->room) {
        s->room = s->room ? 2 * s->room : 256;
        void *items = realloc(files->items, (size_t)s->room * sizeof(*files->items));
        if (!items)
            return rg_cave_refuse(s->why, "%s: no memory for its name", path);
        files->items = items;
    }
    memcpy(found.path, path, RG_CAVE_PATH_SIZE);
    files->items[files->count++] = found;
    return true;
}

static void keep_factors(struct rg_cave_files *files, const char *name, const char *path)
{
    char wanted[64];
    for (int view = 0; view < RG_ATLAS_VIEWS; view++) {
        snprintf(wanted, sizeof(wanted), "dcam%02d_point_max.txt", 20 * view);
        if (!strcmp(name, wanted))
            memcpy(files->point_factors[view], path, RG_CAVE_PATH_SIZE);
    }
    if (!strcmp(name, "normalized_env_max.txt"))
        memcpy(files->env_factors, path, RG_CAVE_PATH_SIZE);
}

// Searches a folder in the order of names, so that messages are always the same.
static bool search_folder(struct search *s, const char *folder, int depth)
{
    struct dirent **entries;
    const int count = scandir(folder, &entries, NULL, alphasort);
    if (count < 0)
        return rg_cave_refuse(s->why, "%s: %s; name a folder with pictures of the database", folder,
                              strerror(errno));
    bool good = true;
    for (int i = 0; i < count; i++) {
        char path[RG_CAVE_PATH_SIZE] = "";
        struct stat st;
        const char *name = entries[i]->d_name;
        const bool fits = snprintf(path, sizeof(path), "%s/%s", folder, name) < (int)sizeof(path);
        if (good && name[0] != '.' && fits && !stat(path, &st)) {
            if (S_ISDIR(st.st_mode))
                good = depth >= DEEPEST || search_folder(s, path, depth + 1);
            else if (S_ISREG(st.st_mode)) {
                good = add_picture(s, name, path);
                keep_factors(s->files, name, path);
            }
        }
        free(entries[i]);
    }
    free(entries);
    return good;
}

static int place_of(const struct rg_cave_found *f)
{
    const int cell = f->light * RG_ATLAS_PHIS + f->phi;
    return ((f->env * RG_ATLAS_VIEWS + f->view) * RG_ATLAS_CELLS + cell) * RG_ATLAS_OSCILLATIONS +
           f->oscillation;
}

// Sorts by place in the atlas, the widest first.
static int compare_found(const void *a, const void *b)
{
    const struct rg_cave_found *x = a, *y = b;
    const int by_place = place_of(x) - place_of(y), by_width = y->width - x->width;
    if (by_place)
        return by_place;
    return by_width ? by_width : strcmp(x->path, y->path);
}

static void keep_widest(struct rg_cave_files *files)
{
    int kept = 0;
    qsort(files->items, (size_t)files->count, sizeof(*files->items), compare_found);
    for (int i = 0; i < files->count; i++)
        if (!kept || place_of(&files->items[i]) != place_of(&files->items[kept - 1]))
            files->items[kept++] = files->items[i];
    files->count = kept;
}

bool rg_cave_find(const char *folder, struct rg_cave_files *files, struct rg_cave_why *why)
{
    memset(files, 0, sizeof(*files));
    struct search search = {.files = files, .why = why};
    bool good = search_folder(&search, folder, 0);
    if (good && !files->count)
        good = rg_cave_refuse(why,
                              "%s: no picture of the database, such as cv0_v10_h90_osc1.png, is in "
                              "it; name another folder",
                              folder);
    if (good)
        keep_widest(files);
    else
        free(files->items);
    return good;
}
