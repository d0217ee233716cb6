// Draws of one fixed function each: the tables, and the meshes, texels and shaders that they use.
//
// A draw goes through a driver's own pipeline, so that its bits are the driver's. Its neighbour is
// the same draw with one field of the state changed, whose bits must differ: otherwise the draw
// does not see its function.
//
// Each backend with such a pipeline executes them (backends/gl/api/fixed/,
// backends/vulkan/api/fixed/).
#ifndef RG_SHADERS_FIXED_FIXED_H
#define RG_SHADERS_FIXED_FIXED_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum {
    RG_FIXED_MAX_DRAWS = 48,
    RG_FIXED_PX = 64, // width and height of targets and stored images
    RG_FIXED_BLIT_PX = 40,
    RG_FIXED_TEXTURE_PX = 32, // width and height of level 0
    RG_FIXED_LEVELS = 6,
    RG_FIXED_TEXTURE_LAYERS = 4, // of an array; a cube has 6
    RG_FIXED_EQUATIONS = 5,      // targets of RG_FIXED_BLEND_EQUATIONS
    RG_FIXED_LAYERS = 4,         // layers and viewports of RG_FIXED_LAYER_STAGE
    RG_FIXED_STORES = 4,         // images of the shader STORE
    RG_FIXED_INSTANCES = 4,      // offsets of instances that there are
    RG_FIXED_SAMPLES = 4,
    RG_FIXED_STATISTICS = 4,
    RG_FIXED_COUNTS = 64,       // counters of the shaders DISCARD and EARLY, one a column
    RG_FIXED_CAUGHT_BYTES = 32, // of a vertex caught by transform feedback
};

// Sections of draw.frag and draw.vert. Names end up in rg_fixed_fragment_name and so on.
#define RG_FIXED_FRAGMENTS(X)                                                                      \
    X(COLOUR)                                                                                      \
    X(AFFINE)                                                                                      \
    X(CENTROID)                                                                                    \
    X(FLAT)                                                                                        \
    X(DERIVATIVES)                                                                                 \
    X(TEXTURE)                                                                                     \
    X(LAYERED)                                                                                     \
    X(CUBE)                                                                                        \
    X(SHADOW)                                                                                      \
    X(GATHER)                                                                                      \
    X(GRAD)                                                                                        \
    X(DEPTH)                                                                                       \
    X(DISCARD)                                                                                     \
    X(EARLY)                                                                                       \
    X(TARGETS)                                                                                     \
    X(DUAL)                                                                                        \
    X(STORE)
#define RG_FIXED_VERTICES(X)                                                                       \
    X(PLAIN)                                                                                       \
    X(CLIPPED)                                                                                     \
    X(FORMATS)                                                                                     \
    X(FEEDBACK)

#define RG_FIXED_FRAGMENT(name) RG_FIXED_FRAGMENT_##name,
#define RG_FIXED_VERTEX(name)   RG_FIXED_VERTEX_##name,
enum rg_fixed_fragment { RG_FIXED_FRAGMENTS(RG_FIXED_FRAGMENT) RG_FIXED_FRAGMENT_COUNT };
enum rg_fixed_vertex_shader { RG_FIXED_VERTICES(RG_FIXED_VERTEX) RG_FIXED_VERTEX_COUNT };

// Stages between vertices and fragments.
enum rg_fixed_between {
    RG_FIXED_BETWEEN_NONE,
    RG_FIXED_GEOMETRY_STAGE,     // a second triangle beside each
    RG_FIXED_LAYER_STAGE,        // each triangle into every layer, in a viewport of its own
    RG_FIXED_TESSELLATION_STAGE, // patches of three corners
};

enum rg_fixed_mesh {
    RG_FIXED_PANE,   // a quadrangle over most of the target, turned a little
    RG_FIXED_SQUARE, // one over all of it, with a texel of level 0 a pixel
    RG_FIXED_FLOOR,  // one in perspective, far away at the top
    RG_FIXED_SHARDS, // triangles through each other
    RG_FIXED_BEYOND, // triangles through the near plane, the eye's plane and far out of the target
};

