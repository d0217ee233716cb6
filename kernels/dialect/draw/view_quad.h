// One quad that fills the view, for programs whose fragments need only their place. A program
// includes this file instead of draw.h, after RG_PARAMS and RG_SLOTS, and after RG_RECORD if it
// needs a record.
#ifndef RG_KERNELS_DIALECT_DRAW_VIEW_QUAD_H
#define RG_KERNELS_DIALECT_DRAW_VIEW_QUAD_H

#include "kernels/dialect/lang.h"

RG_STRUCT(view_nothing)
{
    int nothing;
};
#ifndef RG_RECORD
#define RG_RECORD view_nothing
#endif
#define RG_CORNERS 4
#include "kernels/dialect/draw/draw.h"

RG_FN rg_item view_quad(void)
{
    rg_item t;
    t.alive = 1;
    t.a = rg_corner_make(-1.0f, -1.0f, 1.0f, 1.0f);
    t.b = rg_corner_make(-1.0f, 1.0f, 1.0f, 1.0f);
    t.c = rg_corner_make(1.0f, 1.0f, 1.0f, 1.0f);
    t.d = rg_corner_make(1.0f, -1.0f, 1.0f, 1.0f);
    return t;
}

RG_FN view_nothing view_quad_record(void)
{
    view_nothing r;
    r.nothing = 0;
    return r;
}

#endif
