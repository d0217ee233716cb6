// What a pixel of the scene shows (docs/city.md), in double precision, for one ray at a time. It
// shares nothing with kernels/: it meets the faces themselves, and reads surfaces' words, texels
// and points of the openness as the documents say that they lie.
#ifndef RG_TESTS_ORACLE_SCENERY_SCENE_H
#define RG_TESTS_ORACLE_SCENERY_SCENE_H

#include <stdbool.h>
#include <stdint.h>

enum { ORACLE_POINT = 1, ORACLE_SPOT, ORACLE_SUN };

struct scene_light {
    int kind;
    double place_m[3], way[3]; // way: that it shines, of unit length
    double colour[3];
    double cos_inner, cos_outer;
    double texel_m; // of its shadow map; of points and spots, at 1 m
};

// A texel of a level of a texture: RGBA8, red lowest.
typedef uint32_t (*scene_texel_fn)(void *user, int texture, int level, int x, int y);

// The caller's.
struct scene {
    int face_count;
    const float *corners;       // 12 floats a face
    const uint32_t *surface_of; // a face's
    const uint32_t *surfaces;   // four words each
    const uint32_t *openness;   // 101 x 101 x 60 words
    scene_texel_fn texel;
    void *user;
    int texture_px, texture_levels;
    double zenith[3], horizon[3], clouds, haze_per_m;
    double ambient, bounced, glow, wet;
    int light_count;
    const struct scene_light *lights;
    bool shadows; // faces stand between lights and what is seen
};

// The face that a ray meets first, and how far away in lengths of `way`; -1 where it meets none.
// Faces that turn away are met only where `behind`.
int scene_meet(const struct scene *scene, const double from[3], const double way[3], bool behind,
               double *distance);

struct scene_pixel {
    double light[3];
    double slack[3]; // what one and a half codes of the texture are worth: it is filtered in 8 bits
    bool sky, shadowed; // shadowed: from a light that it faces
    // Not to be compared: the level of the texture, or a shadow, is another one within the
    // precision of floats and shadow maps.
    bool unsure;
};

// What a ray of unit length shows; a pixel is `pixel_m` wide 1 m ahead, and `ahead` is the length
// of 1 m ahead along the ray.
struct scene_pixel scene_see(const struct scene *scene, const double from[3], const double way[3],
                             double pixel_m, double ahead);

#endif