enum rg_fixed_topology {
    RG_FIXED_TRIANGLES,
    RG_FIXED_STRIP,
    RG_FIXED_LINES,
    RG_FIXED_POINTS,
    RG_FIXED_PATCHES,
};

enum rg_fixed_texture { RG_FIXED_2D, RG_FIXED_ARRAY, RG_FIXED_CUBE };
enum rg_fixed_texels {
    RG_FIXED_TEXELS_NONE, // no texture
    RG_FIXED_TEXELS_RGBA8,
    RG_FIXED_TEXELS_SRGB8,
    RG_FIXED_TEXELS_D32F,
    RG_FIXED_TEXELS_BC1,
    RG_FIXED_TEXELS_BC3,
    RG_FIXED_TEXELS_ETC2,
};

// What a texture and the colours of vertices are made of.
enum rg_fixed_plain {
    RG_FIXED_ANY,
    RG_FIXED_CONSTANT, // all texels the same; one colour a triangle
    RG_FIXED_EXTREMES, // texels of 0 and 255 alone; one colour a triangle
};

enum rg_fixed_filter { RG_FIXED_NEAREST, RG_FIXED_LINEAR };
enum rg_fixed_mip { RG_FIXED_MIP_OFF, RG_FIXED_MIP_NEAREST, RG_FIXED_MIP_LINEAR };
enum rg_fixed_wrap { RG_FIXED_REPEAT, RG_FIXED_MIRROR, RG_FIXED_EDGE, RG_FIXED_BORDER };
enum rg_fixed_border { RG_FIXED_CLEAR, RG_FIXED_BLACK, RG_FIXED_WHITE };
enum rg_fixed_compare {
    RG_FIXED_COMPARE_OFF,
    RG_FIXED_LESS,
    RG_FIXED_LESS_EQUAL,
    RG_FIXED_GREATER,
    RG_FIXED_NOT_EQUAL,
    RG_FIXED_ALWAYS,
};

enum rg_fixed_cull { RG_FIXED_CULL_NONE, RG_FIXED_CULL_BACK, RG_FIXED_CULL_FRONT };
enum rg_fixed_depth { RG_FIXED_DEPTH_NONE, RG_FIXED_D16, RG_FIXED_D32F, RG_FIXED_D32F_S8 };
enum rg_fixed_stencil {
    RG_FIXED_STENCIL_OFF,
    RG_FIXED_INCREMENT, // wraps
    RG_FIXED_DECREMENT, // likewise
    RG_FIXED_INVERT,
};

enum rg_fixed_format { RG_FIXED_RGBA8, RG_FIXED_RGBA16F, RG_FIXED_RGBA32F, RG_FIXED_FORMAT_COUNT };
enum rg_fixed_blend {
    RG_FIXED_BLEND_OFF,
    RG_FIXED_BLEND_OVER,        // source * its alpha + target * (1 - that), in every target
    RG_FIXED_BLEND_EQUATIONS,   // the same factors; target i has equation i: add, subtract, reverse
                                // subtract, least, most
    RG_FIXED_BLEND_SRC1_COLOUR, // source * second colour + target * (1 - that)
    RG_FIXED_BLEND_SRC1_ALPHA,
};

// All of a draw's state. Zero is the plain case; every field is an int, so that a neighbour is one
// field and its other value.
struct rg_fixed_state {
    // Shaders.
    int fragment; // enum rg_fixed_fragment
    int vertex;   // enum rg_fixed_vertex_shader
    int between;  // enum rg_fixed_between
    int nudge;    // moves vertices by so many 1/256 of a pixel
    int shift;    // moves texture coordinates by so many 1/4096 of a texture
    int plain;    // enum rg_fixed_plain
    int value;    // what shaders make of it

