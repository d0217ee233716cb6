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
    {"linear", "at texels' centres as nearest", STATE(TEXTURED, .mesh = N(SQUARE), SMOOTH),
     STATE(TEXTURED, .mesh = N(SQUARE))},
    {"linear", "a constant texture as nearest", CONSTANT(PANE, SMOOTH)},
    {"trilinear", "a constant texture as nearest", CONSTANT(FLOOR, SMOOTH, .mip = N(MIP_LINEAR))},
    {"trilinear", "at a whole level as mip nearest", LEVEL_2(MIP_LINEAR), LEVEL_2(MIP_NEAREST)},
    {"anisotropic", "a constant texture as nearest",
     CONSTANT(FLOOR, SMOOTH, .mip = N(MIP_LINEAR), .anisotropy = 8)},
    {"wrap modes", "a constant texture as nearest",
     CONSTANT(PANE, SMOOTH, .wrap_u = N(MIRROR), .wrap_v = N(EDGE))},
    {"cube seams", "a constant cube as nearest",
     STATE(.fragment = N(FRAGMENT_CUBE), .texels = N(TEXELS_RGBA8), .texture = N(CUBE),
           .plain = N(CONSTANT), SMOOTH),
     STATE(.fragment = N(FRAGMENT_CUBE), .texels = N(TEXELS_RGBA8), .texture = N(CUBE),
           .plain = N(CONSTANT))},
    {"array layers", "layer 0 as a texture without layers",
     STATE(.fragment = N(FRAGMENT_LAYERED), .texels = N(TEXELS_RGBA8), .texture = N(ARRAY),
           .mesh = N(SQUARE)),
     STATE(TEXTURED, .mesh = N(SQUARE))},
    {"sRGB decoding", "black and white as they are",
     STATE(.fragment = N(FRAGMENT_TEXTURE), .texels = N(TEXELS_SRGB8), .plain = N(EXTREMES)),
     STATE(TEXTURED, .plain = N(EXTREMES))},
    {"perspective interpolation", "with w = 1 as without perspective",
     STATE(.mesh = N(PANE), .fragment = N(FRAGMENT_COLOUR)),
     STATE(.mesh = N(PANE), .fragment = N(FRAGMENT_AFFINE))},
    {"provoking vertex", "one colour a triangle, last as first",
     STATE(.fragment = N(FRAGMENT_FLAT), .mesh = N(SHARDS), .plain = N(CONSTANT),
           .provokes_last = 1),
     STATE(.fragment = N(FRAGMENT_FLAT), .mesh = N(SHARDS), .plain = N(CONSTANT))},
    {"clip distance", "all inside as without",
     STATE(.mesh = N(SHARDS), .vertex = N(VERTEX_CLIPPED), .value = 1024),
     STATE(.mesh = N(SHARDS))},
    {"depth test", "one layer, less as always",
     STATE(.mesh = N(PANE), .depth = N(D16), .depth_test = N(LESS)),
     STATE(.mesh = N(PANE), .depth = N(D16), .depth_test = N(ALWAYS))},
    {"multisampling", "texels that fill their pixels as one sample",
     STATE(TEXTURED, .mesh = N(SQUARE), .samples = 1), STATE(TEXTURED, .mesh = N(SQUARE))},
};

int rg_fixed_closed_count(void)
{
    return (int)(sizeof(rg_fixed_closed) / sizeof(rg_fixed_closed[0]));
}
