// Cartoons of a scene in double precision: a ray caster over its faces, and the colours of the
// styles, written from the papers.
#ifndef RG_TESTS_ORACLE_CARTOON_SCENE_H
#define RG_TESTS_ORACLE_CARTOON_SCENE_H

#include <stdbool.h>
#include <stdint.h>

struct vec {
    double x, y, z;
};

// A mesh as files have it, and a pinhole camera: a picture's pixel looks along ahead + right * u +
// down * v with u, v from -1 to 1 across the picture.
struct scene_oracle {
    int face_count;
    const float *positions, *normals;
    const uint32_t *indices;
    struct vec eye, ahead, right, down;
    int width, height;
    double near_m, far_m;
};

// What a ray through a place of the picture, in pixels, meets first.
struct scene_hit {
    int face; // -1: nothing
    double ahead_m, depth;
    struct vec at, normal; // of unit length, on the side that is seen
};
struct scene_hit scene_cast(const struct scene_oracle *o, double x_px, double y_px);
// The same at a pixel's centre; false where places beside it meet another face, so that it is not
// sure which face a device draws there.
bool scene_cast_pixel(const struct scene_oracle *o, int px, int py, struct scene_hit *hit);

// Where a depth of the picture lies.
struct vec scene_place(const struct scene_oracle *o, int px, int py, double depth);

// A surface as a style sees it, all colours as display values.
struct surface {
    struct vec normal, at, colour;
    double shine;
};
struct look {
    struct vec eye, to_light;
};

double surface_highlight(const struct surface *s, const struct look *l); // (r . v)^32, shine apart

struct gooch {
    double blue, yellow, alpha, beta;
};
struct vec gooch_colour(const struct surface *s, const struct look *l, const struct gooch *g);

struct tones {
    double shadow, middle, middle_from, lit_from, softness, glint_from, shadow_blue;
};
struct vec tones_colour(const struct surface *s, const struct look *l, const struct tones *t);

// Strokes as bytes of paper, 0 ink to 255: `levels` squares of side `size_px` and half as large and
// so on, each texel a byte for each of seven tones, the last of which is blank.
struct hatching {
    int size_px, levels;
    const uint8_t *bytes[8];
    struct vec paper, ink;
    double ambient, lit, wash, tile_m;
    double focal_px; // pixels that something as wide as it is distant takes
};
struct vec hatching_colour(const struct surface *s, const struct look *l, const struct hatching *h);

#endif
