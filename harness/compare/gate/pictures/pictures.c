#include "harness/compare/gate/pictures/pictures.h"

#include <stdio.h>
#include <string.h>

#include "core/base/log.h"
#include "core/image/files/io.h"
#include "harness/compare/diff/pair.h"
#include "harness/record/output.h"

static void prefix_of(const char *folder, const char *name, char prefix[PATH_MAX])
{
    char part[RG_OUTPUT_PART];
    rg_output_part(name, part);
    snprintf(prefix, PATH_MAX, "%.3800s/%s", folder, part);
}

void rg_gate_picture_path(const char *folder, const char *name, int picture, char path[PATH_MAX])
{
    static const char *const ends[RG_GATE_PICTURES] = {"a", "b", "flip", "difference"};
    char prefix[PATH_MAX];
    prefix_of(folder, name, prefix);
    snprintf(path, PATH_MAX, "%.4000s-%s.png", prefix, ends[picture]);
}

bool rg_gate_pictures_can_be_written(const char *folder, int64_t pixels)
{
    enum { BYTES_A_PIXEL = 3 };
    const int64_t linear = 2 * rg_picture_file_bytes("a.exr", pixels);
    if (strlen(folder) > PATH_MAX / 2)
        return rg_error("%.80s...: is too long a name for a folder; choose a shorter one", folder);
    return rg_output_can_be_written(folder, RG_GATE_PICTURES * BYTES_A_PIXEL * pixels + linear);
}

// Writes a side's picture as a screen shows it, and its linear light.
static bool write_side(const char *folder, const char *name, int side,
                       const struct rg_picture *picture)
{
    char path[PATH_MAX];
    rg_gate_picture_path(folder, name, side, path);
    if (!rg_picture_write(path, picture, &(struct rg_write_options){0}))
        return false;
    memcpy(path + strlen(path) - 3, "exr", 3);
    return rg_picture_write(path, picture, &(struct rg_write_options){.full_float = true});
}

bool rg_gate_pictures_write(const char *folder, const char *name, const struct rg_picture *a,
                            const struct rg_picture *b, const struct rg_comparison *comparison)
{
    char prefix[PATH_MAX];
    const bool ok = rg_output_folder(folder) && write_side(folder, name, 0, a) &&
                    write_side(folder, name, 1, b);
    prefix_of(folder, name, prefix);
    return ok && rg_pair_heatmaps(prefix, a, b, comparison);
}