    // Vertices.
    int mesh;     // enum rg_fixed_mesh
    int topology; // enum rg_fixed_topology
    int indexed;  // 16-bit indices, in strips that 0xFFFF ends
    int base_vertex, first_instance, more_instances;
    int indirect; // its arguments lie in a buffer

    // Texture.
    int texture; // enum rg_fixed_texture
    int texels;  // enum rg_fixed_texels
    int flip;    // n: bit n - 1 of level 0, or of the last vertex's own formats, is flipped
    int mag, min, mip;
    int wrap_u, wrap_v, border;
    int anisotropy;                         // 0: off
    int bias_16, lod_least_16, lod_most_16; // 1/16 of a level; lod_most_16 0: no clamp
    int compare;                            // enum rg_fixed_compare

    // Primitives.
    int cull;
    int depth_clamp;
    int provokes_last;
    int offset_units, offset_slope_16;
    int viewports; // each layer's own, and scissors
    int scissor;   // inset in pixels; 0: none
    int samples;   // 0: one, else RG_FIXED_SAMPLES
    int alpha_to_coverage;
    int samples_off; // bits of samples that the sample mask leaves out

    // Depth and stencil.
    int depth;      // enum rg_fixed_depth: the attachment
    int depth_test; // enum rg_fixed_compare; writes depth as well
    int stencil_front, stencil_back;

    // Colour.
    int format, more_targets, layers; // 0 layers: one, not an array
    int blend;
    int write_off; // bits of channels that are not written

    // What else is read.
    int stores; // the stored images
    int counts; // the buffer of counts
    int feedback;
    int queries; // visible samples, then RG_FIXED_STATISTICS of the pipeline's statistics: vertices
                 // and primitives assembled, primitives before and after clipping
    int blit;    // 0: none, else 1 + enum rg_fixed_filter
};

struct rg_fixed_draw {
    const char *feature; // "trilinear"
    const char *about;   // one line
    struct rg_fixed_state state;
    size_t changed; // offset of the neighbour's field
    int to;         // its other value
    const char *field;
};

extern const struct rg_fixed_draw rg_fixed_draws[];
int rg_fixed_count(void);
struct rg_fixed_state rg_fixed_neighbour(const struct rg_fixed_draw *draw);

// A case that has one right picture, however a driver filters or interpolates: two ways to draw it
// must leave the same bits.
struct rg_fixed_closed {
    const char *feature; // that of a draw
    const char *about;   // one line
    struct rg_fixed_state state, same;
};
extern const struct rg_fixed_closed rg_fixed_closed[];
int rg_fixed_closed_count(void);

const char *rg_fixed_fragment_name(int fragment);
const char *rg_fixed_vertex_name(int vertex);
// The sections of draw.geom, draw.tesc and draw.tese; NULL: it has none.
const char *rg_fixed_between_name(int between);

// --- what a draw reads (vertices.c, texels.c) ---

struct rg_fixed_vertex {
    float position[4], at[4], colour[4];
};
// Attributes of other formats, in this order, from location RG_FIXED_FORMATS_AT on: unsigned and
// signed bytes, unsigned and signed 16 bits, halves, and 10, 10, 10 and 2 bits.
enum {
    RG_FIXED_OFFSETS_AT = 3, // location of an instance's offset
    RG_FIXED_FORMATS_AT = 4,
    RG_FIXED_FORMATS = 6,
    RG_FIXED_FORMATS_STRIDE = 32,
    RG_FIXED_MAX_VERTICES = 96,
    RG_FIXED_MAX_INDICES = 128,
};
extern const int rg_fixed_format_offsets[RG_FIXED_FORMATS];

struct rg_fixed_vertices {
    int count, index_count;
    struct rg_fixed_vertex vertices[RG_FIXED_MAX_VERTICES];
    uint8_t formats[RG_FIXED_MAX_VERTICES * RG_FIXED_FORMATS_STRIDE];
    float offsets[RG_FIXED_INSTANCES][4];
    uint16_t indices[RG_FIXED_MAX_INDICES];
};
void rg_fixed_make_vertices(const struct rg_fixed_state *state, struct rg_fixed_vertices *made);

