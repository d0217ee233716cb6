// The slots of one kernel: the buffers and images that it reads and writes, as accessor functions.
//
// A kernel header defines RG_PARAMS (its struct of parameters) and RG_SLOTS, then includes this
// file:
//
//   IN(slot, T, name)        name_at(rg, i)                  a buffer of T, read
//   OUT(slot, T, name)       name_put(rg, i, v)              a buffer of T, written
//   INOUT(slot, T, name)     both                            an item touches its own elements only
//   ATOMIC(slot, T, name)    name_add, _min, _max, _or, _store (rg, i, v); name_load(rg, i);
//                            name_exchange_if(rg, i, expected, v) returns what was there
//                                                            a buffer of int or uint, shared
//   IMAGE(slot, F, name)     name_texel(rg, x, y, layer, level), name_width(rg, level),
//                            name_height(rg, level), name_levels(rg); name_bytes(rg, x, y, layer,
//                            level): a texel of RGBA8 as one word, r lowest; name_texels(rg, x0,
//                            x1, y, layer, level): two of a row, where x1 is x0 or x0 + 1;
//                            name_nearest(rg, u, v, layer, level): the texel at (u, v), 0 to 1
//                            across the image, clamped at the edges
//   SAMPLED(slot, F, name, how)
//                            the same, which the driver's sampler reads on native devices:
//     FILTERED               name_linear(rg, u, v, layer, level) of four texels,
//                            name_trilinear(rg, u, v, layer, lod), both clamped at the edges;
//                            name_between(rg, x, y, layer, level): linear, at a place in texels
//     TILED                  repeated (kernels/scenery/texture.h)
//     CUBE                   six layers by direction (dialect/image/cube_light.h)
//     SHADOW                 depths that are compared (kernels/scenery/shadow.h), singly or four at
//     a
//                            time: the constant rg_filters_depth says whether the driver weighs
//                            four
//   OUT_IMAGE(slot, F, name) name_store(rg, x, y, layer, c)  level 0 of an image of format F
//
// A GRID kernel whose items (x, y, z) each store texel (x, y) of one layer of its OUT_IMAGE at
// most, and write nothing else, defines RG_OWN_TEXELS: that layer, of p and z alone. Native devices
// draw its texels. kernels/build/describe.h checks the slots.
//
// Slots count from 1, buffers and images together. `rg` is the kernel's context, which every helper
// that reads or writes gets. The value that an atomic returns must never influence a result, which
// is why add, min, max and or return none.
#ifndef RG_KERNELS_DIALECT_SLOTS_SLOTS_H
#define RG_KERNELS_DIALECT_SLOTS_SLOTS_H

#include "kernels/dialect/image/format.h"

// The parameters of a run, and the slots beside the kernel's own. Stages of DRAW programs have
// larger parameters and further slots (dialect/draw/draw.h).
#ifndef RG_RUN_PARAMS
#define RG_RUN_PARAMS RG_PARAMS
#endif
#ifndef RG_STAGE_SLOTS
#define RG_STAGE_SLOTS
#endif
#define RG_ALL_SLOTS RG_SLOTS RG_STAGE_SLOTS

// An image like any other, where no sampler reads it.
#define SAMPLED(slot, F, name, how) IMAGE(slot, F, name)

// name_texels for formats and languages in which two texels together cost as much as singly.
#define RG_TEXELS_SINGLY(name)                                                                     \
    RG_FN rg_texels name##_texels(rg_ctx rg, int x0, int x1, int y, int layer, int level)          \
    {                                                                                              \
        rg_texels t;                                                                               \
        t.left = name##_texel(rg, x0, y, layer, level);                                            \
        t.right = name##_texel(rg, x1, y, layer, level);                                           \
        return t;                                                                                  \
    }

#define RG_GRID_KERNEL(name)                                                                       \
    RG_PROC void rg_kernel(rg_ctx rg RG_UNUSED, RG_RUN_PARAMS p RG_UNUSED, int x RG_UNUSED,        \
                           int y RG_UNUSED, int z RG_UNUSED)

// A kernel with many items that change nothing can say which these are: true only if running items
// x to x + count - 1 would write nothing but the values already there. It defines RG_IDLE_ITEMS,
// the number of items to ask for at a time. `cpu` asks, and skips idle items; other devices run
// all.
#define RG_GRID_IDLE(name)                                                                         \
    RG_FN bool rg_is_idle(rg_ctx rg RG_UNUSED, RG_RUN_PARAMS p RG_UNUSED, int x RG_UNUSED,         \
                          int y RG_UNUSED, int z RG_UNUSED, int count RG_UNUSED)

#if RG_GLSL
#include "kernels/dialect/slots/glsl.h"
#else
#include "kernels/dialect/slots/memory.h"
#endif

#include "kernels/dialect/image/filter.h"

#endif
