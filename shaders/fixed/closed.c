// The table of closed cases.
#include "shaders/fixed/fixed.h"

#define N(constant) RG_FIXED_##constant
#define TEXTURED    .fragment = N(FRAGMENT_TEXTURE), .texels = N(TEXELS_RGBA8)
#define SMOOTH      .mag = N(LINEAR), .min = N(LINEAR)
#define STATE(...)                                                                                 \
    {                                                                                              \
        __VA_ARGS__                                                                                \
    }
#define CONSTANT(mesh_, ...)                                                                       \
    STATE(TEXTURED, .plain = N(CONSTANT), .mesh = N(mesh_), __VA_ARGS__),                          \
        STATE(TEXTURED, .plain = N(CONSTANT), .mesh = N(mesh_))
#define LEVEL_2(mip_)                                                                              \
    STATE(TEXTURED, .mesh = N(FLOOR), SMOOTH, .mip = N(mip_), .lod_least_16 = 32, .lod_most_16 = 32)

const struct rg_fixed_closed rg_fixed_closed[] = {
    {"linear", "at texels' centres equals nearest", STATE(TEXTURED, .mesh = N(SQUARE), SMOOTH),
     STATE(TEXTURED, .mesh = N(SQUARE))},
    {"linear", "a constant texture equals nearest", CONSTANT(PANE, SMOOTH)},
    {"trilinear", "a constant texture equals nearest",
     CONSTANT(FLOOR, SMOOTH, .mip = N(MIP_LINEAR))},
    {"trilinear", "at a whole level equals mip nearest", LEVEL_2(MIP_LINEAR), LEVEL_2(MIP_NEAREST)},
    {"anisotropic", "a constant texture equals nearest",
     CONSTANT(FLOOR, SMOOTH, .mip = N(MIP_LINEAR), .anisotropy = 8)},
    {"wrap modes", "a constant texture equals nearest",
     CONSTANT(PANE, SMOOTH, .wrap_u = N(MIRROR), .wrap_v = N(EDGE))},
    {"cube seams", "a constant cube equals nearest",
     STATE(.fragment = N(FRAGMENT_CUBE), .texels = N(TEXELS_RGBA8), .texture = N(CUBE),
           .plain = N(CONSTANT), SMOOTH),
     STATE(.fragment = N(FRAGMENT_CUBE), .texels = N(TEXELS_RGBA8), .texture = N(CUBE),
           .plain = N(CONSTANT))},
    {"array layers", "layer 0 equals a texture without layers",
     STATE(.fragment = N(FRAGMENT_LAYERED), .texels = N(TEXELS_RGBA8), .texture = N(ARRAY),
           .mesh = N(SQUARE)),
     STATE(TEXTURED, .mesh = N(SQUARE))},
    {"sRGB decoding", "black and white are unchanged",
     STATE(.fragment = N(FRAGMENT_TEXTURE), .texels = N(TEXELS_SRGB8), .plain = N(EXTREMES)),
     STATE(TEXTURED, .plain = N(EXTREMES))},
    {"perspective interpolation", "w = 1 equals interpolation without perspective",
     STATE(.mesh = N(PANE), .fragment = N(FRAGMENT_COLOUR)),
     STATE(.mesh = N(PANE), .fragment = N(FRAGMENT_AFFINE))},
    {"provoking vertex", "with one colour a triangle, last equals first",
     STATE(.fragment = N(FRAGMENT_FLAT), .mesh = N(SHARDS), .plain = N(CONSTANT),
           .provokes_last = 1),
     STATE(.fragment = N(FRAGMENT_FLAT), .mesh = N(SHARDS), .plain = N(CONSTANT))},
    {"clip distance", "planes that cut nothing equal no planes",
     STATE(.mesh = N(SHARDS), .vertex = N(VERTEX_CLIPPED), .value = 1024),
     STATE(.mesh = N(SHARDS))},
    {"depth test", "with one layer, less equals always",
     STATE(.mesh = N(PANE), .depth = N(D16), .depth_test = N(LESS)),
     STATE(.mesh = N(PANE), .depth = N(D16), .depth_test = N(ALWAYS))},
    {"multisampling", "texels that fill their pixels equal one sample",
     STATE(TEXTURED, .mesh = N(SQUARE), .samples = 1), STATE(TEXTURED, .mesh = N(SQUARE))},
};

int rg_fixed_closed_count(void)
{
    return (int)(sizeof(rg_fixed_closed) / sizeof(rg_fixed_closed[0]));
}
