// Makes an OpenCL kernel of a DRAW program: shades the tiles whose primitives shaders/bins.cl has
// sorted. A work item owns a block of pixels of one tile and draws the tile's primitives there, in
// order.
#include RG_KERNEL_HEADER
#include "kernels/dialect/draw/blend.h"
#include "kernels/dialect/draw/coverage.h"
#include "kernels/dialect/draw/bins.h"

// The inputs and the target of a work item.
typedef struct rg_shading {
    rg_ctx rg;
    RG_RUN_PARAMS p;
    __global uint *colour; // texels of the target's layer and level
    __global uint *depth;
    int x0, y0, x1, y1; // the block
} rg_shading;

RG_PROC void rg_blend(const rg_shading *s, int texel, rgba c)
{
    int blend = s->p.draw.blend;
    if (s->p.draw.colour_format == RG_RGBA8_FORMAT)
        rg_blend_RGBA8(s->colour, texel, c, blend);
    else if (s->p.draw.colour_format == RG_RGBA16F_FORMAT)
        rg_blend_RGBA16F(s->colour, texel * 2, c, blend);
    else if (s->p.draw.colour_format != 0)
        rg_blend_RGBA32F(s->colour, texel * 4, c, blend);
}

// Draws a covered pixel; returns 1 if it is visible.
RG_FN uint rg_draw_pixel(const rg_shading *s, rg_fragment fragment, int px, int py)
{
    rg_fragment f = rg_settled(fragment);
    int texel = py * s->p.draw.width + px;
    bool seen = f.kept != 0;
    if (s->p.draw.depth_mode != 0)
        seen = seen && f.depth < as_float(s->depth[texel]);
    if (!seen)
        return 0;
    if (s->p.draw.depth_mode == 2)
        s->depth[texel] = as_uint(f.depth);
    rg_blend(s, texel, rg_drawn(s->p.draw, f.colour));
    return 1;
}

#if defined(RG_LIGHTS)

// The sums of lights for the pixels of a block's row.
typedef struct rg_lit_row {
#define RG_ROW(part) float part[RG_TILE_PX];
    RG_LIGHT_PARTS(RG_ROW)
} rg_lit_row;

RG_FN void rg_put_light(rg_lit_row *lit, int x, rg_lit l)
{
#define RG_PUT_PART(part) lit->part[x] = l.part;
    RG_LIGHT_PARTS(RG_PUT_PART)
}

RG_FN rg_lit rg_light_of(const rg_lit_row *lit, int x)
{
    rg_lit l;
#define RG_GET_PART(part) l.part = lit->part[x];
    RG_LIGHT_PARTS(RG_GET_PART)
    return l;
}

// Whether a covered pixel will be seen, as far as can be told without its colour.
RG_FN int rg_will_be_seen(const rg_shading *s, RG_RECORD record, int px, int py)
{
    if (s->p.draw.depth_mode == 0)
        return 1;
    rg_fragment f = rg_settled(rg_program_fragment(s->rg, s->p.program, record, px, py,
                                                   rg_no_light()));
    return f.kept != 0 && f.depth < as_float(s->depth[py * s->p.draw.width + px]) ? 1 : 0;
}

// Adds one light after the other, in the order of kernels/dialect/draw/lit.h, each for pixels side
// by side. PoCL would not vectorise the loop over pixels if a loop over lights lay inside it.
// Instead of a pixel that will not be seen it lights one that will, since programs may read memory
// for no others.
RG_PROC void rg_light_row(const rg_shading *s, RG_RECORD record, rg_block_triangle ta,
                          rg_block_triangle tb, int x0, int py, int y, int count, rg_lit_row *lit)
{
    int px[RG_TILE_PX];
#pragma clang loop vectorize(assume_safety) vectorize_width(8) interleave_count(1)
    for (int x = 0; x < count; x++) {
        px[x] = -1;
        rg_put_light(lit, x, rg_no_light());
        if ((rg_block_inside(ta, x, y) & rg_block_inside(tb, x, y)) >= 0)
            px[x] = rg_will_be_seen(s, record, x0 + x, py) ? x0 + x : -1;
    }
    int seen = -1;
    for (int x = 0; x < count; x++)
        seen = rg_imax(seen, px[x]);
    if (seen < 0)
        return;
    for (int light = 0; light < s->p.program.lights; light++) {
#if defined(RG_LIGHT_RECORD)
        RG_LIGHT_RECORD by = rg_program_record_light(s->rg, s->p.program, record, light);
#define RG_BY , by
#else
#define RG_BY
#endif
#pragma clang loop vectorize(assume_safety) vectorize_width(8) interleave_count(1)
        for (int x = 0; x < count; x++) {
            rg_lit l = rg_program_light(s->rg, s->p.program, record, px[x] < 0 ? seen : px[x], py,
                                          light RG_BY);
            rg_put_light(lit, x, rg_light_sum(rg_light_of(lit, x), l));
        }
    }
}

#define RG_LIT , rg_light_of(&lit, x)
#else
#define RG_LIT
#endif

