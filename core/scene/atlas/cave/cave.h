// The original database of Garg and Nayar (CAVE, Columbia University), packed as an atlas.
#ifndef RG_CORE_SCENE_ATLAS_CAVE_CAVE_H
#define RG_CORE_SCENE_ATLAS_CAVE_CAVE_H

#include "core/scene/atlas/atlas.h"

// Converts a factor of the database to radiance for an irradiance of 1. It brings the 18 streaks of
// rows theta_light 10 and 50, seen from the front, nearest to the traced ones (least squares of the
// logarithms).
#define RG_CAVE_POINT_SCALE 0.2710f

// Packs the database under a folder that holds point_light_database and env_light_database:
//
//   point_light_database/size{32,16,8,4}/dcam{00..80}/cv{V}_v{L}_h{P}_osc{K}.png
//   point_light_database/txt/dcam{00..80}_point_max.txt      "cv{V}", "v{L}", "h{P} f0 ... f9"
//   env_light_database/size{32,16,8,4}/cv{V}_osc{K}.png
//   env_light_database/txt/normalized_env_max.txt            "cv{V}", then f0 ... f9
//
// The four widths become levels 0 to 3, each resampled to its row's height. At light elevations 90
// and -90 any one azimuth is enough. Environment factors are scaled so that oscillation 0 from the
// front covers its middle for the time that a drop takes to fall its own diameter. `size` is
// RG_ATLAS_CAVE or RG_ATLAS_CAVE_SMALL, which needs widths 8 and 4 alone. `progress` may be NULL.
// NULL, and one logged line that names the file, when a file is missing or invalid. The caller
// destroys it.
struct rg_atlas *rg_cave_pack(const char *folder, enum rg_atlas_size size,
                              const struct rg_atlas_progress *progress);

#endif
