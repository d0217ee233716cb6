// The table of draws, the most telling first.
#include "shaders/fixed/fixed.h"

#define N(constant) RG_FIXED_##constant
#define DRAW(feature, about, neighbour, to, ...)                                                   \
    {                                                                                              \
        feature, about, {__VA_ARGS__}, offsetof(struct rg_fixed_state, neighbour), to, #neighbour  \
    }
#define TEXTURED .fragment = N(FRAGMENT_TEXTURE), .texels = N(TEXELS_RGBA8)
#define SMOOTH   .mag = N(LINEAR), .min = N(LINEAR)
#define AFAR     TEXTURED, .mesh = N(FLOOR), SMOOTH

const struct rg_fixed_draw rg_fixed_draws[] = {
    // Sampling.
    DRAW("nearest", "nearest texels of a turned pane", shift, 1, TEXTURED),
    DRAW("linear", "four texels weighed, of a turned pane", shift, 1, TEXTURED, SMOOTH),
    DRAW("mip nearest", "a floor, linear in the nearest level", bias_16, 1, AFAR,
         .mip = N(MIP_NEAREST)),
    DRAW("trilinear", "a floor, linear in two levels", bias_16, 1, AFAR, .mip = N(MIP_LINEAR)),
    DRAW("anisotropic", "a floor with anisotropy 8", anisotropy, 0, AFAR, .mip = N(MIP_LINEAR),
         .anisotropy = 8),
    DRAW("LOD bias and clamp", "a floor with a bias, between two levels", lod_most_16, 41, AFAR,
         .mip = N(MIP_LINEAR), .bias_16 = 20, .lod_least_16 = 24, .lod_most_16 = 40),
    DRAW("gradients", "textureGrad, whose gradients vary", value, 41, .fragment = N(FRAGMENT_GRAD),
         .texels = N(TEXELS_RGBA8), SMOOTH, .mip = N(MIP_LINEAR), .value = 40),
    DRAW("gather", "textureGather of two channels", shift, 8, .fragment = N(FRAGMENT_GATHER),
         .texels = N(TEXELS_RGBA8), SMOOTH),
    DRAW("depth compare", "a linear shadow sampler", compare, N(GREATER),
         .fragment = N(FRAGMENT_SHADOW), .texels = N(TEXELS_D32F), SMOOTH, .compare = N(LESS)),
    DRAW("cube seams", "a cube across its edges, linear", shift, 4, .fragment = N(FRAGMENT_CUBE),
         .texels = N(TEXELS_RGBA8), .texture = N(CUBE), SMOOTH),
    DRAW("array layers", "the nearest layer of an array, linear", value, 1,
         .fragment = N(FRAGMENT_LAYERED), .texels = N(TEXELS_RGBA8), .texture = N(ARRAY), SMOOTH),
    DRAW("wrap modes", "repeated across and mirrored upwards", wrap_v, N(EDGE), TEXTURED, SMOOTH,
         .wrap_v = N(MIRROR)),
    DRAW("border colour", "linear into an opaque black border", border, N(WHITE), TEXTURED, SMOOTH,
         .wrap_u = N(BORDER), .wrap_v = N(BORDER), .border = N(BLACK)),
    DRAW("sRGB decoding", "linear over sRGB texels", texels, N(TEXELS_RGBA8),
         .fragment = N(FRAGMENT_TEXTURE), .texels = N(TEXELS_SRGB8), SMOOTH),
    DRAW("BC1", "random blocks", flip, 1, .fragment = N(FRAGMENT_TEXTURE), .texels = N(TEXELS_BC1)),
    DRAW("BC3", "random blocks", flip, 1, .fragment = N(FRAGMENT_TEXTURE), .texels = N(TEXELS_BC3)),
    DRAW("ETC2", "random blocks of RGB", flip, 8, .fragment = N(FRAGMENT_TEXTURE),
         .texels = N(TEXELS_ETC2)),

    // Fragments' values.
    DRAW("perspective interpolation", "colours of a floor", fragment, N(FRAGMENT_AFFINE),
         .mesh = N(FLOOR)),
    DRAW("centroid interpolation", "colours of shards, 4 samples", fragment, N(FRAGMENT_COLOUR),
         .fragment = N(FRAGMENT_CENTROID), .mesh = N(SHARDS), .samples = 1),
    DRAW("derivatives", "dFdx, dFdy and fwidth over a floor", nudge, 8,
         .fragment = N(FRAGMENT_DERIVATIVES), .mesh = N(FLOOR), .format = N(RGBA32F)),
    DRAW("provoking vertex", "flat colours, of the first corner", provokes_last, 1,
         .fragment = N(FRAGMENT_FLAT), .mesh = N(SHARDS)),

    // Primitives.
    DRAW("clipping", "triangles through the near plane and beyond the guard band", depth_clamp, 1,
         .mesh = N(BEYOND)),
    DRAW("clip distance", "shards cut by a plane", value, 1, .vertex = N(VERTEX_CLIPPED),
         .mesh = N(SHARDS)),
    DRAW("culling", "shards without those that turn clockwise", cull, N(CULL_FRONT),
         .mesh = N(SHARDS), .cull = N(CULL_BACK)),
    DRAW("lines", "lines of one pixel", nudge, 64, .mesh = N(SHARDS), .topology = N(LINES)),
    DRAW("points", "points of 5 pixels", value, 6, .mesh = N(SHARDS), .topology = N(POINTS),
         .value = 5),
    DRAW("scissor", "a pane, 5 pixels cut off all around", scissor, 6, .scissor = 5),
    DRAW("geometry stage", "a second triangle beside each", value, 1, .mesh = N(SHARDS),
         .between = N(GEOMETRY_STAGE)),
    DRAW("tessellation", "patches at fractional levels", value, 18, .mesh = N(SHARDS),
         .topology = N(PATCHES), .between = N(TESSELLATION_STAGE), .value = 17),
    DRAW("layers and viewports", "each triangle into 4 layers, each with a viewport and a scissor",
         value, 2, .mesh = N(SHARDS), .between = N(LAYER_STAGE), .viewports = 1,
         .layers = N(LAYERS), .scissor = 5),
    DRAW("indexed draws", "an indirect one with restarts, base vertex and instances", base_vertex,
         4, .mesh = N(SHARDS), .topology = N(STRIP), .indexed = 1, .base_vertex = 3,
         .more_instances = 1, .first_instance = 1, .indirect = 1),
    DRAW("transform feedback", "a strip's vertices, caught as triangles", shift, 1,
         .vertex = N(VERTEX_FEEDBACK), .mesh = N(SHARDS), .topology = N(STRIP), .feedback = 1,
         .value = 1),
    DRAW("vertex formats", "bytes, words, halves and tens as colours", flip, 6,
         .vertex = N(VERTEX_FORMATS), .mesh = N(SHARDS), .format = N(RGBA16F)),

    // Depth and stencil.
    DRAW("depth test", "shards through each other, 16 bits", depth_test, N(NOT_EQUAL),
         .mesh = N(SHARDS), .depth = N(D16), .depth_test = N(LESS)),
    DRAW("polygon offset", "shards with slope and unit, 32 bits", offset_units, 5,
         .mesh = N(SHARDS), .depth = N(D32F), .depth_test = N(LESS), .offset_units = 4,
         .offset_slope_16 = 24),
    DRAW("late depth", "fragments that write their depth", value, 1, .fragment = N(FRAGMENT_DEPTH),
         .mesh = N(SHARDS), .depth = N(D32F), .depth_test = N(LESS_EQUAL)),
    DRAW("early depth", "fragments tested before they count and discard", fragment,
         N(FRAGMENT_DISCARD), .fragment = N(FRAGMENT_EARLY), .mesh = N(SHARDS), .depth = N(D32F),
         .depth_test = N(LESS), .counts = 1),
    DRAW("stencil", "two sides with an operation each", stencil_back, N(DECREMENT),
         .mesh = N(SHARDS), .depth = N(D32F_S8), .depth_test = N(LESS),
         .stencil_front = N(INCREMENT), .stencil_back = N(INVERT)),

    // Colour.
    DRAW("blending RGBA8", "five targets with an equation each", blend, N(BLEND_OVER),
         .fragment = N(FRAGMENT_TARGETS), .mesh = N(SHARDS), .blend = N(BLEND_EQUATIONS),
         .more_targets = N(EQUATIONS) - 1),
    DRAW("blending RGBA16F", "five targets with an equation each", blend, N(BLEND_OVER),
         .fragment = N(FRAGMENT_TARGETS), .mesh = N(SHARDS), .blend = N(BLEND_EQUATIONS),
         .more_targets = N(EQUATIONS) - 1, .format = N(RGBA16F)),
    DRAW("blending RGBA32F", "five targets with an equation each", blend, N(BLEND_OVER),
         .fragment = N(FRAGMENT_TARGETS), .mesh = N(SHARDS), .blend = N(BLEND_EQUATIONS),
         .more_targets = N(EQUATIONS) - 1, .format = N(RGBA32F)),
    DRAW("dual source", "weighed by a second colour", blend, N(BLEND_SRC1_ALPHA),
         .fragment = N(FRAGMENT_DUAL), .mesh = N(SHARDS), .blend = N(BLEND_SRC1_COLOUR)),
    DRAW("write mask", "green and alpha alone", write_off, 4, .mesh = N(SHARDS), .write_off = 5),
    DRAW("multisampling", "shards of 4 samples, resolved; the neighbour masks one out", samples_off,
         8, .mesh = N(SHARDS), .samples = 1),
    DRAW("alpha to coverage", "alpha as samples", alpha_to_coverage, 0, .mesh = N(SHARDS),
         .samples = 1, .alpha_to_coverage = 1),
    DRAW("stores", "images of four formats", nudge, 8, .fragment = N(FRAGMENT_STORE), .stores = 1),
    DRAW("queries", "occlusion and the pipeline's statistics", depth_test, N(ALWAYS),
         .mesh = N(SHARDS), .depth = N(D32F), .depth_test = N(LESS), .queries = 1),
    DRAW("blit", "a target made smaller, linear", blit, 1 + N(NEAREST), .mesh = N(SHARDS),
         .blit = 1 + N(LINEAR)),
};

int rg_fixed_count(void)
{
    return (int)(sizeof(rg_fixed_draws) / sizeof(rg_fixed_draws[0]));
}

_Static_assert(sizeof(rg_fixed_draws) / sizeof(rg_fixed_draws[0]) <= RG_FIXED_MAX_DRAWS,
               "more draws than a message holds");

struct rg_fixed_state rg_fixed_neighbour(const struct rg_fixed_draw *draw)
{
    struct rg_fixed_state state = draw->state;
    *(int *)(void *)((char *)&state + draw->changed) = draw->to;
    return state;
}
