"""The atlas of streaks and splashes: its cells, levels, lobes and hash."""
from fault import Fault

TESTS = ("atlas, lobes", "atlas, rays", "atlas, cache", "atlas, database", "atlas, compared", "atlas, streaks", "atlas, splashed water",
         "atlas, brightness")
OWN_CACHE = True  # nobody may keep an atlas made by a fault

LOBES, LEVELS = "core/scene/atlas/lights.c", "core/scene/atlas/levels.c"
SPLASH, WATER = "core/scene/atlas/splash.c", "core/scene/atlas/optics/water.c"
DROP, RAYS = "core/scene/atlas/optics/drop.c", "core/scene/atlas/optics/trace.c"
FIND, COMPARE, FIGURES = "core/scene/atlas/cave/find.c", "core/scene/atlas/cave/compare.c", "harness/atlas/compare.c"

ROWS = [
    Fault(LOBES, "direction[0] = (float)(cos(elevation) * «sin(azimuth)»);", "-sin(azimuth)", "lights of the atlas are mirrored"),
    Fault(LOBES, "return 1 + (light - 1) * «RG_ATLAS_PHIS» + phi;", "(RG_ATLAS_PHIS - 1)", "cells of the atlas share lobes"),
    Fault(LOBES, "return «4» * half * (sin(elevation + half)", "2", "a lobe's share of the sphere is half"),
    Fault(LOBES, "lobes->peak = (float)(«1» / irradiance);", "0.5", "lobes have half their light"),
    Fault(LOBES, "cos((RG_LAMP_DEG + RG_RIM_DEG) * M_PI / 180 «+ SQUARE_REACH_RAD»);", "- SQUARE_REACH_RAD", "lobes end at the grid's lines"),
    Fault(DROP, "(float)((is_database ? «0» : MEASURED_REST_A20) +", "MEASURED_REST_A20", "the database's drops are flat at rest"),
    Fault(DROP, "&(is_database ? «database : measured»)[oscillation];", "measured : database", "the two sets of swings are exchanged"),
    Fault(DROP, ".blind = is_database ? «BLIND» : 0", "0", "light runs along the wall of the database's drops"),
    Fault(RAYS, "seen = «t < s.blind» ? 0.0f : 1.0f;", "t > s.blind", "light passes far walls, not near ones"),
    Fault(RAYS, "keep(row, way, i, along(scaled(inside.refracted, seen), «1 - seen», d),", "0", "light that passes a near wall is refracted there"),
    Fault(LEVELS, "{\"small\",          true,  false, «RG_ATLAS_MEASURED_SMALL»,", "RG_ATLAS_MEASURED", "the small atlas of measured swings is the full one"),
    Fault(LOBES, "return ((2 * axis + «(d[axis] < 0)») * RG_LOBE_GRID", "(d[axis] > 0)", "rays look up the opposite lobes"),
    Fault(LEVELS, "return (rows[view + 1] >> level) «- (rows[view] >> level)»;", "- 0", "rows of the atlas overlap"),
    Fault(LEVELS, "rg_float_bits(value) + «0x1000u»", "0u", "the atlas' halves are cut off, not rounded"),
    Fault(LEVELS, "return sum «/ area»;", "/ 1", "a smaller level of the atlas is brighter"),
    Fault(LEVELS, "return to > from ? «to - from» : 0;", "1", "a pixel that is shared counts wholly"),
    Fault(LEVELS, "return layer_texels * (size_t)layer + «rg_atlas_image_texels(&above)»;", "0", "levels of the atlas lie upon each other"),
    Fault(FIND, "by_width = «y->width - x->width»;", "x->width - y->width", "of a picture's widths the smallest is compared"),
    Fault(FIND, "return «!name[end]» && k >= 0", "true", "names that only begin like the database's are taken"),
    Fault(COMPARE, "return «mirrors[oscillation]»;", "oscillation == 2 ? 2 : mirrors[oscillation]", "a drop that swings to the right is its own mirror image"),
    Fault(COMPARE, "(«mirrored» ? width - 1 - c : c)", "false", "no picture is laid beside ours mirrored"),
    Fault(COMPARE, "const double x = (double)a[i] «- sum_a / count»", "- 0", "pictures correlate about black, not their mean"),
    Fault(COMPARE, "row->flat |= «!correlate(w->ours, w->theirs, count, &row->correlation[way])»;", "(correlate(w->ours, w->theirs, count, &row->correlation[way]), false)", "even pictures count as unlike"),
    Fault(FIGURES, "above += «value > GOOD»;", "value > 0.5", "pictures above one half count as good"),
    Fault(FIGURES, "const double x = «log(row->ours)», y", "row->ours", "brightness is compared by itself, not by its logarithm"),
    Fault(WATER, "follow(w, ball, at, out, left * «mirrors», deep + 1, light);", "0", "balls of a splash mirror nothing"),
    Fault(WATER, "left * (reflectance(facing) «- reflectance(-way[1])»)", "- 0", "a wave mirrors what flat water does, too"),
    Fault(WATER, "along(inside, «-2 * after», normal, inside);", "-1 * after", "light leaves a ball askew after its reflection inside"),
    Fault(SPLASH, "atan2(fabs(from[0]), «-from[2]») * steps", "from[2]", "lights show on splashes from behind as from before"),
    Fault(SPLASH, "light->cells[height][phi] / (sum «* cell_sr»)", "* 1", "lights show on splashes alike however wide their cell"),
]