// The block's pixels that one or both of two triangles cover, each once. Returns the number of
// visible ones.
RG_FN uint rg_draw_triangles(const rg_shading *s, RG_RECORD record, rg_triangle a,
                                     rg_triangle b)
{
    int x0 = rg_imax(rg_imin(a.first_x, b.first_x), s->x0);
    int y0 = rg_imax(rg_imin(a.first_y, b.first_y), s->y0);
    int x1 = rg_imin(rg_imax(a.end_x, b.end_x), s->x1);
    int y1 = rg_imin(rg_imax(a.end_y, b.end_y), s->y1);
    rg_block_triangle ta = rg_block_triangle_make(a, x0, y0);
    rg_block_triangle tb = rg_block_triangle_make(b, x0, y0);
    uint seen = 0;
    for (int y = 0; y < y1 - y0; y++) {
#if defined(RG_LIGHTS)
        rg_lit_row lit;
        rg_light_row(s, record, ta, tb, x0, y0 + y, y, x1 - x0, &lit);
#endif
// Pixels share no memory. Vectors wider than 8 would exceed most rows.
#pragma clang loop vectorize(assume_safety) vectorize_width(8) interleave_count(1)
        for (int x = 0; x < x1 - x0; x++)
            if ((rg_block_inside(ta, x, y) & rg_block_inside(tb, x, y)) >= 0)
                seen += rg_draw_pixel(
                    s, rg_program_fragment(s->rg, s->p.program, record, x0 + x, y0 + y RG_LIT),
                    x0 + x, y0 + y);
    }
    return seen;
}

RG_FN rg_long rg_area(int x0, int y0, int x1, int y1, int x2, int y2)
{
    return (rg_long)(x0 - x1) * (y2 - y0) - (rg_long)(x2 - x0) * (y0 - y1);
}

// The two triangles of a quad share no pixel unless they turn differently: the quad is folded then,
// and they are drawn one after the other.
RG_FN uint rg_draw_prim(const rg_shading *s, rg_snapped c, RG_RECORD record)
{
    rg_triangle a = rg_triangle_make(s->p.draw, c.x0, c.y0, c.x1, c.y1, c.x2, c.y2);
    rg_triangle b = a;
    bool folded = false;
    if (RG_CORNERS == 4) {
        b = rg_triangle_make(s->p.draw, c.x0, c.y0, c.x2, c.y2, c.x3, c.y3);
        rg_long turn_a = rg_area(c.x0, c.y0, c.x1, c.y1, c.x2, c.y2);
        rg_long turn_b = rg_area(c.x0, c.y0, c.x2, c.y2, c.x3, c.y3);
        folded = (turn_a < 0 && turn_b > 0) || (turn_a > 0 && turn_b < 0);
    }
    uint seen = 0;
    for (int part = 0; part <= (folded ? 1 : 0); part++) {
        rg_triangle first = part == 0 ? a : b;
        seen += rg_draw_triangles(s, record, first, folded ? first : b);
    }
    return seen;
}

#define RG_ARRAY_ARG(T, name)    , __global T *name, int name##_count
#define IN(slot, T, name)        RG_ARRAY_ARG(const T, name)
#define IMAGE(slot, F, name)     RG_ARRAY_ARG(const uint, name), rg_image_shape name##_shape

// Global ids are blocks, tile by tile.
__kernel void rg_draw(RG_RUN_PARAMS params, rg_bins bins, __global const rg_prim *prims,
                      __global const uint *ends, __global const uint *list, __global uint *colour,
                      int colour_word, __global uint *depth, int depth_word,
                      __global uint *samples RG_ALL_SLOTS)
{
#undef IN
#undef IMAGE
#define RG_ARRAY_BIND(name)  s.rg.name = name; s.rg.name##_count = name##_count;
#define IN(slot, T, name)    RG_ARRAY_BIND(name)
#define IMAGE(slot, F, name) RG_ARRAY_BIND(name) s.rg.name##_shape = name##_shape;
    rg_shading s;
    RG_ALL_SLOTS
    int blocks_x = RG_TILE_PX / bins.block_px;
    int id = (int)get_global_id(0);
    int tile = id / (blocks_x * blocks_x);
    if (tile >= bins.tiles)
        return;
    int block = id % (blocks_x * blocks_x);
    uint k = tile == 0 ? 0u : ends[tile * bins.lanes - 1];
    uint end = ends[(tile + 1) * bins.lanes - 1];
    s.p = params;
    // The build options say how the draw blends, so that no pixel has to decide.
    s.p.draw.colour_format = RG_VARIANT_FORMAT;
    s.p.draw.blend = RG_VARIANT_BLEND;
    s.p.draw.depth_mode = RG_VARIANT_DEPTH;
    s.colour = colour + colour_word;
    s.depth = depth + depth_word;
    s.x0 = params.draw.x0 + tile % bins.tiles_x * RG_TILE_PX + block % blocks_x * bins.block_px;
    s.y0 = params.draw.y0 + tile / bins.tiles_x * RG_TILE_PX + block / blocks_x * bins.block_px;
    s.x1 = rg_imin(s.x0 + bins.block_px, params.draw.x1);
    s.y1 = rg_imin(s.y0 + bins.block_px, params.draw.y1);
    for (; k < end; k++) {
        __global const rg_prim *prim = &prims[list[k]];
        uint seen = rg_draw_prim(&s, prim->corners, prim->record);
        if (params.draw.counted != 0 && seen != 0)
            atomic_add(&samples[prim->item], seen);
    }
}
