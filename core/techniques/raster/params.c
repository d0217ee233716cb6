#include "core/techniques/raster/raster.h"

#define AT(field) offsetof(struct raster_settings, field)

// clang-format off
static const struct rg_param rows[] = {
    {"scene", RG_PARAM_CHOICE, AT(scene), RASTER_BILLBOARDS, 0, RASTER_SCENES - 1, "1", "scene to draw: streaks of rain, a model, a finely divided knot, or panes of all sizes", "billboards mesh triangles quads"},
    {"seed", RG_PARAM_INT, AT(seed), 1, 0, 2147483647, "1", "seed of the drops and the quads", NULL},
    {"share", RG_PARAM_FLOAT, AT(share), 1, 0, 1, "1", "share of the scene's items that is drawn, from the first on", NULL},
    {"count", RG_PARAM_CHOICE, AT(count), 0, 0, 1, "1", "whether to count the items that cover a pixel centre, and these pixels, in one more draw", "off on"},
    {"blend", RG_PARAM_CHOICE, AT(blend), 0, 0, 3, "1", "blending with the target's colours; scene: over for billboards and quads, off for others", "scene off over add"},
    {"depth", RG_PARAM_CHOICE, AT(depth), 0, 0, 3, "1", "depth test and writes; scene: write for mesh and triangles, off for others", "scene off test write"},
    {"cull", RG_PARAM_CHOICE, AT(cull), 0, 0, 3, "1", "faces that are culled; scene: those of closed meshes that face away, none of others", "scene none back front"},
    {"format", RG_PARAM_CHOICE, AT(format), RASTER_RGBA16F, 0, 2, "1", "format of the image that is drawn to; others than rgba16f are copied to the target", "rgba16f rgba8 rgba32f"},
    {"billboards", RG_PARAM_INT, AT(billboards), 785000, 1, 10000000, "1", "number of drops in the air", NULL},
    {"reach_m", RG_PARAM_FLOAT, AT(reach_m), 20, 1, 1000, "m", "depth of the layer of air that holds drops, ahead of the eye", NULL},
    {"air_width_m", RG_PARAM_FLOAT, AT(air_width_m), 40, 1, 1000, "m", "width of the layer of air that holds drops, across the view", NULL},
    {"air_height_m", RG_PARAM_FLOAT, AT(air_height_m), 27.5, 1, 1000, "m", "height of the layer of air that holds drops; the eye is at half this height", NULL},
    {"view_angle_deg", RG_PARAM_FLOAT, AT(view_angle_deg), 45, 1, 150, "deg", "vertical angle of view on billboards", NULL},
    {"streak_radius_mm", RG_PARAM_FLOAT, AT(streak_radius_mm), 1.6, 0.001, 1000, "mm", "half the width of a streak", NULL},
    {"streak_length_mm", RG_PARAM_FLOAT, AT(streak_length_mm), 136, 0.001, 10000, "mm", "length of a streak: how far a drop falls in 1/60 s", NULL},
    {"fall_m_s", RG_PARAM_FLOAT, AT(fall_m_s), 8.16, 0.01, 100, "m/s", "speed of drops downwards", NULL},
    {"wind_m_s", RG_PARAM_FLOAT, AT(wind_m_s), 0.02, -100, 100, "m/s", "speed of drops to the right, which tilts the streaks", NULL},
    {"step_s", RG_PARAM_FLOAT, AT(step_s), 1.0 / 60, 1e-4, 1, "s", "simulated time per frame", NULL},
    {"opacity", RG_PARAM_FLOAT, AT(opacity), 0.5, 0, 1, "1", "opacity of a streak", NULL},
    {"model", RG_PARAM_FILE, AT(model), 0, 0, 0, "file", "mesh to draw: a name such as bunny, armadillo or torus, or a file", "bunny"},
    {"faces", RG_PARAM_INT, AT(faces), 0, 0, 10000000, "1", "number of faces that the model is decimated or refined to; 0: as it comes", NULL},
    {"triangles", RG_PARAM_INT, AT(triangles), 1000000, 1000, 10000000, "1", "approximate number of faces of the knot", NULL},
    {"view", RG_PARAM_INT, AT(view), 0, 0, RASTER_VIEWS - 1, "1", "corner of a dodecahedron around the mesh from which it is seen", NULL},
    {"inside", RG_PARAM_INT, AT(inside), 0, 0, 1, "1", "1: the eye is in the middle of the mesh's bounds and looks towards that corner", NULL},
    {"zoom", RG_PARAM_FLOAT, AT(zoom), 1, 0.01, 1000, "1", "factor by which the eye is nearer; 1: the whole mesh is in the picture", NULL},
    {"near", RG_PARAM_FLOAT, AT(near_plane), 0.02, 1e-4, 10, "size/2", "distance of the near plane, which cuts off the mesh, in halves of its longest side", NULL},
    {"shift_px", RG_PARAM_FLOAT, AT(shift_px), 0, -1000, 1000, "px", "shift of the mesh's picture to the right", NULL},
    {"turn_deg", RG_PARAM_FLOAT, AT(turn_deg), 1, -180, 180, "deg/frame", "turn per frame: of the mesh about its upright axis, and of the quads in their plane", NULL},
    {"quads", RG_PARAM_INT, AT(quads), 2000, 1, 1000000, "1", "number of overlapping panes", NULL},
};
// clang-format on

const struct rg_param_table raster_param_table = {
    .technique = "raster",
    .rows = rows,
    .count = sizeof(rows) / sizeof(rows[0]),
    .settings_size = sizeof(struct raster_settings),
};
