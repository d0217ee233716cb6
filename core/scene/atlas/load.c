// Loads the atlas of a size from the cache, or makes it and stores it there.
#include "core/base/log.h"
#include "core/scene/atlas/cache.h"

struct rg_atlas *rg_atlas_load(enum rg_atlas_size size, const struct rg_atlas_progress *progress)
{
    char path[RG_ATLAS_PATH_SIZE] = "streak atlas", why[256], gone[256];
    enum rg_atlas_cached state;
    const bool kept = rg_atlas_cache_path(size, path, why);
    struct rg_atlas *atlas = rg_atlas_cache_read(size, &state, gone);
    if (atlas)
        return atlas;
    const struct rg_atlas_kind *kind = &rg_atlas_kinds[size];
    if (kind->is_packed)
        return rg_error_null("%s: %s; `raingauge atlas %s--from DIR` packs the original database",
                             path, gone, kind->is_small ? "--quick " : "");
    if (state != RG_ATLAS_ABSENT)
        rg_warning("%s: %s; the streak atlas is made anew", path, gone);
    else if (!kind->is_small)
        rg_info("the streak atlas is made, which takes a minute or two%s%s",
                kept ? ", and kept as " : "", kept ? path : "");
    atlas = rg_atlas_make(size, progress);
    if (atlas && !rg_atlas_cache_write(atlas, why))
        rg_warning("the streak atlas is not kept: %s", why);
    return atlas;
}
