// A DRAW program: items that become polygons, and the colour and depth of their pixels.
//
// A program's header defines RG_PARAMS and RG_SLOTS (slots 1 to RG_DRAW_SLOTS - 1) like a GRID
// kernel's. It also defines RG_CORNERS (3 or 4: corners of an item) and RG_RECORD (the struct of
// 4-byte scalars that its fragments read), includes this file, and has three functions:
//
//   RG_DRAW_ITEM(name)      { ... }  returns item i's corners in clip space (clip.h). It runs for
//                                    every item, so it is short and has no branches.
//   RG_DRAW_RECORD(name)    { ... }  returns item i's record for its fragments. It runs for
//                                    items that are seen.
//   RG_DRAW_FRAGMENT(name)  { ... }  returns colour and depth of pixel (px, py), from the record r
//                                    alone.
//
// All three get the slots `rg` and the parameters `p`; the first two also get the state `draw`.
//
// A program that defines RG_LIGHTS has lights, as many as its parameters' `int lights` says, and a
// fourth function:
//
//   RG_DRAW_LIGHT(name)     { ... }  returns the rg_lit that light number `light` adds at pixel
//                                    (px, py), from r.
//
// An rg_lit is an rgba. In a program that also defines RG_GLOSS it is an rg_glossy: what falls on
// a surface, and beside it what the surface mirrors without tinting it.
//
// A program that also defines RG_LIGHT_RECORD (a struct of 4-byte scalars) has a record for each
// item and light, and a fifth function:
//
//   RG_DRAW_RECORD_LIGHT(name)  { ... }  returns the record of light number `light` and the item
//                                        whose record is r, from r alone. RG_DRAW_LIGHT gets it
//                                        as `by`.
//
// Devices compute this record once for each item and light, or once for each pixel and light.
//
// The RG_DRAW_FRAGMENT of a program with lights also gets `rg_lit lit`: the sum of zero and
// lights 0 to p.lights - 1, in order. Only the colour may depend on `lit`: devices ask for depth
// and `kept` before they run the lights, so that they need not light hidden pixels.
//
// A program with many items out of sight can say which these are. It defines RG_GROUP_ITEMS, a
// power of 2 up to 64, and RG_GROUP, a struct of 4-byte scalars that so many items in a row share,
// and has:
//
//   RG_DRAW_GROUP(name)  { ... }  returns the data that items RG_GROUP_ITEMS * number and following
//                                 share.
//   RG_DRAW_UNSEEN(name)  { ... }  returns 1 only if item i, of `group`, covers no pixel: its
//                                  corners are dead, whatever the scissor.
//
// `cpu` asks, and makes no corners of unseen items; other devices make the corners of all. `cpu`
// asks for a group before it needs it, so that RG_DRAW_GROUP may RG_FETCH the elements that the
// group's items will read.
//
// A program in which many records need only a part of the fragments' arithmetic defines RG_PLAIN,
// and has:
//
//   RG_DRAW_PLAIN(name)  { ... }  returns 1 if r is such a record.
//
// Its RG_DRAW_LIGHT and RG_DRAW_FRAGMENT may leave out the other part if rg_all_plain(rg) is not 0,
// and must return the same. `cpu` lists pixels of plain records apart; on other devices
// rg_all_plain is 0.
//
// A program whose fragments are as deep as its corners, interpolated, defines RG_DEPTH_OF_CORNERS.
// Native devices then leave depth to the driver, which can test it early. In their fragments rg_at
// is the pixel's place among the corners, also interpolated: (0, 0), (1, 0) and, for the last
// corner, (0, 1); the third of four has (1, 1). Kernels use it in RG_INTERPOLATED (dialect/lang.h).
//
// A program whose fragments read most words of a long record defines RG_COLUMNS. `cpu` then reads
// the record once for a primitive's listed pixels, and spreads its words, instead of gathering
// them.
#ifndef RG_KERNELS_DIALECT_DRAW_DRAW_H
#define RG_KERNELS_DIALECT_DRAW_DRAW_H

#include "kernels/dialect/draw/clip.h"

// Prefetches element i of a slot's buffer into the cache, on devices where programs can.
#if RG_GLSL || RG_OPENCL || RG_CHECKED
#define RG_FETCH(rg, name, i)
#else
#define RG_FETCH(rg, name, i) __builtin_prefetch(&(rg).name[i]);
#endif

#define RG_DRAW_SLOTS 12 // the stages take the last four of the 16 slots

// A packed primitive: corners on the grid, its item's index, and the item's record.
RG_STRUCT(rg_prim)
{
    rg_snapped corners;
    int item;
    RG_RECORD record;
};

// The parameters of all stages' shells.
RG_STRUCT(rg_draw_call)
{
    rg_draw_state draw;
    RG_PARAMS program;
};
#define RG_RUN_PARAMS rg_draw_call

// The slots that a stage binds beside the program's own. The vertex stage has slot 12 in a form of
// its own (shaders/draw.vert).
#if defined(RG_STAGE_COUNT)
#define RG_STAGE_SLOTS OUT(13, uint, rg_counts) OUT(15, uint, rg_fates)
#elif defined(RG_STAGE_EMIT)
#define RG_STAGE_SLOTS                                                                             \
    OUT(12, rg_prim, rg_prims)                                                                     \
    IN(13, uint, rg_before) OUT(14, uint, rg_draw_args) IN(15, uint, rg_fates)
