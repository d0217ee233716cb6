// The parameters of faces.h.
#ifndef RG_KERNELS_CARTOON_SCENE_FACES_PARAMS_H
#define RG_KERNELS_CARTOON_SCENE_FACES_PARAMS_H

#include "kernels/dialect/matrix.h"

RG_STRUCT(cartoon_faces_params)
{
    m4 to_clip; // from the world
    int first;  // the face that is item 0
};
RG_STRUCT_SIZE(cartoon_faces_params, 17)

#endif
