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
    {"linear", "at texel centres, linear filtering equals nearest filtering",
     STATE(TEXTURED, .mesh = N(SQUARE), SMOOTH), STATE(TEXTURED, .mesh = N(SQUARE))},
    {"linear", "on a constant texture, every filter gives the same", CONSTANT(PANE, SMOOTH)},
    {"trilinear", "on a constant texture, every filter gives the same",
     CONSTANT(FLOOR, SMOOTH, .mip = N(MIP_LINEAR))},
    {"trilinear", "at a whole level, both levels are one: trilinear equals mip nearest",
     LEVEL_2(MIP_LINEAR), LEVEL_2(MIP_NEAREST)},
    {"anisotropic", "on a constant texture, every filter gives the same",
     CONSTANT(FLOOR, SMOOTH, .mip = N(MIP_LINEAR), .anisotropy = 8)},
    {"wrap modes", "on a constant texture, every wrap mode gives the same",
     CONSTANT(PANE, SMOOTH, .wrap_u = N(MIRROR), .wrap_v = N(EDGE))},
    {"cube seams", "on a constant cube map, every filter gives the same",
     STATE(.fragment = N(FRAGMENT_CUBE), .texels = N(TEXELS_RGBA8), .texture = N(CUBE),
           .plain = N(CONSTANT), SMOOTH),
     STATE(.fragment = N(FRAGMENT_CUBE), .texels = N(TEXELS_RGBA8), .texture = N(CUBE),
           .plain = N(CONSTANT))},
    {"array layers", "layer 0 of an array equals a texture without layers",
     STATE(.fragment = N(FRAGMENT_LAYERED), .texels = N(TEXELS_RGBA8), .texture = N(ARRAY),
           .mesh = N(SQUARE)),
     STATE(TEXTURED, .mesh = N(SQUARE))},
    {"sRGB decoding", "decoding leaves black and white unchanged",
     STATE(.fragment = N(FRAGMENT_TEXTURE), .texels = N(TEXELS_SRGB8), .plain = N(EXTREMES)),
     STATE(TEXTURED, .plain = N(EXTREMES))},
    {"perspective interpolation", "where w is 1, perspective changes nothing",
     STATE(.mesh = N(PANE), .fragment = N(FRAGMENT_COLOUR)),
     STATE(.mesh = N(PANE), .fragment = N(FRAGMENT_AFFINE))},
    {"provoking vertex", "if all corners have one colour, any corner may provoke",
     STATE(.fragment = N(FRAGMENT_FLAT), .mesh = N(SHARDS), .plain = N(CONSTANT),
           .provokes_last = 1),
     STATE(.fragment = N(FRAGMENT_FLAT), .mesh = N(SHARDS), .plain = N(CONSTANT))},
    {"clip distance", "planes that cut nothing change nothing",
     STATE(.mesh = N(SHARDS), .vertex = N(VERTEX_CLIPPED), .value = 1024),
     STATE(.mesh = N(SHARDS))},
    {"depth test", "in front of an empty depth buffer, less equals always",
     STATE(.mesh = N(PANE), .depth = N(D16), .depth_test = N(LESS)),
     STATE(.mesh = N(PANE), .depth = N(D16), .depth_test = N(ALWAYS))},
    {"multisampling", "where a texel fills a whole pixel, four samples equal one",
     STATE(TEXTURED, .mesh = N(SQUARE), .samples = 1), STATE(TEXTURED, .mesh = N(SQUARE))},
};

int rg_fixed_closed_count(void)
{
    return (int)(sizeof(rg_fixed_closed) / sizeof(rg_fixed_closed[0]));
}
