// A rasteriser that shares nothing with kernels/: which pixels a polygon covers, in exact integers,
// and which face a ray through a pixel's centre meets where, in double precision.
#ifndef RG_TESTS_ORACLE_RASTER_H
#define RG_TESTS_ORACLE_RASTER_H

#include <stdbool.h>
#include <stdint.h>

// Corners in 1/256 pixel, y downwards, within 2^29 of 0.
struct oracle_point {
    int64_t x, y;
};

// Whether a simple polygon, in either turn, covers a pixel: holds its centre, moved by something
// infinitesimal to the right and by something smaller still down. So a centre on a left or a top
// edge is inside, and of polygons that share an edge exactly one covers the centres on it.
bool oracle_covers(const struct oracle_point *corners, int count, int px, int py);

// The distance of a pixel's centre from a polygon's outline, in pixels.
double oracle_outline_px(const struct oracle_point *corners, int count, int px, int py);

// Twice the area, in 1/256 pixel squared: positive where the corners turn clockwise as seen.
int64_t oracle_turn(const struct oracle_point corners[3]);

// A face in clip space (x, y, z, w a corner; y downwards) on a target of this size.
struct oracle_face {
    double corners[3][4];
    int width, height;
};

// The face of three positions under a matrix of four rows.
struct oracle_face oracle_face_at(const float *matrix, const float *positions,
                                  const uint32_t face[3], int width, int height);

// A face's picture on the target: its part behind the near plane (depth 0 or more), projected.
struct oracle_outline {
    int count; // corners, in pixels; 0: nothing is seen
    double x[4], y[4];
    double turn; // twice the area in pixels, positive clockwise
};
struct oracle_outline oracle_outline_of(const struct oracle_face *face);

// How far inside the outline a pixel's centre lies, in pixels; negative outside.
double oracle_margin(const struct oracle_outline *outline, int px, int py);

// Where the ray through a pixel's centre meets a face's plane: the weights of the corners, and the
// depth. False where it runs along the plane.
struct oracle_hit {
    double weights[3], depth;
};
bool oracle_hit(const struct oracle_face *face, int px, int py, struct oracle_hit *hit);

#endif
