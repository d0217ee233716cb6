#include <math.h>

#include "core/techniques/scenery/lights/lights.h"
#include "core/techniques/streaks/packets/packets.h"
#include "core/techniques/streaks/streaks.h"

#define AT(field) offsetof(struct streaks_settings, field)

// clang-format off
static const struct rg_param rows[] = {
    {"seed", RG_PARAM_INT, AT(seed), 1, 0, 2147483647, "1", "seed of the particles", NULL},
    {"rain_width_m", RG_PARAM_FLOAT, AT(rain_width_m), 400, 1, 100000, "m", "width of the rain space, along x", NULL},
    {"rain_depth_m", RG_PARAM_FLOAT, AT(rain_depth_m), 400, 1, 100000, "m", "depth of the rain space, along z", NULL},
    {"rain_height_m", RG_PARAM_FLOAT, AT(rain_height_m), 230, 1, 10000, "m", "height of the rain space, along the fall", NULL},
    {"slant_deg", RG_PARAM_FLOAT, AT(slant_deg), 0, 0, 60, "deg", "angle by which the fall leans from straight down", NULL},
    {"slant_azimuth_deg", RG_PARAM_FLOAT, AT(slant_azimuth_deg), 0, -360, 360, "deg", "direction that the fall leans to: 0 along x, 90 along z", NULL},
    {"density_map", RG_PARAM_FILE, AT(density_map), 0, 0, 0, "file", "image whose grey is the density of drops, white the densest; none: a round gradient", ""},
    {"drops_m2_s", RG_PARAM_FLOAT, AT(drops_m2_s), STREAKS_DEFAULT_DROPS_M2_S, 1e-6, 1e9, "1/(m2 s)", "drops per square metre and second where the density map is white", NULL},
    {"fall_speed_m_s", RG_PARAM_FLOAT, AT(fall_speed_m_s), 8.16, 0.01, 1000, "m/s", "fall speed of all drops", NULL},
    {"spectrum", RG_PARAM_CHOICE, AT(spectrum), 1, 0, 2, "1", "sizes of drops: off: one size, by drops_m2_s, fall_speed_m_s and drop_radius_mm; or as many of each size as Marshall and Palmer, or Best, found for rain_mm_h, whatever those three are set to", "off marshall-palmer best"},
    {"rain_mm_h", RG_PARAM_FLOAT, AT(rain_mm_h), 20, 0.1, 500, "mm/h", "rain rate of the spectrum where the density map is white", NULL},
    {"normalised", RG_PARAM_CHOICE, AT(normalised), 1, 0, 1, "1", "number of drops of the spectrum: on: so many that those of 0.1 to 6 mm make rain_mm_h; off: as many as its authors give, which make somewhat more or less", "off on"},
    {"least_diameter_mm", RG_PARAM_FLOAT, AT(least_diameter_mm), 0.3, 0.1, 5, "mm", "diameter of the spectrum's smallest drops; smaller ones are left out", NULL},
    {"terminal_speed", RG_PARAM_CHOICE, AT(terminal_speed), 0, 0, 1, "1", "fall speed of the spectrum's drops by their size: as Gunn and Kinzer measured it, or by Atlas' fit", "gunn-kinzer atlas"},
    {"kept_share", RG_PARAM_FLOAT, AT(kept_share), 0.12, 1e-6, 1, "1", "share of the spectrum's drops that exists; each of these stands for more drops", NULL},
    {"kept", RG_PARAM_CHOICE, AT(kept), 2, 0, 2, "1", "which of the spectrum's drops exist: all sizes alike; by cross-section, so that small drops stand for many and large ones for few; or by cross-section over speed, so that all streaks are about as bright", "alike section streak"},
    {"local_height_m", RG_PARAM_FLOAT, AT(local_height_m), 20, 0.1, 10000, "m", "height of the local space, in which rain is drawn as particles", NULL},
    {"culling_radius_m", RG_PARAM_FLOAT, AT(culling_radius_m), 20, 0.1, 100000, "m", "radius around the observer within which it rains", NULL},
    {"limits", RG_PARAM_CHOICE, AT(limits), 1, 0, 1, "1", "whether rain keeps to the culling radius; off: there is none, and the local space is repeated up and down", "off on"},
    {"fit", RG_PARAM_CHOICE, AT(fit), 0, 0, 1, "1", "whether to search for the smallest culling_radius_m and local_height_m, whatever they are set to, that show the first frame within fit_error", "off on"},
    {"fit_error", RG_PARAM_FLOAT, AT(fit_error), 0.05, 0.001, 1, "1", "for fit: largest mean FLIP over the pixels with rain, against limits=off; a just noticeable difference is 0.1", NULL},
    {"packets", RG_PARAM_CHOICE, AT(scheme), 0, 0, 4, "1", "how particles are grouped; auto: the way with the fewest packets", "auto world kd quad grid"},
    {"packet_size", RG_PARAM_INT, AT(packet_size), 50000, 1, 1000000000, "1", "most particles in a packet", NULL},
    {"select", RG_PARAM_CHOICE, AT(select), 0, 0, 1, "1", "selection of packets by bounding rectangles of view and culling radius, or by the convex hull of what both see", "rect hull"},
    {"cull", RG_PARAM_CHOICE, AT(exact), 0, 0, 1, "1", "how particles are culled: only with their packets, or also one by one at the culling radius", "packets exact"},
    {"blocks", RG_PARAM_CHOICE, AT(all_blocks), 0, 0, 1, "1", "which of the packets' blocks of 32 particles are drawn: those that can be seen, or all, as in the thesis", "seen all"},
    {"sparse", RG_PARAM_INT, AT(sparse), 1, 1, 1024, "1", "share of the blocks that is drawn, as one in so many: less rain, for a quick look at how other settings change times", NULL},
    {"order", RG_PARAM_CHOICE, AT(by_id), 0, 0, 1, "1", "order of drawing: packet by packet, or by the numbers of the particles, whatever their packets", "packet id"},
    {"memory_mb", RG_PARAM_INT, AT(memory_mb), 8192, 1, 1000000, "MB", "most memory that particles may take", NULL},
    {"depth_map", RG_PARAM_CHOICE, AT(dynamic_map), 0, 0, 1, "1", "depth map of the scene along the fall: drawn once for the whole rain space, or repeatedly around the observer", "static dynamic"},
    {"depth_map_px", RG_PARAM_INT, AT(map_px), 8192, 16, 16384, "px", "side of the depth map", NULL},
    {"depth_map_period", RG_PARAM_INT, AT(map_period), 1, 1, 100000, "frames", "frames between two drawings of a dynamic depth map", NULL},
    {"scene", RG_PARAM_FILE, AT(scene), 0, 0, 0, "file", "place where it rains: 'city', a model by name, or a mesh file", "city"},
    {"city", RG_PARAM_CHOICE, AT(city), 0, 0, 1, "1", "version of the city: the one of 779,287 triangles, or a simpler one", "full small"},
    {"city_seed", RG_PARAM_INT, AT(city_seed), 1, 0, 2147483647, "1", "seed of the city", NULL},
    {"geometry", RG_PARAM_CHOICE, AT(geometry), 1, 0, 1, "1", "whether the scene is drawn", "off on"},
    {"time", RG_PARAM_CHOICE, AT(time), 0, 0, 1, "1", "time of day", "day night"},
    {"camera", RG_PARAM_CHOICE, AT(camera), STREAKS_FIRST, 0, 2, "1", "view: one of the thesis's two, or eye and target as given", "first second free"},
    {"eye_x_m", RG_PARAM_FLOAT, AT(eye_x_m), 0, -1e6, 1e6, "m", "x of the free camera's place", NULL},
    {"eye_y_m", RG_PARAM_FLOAT, AT(eye_y_m), 1.7, -1e6, 1e6, "m", "height of the free camera above the ground", NULL},
    {"eye_z_m", RG_PARAM_FLOAT, AT(eye_z_m), 0, -1e6, 1e6, "m", "z of the free camera's place", NULL},
    {"target_x_m", RG_PARAM_FLOAT, AT(target_x_m), 0, -1e6, 1e6, "m", "x of the point that the free camera looks at", NULL},
    {"target_y_m", RG_PARAM_FLOAT, AT(target_y_m), 5, -1e6, 1e6, "m", "y of the point that the free camera looks at", NULL},
    {"target_z_m", RG_PARAM_FLOAT, AT(target_z_m), 40, -1e6, 1e6, "m", "z of the point that the free camera looks at", NULL},
    {"view_angle_deg", RG_PARAM_FLOAT, AT(view_angle_deg), 50, 1, 150, "deg", "vertical angle of view", NULL},
    {"walk_m_s", RG_PARAM_FLOAT, AT(walk_m_s), 0, -1000, 1000, "m/s", "speed at which the camera walks ahead, swaying and bobbing", NULL},
    {"step_s", RG_PARAM_FLOAT, AT(step_s), 1.0 / 60, 1e-4, 1, "s", "simulated time per frame", NULL},
    {"lights", RG_PARAM_INT, AT(lights), SCENERY_USUAL_LIGHTS, SCENERY_USUAL_LIGHTS, 16, "1", "number of the scene's lights that shine; -1: by day the sun, by night 16 lights", NULL},
    {"lights_file", RG_PARAM_FILE, AT(lights_file), 0, 0, 0, "file", "JSON file with lights in place of the scene's", ""},
    {"environment_light", RG_PARAM_CHOICE, AT(environment_light), 1, 0, 1, "1", "whether the sky lights particles", "off on"},
    {"shadows", RG_PARAM_CHOICE, AT(shadows), 1, 0, 1, "1", "whether the scene casts shadows on itself and on particles", "off on"},
    {"shadow_map_px", RG_PARAM_INT, AT(shadow_map_px), 2048, 16, 8192, "px", "side of a light's shadow map", NULL},
    {"atlas", RG_PARAM_CHOICE, AT(atlas), 0, 0, 3, "1", "atlas of streak textures: the whole one, one of a quarter of the size, or the original database as `raingauge atlas --from` packed it, or with --quick", "full small cave cave-small"},
    {"swings", RG_PARAM_CHOICE, AT(swings), 0, 0, 1, "1", "shape and oscillation of drops in traced atlases: flat and slight as in wind tunnels, or strong as in the original database", "measured database"},
    {"taps", RG_PARAM_CHOICE, AT(taps), 0, 0, 2, "1", "number of streak textures read for each light", "2 4 8"},
    {"view_below", RG_PARAM_CHOICE, AT(absolute_views), 0, 0, 1, "1", "streaks seen from below: mirrored with their light, or, as in the thesis, as if seen from above", "mirrored absolute"},
    {"last_mip", RG_PARAM_INT, AT(last_mip), 5, 0, 5, "1", "coarsest level of the streak atlas that is read", NULL},
    {"thin_streaks", RG_PARAM_CHOICE, AT(points), 0, 0, 1, "1", "streaks thinner than a pixel: drawn a pixel wide and fainter, or only where they cover a pixel's middle, as in the thesis", "area points"},
    {"look", RG_PARAM_CHOICE, AT(look), 0, 0, 1, "1", "group of settings, which later settings override: rain of a spectrum, as bright as in a photograph, or as in the thesis's figures, of one size, with streaks brighter than real ones and without far rain", "photograph thesis"},
    {"drops", RG_PARAM_CHOICE, AT(drops), 1, 0, 1, "1", "whether drops are visible", "off on"},
    {"splashes", RG_PARAM_CHOICE, AT(splashes), 1, 0, 1, "1", "whether splashes are visible", "off on"},
    {"splash_materials", RG_PARAM_CHOICE, AT(splash_materials), 1, 0, 1, "1", "whether the form of splashes follows the surface, water, rough or smooth, or is the same for all", "off on"},
    {"splash_up", RG_PARAM_CHOICE, AT(splashes_upright), 0, 0, 1, "1", "direction of splashes: along the normal of what is hit, or upright, as in the thesis", "normal vertical"},
    {"drop_radius_mm", RG_PARAM_FLOAT, AT(drop_radius_mm), 1.6, 0.05, 10, "mm", "radius of all drops", NULL},
    {"exposure_s", RG_PARAM_FLOAT, AT(exposure_s), 1.0 / 60, 1e-4, 1, "s", "time for which the camera's shutter is open, which sets the length of streaks", NULL},
    {"splash_s", RG_PARAM_FLOAT, AT(splash_s), 0.126, 0.001, 10, "s", "duration of a splash", NULL},
    {"splash_width_mm", RG_PARAM_FLOAT, AT(splash_width_mm), 60, 0.1, 10000, "mm", "width of the picture of a splash, two thirds as high, for a drop of 1.6 mm radius; that of others in proportion to the drop", NULL},
    {"streak_gain", RG_PARAM_FLOAT, AT(streak_gain), 1, 0, 1000, "1", "factor of the light of streaks", NULL},
    {"streak_opacity", RG_PARAM_FLOAT, AT(streak_opacity), 1, 0, 40, "1", "opacity of streaks, as a multiple of the share of the exposure for which drops cover what lies behind", NULL},
    {"splash_gain", RG_PARAM_FLOAT, AT(splash_gain), 1, 0, 1000, "1", "factor of the light of splashes", NULL},
    {"splash_opacity", RG_PARAM_FLOAT, AT(splash_opacity), 1, 0, 40, "1", "opacity of splashes, as a multiple of the share of the light behind that they replace", NULL},
    {"splash_light", RG_PARAM_CHOICE, AT(splash_matt), 0, 0, 1, "1", "how splashes show lights: as clear water does, or as matt white, as in the thesis", "water matt"},
    {"splash_fade", RG_PARAM_FLOAT, AT(splash_fade), 0.25, 0, 1, "1", "outer share of the culling radius in which splashes fade away, so that none visibly ends there", NULL},
    {"far_layers", RG_PARAM_INT, AT(far_layers), 4, 0, 64, "1", "layers of rain beyond the culling radius, each as thick as the radius, which add and hide as much light as their drops would; with limits=off it rains there anyway", NULL},
    {"overlay", RG_PARAM_CHOICE, AT(overlay), 0, 0, 2, "1", "lines over the picture: rain space, local space, culling radius, packets and lights; or lights alone", "off on lights"},
    {"outside", RG_PARAM_CHOICE, AT(outside), 0, 0, 3, "1", "second camera, which looks at the whole rain space, at the volume in which it rains around the observer, or, with limits=off, at a rain space that is a perspective camera's frustum, along whose rays drops fall; drops are marks in the colour of their height", "off space volume frustum"},
    {"outside_turn_deg", RG_PARAM_FLOAT, AT(outside_turn_deg), 30, -360, 360, "deg", "azimuth of the second camera around what it looks at: 0 along x, 90 along z", NULL},
    {"outside_rise_deg", RG_PARAM_FLOAT, AT(outside_rise_deg), 25, 1, 89, "deg", "elevation of the second camera above the horizon", NULL},
    {"outside_map", RG_PARAM_CHOICE, AT(outside_map), 0, 0, 2, "1", "for outside: map that lies over the rain; white is the densest place, or the highest", "none density depth"},
    {"state", RG_PARAM_CHOICE, AT(keeps_state), 0, 0, 1, "1", "whether to keep each frame's particles, for comparisons of states", "off on"},
};
// clang-format on

// In the order of the choices; the first has the defaults.
static const char *const looks[] = {
    "spectrum=marshall-palmer swings=measured thin_streaks=area streak_gain=1 streak_opacity=1 "
    "far_layers=4 splash_materials=on "
    "splash_up=normal splash_s=0.126 splash_width_mm=60 splash_gain=1 splash_opacity=1 "
    "splash_light=water splash_fade=0.25",
    "spectrum=off swings=database thin_streaks=points streak_gain=4 streak_opacity=3 far_layers=0 "
    "splash_materials=off "
    "splash_up=vertical splash_s=0.15 splash_width_mm=40 splash_gain=0.35 splash_opacity=0.35 "
    "splash_light=matt splash_fade=0",
};

const struct rg_param_table streaks_param_table = {
    .technique = "streaks",
    .rows = rows,
    .count = sizeof(rows) / sizeof(rows[0]),
    .settings_size = sizeof(struct streaks_settings),
    .preset = "look",
    .presets = looks,
};

double streaks_widest_m(const struct streaks_settings *set)
{
    return hypot(set->rain_width_m, set->rain_depth_m);
}
