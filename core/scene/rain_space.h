// The rain space, the box in which it rains (Creus, section 4.2), and what follows from
// it: the rain frame, the local space around the observer, and how far drops have fallen.
//
// The rain frame has metres along three axes of length 1: s along the fall, x and y across it, from
// the middle of the box's top plane. x cross y is s; rain that falls straight down has x and y
// along the world's x and z. The box is |x| <= half_x_m, |y| <= half_y_m, 0 <= s <= height_m. Clip
// coordinates across are x / half_x_m and y / half_y_m. A density map lies over the top plane, its
// columns along x, its rows along y.
#ifndef RG_CORE_SCENE_RAIN_SPACE_H
#define RG_CORE_SCENE_RAIN_SPACE_H

#include <stdbool.h>

#include "core/scene/camera.h"

// The orthographic camera that defines the box: its near plane is the top, its far plane the
// ground.
struct rg_rain_space_settings {
    double ground_m[3];                // in the world: the middle of the ground plane
    double fall[3];                    // in the world: where drops fall to; of any length but 0
    double width_m, depth_m, height_m; // along x, y and s; above 0
};

struct rg_rain_space {
    double origin_m[3];      // in the world: the middle of the top plane
    double x[3], y[3], s[3]; // the axes, in the world
    double half_x_m, half_y_m, height_m;
};

// False, and one logged line that names what is wrong, if a size is not above 0, the fall has no
// direction, or something is no number; `space` is undefined then.
bool rg_rain_space_make(const struct rg_rain_space_settings *settings, struct rg_rain_space *space);

// A direction of fall: straight down, leaned by `slant_deg` towards an azimuth, 0 along the world's
// x axis, 90 along z.
void rg_rain_fall(double slant_deg, double azimuth_deg, double fall[3]);

// Points and directions, from the world to the rain frame and back.
void rg_rain_point(const struct rg_rain_space *space, const double world[3], double rain[3]);
// A camera's place, in the rain frame.
void rg_rain_eye(const struct rg_rain_space *space, const struct rg_camera *camera, double rain[3]);
void rg_rain_direction(const struct rg_rain_space *space, const double world[3], double rain[3]);
void rg_rain_world_point(const struct rg_rain_space *space, const double rain[3], double world[3]);

// Both as matrices, row by row, as core/scene/matrix.h has them. Either may be NULL.
void rg_rain_matrices(const struct rg_rain_space *space, float world_to_rain[16],
                      float rain_to_world[16]);
// The matrix from the rain frame to clip space, made from the world's to clip space; multiplied in
// double precision and rounded once.
void rg_rain_to_clip(const struct rg_rain_space *space, const float world_to_clip[16],
                     float rain_to_clip[16]);

// What takes (px, py, 1) to the ray through a pixel, from the world to the rain frame.
void rg_rain_rays(const struct rg_rain_space *space, const float world[16], float rain[16]);

// The corners, in the rain frame, of what a camera sees: near ones first. Drawing does not clip at
// the far plane, so the view reaches to the box's farthest corner if the far plane is nearer.
// False, with one logged line, if the camera cannot see (rg_camera_matrix).
bool rg_rain_view_corners(const struct rg_rain_space *space, const struct rg_camera *camera,
                          double aspect, double corners[8][3]);

// --- the local space: s from top to top + height, the observer always half way between ---

double rg_rain_local_top(double eye_s_m, double local_height_m);

// The run position, in [0, 1): how far drops have advanced in the local space whose top is at
// `top_m`. A particle is at s = top + height * fract(start + run).
//
// Creus adds time and the observer's rise and fall to it frame by frame (section 4.4.1); here it is
// a function of both, so that nothing accumulates and any frame can be computed alone. A drop stays
// where it is in the world when the local space moves, and comes in again at its other end where
// the local space has left it.
double rg_rain_run(double fall_speed_m_s, double time_s, double top_m, double local_height_m);

#endif
