// The sections that bound each draw, and what drivers are known to leave beyond bounds.
#include "shaders/fixed/bounds/bounds.h"

#include <string.h>

// Names of OpenGL 4.6 and of Vulkan 1.3, or of both.
#define NORMALIZED "Conversion from Floating-Point to Normalized Fixed-Point"
#define COVERED    "Basic Polygon Rasterization; " NORMALIZED
#define FILTERED                                                                                   \
    "OpenGL, Coordinate Wrapping and Texel Selection; Vulkan, Texel Coordinate Systems, Texel "    \
    "Filtering"
#define LEVELS                                                                                     \
    "OpenGL, Scale Factor and Level of Detail; Vulkan, Scale Factor Operation, LOD "               \
    "Operation; " FILTERED
#define S3TC    "Khronos Data Format, S3TC Compressed Texture Image Formats"
#define TESTED  "OpenGL, Depth Buffer Test; Vulkan, Depth Test; " COVERED
#define BLENDED "OpenGL, Blending; Vulkan, Blend Operations; " COVERED
#define SAMPLED                                                                                    \
    "Multisampling; OpenGL Shading Language, Interpolation Qualifiers; Vulkan, "                   \
    "standardSampleLocations; " COVERED

static const struct {
    const char *feature, *sections;
} rows[] = {
    {"nearest", FILTERED},
    {"linear", FILTERED},
    {"mip nearest", LEVELS},
    {"trilinear", LEVELS},
    {"anisotropic", NULL}, // number and places of its samples are the device's
    {"LOD bias and clamp", LEVELS},
    {"gradients", LEVELS},
    {"gather", "Texture Gather; " FILTERED},
    {"depth compare", "OpenGL, Texture Comparison Modes; Vulkan, Depth Compare Operation"},
    {"cube seams",
     "OpenGL, Cube Map Texture Selection, Seamless Cube Map Filtering; Vulkan, Cube Map Face "
     "Selection, Cube Map Edge Handling; " FILTERED},
    {"array layers", FILTERED},
    {"wrap modes", FILTERED},
    {"border colour", FILTERED},
    {"sRGB decoding", "Khronos Data Format, sRGB EOTF; " FILTERED},
    {"BC1", S3TC},
    {"BC3", S3TC},
    {"ETC2", "Khronos Data Format, ETC2 Compressed Texture Image Formats"},
    {"perspective interpolation", COVERED},
    {"centroid interpolation", SAMPLED},
    {"derivatives", "OpenGL Shading Language, Derivative Functions; Vulkan, Derivative Operations"},
    {"provoking vertex", "OpenGL, Flatshading; Vulkan, Flat Shading; " COVERED},
    {"clipping", "Primitive Clipping; " COVERED},
    {"clip distance", "Primitive Clipping; " COVERED},
    {"culling", COVERED},
    {"lines", "Basic Line Segment Rasterization"},
    {"points", "Basic Point Rasterization"},
    {"scissor", "Scissor Test; " COVERED},
    {"geometry stage", COVERED},
    {"tessellation", NULL}, // which triangles fill a patch is the device's
    {"layers and viewports", "Controlling the Viewport; " COVERED},
    {"indexed draws", "Triangle Strips; " COVERED},
    {"transform feedback", "Transform Feedback; Triangle Strips; " COVERED},
    {"vertex formats", "Conversion from Normalized Fixed-Point to Floating-Point; " COVERED},
    {"depth test", TESTED},
    {"polygon offset", "OpenGL, Depth Offset; Vulkan, Depth Bias; " TESTED},
    {"late depth", TESTED},
    {"early depth", "OpenGL, Early Fragment Tests; Vulkan, Early Fragment Test; " TESTED},
    {"stencil", "Stencil Test; " TESTED},
    {"blending RGBA8", BLENDED},
    {"blending RGBA16F", "16-Bit Floating-Point Numbers; " BLENDED},
    {"blending RGBA32F", BLENDED},
    {"dual source", "Dual Source Blending; " BLENDED},
    {"write mask", "OpenGL, Fine Control of Buffer Updates; Vulkan, Color Write Mask; " COVERED},
    {"multisampling", SAMPLED},
    {"alpha to coverage", "OpenGL, Alpha To Coverage; Vulkan, Multisample Coverage; " SAMPLED},
    {"stores", "Unsigned 11-Bit Floating-Point Numbers; " COVERED},
    {"queries", "Occlusion Queries; Pipeline Statistics Queries; " TESTED},
    {"blit", "OpenGL, Blitting Pixel Rectangles; Vulkan, Image Copies With Scaling"},
};

const char *rg_fixed_sections(const char *feature)
{
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); i++)
        if (!strcmp(rows[i].feature, feature))
            return rows[i].sections;
    return NULL;
}

// A device whose name has this part leaves at most so many values beyond, the first in this part of
// the picture.
static const struct {
    const char *feature, *device, *part;
    int most;
    const char *why;
} faults[] = {
    // In triangles with corners of several w, the value lies outside the pixel.
    {"centroid interpolation", "llvmpipe", "colour 0", 6,
     "Mesa divides by w at the pixel's centre"},
};

const char *rg_fixed_known_fault(const char *feature, const char *device,
                                 const struct rg_fixed_beyond *beyond)
{
    for (size_t i = 0; i < sizeof(faults) / sizeof(faults[0]); i++)
        if (!strcmp(faults[i].feature, feature) && strstr(device, faults[i].device) &&
            !strcmp(beyond->part, faults[i].part) && beyond->count > 0 &&
            beyond->count <= faults[i].most)
            return faults[i].why;
    return NULL;
}
