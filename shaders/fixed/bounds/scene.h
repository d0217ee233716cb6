// A draw of fixed functions, computed in double from its geometry and texels: every value is the
// interval that the specifications leave to a device.
#ifndef RG_SHADERS_FIXED_BOUNDS_SCENE_H
#define RG_SHADERS_FIXED_BOUNDS_SCENE_H

#include <stdbool.h>
#include <stdint.h>

#include "shaders/fixed/bounds/span.h"
#include "shaders/fixed/fixed.h"

// The step of so many fraction bits, of which Vulkan demands at least 4 everywhere.
static inline double rg_precision_step(int bits)
{
    return ldexp(1, -(bits < 4 ? 4 : bits > 16 ? 16 : bits));
}

// --- primitives (corners.c) ---

struct rg_corner {
    double place[4]; // in clip space
    double at[4], colour[4];
    double cut; // clip distance
};

struct rg_primitive {
    int count; // of corners: a triangle, a line or a point
    struct rg_corner corners[3];
    int provoking; // corner whose colour is flat
    int layer;
};

struct rg_scene;
typedef void rg_primitive_use(struct rg_scene *scene, const struct rg_primitive *primitive);
// Shades and assembles all vertices, through the geometry stage if there is one.
void rg_scene_assemble(struct rg_scene *scene, rg_primitive_use *use);

// --- coverage (cover.c) ---

enum rg_cover { RG_COVER_NO, RG_COVER_MAYBE, RG_COVER_YES };

// A primitive's convex outline in the target, clipped.
struct rg_outline {
    int count;
    double corners[12][2];
    double slack; // px that an edge may lie elsewhere
    int facing;   // 1: counter-clockwise, -1, or 0: slack decides
    // Made of the above once for all places.
    double side;           // 1 or -1: the area's sign
    double edges[12][2];   // from a corner to the next
    double slacks[12];     // of twice the area between an edge and a place
    struct rg_span box[2]; // in x and y, with slack
};

// False: nothing is left of it.
bool rg_outline_of(const struct rg_scene *scene, const struct rg_primitive *primitive,
                   struct rg_outline *outline);
// Whether it covers a place: surely, if no slack of the corners uncovers it.
enum rg_cover rg_outline_cover(const struct rg_outline *outline, double x, double y);

// --- attributes (plane.c) ---

// b[i] . (x, y, 1): the weight of corner i, divided by the place's w.
struct rg_plane {
    double b[3][3], b_error[3][3];
    double w[3];
    double slack;
};

// False: the triangle has no area.
bool rg_plane_of(const struct rg_scene *scene, const struct rg_primitive *primitive, double slack,
                 struct rg_plane *plane);
// What all attributes share at a place of the target: the corners' weights around it.
struct rg_place {
    double weights[3][4]; // at the corners of a square
    double errors[3];     // of the weights
    double over[4];       // sums of the weights
    double least, error;  // of those
};
// Anywhere within `reach` of a place in x and y.
void rg_plane_at(const struct rg_plane *plane, double x, double y, double reach,
                 struct rg_place *place);
// An attribute with these values at the corners. Inside the triangle it lies between those.
struct rg_span rg_plane_value(const struct rg_place *place, const double values[3], bool is_inside);
// The same without perspective; for z / w, values are z of the corners.
struct rg_span rg_plane_affine(const struct rg_place *place, const double over_w[3]);
// The attribute's steps from a pixel to its neighbours in x or y, as shaders take derivatives.
struct rg_span rg_plane_step(const struct rg_plane *plane, const double values[3], double x,
                             double y, bool in_y);
// What polygon offset adds to a triangle's depth.
struct rg_span rg_plane_offset(const struct rg_scene *scene, const struct rg_primitive *primitive,
                               double slack);

// --- texels (decode.c, texture.c, cube.c) ---

enum { RG_SCENE_FACES = 6 };

struct rg_texture {
    int layers, levels;
    // Decoded, level by level: [layer][level][y * width + x][channel]; NULL: no texture
    struct rg_span (*texels)[RG_FIXED_LEVELS][RG_FIXED_TEXTURE_PX * RG_FIXED_TEXTURE_PX][4];
    struct rg_span border[4];
    struct rg_span corners[RG_SCENE_FACES][4][4]; // of a cube
    double weight;                                // error of a weight of a filter
};

