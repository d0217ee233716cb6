// The parameters of mesh.h.
#ifndef RG_KERNELS_RASTER_MESH_PARAMS_H
#define RG_KERNELS_RASTER_MESH_PARAMS_H

#include "kernels/dialect/matrix.h"

RG_STRUCT(raster_mesh_params)
{
    m4 to_clip;
    float light_x, light_y, light_z; // towards the light, in the mesh's space, of unit length
    float ambient;
};
RG_STRUCT_SIZE(raster_mesh_params, 20)

#endif
