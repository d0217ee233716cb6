// Makes a C function for cpu:reference of the DRAW program that was just included: plain loops over
// items, triangles and pixels, in order.
#include "backends/cpu/kernels/bind_tmpl.h"
#include "kernels/dialect/draw/blend.h"
#include "kernels/dialect/draw/coverage.h"
#include "kernels/dialect/draw/lit.h"

struct drawing {
    rg_ctx rg;
    rg_draw_call p;
    struct cpu_target target;
};

static void blend(const struct drawing *d, int texel, rgba c)
{
    const rg_draw_state *draw = &d->p.draw;
    if (draw->colour_format == RG_RGBA8_FORMAT)
        rg_blend_RGBA8(d->target.colour, texel, c, draw->blend);
    else if (draw->colour_format == RG_RGBA16F_FORMAT)
        rg_blend_RGBA16F(d->target.colour, texel * 2, c, draw->blend);
    else if (draw->colour_format == RG_RGBA32F_FORMAT)
        rg_blend_RGBA32F(d->target.colour, texel * 4, c, draw->blend);
}

static void draw_pixel(const struct drawing *d, const RG_RECORD *record, int item, int px, int py)
{
    const rg_draw_state *draw = &d->p.draw;
    const int texel = py * draw->width + px;
    d->rg.notes->fragments++;
    rg_fragment f = rg_drawn_fragment(d->rg, d->p.program, *record, px, py);
    if (!f.kept)
        return;
    if (draw->depth_mode != RG_DEPTH_IS_OFF && !(f.depth < rg_bits_float(d->target.depth[texel])))
        return;
    d->rg.notes->fragments_kept++;
    if (draw->depth_mode == RG_DEPTH_IS_WRITE)
        d->target.depth[texel] = rg_float_bits(f.depth);
    if (draw->counted)
        d->target.samples[item]++;
    blend(d, texel, rg_drawn(*draw, f.colour));
}

static void draw_triangle(const struct drawing *d, const RG_RECORD *record, int item, rg_triangle t)
{
    for (int py = t.first_y; py < t.end_y; py++)
        for (int px = t.first_x; px < t.end_x; px++)
            if (rg_triangle_covers(t, px, py))
                draw_pixel(d, record, item, px, py);
}

static void draw_prim(const struct drawing *d, const RG_RECORD *record, int item, rg_snapped s)
{
    draw_triangle(d, record, item, rg_triangle_make(d->p.draw, s.x0, s.y0, s.x1, s.y1, s.x2, s.y2));
    if (RG_CORNERS == 4)
        draw_triangle(d, record, item,
                      rg_triangle_make(d->p.draw, s.x0, s.y0, s.x2, s.y2, s.x3, s.y3));
}

static void draw_item(const struct drawing *d, int item)
{
    const rg_draw_state draw = d->p.draw;
    const rg_item t = rg_item_closed(rg_program_item(d->rg, draw, d->p.program, item), RG_CORNERS);
    const rg_projected projected = rg_project(draw, t);
    if (projected.fate == RG_FATE_DEAD)
        return;
    d->rg.notes->records++;
    const RG_RECORD record = rg_program_record(d->rg, draw, d->p.program, item);
    if (projected.fate == RG_FATE_WHOLE) {
        draw_prim(d, &record, item, projected.corners);
        return;
    }
    const rg_polygon g = rg_clip(draw, t, RG_CORNERS, projected.fate);
    for (int k = 0; k < rg_polygon_prims(g, RG_CORNERS); k++)
        draw_prim(d, &record, item, rg_polygon_prim(draw, g, RG_CORNERS, k));
}

static void run_draw(const struct cpu_call *call)
{
    const struct drawing d = {bind_context(call), *(const rg_draw_call *)call->params,
                              call->target};
    for (int i = d.p.draw.item_begin; i < d.p.draw.item_end; i++)
        draw_item(&d, i);
}

RG_EXPORT_KERNEL = {.run = run_draw};
