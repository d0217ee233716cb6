// The parameters of the pictures of drops' maps: the place of the pane in the picture.
#ifndef RG_KERNELS_DROPS_VIEW_PARAMS_H
#define RG_KERNELS_DROPS_VIEW_PARAMS_H

#include "kernels/dialect/lang.h"

RG_STRUCT(drops_view_params)
{
    int columns; // cells of the pane
    int rows;
    int stride;
    int is_of_ids;      // 1: the ID map, else the height map
    float cells_per_px; // of the picture
    float first_column; // at the picture's left edge
    float first_row;
    float white_mm; // the height that is drawn white
    float cell_mm;  // side of a cell
    int width;      // of the picture, in pixels
    int height;
    uint critical;  // quanta: heavier drops run
    float least_px; // radius of the smallest disc that is drawn
};
RG_STRUCT_SIZE(drops_view_params, 13)

#endif
