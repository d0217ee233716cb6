// Makes an OpenCL kernel of a DRAW program: shades the tiles whose primitives shaders/bins.cl has
// sorted. A work item owns a block of pixels of one tile, and draws the tile's primitives there, in
// order.
#include RG_KERNEL_HEADER
#include "kernels/dialect/draw/blend.h"
#include "kernels/dialect/draw/coverage.h"
#include "kernels/dialect/draw/bins.h"

// RG_BLOCK_PX and RG_VARIANT_* are options of the driver's compiler, which `#if` does not know. On a
// processor a block is a whole tile. On a GPU it has few pixels, and a work group has the tile: with
// loops of constant length, registers hold a block. A work item keeps a block's pixels from the first
// primitive to the last, except on a processor if these are few.
#define RG_BLOCKS_X     (RG_TILE_PX / RG_BLOCK_PX)
#define RG_BLOCKS       (RG_BLOCKS_X * RG_BLOCKS_X)
#define RG_MANY_PRIMS   16
#define RG_BLOCK_PART(i, first, end)                                                               \
    for (int i = RG_BLOCKS > 1 ? 0 : (first); i < (RG_BLOCKS > 1 ? RG_BLOCK_PX : (end)); i++)      \
        if (RG_BLOCKS == 1 || (i >= (first) && i < (end)))

#define RG_TEXEL_WORDS                                                                             \
    (RG_VARIANT_FORMAT == RG_RGBA32F_FORMAT   ? RG_WORDS_RGBA32F                                   \
     : RG_VARIANT_FORMAT == RG_RGBA16F_FORMAT ? RG_WORDS_RGBA16F                                   \
                                              : RG_WORDS_RGBA8)

// The inputs of a work item, its target, and the corners of its block: the end is excluded.
typedef struct rg_shading {
    rg_ctx rg;
    RG_RUN_PARAMS p;
    __global uint *colour; // texels of the target's layer and level
    __global uint *depth;
    int x0, y0, x1, y1;
} rg_shading;

// The pixels of a block, if a work item keeps them, row by row.
typedef struct rg_pixels {
    uint colour[RG_TEXEL_WORDS][RG_BLOCK_PX * RG_BLOCK_PX];
    float depth[RG_BLOCK_PX * RG_BLOCK_PX];
} rg_pixels;

// Pixel (x, y) of the block, in the target and among those that are kept.
RG_FN int rg_texel_at(const rg_shading *s, int x, int y)
{
    return (s->y0 + y) * s->p.draw.width + s->x0 + x;
}

RG_FN int rg_kept_at(int x, int y)
{
    return y * RG_BLOCK_PX + x;
}

// Word `w` of a pixel; 0 if its format has fewer.
RG_FN uint rg_word_of(const rg_shading *s, const rg_pixels *own, bool keeps, int w, int x, int y)
{
    if (w >= RG_TEXEL_WORDS)
        return 0u;
    return keeps ? own->colour[w % RG_TEXEL_WORDS][rg_kept_at(x, y)]
                 : s->colour[rg_texel_at(s, x, y) * RG_TEXEL_WORDS + w];
}

RG_PROC void rg_set_word(const rg_shading *s, rg_pixels *own, bool keeps, int w, int x, int y,
                         uint word)
{
    if (w < RG_TEXEL_WORDS && keeps)
        own->colour[w % RG_TEXEL_WORDS][rg_kept_at(x, y)] = word;
    else if (w < RG_TEXEL_WORDS)
        s->colour[rg_texel_at(s, x, y) * RG_TEXEL_WORDS + w] = word;
}

RG_FN float rg_depth_of(const rg_shading *s, const rg_pixels *own, bool keeps, int x, int y)
{
    return keeps ? own->depth[rg_kept_at(x, y)] : as_float(s->depth[rg_texel_at(s, x, y)]);
}

RG_PROC void rg_set_depth(const rg_shading *s, rg_pixels *own, bool keeps, int x, int y,
                          float depth)
{
    if (keeps)
        own->depth[rg_kept_at(x, y)] = depth;
    else
        s->depth[rg_texel_at(s, x, y)] = as_uint(depth);
}

