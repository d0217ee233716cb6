// The parameters of show.h.
#ifndef RG_KERNELS_DROPS_SHOW_PARAMS_H
#define RG_KERNELS_DROPS_SHOW_PARAMS_H

#include "kernels/dialect/lang.h"

RG_STRUCT(drops_show_params)
{
    int columns; // cells of the pane
    int rows;
    int stride;
    int is_of_ids;      // 1: the ID map, else the height map
    float cells_per_px; // of the picture
    float first_column; // at the picture's left edge
    float first_row;
    float white_mm; // the height that is drawn white
};
RG_STRUCT_SIZE(drops_show_params, 8)

#endif
