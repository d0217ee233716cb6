// The rain space is the box in which it rains (Creus, section 4.2). This file also has the rain
// frame, the local space around the observer, and the distance that drops have fallen.
//
// The rain frame has coordinates in metres along three orthonormal axes, from the middle of the
// box's top plane: s along the fall, x and y across it. The cross product of x and y is s. For rain
// that falls straight down, x and y are along the world's x and z. The box is |x| <= half_x_m, |y|
// <= half_y_m, 0 <= s <= height_m. Clip coordinates across are x / half_x_m and y / half_y_m. A
// density map lies over the top plane, its columns along x, its rows along y.
#ifndef RG_CORE_SCENE_RAIN_SPACE_H
#define RG_CORE_SCENE_RAIN_SPACE_H

#include <stdbool.h>

#include "core/scene/camera.h"

// The box as an orthographic camera: its near plane is the top, its far plane the ground.
struct rg_rain_space_settings {
    double ground_m[3];                // in the world: the middle of the ground plane
    double fall[3];                    // in the world: the direction of falling; not 0
    double width_m, depth_m, height_m; // along x, y and s; above 0
};

struct rg_rain_space {
    double origin_m[3];      // in the world: the middle of the top plane
    double x[3], y[3], s[3]; // the axes, in the world
    double half_x_m, half_y_m, height_m;
};

// False, and one logged line that names what is wrong, if a size is not above 0, the fall has no
// direction, or a number is NaN; `space` is then undefined.
bool rg_rain_space_make(const struct rg_rain_space_settings *settings, struct rg_rain_space *space);

// The direction of fall: straight down, leaned by `slant_deg` towards an azimuth, which is 0 along
// the world's x axis and 90 along z.
void rg_rain_fall(double slant_deg, double azimuth_deg, double fall[3]);

// Convert points and directions between the world and the rain frame.
void rg_rain_point(const struct rg_rain_space *space, const double world[3], double rain[3]);
// A camera's position in the rain frame.
void rg_rain_eye(const struct rg_rain_space *space, const struct rg_camera *camera, double rain[3]);
void rg_rain_direction(const struct rg_rain_space *space, const double world[3], double rain[3]);
void rg_rain_world_point(const struct rg_rain_space *space, const double rain[3], double world[3]);

// Both conversions as matrices, row by row (core/scene/matrix.h). Either may be NULL.
void rg_rain_matrices(const struct rg_rain_space *space, float world_to_rain[16],
                      float rain_to_world[16]);
// The matrix from the rain frame to clip space, computed from the one from the world to clip space,
// in double precision and rounded once.
void rg_rain_to_clip(const struct rg_rain_space *space, const float world_to_clip[16],
                     float rain_to_clip[16]);

// Converts the matrix that maps (px, py, 1) to the ray through a pixel from the world to the rain
// frame.
void rg_rain_rays(const struct rg_rain_space *space, const float world[16], float rain[16]);

// The eight corners of a camera's view in the rain frame: near ones first. Drawing does not clip at
// the far plane, so the view reaches to the box's farthest corner if the far plane is nearer.
// False, with one logged line, if the camera cannot see (rg_camera_matrix).
bool rg_rain_view_corners(const struct rg_rain_space *space, const struct rg_camera *camera,
                          double aspect, double corners[8][3]);

// --- the local space: s from top to top + height, the observer always half way between ---

double rg_rain_local_top(double eye_s_m, double local_height_m);

// The run position, in [0, 1): the share of the local space, whose top is at `top_m`, that drops
// have fallen through. A particle is at s = top + height * fract(start + run).
//
// Creus updates it frame by frame from time and the observer's rise and fall (section 4.4.1). Here
// it is a function of both, so that no error accumulates and any frame can be computed alone. When
// the local space moves, a drop keeps its place in the world, and re-enters at the opposite end
// once it is outside.
double rg_rain_run(double fall_speed_m_s, double time_s, double top_m, double local_height_m);

#endif
