"""The atlas of streaks and splashes: its cells, levels, lobes and hash."""
from fault import Fault

TESTS = ("atlas, lobes", "atlas, rays", "atlas, cache", "atlas, database", "atlas, compared", "atlas, streaks", "atlas, splashed water",
         "atlas, brightness")
OWN_CACHE = True  # nobody may keep an atlas made by a fault

LOBES, LEVELS = "core/scene/atlas/lights.c", "core/scene/atlas/levels.c"
SPLASH, WATER = "core/scene/atlas/splash.c", "core/scene/atlas/optics/water.c"
DROP, RAYS = "core/scene/atlas/optics/drop.c", "core/scene/atlas/optics/trace.c"
FIND, COMPARE, FIGURES = "core/scene/atlas/cave/find.c", "core/scene/atlas/cave/compare.c", "harness/commands/drawing/atlas/compare.c"
EXPORT, TEXTURES = "harness/commands/drawing/atlas/export.c", "harness/commands/drawing/atlas/textures.c"

ROWS = [
    Fault(LOBES, "direction[0] = (float)(cos(elevation) * «sin(azimuth)»);", "-sin(azimuth)", "lights of the atlas are mirrored"),
    Fault(LOBES, "return 1 + (light - 1) * «RG_ATLAS_PHIS» + phi;", "(RG_ATLAS_PHIS - 1)", "cells of the atlas share lobes"),
    Fault(LOBES, "return «4» * half * (sin(elevation + half)", "2", "a lobe's share of the sphere is half"),
    Fault(LOBES, "lobes->peak = (float)(«1» / irradiance);", "0.5", "lobes have half their light"),
    Fault(LOBES, "cos((lamp_deg + RG_RIM_DEG) * M_PI / 180 «+ SQUARE_REACH_RAD»);", "- SQUARE_REACH_RAD", "lobes end at the grid's lines"),
    Fault(DROP, "(float)((is_database ? «0» : MEASURED_REST_A20) +", "MEASURED_REST_A20", "the database's drops are flat at rest"),
    Fault(DROP, "&(«is_database ? database : measured»)[oscillation];", "is_database ? measured : database", "the two sets of swings are exchanged"),
    Fault(DROP, ".blind = is_database ? «BLIND» : 0", "0", "light runs along the wall of the database's drops"),
    Fault(RAYS, "seen = «t < s.blind» ? 0.0f : 1.0f;", "t > s.blind", "light passes far walls, not near ones"),
    Fault(RAYS, "keep(row, way, i, along(scaled(inside.refracted, seen), «1 - seen», d),", "0", "light that passes a near wall is refracted there"),
    Fault("core/techniques/streaks/open.c", "size = «rg_atlas_kinds[size].measured»;", "RG_ATLAS_MEASURED", "the small atlas of measured swings is the full one"),
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
    Fault(SPLASH, "const bool rises = «passed < m->rise»;", "passed < 0.5", "crowns of puddles rise beyond their height",
          tests=("atlas, crowns",)),
    Fault(SPLASH, "m->life_s * «2 * m->rise» * (0.03 + 0.6 * when.a)", "1", "droplets leave a puddle's crown as late as it falls",
          tests=("atlas, crowns",)),
    Fault(SPLASH, "atan2(fabs(from[0]), «-from[2]») * steps", "from[2]", "lights show on splashes from behind as from before"),
    Fault(SPLASH, "light->cells[height][phi] / (sum «* cell_sr»)", "* 1", "lights show on splashes alike however wide their cell"),
    Fault(FIGURES, "            «figures.worst_row = row;»", "figures.worst_row = figures.worst_row ? figures.worst_row : row;", "the first picture of a set is called the worst", tests=("atlas, figures",)),
    Fault(FIGURES, "if («rg_cave_figures(comparison, which, (enum rg_cave_way)way).median >\n            rg_cave_figures(comparison, which, best).median»)", "rg_cave_figures(comparison, which, (enum rg_cave_way)way).median >= rg_cave_figures(comparison, which, best).median", "of equal ways the last is the best", tests=("atlas, figures",)),
    Fault(FIGURES, "best).pictures ? RG_CAVE_LIGHTS : «RG_CAVE_ENV»;", "RG_CAVE_LIGHTS", "pictures of light from everywhere alone have no best way", tests=("atlas, figures",)),
    Fault(FIGURES, "if («row->found.env || !(row->ours > 0 && row->theirs > 0)»)", "!(row->ours > 0 && row->theirs > 0)", "light from everywhere counts as a single light's brightness", tests=("atlas, figures",)),
    Fault(FIGURES, "if («n < LEAST_PAIRS»)", "n < LEAST_PAIRS - 1", "two pictures have a correlation of brightness", tests=("atlas, figures",)),
    Fault(FIGURES, "return «(x->correlation > y->correlation) - (x->correlation < y->correlation)»;", "(x->correlation < y->correlation) - (x->correlation > y->correlation)", "the pictures most alike are called least alike", tests=("atlas, figures",)),
    Fault(FIGURES, "i < count && «i < WORST_PRINTED»;", "true", "all pictures are called least alike", tests=("atlas, figures",)),
    Fault(FIGURES, "\"view at %d degrees\", «20 * view»);", "view", "views are told by their numbers, not by degrees", tests=("atlas, figures",)),
    Fault(FIGURES, "json_integer(«20 * f->light - 90»)", "20 * f->light", "programs are told elevations from the ground up", tests=("atlas, figures",)),
    Fault(FIGURES, "\"best\", way_names[«best»],", "0", "programs are told that pictures are best as they are", tests=("atlas, figures",)),
    Fault(FIGURES, "\"view %d\", «20 * view»);", "view", "programs are told views by their numbers", tests=("atlas, figures",)),
    Fault(EXPORT, "if (factor > 0 && «(range.least <= 0 || factor < range.least)»)", "range.least <= 0", "the first factor is called the least", tests=("atlas, export",)),
    Fault(EXPORT, "20 * («cell / RG_ATLAS_PHIS») - 90", "cell / RG_ATLAS_LIGHTS", "factors are listed by other elevations", tests=("atlas, export",)),
    Fault(EXPORT, "rg_level_size(image->height, «level»), 1, path))", "level + 1", "levels are written with half their height", tests=("atlas, export",)),
    Fault(EXPORT, "const float exposure = «SHEET_EXPOSURE» /", "1.0f", "sheets of factors are too dark to see", tests=("atlas, export",)),
    Fault(EXPORT, "factors[«c / (RG_ATLAS_CELL_PX >> 2)»] * exposure", "c / RG_ATLAS_CELL_PX", "cells of a sheet have a neighbour's brightness", tests=("atlas, export",)),
    Fault(EXPORT, "&sheet, side * half «+ point + GAP»);", "+ point", "light from everywhere is drawn into the gap of a sheet", tests=("atlas, export",)),
    Fault(EXPORT, "const int top = «layer / FRAMES_A_ROW» *", "layer / FRAMES_A_ROW / 2", "rows of splashes cover each other", tests=("atlas, export",)),
    Fault(EXPORT, "good = «good && write_splashes(atlas, folder)»;", "good", "the sheet of splashes is not written", tests=("atlas, export",)),
    Fault(TEXTURES, "p.texels[i] = «(float)rg_srgb_decode((double)value)»;", "value", "grey textures look brighter than they are", tests=("textures",)),
    Fault(TEXTURES, "channel(word, k) + «to[k] * (1 - channel(word, 3))»", "to[k]", "a sheet's ground shines through paint", tests=("textures",)),
    Fault(TEXTURES, "y / zoom * t->side_px + «x / zoom»];", "x / zoom / 2", "textures on a sheet are twice as wide", tests=("textures",)),
    Fault(TEXTURES, "if («!t->level && rows->count == RG_MAX_TEXTURE_ROWS»)", "!t->level && rows->count == RG_MAX_TEXTURE_ROWS - 1", "as many textures as a list holds are too many", tests=("textures",)),
    Fault(TEXTURES, "|| «t->column >= COLUMNS» ||", "false", "a texture beside the sheet covers others", tests=("textures",)),
]
