// The parameters of lines.h and sheets.h.
#ifndef RG_KERNELS_SCENERY_OVERLAY_LINES_PARAMS_H
#define RG_KERNELS_SCENERY_OVERLAY_LINES_PARAMS_H

#include "kernels/dialect/matrix.h"

// A line's words: both ends, a premultiplied colour, and its width in pixels. A sheet's words: four
// corners, in turn, and a premultiplied colour.
#define SCENERY_LINE_WORDS  11
#define SCENERY_SHEET_WORDS 16

// Lines are at most this wide; a wider one might end before the picture's edge.
#define SCENERY_WIDEST_PX 64.0f

RG_STRUCT(scenery_lines_params)
{
    m4 to_clip; // from the world
};
RG_STRUCT_SIZE(scenery_lines_params, 16)

#endif