RG_PROC void rg_keep_pixels(const rg_shading *s, rg_pixels *own)
{
    RG_BLOCK_PART(y, 0, s->y1 - s->y0)
        RG_BLOCK_PART(x, 0, s->x1 - s->x0) {
            for (int w = 0; RG_VARIANT_FORMAT != 0 && w < RG_TEXEL_WORDS; w++)
                own->colour[w][rg_kept_at(x, y)] =
                    s->colour[rg_texel_at(s, x, y) * RG_TEXEL_WORDS + w];
            if (RG_VARIANT_DEPTH != RG_DEPTH_IS_OFF)
                own->depth[rg_kept_at(x, y)] = as_float(s->depth[rg_texel_at(s, x, y)]);
        }
}

RG_PROC void rg_store_pixels(const rg_shading *s, const rg_pixels *own)
{
    RG_BLOCK_PART(y, 0, s->y1 - s->y0)
        RG_BLOCK_PART(x, 0, s->x1 - s->x0) {
            for (int w = 0; RG_VARIANT_FORMAT != 0 && w < RG_TEXEL_WORDS; w++)
                s->colour[rg_texel_at(s, x, y) * RG_TEXEL_WORDS + w] =
                    own->colour[w][rg_kept_at(x, y)];
            if (RG_VARIANT_DEPTH == RG_DEPTH_IS_WRITE)
                s->depth[rg_texel_at(s, x, y)] = as_uint(own->depth[rg_kept_at(x, y)]);
        }
}

RG_PROC void rg_blend(const rg_shading *s, rg_pixels *own, bool keeps, int x, int y, rgba c)
{
    rg_texel t = {rg_word_of(s, own, keeps, 0, x, y), rg_word_of(s, own, keeps, 1, x, y),
                  rg_word_of(s, own, keeps, 2, x, y), rg_word_of(s, own, keeps, 3, x, y)};
    if (RG_VARIANT_FORMAT == RG_RGBA8_FORMAT)
        t.a = rg_blended_RGBA8(t.a, c, RG_VARIANT_BLEND);
    else if (RG_VARIANT_FORMAT == RG_RGBA16F_FORMAT)
        t = rg_blended_RGBA16F(t, c, RG_VARIANT_BLEND);
    else
        t = rg_blended_RGBA32F(t, c, RG_VARIANT_BLEND);
    rg_set_word(s, own, keeps, 0, x, y, t.a);
    rg_set_word(s, own, keeps, 1, x, y, t.b);
    rg_set_word(s, own, keeps, 2, x, y, t.c);
    rg_set_word(s, own, keeps, 3, x, y, t.d);
}

// Draws a covered pixel of the block; returns 1 if it is visible.
RG_FN uint rg_draw_pixel(const rg_shading *s, rg_pixels *own, bool keeps, rg_fragment fragment,
                         int x, int y)
{
    rg_fragment f = rg_settled(fragment);
    bool seen = f.kept != 0;
    if (RG_VARIANT_DEPTH != RG_DEPTH_IS_OFF)
        seen = seen && f.depth < rg_depth_of(s, own, keeps, x, y);
    if (!seen)
        return 0;
    if (RG_VARIANT_DEPTH == RG_DEPTH_IS_WRITE)
        rg_set_depth(s, own, keeps, x, y, f.depth);
    if (RG_VARIANT_FORMAT != 0)
        rg_blend(s, own, keeps, x, y, rg_drawn(s->p.draw, f.colour));
    return 1;
}

#if defined(RG_LIGHTS)

