// Cartoons of a scene in double precision: a ray caster over its faces, and the colours of the
// styles, written from the papers.
#ifndef RG_TESTS_ORACLE_CARTOON_SCENE_H
#define RG_TESTS_ORACLE_CARTOON_SCENE_H

#include <stdbool.h>
#include <stdint.h>

struct vec {
    double x, y, z;
};

// A mesh as in files, and a pinhole camera: a pixel looks along ahead + right * u + down * v, with
// u, v from -1 to 1 across the picture.
struct scene_oracle {
    int face_count;
    const float *positions, *normals;
    const uint32_t *indices;
    struct vec eye, ahead, right, down;
    int width, height;
    double near_m, far_m;
};

// The first face that a ray meets through a place of the picture, in pixels.
struct scene_hit {
    int face; // -1: nothing
    double ahead_m, depth;
    struct vec at, normal; // of unit length, on the visible side
};
struct scene_hit scene_cast(const struct scene_oracle *o, double x_px, double y_px);
// The same at a pixel's centre; false if places around it meet another face, so that a device may
// draw either.
bool scene_cast_pixel(const struct scene_oracle *o, int px, int py, struct scene_hit *hit);

// The place in the world of a depth of the picture.
struct vec scene_place(const struct scene_oracle *o, int px, int py, double depth);

// A surface as a style gets it, all colours as display values.
struct surface {
    struct vec normal, at, colour;
    double shine;
};
struct look {
    struct vec eye, to_light;
};

double surface_highlight(const struct surface *s, const struct look *l); // (r . v)^32 without shine

struct gooch {
    double blue, yellow, alpha, beta;
};
struct vec gooch_colour(const struct surface *s, const struct look *l, const struct gooch *g);

struct tones {
    double shadow, middle, middle_from, lit_from, softness, glint_from, shadow_blue;
};
struct vec tones_colour(const struct surface *s, const struct look *l, const struct tones *t);

// Strokes as bytes of paper, 0 (ink) to 255: `levels` squares, the first of side `size_px`, each
// next half as large. Each texel has a byte for each of seven tones, the last of which is blank.
struct hatching {
    int size_px, levels;
    const uint8_t *bytes[8];
    struct vec paper, ink;
    double ambient, lit, wash, tile_m;
    double focal_px; // the pixels of an object that is as wide as it is distant
};
struct vec hatching_colour(const struct surface *s, const struct look *l, const struct hatching *h);

#endif
