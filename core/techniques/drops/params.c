#include "core/techniques/drops/drops.h"

#define AT(field) offsetof(struct drops_settings, field)

// clang-format off
static const struct rg_param rows[] = {
    {"seed", RG_PARAM_INT, AT(seed), 1, 0, 2147483647, "1", "seed of all random numbers", NULL},
    {"columns", RG_PARAM_INT, AT(columns), 1000, 16, 8192, "1", "number of cells across the pane", NULL},
    {"rows", RG_PARAM_INT, AT(rows), 600, 16, 8192, "1", "number of cells from the top of the pane to the bottom", NULL},
    {"cell_mm", RG_PARAM_FLOAT, AT(cell_mm), 0.5, 0.1, 10, "mm", "side of a cell (l)", NULL},
    {"tilt_deg", RG_PARAM_FLOAT, AT(tilt_deg), 90, 0, 180, "deg", "tilt of the pane from lying flat; 90: upright, as in the paper", NULL},
    {"turn_deg", RG_PARAM_FLOAT, AT(turn_deg), 0, -180, 180, "deg", "turn of the pane in its plane; 180: upside down", NULL},
    {"max_drops", RG_PARAM_INT, AT(max_drops), 700, 1, 1000000, "1", "most drops at a time (n)", NULL},
    {"drops_s", RG_PARAM_FLOAT, AT(drops_s), 12, 0, 1000000, "1/s", "drops that land per second, by chance; the paper's program: one in every fifth step", NULL},
    {"critical_mass_mg", RG_PARAM_FLOAT, AT(critical_mass_mg), 20, 0.1, 10000, "mg", "mass of a drop that an upright pane just holds (m_c)", NULL},
    {"max_mass_mg", RG_PARAM_FLOAT, AT(max_mass_mg), 100, 0.1, 10000, "mg", "largest mass of a drop that lands (m_max)", NULL},
    {"meander_rad", RG_PARAM_FLOAT, AT(meander_rad), 0.3, 0, 1.2, "rad", "largest angle by which a drop that runs straight may turn aside (theta)", NULL},
    {"residual_beta", RG_PARAM_FLOAT, AT(residual_beta), 3, 0, 1000, "1", "how readily drops leave residual drops behind (beta)", NULL},
    {"residual_max_s", RG_PARAM_FLOAT, AT(residual_max_s), 0.1, 0.001, 10, "s", "time from one residual drop until the next is as likely as ever (tau_max)", NULL},
    {"residual_low", RG_PARAM_FLOAT, AT(residual_low), 0.1, 0, 1, "1", "smallest share of its mass that a drop leaves behind (alpha)", NULL},
    {"residual_high", RG_PARAM_FLOAT, AT(residual_high), 0.3, 0, 1, "1", "largest share of its mass that a drop leaves behind", NULL},
    {"step_s", RG_PARAM_FLOAT, AT(step_s), 1.0 / 60, 0.0001, 0.1, "s", "simulated time per frame", NULL},
    {"substeps", RG_PARAM_INT, AT(substeps), 4, 1, 64, "1", "number of parts of a step, in each of which drops choose their way anew (b)", NULL},
    {"remove_s", RG_PARAM_FLOAT, AT(remove_s), -1, -1, 1000000, "s", "time at which all drops are removed, so that water shrinks; -1: never", NULL},
    {"rules", RG_PARAM_CHOICE, AT(rules), DROPS_PAPER, 0, 1, "1", "units of how far drops see, the least drop, flattening and thinning: cells and steps, as in the paper, or mm and s; both agree at cells of 0.5 mm and steps of 1/60 s", "paper physical"},
    {"trail", RG_PARAM_CHOICE, AT(trail), DROPS_TRAIL_BEADS, 0, 2, "1", "trail of a drop: the paper's hemispheres 1.5 cells apart, one hemisphere swept along the line, or hemispheres that break into beads", "hemispheres lines beads"},
    {"erode_mm", RG_PARAM_FLOAT, AT(erode_mm), 0.01, 0, 10, "mm", "height below which water is removed, where it is smoothed (T_e)", NULL},
    {"owned_mm", RG_PARAM_FLOAT, AT(owned_mm), 0.5, 0, 10, "mm", "height below which water belongs to no drop, where it is smoothed (T_id)", NULL},
    {"erode", RG_PARAM_CHOICE, AT(erode), 1, 0, 1, "1", "whether trails become thinner", "off on"},
    {"merge", RG_PARAM_CHOICE, AT(merge), 1, 0, 1, "1", "whether drops whose water meets become one", "off on"},
    {"residual", RG_PARAM_CHOICE, AT(residual), 1, 0, 1, "1", "whether running drops leave residual drops behind", "off on"},
    {"smooth", RG_PARAM_CHOICE, AT(smooth), 1, 0, 1, "1", "whether water flattens", "off on"},
    {"sleep", RG_PARAM_CHOICE, AT(sleep), 1, 0, 1, "1", "whether work is skipped where nothing changes; the result is the same", "off on"},
    {"view", RG_PARAM_CHOICE, AT(view), DROPS_VIEW_PANE, 0, DROPS_VIEWS - 1, "1", "picture: the lit pane, the height map, the ID map, or drops over the height map", "pane height ids particles"},
    {"distance_mm", RG_PARAM_FLOAT, AT(distance_mm), 600, 100, 100000, "mm", "distance of the camera from the pane's middle", NULL},
    {"aperture_mm", RG_PARAM_FLOAT, AT(aperture_mm), 20, 0, 100, "mm", "width of the camera's lens, which is focused on the pane; 0: everything is sharp", NULL},
    {"refractive_index", RG_PARAM_FLOAT, AT(refractive_index), 1.333, 1, 3, "1", "refractive index of water", NULL},
    {"contact_mm", RG_PARAM_FLOAT, AT(contact_mm), 0.1, 0, 10, "mm", "height below which water bends no light", NULL},
    {"rays_px", RG_PARAM_INT, AT(rays_px), 2, 1, 8, "1", "rays along a side of a pixel of the lit pane", NULL},
    {"environment", RG_PARAM_FILE, AT(environment), 0, 0, 0, "file", "surroundings: 'street', 'street-night', 'sky', 'city' or 'city-night', a map of open3d-gui-data by name, a KTX cube map, or a lat-long image", "street"},
    {"environment_px", RG_PARAM_INT, AT(environment_px), 256, 16, 4096, "px", "texels along a face of the environment after resampling", NULL},
    {"background", RG_PARAM_FILE, AT(background), 0, 0, 0, "file", "picture behind the pane; none: the environment is visible", ""},
    {"background_m", RG_PARAM_FLOAT, AT(background_m), 20, 0.1, 100000, "m", "distance of the background behind the pane", NULL},
    {"background_deg", RG_PARAM_FLOAT, AT(background_deg), 90, 1, 170, "deg", "width of the background, seen from the pane; beyond its edges it is mirrored", NULL},
};
// clang-format on

const struct rg_param_table drops_param_table = {
    .technique = "drops",
    .rows = rows,
    .count = sizeof(rows) / sizeof(rows[0]),
    .settings_size = sizeof(struct drops_settings),
};
