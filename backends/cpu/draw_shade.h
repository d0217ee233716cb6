// A tile of the target: its primitives become pixels, in order.
//
// Pixels of small primitives and short spans are gathered in a list that many primitives share.
// Wide spans are shaded at once, when what is listed has been drawn.
#ifndef RG_BACKENDS_CPU_DRAW_SHADE_H
#define RG_BACKENDS_CPU_DRAW_SHADE_H

#include "backends/cpu/draw_blend.h"
#include "backends/cpu/draw_span.h"

enum { WIDE_SPAN = 24 }; // pixels that are worth a row of their own

struct shader {
    const struct cpu_program *program;
    const struct cpu_call *call;
    const struct cpu_bins *bins;
    rg_draw_state draw;
    int x0, y0, x1, y1; // the tile's pixels
    struct cpu_list list;
    struct cpu_row row;
    struct passed passed;
};

static void count_passed(const struct shader *s)
{
    for (int i = 0; i < s->passed.count; i++) {
        const int item = s->bins->items[s->list.prim[s->passed.which[i]]];
        __atomic_fetch_add(&s->call->target.samples[item], 1u, __ATOMIC_RELAXED);
    }
}

// Draws what is listed.
static void flush(struct shader *s)
{
    struct cpu_list *list = &s->list;
    if (!list->count)
        return;
    for (int i = list->count; i < cpu_padded(list->count); i++) {
        list->x[i] = list->x[i - 1];
        list->y[i] = list->y[i - 1];
        list->prim[i] = list->prim[i - 1];
    }
    s->program->list(s->call, s->bins->records, list);
    test_list(list, s->call->target.depth, s->draw.width, s->draw.depth_mode, &s->passed);
    if (s->draw.counted)
        count_passed(s);
    if (s->call->target.colour)
        blend_list(s->call->target.colour, list, &s->passed, s->draw.colour_format, s->draw.blend);
    list->count = 0;
}

static void draw_row(struct shader *s, int prim, int x, int y, int count)
{
    const struct cpu_bins *bins = s->bins;
    const struct cpu_target *target = &s->call->target;
    const size_t first = (size_t)y * (size_t)s->draw.width + (size_t)x;
    s->row.x = x;
    s->row.y = y;
    s->row.count = count;
    s->program->row(s->call, bins->records + (size_t)prim * bins->record_size, &s->row);
    const int passing =
        test_row(&s->row, target->depth ? target->depth + first : NULL, s->draw.depth_mode);
    if (s->draw.counted && passing)
        __atomic_fetch_add(&target->samples[bins->items[prim]], (uint)passing, __ATOMIC_RELAXED);
    if (target->colour && passing)
        blend_row(target->colour, first, &s->row, s->draw.colour_format, s->draw.blend);
}

static void list_mask(struct shader *s, const struct cpu_ref *ref)
{
    struct cpu_list *list = &s->list;
    const int log2_width = ref->place & 3;
    const int x = (ref->place >> 2) & 0x3fff, y = ref->place >> 16;
    const int last_column = (1 << log2_width) - 1;
    if (list->count > CPU_FRAGMENTS - 64)
        flush(s);
    int count = list->count;
    for (uint64_t rest = ref->mask; rest; rest &= rest - 1) {
        const int bit = __builtin_ctzll(rest);
        list->x[count] = x + (bit & last_column);
        list->y[count] = y + (bit >> log2_width);
        list->prim[count] = ref->prim;
        count++;
    }
    list->count = count;
}

static void list_span(struct shader *s, int prim, int x, int y, int count)
{
    struct cpu_list *list = &s->list;
    if (list->count + count > CPU_FRAGMENTS)
        flush(s);
    for (int i = 0; i < count; i++) {
        list->x[list->count + i] = x + i;
        list->y[list->count + i] = y;
        list->prim[list->count + i] = prim;
    }
    list->count += count;
}

// A triangle's pixels do not coincide, so that only what was listed before it comes before its
// rows.
static void draw_block(struct shader *s, int prim, const rg_triangle *t, int x, int y, int width,
                       int height, bool *flushed)
{
    struct spans spans;
    make_spans(&spans, t, x, y, width, height);
    for (int row = 0; row < height; row++) {
        const int begin = spans.begin[row], count = spans.end[row] - begin;
        if (count >= WIDE_SPAN) {
            if (!*flushed)
                flush(s);
            *flushed = true;
            draw_row(s, prim, x + begin, y + row, count);
        } else if (count > 0) {
            list_span(s, prim, x + begin, y + row, count);
        }
    }
}

static void draw_triangle(struct shader *s, int prim, rg_triangle t)
{
    const int begin_x = rg_imax(t.first_x, s->x0), end_x = rg_imin(t.end_x, s->x1);
    const int begin_y = rg_imax(t.first_y, s->y0), end_y = rg_imin(t.end_y, s->y1);
    bool flushed = false;
    for (int y = begin_y; y < end_y; y += CPU_BLOCK_PX)
        for (int x = begin_x; x < end_x; x += CPU_BLOCK_PX)
            draw_block(s, prim, &t, x, y, rg_imin(end_x - x, CPU_BLOCK_PX),
                       rg_imin(end_y - y, CPU_BLOCK_PX), &flushed);
}

static void draw_corners(struct shader *s, int prim)
{
    const rg_snapped c = s->bins->corners[prim];
    draw_triangle(s, prim, rg_triangle_make(s->draw, c.x0, c.y0, c.x1, c.y1, c.x2, c.y2));
    if (s->program->corners == 4)
        draw_triangle(s, prim, rg_triangle_make(s->draw, c.x0, c.y0, c.x2, c.y2, c.x3, c.y3));
}

static void shade_tile(const struct cpu_program *program, const struct cpu_call *call,
                       const struct cpu_bins *bins, int tile)
{
    struct shader s;
    const struct cpu_tiling *tiling = &bins->tiling;
    const int side = 1 << tiling->log2_side;
    s.program = program;
    s.call = call;
    s.bins = bins;
    s.draw = *(const rg_draw_state *)call->params;
    s.x0 = tile % tiling->across * side;
    s.y0 = tile / tiling->across * side;
    s.x1 = s.x0 + side;
    s.y1 = s.y0 + side;
    s.list.count = 0;
    for (int c = 0; c < bins->chunk_count; c++) {
        const int *first = bins->chunks[c].first;
        for (int i = first[tile]; i < first[tile + 1]; i++) {
            const struct cpu_ref *ref = &bins->refs[i];
            if (ref->place < 0)
                draw_corners(&s, ref->prim);
            else
                list_mask(&s, ref);
        }
    }
    flush(&s);
}

#endif