#elif defined(RG_STAGE_FRAGMENT)
#define RG_STAGE_SLOTS                                                                             \
    IN(12, rg_prim, rg_prims) ATOMIC(14, uint, rg_samples) IMAGE(15, D32F, rg_behind)
#endif

#include "kernels/dialect/slots/slots.h"

// A pixel's colour, premultiplied if it is blended, and its depth, 0 near to 1 far.
RG_STRUCT(rg_fragment)
{
    rgba colour;
    float depth;
    int kept; // 0: the pixel is left as it was
};

RG_FN rg_fragment rg_fragment_make(rgba colour, float depth)
{
    rg_fragment f;
    f.colour = colour;
    f.depth = depth;
    f.kept = 1;
    return f;
}

#define RG_DRAW_ITEM(name)                                                                         \
    RG_FN rg_item rg_program_item(rg_ctx rg RG_UNUSED, rg_draw_state draw RG_UNUSED,               \
                                  RG_PARAMS p RG_UNUSED, int i RG_UNUSED)
#define RG_DRAW_RECORD(name)                                                                       \
    RG_FN RG_RECORD rg_program_record(rg_ctx rg RG_UNUSED, rg_draw_state draw RG_UNUSED,           \
                                      RG_PARAMS p RG_UNUSED, int i RG_UNUSED)
#define RG_DRAW_GROUP(name)                                                                        \
    RG_FN RG_GROUP rg_program_group(rg_ctx rg RG_UNUSED, RG_PARAMS p RG_UNUSED, int number)
#define RG_DRAW_UNSEEN(name)                                                                       \
    RG_FN int rg_program_unseen(rg_ctx rg RG_UNUSED, RG_PARAMS p RG_UNUSED, RG_GROUP group, int i)
#define RG_DRAW_PLAIN(name) RG_FN int rg_program_plain(RG_RECORD r)
#if defined(RG_LIGHT_RECORD)
#define RG_DRAW_RECORD_LIGHT(name)                                                                 \
    RG_FN RG_LIGHT_RECORD rg_program_record_light(rg_ctx rg RG_UNUSED, RG_PARAMS p RG_UNUSED,      \
                                                  RG_RECORD r RG_UNUSED, int light RG_UNUSED)
#define RG_LIGHT_BY                      , RG_LIGHT_RECORD by RG_UNUSED
#define RG_RECORD_LIGHT(rg, p, r, light) , rg_program_record_light(rg, p, r, light)
#else
#define RG_LIGHT_BY
#define RG_RECORD_LIGHT(rg, p, r, light)
#endif
#if defined(RG_LIGHTS)
#if defined(RG_GLOSS)
RG_STRUCT(rg_glossy)
{
    float r, g, b;
    float gloss_r, gloss_g, gloss_b;
};
#define rg_lit             rg_glossy
#define RG_LIGHT_PARTS(DO) DO(r) DO(g) DO(b) DO(gloss_r) DO(gloss_g) DO(gloss_b)
#else
#define rg_lit             rgba
#define RG_LIGHT_PARTS(DO) DO(r) DO(g) DO(b) DO(a)
#endif
#define RG_DRAW_LIGHT(name)                                                                        \
    RG_FN rg_lit rg_program_light(rg_ctx rg RG_UNUSED, RG_PARAMS p RG_UNUSED,                      \
                                  RG_RECORD r RG_UNUSED, int px RG_UNUSED, int py RG_UNUSED,       \
                                  int light RG_UNUSED RG_LIGHT_BY)
#define RG_FRAGMENT_LIT , rg_lit lit RG_UNUSED

RG_FN rg_lit rg_no_light(void)
{
    rg_lit none;
#define RG_DARK(part) none.part = 0.0f;
    RG_LIGHT_PARTS(RG_DARK)
#undef RG_DARK
    return none;
}

RG_FN rg_lit rg_light_sum(rg_lit a, rg_lit b)
{
    rg_lit sum;
#define RG_SUM(part) sum.part = a.part + b.part;
    RG_LIGHT_PARTS(RG_SUM)
#undef RG_SUM
    return sum;
}
#else
#define RG_FRAGMENT_LIT
#endif
#define RG_DRAW_FRAGMENT(name)                                                                     \
    RG_FN rg_fragment rg_program_fragment(rg_ctx rg RG_UNUSED, RG_PARAMS p RG_UNUSED,              \
                                          RG_RECORD r RG_UNUSED, int px RG_UNUSED,                 \
                                          int py RG_UNUSED RG_FRAGMENT_LIT)

// The depth that all devices use: within 0 to 1, and never subnormal.
RG_FN float rg_settled_depth(float depth)
{
    float settled = rg_clamp(depth, 0.0f, 1.0f);
    return settled < 1e-30f ? 0.0f : settled;
}

RG_FN rg_fragment rg_settled(rg_fragment f)
{
    rg_fragment settled = f;
    settled.depth = rg_settled_depth(f.depth);
    return settled;
}

// A colour that leaves the driver nothing to round before it blends. Blended floats stay as they
// are.
RG_FN rgba rg_drawn(rg_draw_state draw, rgba c)
{
    rgba drawn = c;
    if (draw.colour_format == RG_RGBA8_FORMAT)
        drawn = rg_rounded_RGBA8(c);
    if (draw.colour_format == RG_RGBA16F_FORMAT && draw.blend == 0)
        drawn = rg_rounded_RGBA16F(c);
    return drawn;
}

#endif