// Decodes a level of 32 x 32 texels in blocks.
void rg_decode_blocks(enum rg_fixed_texels texels, const uint8_t *blocks, struct rg_span (*out)[4]);
// Fills the texture's texels.
void rg_scene_texture(struct rg_scene *scene);
// Where a direction meets a face of a cube; false: surely nowhere.
bool rg_cube_place(const struct rg_span direction[3], int face, struct rg_span *u,
                   struct rg_span *v);
// A texel of level 0 of a face, or one beyond its edges; rg_cube_corners comes first.
const struct rg_span *rg_cube_texel(const struct rg_texture *texture, int face, int x, int y);
void rg_cube_corners(struct rg_texture *texture);
// The texture function of the state's sampler at u and v, in textures.
void rg_texture_look(const struct rg_scene *scene, struct rg_span u, struct rg_span v, int layer,
                     int level, struct rg_span out[4]);
// The same between two levels; `lod` before bias and clamp.
void rg_texture_look_lod(const struct rg_scene *scene, struct rg_span u, struct rg_span v,
                         struct rg_span lod, struct rg_span out[4]);
void rg_texture_gather(const struct rg_scene *scene, struct rg_span u, struct rg_span v,
                       int channel, struct rg_span out[4]);
// Comparison of `depth` with the texels.
struct rg_span rg_texture_compare(const struct rg_scene *scene, struct rg_span u, struct rg_span v,
                                  struct rg_span depth);
// A linear filter's value on a grid of px x px texels, whose edge goes on outside.
struct rg_span rg_grid_filter(const struct rg_span *texels, int stride, int px, struct rg_span x,
                              struct rg_span y);

// --- fragments (shade.c) ---

struct rg_fragment {
    double x, y; // the pixel's centre
    const struct rg_primitive *primitive;
    const struct rg_plane *plane; // NULL: a point's, whose attributes are its corner's
    struct rg_place place;        // where attributes may be taken
    bool is_inside;               // and all of that within the primitive
    struct rg_span depth;
    struct rg_span colours[RG_FIXED_EQUATIONS][4], second[4];
    struct rg_span stored[RG_FIXED_STORES][4];
    enum rg_cover stays; // is not discarded
};
void rg_fragment_shade(const struct rg_scene *scene, struct rg_fragment *fragment);

// --- samples of the target (merge.c) ---

struct rg_sample {
    struct rg_span colours[RG_FIXED_EQUATIONS][4];
    struct rg_span depth;
    uint64_t stencil[4]; // a bit for each value that it may have
};

// Tests and blends a fragment into a sample. Returns whether it passes the tests.
enum rg_cover rg_sample_merge(const struct rg_scene *scene, const struct rg_fragment *fragment,
                              int facing, enum rg_cover cover, struct rg_sample *sample);

// --- all of it (scene.c) ---

struct rg_scene {
    const struct rg_fixed_state *state;
    const struct rg_fixed_precision *precision;
    double grid; // px
    struct rg_fixed_vertices vertices;
    struct rg_texture texture;
    int sample_count, layer_count;
    double places[RG_FIXED_SAMPLES][2];
    struct rg_sample *samples;                    // [layer][y][x][sample]
    struct rg_span (*stores)[RG_FIXED_STORES][4]; // of each pixel; NULL: none are asked for
    struct rg_span counts[RG_FIXED_COUNTS];       // of fragments in a column
    struct rg_span visible;                       // samples
    int primitive_count, inside_count;            // those with a corner inside the clip volume
    struct rg_span caught[3 * RG_FIXED_MAX_VERTICES][8];
};

// Draws everything. NULL, and one logged line, without memory; else the caller frees it.
struct rg_scene *rg_scene_draw(const struct rg_fixed_state *state,
                               const struct rg_fixed_precision *precision);
void rg_scene_free(struct rg_scene *scene);
struct rg_sample *rg_scene_sample(const struct rg_scene *scene, int layer, int x, int y,
                                  int sample);

#endif
