// Environment maps: the light from every direction, as a cube map.
#ifndef RG_CORE_SCENE_ENVIRONMENT_ENVIRONMENT_H
#define RG_CORE_SCENE_ENVIRONMENT_ENVIRONMENT_H

#include "core/device/device.h"

enum { RG_ENVIRONMENT_PATH_SIZE = 2048 };

// Six faces in the order and orientation of OpenGL (kernels/dialect/image/cube.h), linear light.
// Each face has a border of one texel from its neighbours, so that filtering crosses edges without
// a seam: light[face][y + 1][x + 1][channel], x and y from -1 to size.
struct rg_environment {
    int size; // texels along a face, without the border
    float *light;
};

// Loads by name or path:
//   "street"         a computed street by day, in rain, with faces of size_px texels, 1024 at most
//   "street-night"   the same by night
//   "sky"            a computed overcast sky
//   "crossroads"     a map that Debian's open3d-gui-data installs, without its "_skybox.ktx"; where
//                    the package is absent, the sky, with a warning
//   "FILE.ktx"       a KTX 1 cube map in R11F_G11F_B10F
//   any other path   a lat-long image (EXR, HDR, PNG: core/image/files/io.h), twice as wide as high
// size_px is what the reader asks for; maps that are read have sizes of their own.
// NULL, and one logged line, on failure. The caller destroys it.
struct rg_environment *rg_environment_load(const char *name, int size_px);
void rg_environment_destroy(struct rg_environment *environment);

// The file that a name stands for, which need not exist: computed maps have none.
void rg_environment_file(const char *name, char path[RG_ENVIRONMENT_PATH_SIZE]);

// Uploads an environment as an image in RG11B10F, 6 layers and `levels` levels, each face resampled
// to size_px texels a side in level 0. The caller destroys it.
struct rg_image *rg_environment_upload(const struct rg_environment *environment, int size_px,
                                       int levels, struct rg_device *device);

#endif
