// raster: coloured panes over each other, facing the eye and turning in their plane.
#include "kernels/dialect/math.h"
#include "kernels/raster/quads_params.h"

#define RG_PARAMS  raster_quads_params
#define RG_SLOTS   IN(1, float, quads)
#define RG_CORNERS 4

RG_STRUCT(raster_quad)
{
    rgba colour; // premultiplied
    float depth;
};
#define RG_RECORD raster_quad
#define RG_DEPTH_OF_CORNERS
#include "kernels/dialect/draw/draw.h"

RG_FN float raster_quad_word(rg_ctx rg, int i, int word)
{
    return quads_at(rg, i * RASTER_QUAD_WORDS + word);
}

// A corner at (x, y) from the centre, in the target's heights.
RG_FN rg_corner raster_corner(rg_ctx rg, raster_quads_params p, int i, float x, float y)
{
    return rg_corner_make(raster_quad_word(rg, i, 0) + 2.0f * x / p.aspect,
                          raster_quad_word(rg, i, 1) + 2.0f * y, raster_quad_word(rg, i, 6), 1.0f);
}

RG_DRAW_ITEM(raster_quads)
{
    float angle = raster_quad_word(rg, i, 4) + p.turned * raster_quad_word(rg, i, 5);
    float along_x = rg_cos(angle) * raster_quad_word(rg, i, 2);
    float along_y = rg_sin(angle) * raster_quad_word(rg, i, 2);
    float across_x = -rg_sin(angle) * raster_quad_word(rg, i, 3);
    float across_y = rg_cos(angle) * raster_quad_word(rg, i, 3);
    rg_item t;
    t.alive = 1;
    t.a = raster_corner(rg, p, i, -along_x - across_x, -along_y - across_y);
    t.b = raster_corner(rg, p, i, across_x - along_x, across_y - along_y);
    t.c = raster_corner(rg, p, i, along_x + across_x, along_y + across_y);
    t.d = raster_corner(rg, p, i, along_x - across_x, along_y - across_y);
    return t;
}

RG_DRAW_RECORD(raster_quads)
{
    raster_quad r;
    r.colour = rg_rgba(raster_quad_word(rg, i, 7), raster_quad_word(rg, i, 8),
                       raster_quad_word(rg, i, 9), raster_quad_word(rg, i, 10));
    r.depth = raster_quad_word(rg, i, 6);
    return r;
}

RG_DRAW_FRAGMENT(raster_quads)
{
    return rg_fragment_make(r.colour, r.depth);
}