// The uniform block of all stages.
struct rg_fixed_params {
    int32_t nudge, shift, value, unused;
};

// The arguments of an indirect draw, as both APIs take them.
struct rg_fixed_arguments {
    uint32_t count, instances, first_index;
    int32_t base_vertex;
    uint32_t first_instance;
};
struct rg_fixed_arguments rg_fixed_arguments(const struct rg_fixed_state *state,
                                             const struct rg_fixed_vertices *vertices);

// The i-th viewport (x, y, width, height) and scissor.
void rg_fixed_viewport(const struct rg_fixed_state *state, int i, int viewport[4]);
void rg_fixed_scissor(const struct rg_fixed_state *state, int i, int scissor[4]);
// What targets hold before a draw: colour, and depth as its far end.
extern const float rg_fixed_before[4];

enum { RG_FIXED_LEVEL_BYTES = RG_FIXED_TEXTURE_PX * RG_FIXED_TEXTURE_PX * 4 };
// Of the texture.
int rg_fixed_layers(const struct rg_fixed_state *state);
int rg_fixed_levels(const struct rg_fixed_state *state);
// Makes one layer of one level, and returns its bytes, at most RG_FIXED_LEVEL_BYTES.
size_t rg_fixed_make_texels(const struct rg_fixed_state *state, int layer, int level,
                            uint8_t *texels);

// --- what it leaves ---

// How finely a device computes, as it says itself: fraction bits of corners in pixels, of texture
// coordinates in texels and of levels, and where a pixel's samples lie.
struct rg_fixed_precision {
    int subpixel_bits, subtexel_bits, mip_bits;
    bool has_places; // the device says where samples lie
    bool is_opengl;  // whose scale factor is at most the sum of both coordinates' greatest steps
    double places[RG_FIXED_SAMPLES][2];
};

// Bytes of a draw: its targets, then depth, stencil and all else that it asks for.
struct rg_fixed_picture {
    uint8_t *bytes;
    size_t size, room;
    bool is_constant; // a part of it has the same texel everywhere
    char lacks[80];   // what the device lacks for it; "": nothing, and it was drawn
    struct rg_fixed_precision precision; // of the device that drew it
};
enum { RG_FIXED_PICTURE_BYTES = 1 << 20 }; // enough room for every draw

// Room for a part of `size` bytes, which the caller fills; NULL: there is none.
void *rg_fixed_part(struct rg_fixed_picture *picture, size_t size);
// Notes whether the last part, of texels of `texel` bytes, is constant.
void rg_fixed_look(struct rg_fixed_picture *picture, size_t size, size_t texel);
// Notes what the device lacks, and returns true, since nothing failed.
bool rg_fixed_lacks(struct rg_fixed_picture *picture, const char *what);

// --- code ---

enum rg_fixed_stage {
    RG_FIXED_STAGE_VERT,
    RG_FIXED_STAGE_TESC,
    RG_FIXED_STAGE_TESE,
    RG_FIXED_STAGE_GEOM,
    RG_FIXED_STAGE_FRAG,
    RG_FIXED_STAGES
};

// A section of a shader: GLSL without its first line, which is "#version 450", and SPIR-V.
struct rg_fixed_code {
    enum rg_fixed_stage stage;
    const char *name; // defined as a macro, it chooses the section
    const char *text;
    const uint32_t *words;
    size_t size; // of the words, in bytes
};

extern const struct rg_fixed_code rg_fixed_codes[]; // made by embed.py; the last has no name
// The code of a draw's stage; NULL: the draw has no such stage.
const struct rg_fixed_code *rg_fixed_code_of(const struct rg_fixed_state *state,
                                             enum rg_fixed_stage stage);

#endif