// The sums of lights for the pixels of a block's row.
typedef struct rg_lit_row {
#define RG_ROW(part) float part[RG_BLOCK_PX];
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

// Whether a covered pixel of the block will be seen, as far as can be told without its colour.
RG_FN int rg_will_be_seen(const rg_shading *s, const rg_pixels *own, bool keeps, RG_RECORD record,
                          int x, int y)
{
    if (RG_VARIANT_DEPTH == RG_DEPTH_IS_OFF)
        return 1;
    rg_fragment f = rg_settled(rg_program_fragment(s->rg, s->p.program, record, s->x0 + x,
                                                   s->y0 + y, rg_no_light()));
    return f.kept != 0 && f.depth < rg_depth_of(s, own, keeps, x, y) ? 1 : 0;
}

// Adds one light after the other, in the order of kernels/dialect/draw/lit.h, each for pixels side
// by side in row y of the block. PoCL would not vectorise the loop over pixels if a loop over
// lights lay inside it. Instead of a pixel that will not be seen it lights one that will, since
// programs may read memory for no others.
RG_PROC void rg_light_row(const rg_shading *s, const rg_pixels *own, bool keeps, RG_RECORD record,
                          rg_block_triangle ta, rg_block_triangle tb, int first, int end, int y,
                          rg_lit_row *lit)
{
    int px[RG_BLOCK_PX];
#pragma clang loop vectorize(assume_safety) vectorize_width(8) interleave_count(1)
    RG_BLOCK_PART(x, first, end) {
        px[x] = -1;
        rg_put_light(lit, x, rg_no_light());
        if ((rg_block_inside(ta, x, y) & rg_block_inside(tb, x, y)) >= 0)
            px[x] = rg_will_be_seen(s, own, keeps, record, x, y) ? s->x0 + x : -1;
    }
    int seen = -1;
    RG_BLOCK_PART(x, first, end)
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
        RG_BLOCK_PART(x, first, end) {
            rg_lit l = rg_program_light(s->rg, s->p.program, record, px[x] < 0 ? seen : px[x],
                                        s->y0 + y, light RG_BY);
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
RG_FN uint rg_draw_triangles(const rg_shading *s, rg_pixels *own, bool keeps, RG_RECORD record,
                             rg_triangle a,
                             rg_triangle b)
{
    int first = rg_imax(rg_imin(a.first_x, b.first_x) - s->x0, 0);
    int first_y = rg_imax(rg_imin(a.first_y, b.first_y) - s->y0, 0);
    int end = rg_imin(rg_imax(a.end_x, b.end_x), s->x1) - s->x0;
    int end_y = rg_imin(rg_imax(a.end_y, b.end_y), s->y1) - s->y0;
    rg_block_triangle ta = rg_block_triangle_make(a, s->x0, s->y0);
    rg_block_triangle tb = rg_block_triangle_make(b, s->x0, s->y0);
    uint seen = 0;
    RG_BLOCK_PART(y, first_y, end_y) {
#if defined(RG_LIGHTS)
        rg_lit_row lit;
        rg_light_row(s, own, keeps, record, ta, tb, first, end, y, &lit);
#endif
// Pixels share no memory. Vectors wider than 8 would exceed most rows.
#pragma clang loop vectorize(assume_safety) vectorize_width(8) interleave_count(1)
        RG_BLOCK_PART(x, first, end)
            if ((rg_block_inside(ta, x, y) & rg_block_inside(tb, x, y)) >= 0)
                seen += rg_draw_pixel(s, own, keeps,
                                      rg_program_fragment(s->rg, s->p.program, record, s->x0 + x,
                                                          s->y0 + y RG_LIT),
                                      x, y);
    }
    return seen;
}

RG_FN rg_long rg_area(int x0, int y0, int x1, int y1, int x2, int y2)
{
    return (rg_long)(x0 - x1) * (y2 - y0) - (rg_long)(x2 - x0) * (y0 - y1);
}

// The two triangles of a quad share no pixel unless they turn differently: the quad is folded then,
// and they are drawn one after the other.
RG_FN uint rg_draw_prim(const rg_shading *s, rg_pixels *own, bool keeps, rg_snapped c,
                        RG_RECORD record)
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
        seen += rg_draw_triangles(s, own, keeps, record, first, folded ? first : b);
    }
    return seen;
}

// Draws a primitive in the block, and counts its visible samples.
RG_PROC void rg_draw_packed(const rg_shading *s, rg_pixels *own, bool keeps,
                            __global const rg_prim *prim, __global uint *samples)
{
    uint seen = rg_draw_prim(s, own, keeps, prim->corners, prim->record);
    if (s->p.draw.counted != 0 && seen != 0)
        atomic_add(&samples[prim->item], seen);
}

// Whether a primitive may cover a pixel of the tile.
RG_FN bool rg_meets_tile(rg_draw_state draw, rg_snapped c, int px, int py)
{
    rg_triangle a = rg_triangle_make(draw, c.x0, c.y0, c.x1, c.y1, c.x2, c.y2);
    bool meets = rg_triangle_touches(a, px, py, RG_TILE_PX, RG_TILE_PX);
    if (RG_CORNERS == 4 && !meets) {
        rg_triangle b = rg_triangle_make(draw, c.x0, c.y0, c.x2, c.y2, c.x3, c.y3);
        meets = rg_triangle_touches(b, px, py, RG_TILE_PX, RG_TILE_PX);
    }
    return meets;
}

#define RG_ARRAY_ARG(T, name)    , __global T *name, int name##_count
#define IN(slot, T, name)        RG_ARRAY_ARG(const T, name)
#define IMAGE(slot, F, name)     RG_ARRAY_ARG(const uint, name), rg_image_shape name##_shape

// Global ids are blocks, tile by tile. If the list has no room for all pairs, a group that shares a
// tile looks for its primitives itself, so that the host need not wait for their number.
__kernel void rg_draw(RG_RUN_PARAMS params, rg_bins bins, __global const rg_prim *prims,
                      __global const uint *ends, __global const uint *list,
                      __global const uint *round, __global uint *colour, int colour_word,
                      __global uint *depth, int depth_word, __global uint *samples RG_ALL_SLOTS)
{
#undef IN
#undef IMAGE
#define RG_ARRAY_BIND(name)  s.rg.name = name; s.rg.name##_count = name##_count;
#define IN(slot, T, name)    RG_ARRAY_BIND(name)
#define IMAGE(slot, F, name) RG_ARRAY_BIND(name) s.rg.name##_shape = name##_shape;
    rg_shading s;
    rg_pixels own;
    RG_ALL_SLOTS
    __local int meets[RG_BLOCKS];
    int id = (int)get_global_id(0);
    int tile = id / RG_BLOCKS;
    if (tile >= bins.tiles)
        return;
    int block = id % RG_BLOCKS;
    uint k = tile == 0 ? 0u : ends[tile * bins.lanes - 1];
    uint end = ends[(tile + 1) * bins.lanes - 1];
    s.p = params;
    s.colour = colour + colour_word;
    s.depth = depth + depth_word;
    // The build options say how the draw blends, so that no pixel has to decide.
    s.p.draw.colour_format = RG_VARIANT_FORMAT;
    s.p.draw.blend = RG_VARIANT_BLEND;
    s.p.draw.depth_mode = RG_VARIANT_DEPTH;
    int tile_x = params.draw.x0 + tile % bins.tiles_x * RG_TILE_PX;
    int tile_y = params.draw.y0 + tile / bins.tiles_x * RG_TILE_PX;
    s.x0 = tile_x + block % RG_BLOCKS_X * RG_BLOCK_PX;
    s.y0 = tile_y + block / RG_BLOCKS_X * RG_BLOCK_PX;
    s.x1 = rg_imin(s.x0 + RG_BLOCK_PX, params.draw.x1);
    s.y1 = rg_imin(s.y0 + RG_BLOCK_PX, params.draw.y1);
    bool is_listed = RG_BLOCKS == 1 || round[RG_ROUND_PAIRS] <= bins.capacity;
    if (is_listed && k == end)
        return;
    if (RG_BLOCKS == 1 && end - k < RG_MANY_PRIMS) {
        for (; k < end; k++)
            rg_draw_packed(&s, &own, false, &prims[list[k]], samples);
        return;
    }
    rg_keep_pixels(&s, &own);
    if (!is_listed) {
        int all = rg_imin(bins.end_prim, (int)round[RG_ROUND_PRIMS]);
        for (int first = 0; first < all; first += RG_BLOCKS) {
            int i = first + block;
            meets[block] = i < all && rg_meets_tile(params.draw, prims[i].corners, tile_x, tile_y);
            barrier(CLK_LOCAL_MEM_FENCE);
            for (int j = 0; j < RG_BLOCKS; j++)
                if (meets[j])
                    rg_draw_packed(&s, &own, true, &prims[first + j], samples);
            barrier(CLK_LOCAL_MEM_FENCE);
        }
        end = k;
    }
    for (; k < end; k++)
        rg_draw_packed(&s, &own, true, &prims[list[k]], samples);
    rg_store_pixels(&s, &own);
}
