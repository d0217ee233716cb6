// The parameters of a frame of streaks (Creus, chapter 4). Lengths are metres in the rain frame: x
// and y lie across the fall, s along it, from the middle of the rain space's top plane.
#ifndef RG_KERNELS_STREAKS_PARAMS_H
#define RG_KERNELS_STREAKS_PARAMS_H

#include "kernels/dialect/matrix.h"

#define STREAKS_BLOCK       32 // particles in a block
#define STREAKS_BLOCK_WORDS 5  // first particle, mask, shift x, shift y, turn

#define STREAKS_STATE_WORDS 10

#define STREAKS_NOTHING 0
#define STREAKS_DROP    1
#define STREAKS_SPLASH  2

RG_STRUCT(streaks_params)
{
    m4 to_clip;    // from the rain frame
    m4 rays;       // (px, py, 1) to the ray through a pixel, as long as 1 along the view
    m4 from_world; // to the rain frame
    float depth_far, depth_per_w; // depth is depth_far + depth_per_w / w
    float half_x, half_y;         // of the rain space
    float top;                    // s of the local space's top
    float local_height;
    float eye_x, eye_y, eye_s;
    float radius;               // of the culling prism, where particles are culled one by one
    float map_x, map_y;         // the depth map's first texel
    float map_per_x, map_per_y; // maps per metre
    float map_top, map_height;  // s of depth 0, and from there to depth 1
    float ground;               // s of the ground plane, which is hit off the map
    float fall;                 // way of a drop in the exposure, upwards; of the settings' drop
    float behind;               // upwards from a particle to its streak's upper end
    float drop_radius;          // of a drop at rest
    float cycles;               // of a drop's slower swing, in the exposure
    float cycles_per_m;         // of its fall
    float half_width;           // of a streak, margins included
    float thinnest_px;          // the least width and length of a drawn streak
    float fall_speed;           // m/s
    float splash_s;             // duration of a splash
    // A splash of the settings' drop: the size of its picture, and the height of the impact in it.
    float splash_width, splash_height, splash_foot;
    float up_x, up_y, up_s; // upward direction of splashes that do not follow the surface
    int follows;            // whether splashes stand on the surface's normal
    int materials;          // whether they depend on the surface's kind
    int around;             // whether the map lies around the observer; there is no rain off it
    int drops, splashes;    // whether they are seen
    int exact;              // whether particles are culled one by one
    int lights;
    int paper_angles;          // whether a view from below counts as one from above (section 4.3.1)
    int first_level;           // the first of the full atlas' levels that is stored
    int last_level;            // the last one that is read
    float focal_px;            // pixels per metre at a distance of one
    float sky_r, sky_g, sky_b; // light from all around
    float gain, opacity;       // of streaks
    float splash_gain, splash_opacity;
    int first_place; // of states
    int sizes;       // classes of drops, a power of 2
    // A splash's share is splash_last less its horizontal distance in metres times splash_fade,
    // within 0 to 1.
    float splash_last, splash_fade;
    int splash_matt; // whether light falls on splashes by Lambert's law, as in the thesis
    // 1 / m: the ground's distance from the camera whose frustum the rain space is; 0: a box.
    float narrowing;
};
RG_STRUCT_SIZE(streaks_params, 104)

#endif
