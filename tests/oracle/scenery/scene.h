// The light of a pixel of the scene (docs/city.md), in double precision, one ray at a time. It
// shares nothing with kernels/: it intersects the faces themselves, and reads surfaces' words,
// texels and points of the openness as the documents describe them.
#ifndef RG_TESTS_ORACLE_SCENERY_SCENE_H
#define RG_TESTS_ORACLE_SCENERY_SCENE_H

#include <stdbool.h>
#include <stdint.h>

enum { ORACLE_POINT = 1, ORACLE_SPOT, ORACLE_SUN };

struct scene_light {
    int kind;
    double place_m[3], way[3]; // way: in which it shines, of unit length
    double colour[3];
    double cos_inner, cos_outer;
    double texel_m; // of its shadow map; for points and spots, at 1 m
};

// A texel of a level of a texture: RGBA8, red lowest.
typedef uint32_t (*scene_texel_fn)(void *user, int texture, int level, int x, int y);

// The caller owns all of it.
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
    bool shadows; // faces block lights
};

// The face that a ray meets first, or -1; `distance` is in lengths of `way`. Faces that turn away
// are met only with `behind`.
int scene_meet(const struct scene *scene, const double from[3], const double way[3], bool behind,
               double *distance);

struct scene_pixel {
    double light[3];
    double slack[3];    // one and a half codes of the texture, since it is filtered in 8 bits
    bool sky, shadowed; // shadowed: from a light that it faces
    // Not to be compared: within the precision of floats and shadow maps, the level of the texture
    // or a shadow may change.
    bool unsure;
};

// The light along a ray of unit length. A pixel is `pixel_m` wide 1 m ahead, where the ray has the
// length `ahead`.
struct scene_pixel scene_see(const struct scene *scene, const double from[3], const double way[3],
                             double pixel_m, double ahead);

// The radiance that water of a roughness on a wet ground mirrors, over that of a white matt surface
// which faces the light: pi times the reflectance of facets by Walter et al. (2007), times the
// cosine. Smith's shadows of both directions go together, and Fresnel's share is Schlick's. `way`
// leads from the eye, `to` to the light; both are of length 1.
double scene_film(const double normal[3], const double way[3], const double to[3], double rough);

#endif
