// Cameras and placements: the way from a mesh's own coordinates to clip space.
//
// Matrices are 16 floats, row by row (core/scene/matrix.h): clip = matrix * (x, y, z, 1). The world
// is right-handed. Clip space is that of kernels (kernels/dialect/draw/clip.h): x to the right; y
// DOWN, since row 0 of a target is its top; depth 0 on the near plane and 1 on the far plane; w is
// the distance ahead of the camera.
#ifndef RG_CORE_SCENE_CAMERA_H
#define RG_CORE_SCENE_CAMERA_H

#include <stdbool.h>

struct rg_camera {
    float position[3], target[3]; // the camera's place, and a point in the middle of the picture
    float up[3];                  // of any length; the direction that is upright in the picture
    float angle_deg;              // angle of view, from the picture's top to its bottom
    float near_plane, far_plane;  // distances, in the world's unit
};

// The matrix from the world to clip space; `aspect` is the picture's width over its height. False,
// and one logged line, if the camera cannot see: no distance to its target, `up` along the view, an
// angle outside 0 to 180 degrees, planes not in the order 0 < near < far, or any NaN.
bool rg_camera_matrix(const struct rg_camera *camera, float aspect, float matrix[16]);
// The matrix from the world to the camera's own space: x right, y up, looking along -z. It fails as
// rg_camera_matrix does.
bool rg_camera_view(const struct rg_camera *camera, float matrix[16]);

// The camera's directions in the world, of unit length, if it can see.
struct rg_camera_axes {
    double right[3], up[3], ahead[3];
};
struct rg_camera_axes rg_camera_axes(const struct rg_camera *camera);

// The placement of a thing in the world, whatever its own bounds are.
struct rg_placement {
    float size;        // the longest side of its bounds is scaled to this
    float turn_deg[3]; // about its centre: first the x axis, then y, then z; right-handed
    float position[3]; // of its centre
};

// The matrix from a thing's coordinates, with these bounds, to the world. The bounds' longest side
// must not be 0; a mesh's never is. The upper left 3x3 also turns normals, which need to be
// normalised again.
void rg_place(const float low[3], const float high[3], const struct rg_placement *placement,
              float matrix[16]);

#endif
