// The scene's depth map from straight above, which shows where particles land.
#include "core/scene/matrix.h"
#include "core/techniques/shower/instance.h"

// Sets the map to cover the scene, with a margin so that its highest and lowest parts are not cut.
static void set_extent(shower_params *p, const struct city_faces *faces)
{
    const float margin_m = 1;
    p->map_x = faces->low[0];
    p->map_z = faces->low[2];
    p->map_per_x = 1 / (faces->high[0] - faces->low[0]);
    p->map_per_z = 1 / (faces->high[2] - faces->low[2]);
    p->map_top_m = faces->high[1] + margin_m;
    p->map_height_m = p->map_top_m - (faces->low[1] - margin_m);
}

// The matrix from the world to the map's clip space: rows run along z, depth downwards.
static m4 matrix_of(const shower_params *p)
{
    float rows[16] = {0};
    rows[0] = 2 * p->map_per_x;
    rows[3] = -2 * p->map_per_x * p->map_x - 1;
    rows[6] = 2 * p->map_per_z;
    rows[7] = -2 * p->map_per_z * p->map_z - 1;
    rows[9] = -1 / p->map_height_m;
    rows[11] = p->map_top_m / p->map_height_m;
    rows[15] = 1;
    return rg_m4_of(rows);
}

// Without a scene to land on, every place is outside the map.
static void set_no_extent(shower_params *p)
{
    p->map_x = p->map_z = 1e9f;
    p->map_per_x = p->map_per_z = p->map_top_m = p->map_height_m = 1;
}

bool shower_add_heights(struct shower *s)
{
    const bool is_drawn = s->scene && s->settings.lands_on_mesh;
    const int side_px = is_drawn ? s->settings.map_px : 1;
    const float farthest = 1;
    const struct rg_asset *heights = rg_add_image(&s->base, "heights", RG_D32F, side_px, side_px);
    if (!is_drawn) {
        set_no_extent(&s->params);
        return heights;
    }
    set_extent(&s->params, &scenery_city(s->scene)->faces);
    const struct rg_draw onto = {.depth = heights ? heights->image : NULL,
                                 .depth_mode = RG_DEPTH_WRITE};
    return heights && rg_image_clear(heights->image, &farthest) &&
           scenery_depth(s->scene, matrix_of(&s->params), &onto);
}
