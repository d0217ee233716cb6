// A rasteriser that shares nothing with kernels/. In exact integers, it finds the pixels that a
// polygon covers; in double precision, where a ray through a pixel's centre meets a face.
#ifndef RG_TESTS_ORACLE_RASTER_H
#define RG_TESTS_ORACLE_RASTER_H

#include <stdbool.h>
#include <stdint.h>

// Corners in 1/256 pixel, y downwards, within 2^29 of 0.
struct oracle_point {
    int64_t x, y;
};

// Whether a simple polygon, in either orientation, covers a pixel: contains its centre, moved right
// by an infinitesimal distance and down by a smaller one. So a centre on a left or top edge is
// inside, and exactly one of the polygons that share an edge covers the centres on it.
bool oracle_covers(const struct oracle_point *corners, int count, int px, int py);

// The distance of a pixel's centre from a polygon's outline, in pixels.
double oracle_outline_px(const struct oracle_point *corners, int count, int px, int py);

// Twice the area, in 1/256 pixel squared; positive if the corners turn clockwise as seen.
int64_t oracle_turn(const struct oracle_point corners[3]);

// A place on the target, in pixels, y downwards.
struct oracle_place {
    double x, y;
};

// The convex hull of places, which it sorts. Writes its corners, clockwise as seen, and returns
// their number. There must be room for twice as many corners as places.
int oracle_hull(struct oracle_place *places, int count, struct oracle_place *corners);

// How far a place is inside the line of the nearest edge of a convex polygon in either orientation,
// in pixels; negative outside.
double oracle_inside_px(const struct oracle_place *corners, int count, struct oracle_place at);

// A face in clip space (x, y, z, w a corner; y downwards) on a target of this size.
struct oracle_face {
    double corners[3][4];
    int width, height;
};

// The face of three positions under a matrix of four rows.
struct oracle_face oracle_face_at(const float *matrix, const float *positions,
                                  const uint32_t face[3], int width, int height);

// A face's picture on the target: the projection of its part beyond the near plane (depth 0 or
// more).
struct oracle_outline {
    int count; // corners, in pixels; 0: the face is not seen
    double x[4], y[4];
    double turn; // twice the area in pixels, positive clockwise
};
struct oracle_outline oracle_outline_of(const struct oracle_face *face);

// The distance of a pixel's centre inside the outline, in pixels; negative outside.
double oracle_margin(const struct oracle_outline *outline, int px, int py);

// The place at which the ray through a pixel's centre meets a face's plane: the corners' weights
// and the depth. False if the ray is parallel to the plane.
struct oracle_hit {
    double weights[3], depth;
};
bool oracle_hit(const struct oracle_face *face, int px, int py, struct oracle_hit *hit);

#endif
