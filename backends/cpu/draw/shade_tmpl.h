// Draws a tile of the target: its primitives become pixels, in order. Small ones and short spans
// are listed (list_tmpl.h); wide spans are shaded at once, after the list has been drawn.
#ifndef RG_BACKENDS_CPU_DRAW_SHADE_TMPL_H
#define RG_BACKENDS_CPU_DRAW_SHADE_TMPL_H

#include "backends/cpu/draw/list_tmpl.h"
#include "backends/cpu/draw/span_tmpl.h"

enum {
    WIDE_SPAN = 24,   // pixels that are worth a vectorised row of their own
    REFS_AHEAD = 12,  // for which corners are fetched
    WORTH_LIGHTS = 2, // from this number of lights on, hidden fragments are dropped first
};

// Trims a row to the pixels from the first to the last one that will pass the depth test; returns
// their number.
static int trim_hidden(struct shader *s, int prim, int *x, int y, int count)
{
    s->program->row_depth(s->call, s->bins->records, prim, *x, y, count, &s->fragments);
    const size_t texel = texel_of(s, y << 16 | *x);
    int first = 0, end = count;
    while (first < end && !is_seen(s, first, texel + (size_t)first))
        first++;
    while (first < end && !is_seen(s, end - 1, texel + (size_t)end - 1))
        end--;
    *x += first;
    return end - first;
}

static void draw_row(struct shader *s, int prim, int x, int y, int count)
{
    if (s->drops_hidden)
        count = trim_hidden(s, prim, &x, y, count);
    if (!count)
        return;
    const size_t first = (size_t)y * (size_t)s->draw.width + (size_t)x;
    const size_t size = (size_t)count * sizeof(uint), words = (size_t)s->texel_words;
    struct pixels *pixels = &s->pixels;
    s->program->row(s->call, s->bins->records, prim, x, y, count, &s->fragments);
    if (words)
        memcpy(pixels->texels, s->target.colour + first * words, size * words);
    if (s->draw.depth_mode != RG_DEPTH_IS_OFF)
        memcpy(pixels->depth, s->target.depth + first, size);
    meet(s);
    if (words)
        memcpy(s->target.colour + first * words, pixels->texels, size * words);
    if (s->draw.depth_mode == RG_DEPTH_IS_WRITE)
        memcpy(s->target.depth + first, pixels->depth, size);
    if (s->draw.counted) {
        int samples = 0;
        for (int i = 0; i < count; i++)
            samples += s->fragments.kept[i];
        count_sample(s, prim, samples);
    }
}

// Draws a shape's pixels in a block. The list is drawn before the shape's first long row, except
// pixels of the shape itself, which are all different and can wait.
static void draw_block(struct shader *s, int named, const struct convex *shape, int x, int y,
                       int width, int height, bool *flushed)
{
    struct spans spans;
    make_spans(&spans, shape, x, y, width, height);
    for (int row = 0; row < height; row++) {
        const int begin = spans.begin[row], count = spans.end[row] - begin;
        if (count >= WIDE_SPAN) {
            if (!*flushed)
                flush(s);
            *flushed = true;
            draw_row(s, named & (CPU_PLAIN - 1), x + begin, y + row, count);
        } else if (count > 0) {
            for (int i = 0; i < count; i++)
                list_pixel(s, list_for(s, named), named & (CPU_PLAIN - 1), x + begin + i, y + row);
        }
    }
}

static void draw_convex(struct shader *s, int named, const struct convex *shape)
{
    const rg_triangle *t = &shape->t;
    const int begin_x = rg_imax(t->first_x, s->x0), end_x = rg_imin(t->end_x, s->x1);
    const int begin_y = rg_imax(t->first_y, s->y0), end_y = rg_imin(t->end_y, s->y1);
    // Rows of a band are drawn one after the other.
    const int rows = s->x1 - s->x0 > s->y1 - s->y0 ? 1 : BLOCK_PX;
    bool flushed = false;
    for (int y = begin_y; y < end_y; y += rows)
        for (int x = begin_x; x < end_x; x += BLOCK_PX)
            draw_block(s, named, shape, x, y, rg_imin(end_x - x, BLOCK_PX),
                       rg_imin(end_y - y, rows), &flushed);
}

static void draw_triangle(struct shader *s, int named, rg_triangle t)
{
    draw_convex(s, named, &(struct convex){.t = t});
}

static void draw_corners(struct shader *s, int named)
{
    const rg_snapped c = s->bins->corners[named & (CPU_PLAIN - 1)];
    struct convex quad;
    if (s->program->corners == 4 && make_convex(&s->draw, c, &quad)) {
        draw_convex(s, named, &quad);
        return;
    }
    draw_triangle(s, named, rg_triangle_make(s->draw, c.x0, c.y0, c.x1, c.y1, c.x2, c.y2));
    if (s->program->corners == 4)
        draw_triangle(s, named, rg_triangle_make(s->draw, c.x0, c.y0, c.x2, c.y2, c.x3, c.y3));
}

static int texel_words(int format)
{
    return format == RG_RGBA8_FORMAT     ? 1
           : format == RG_RGBA16F_FORMAT ? 2
           : format == RG_RGBA32F_FORMAT ? 4
                                         : 0;
}

static void begin_tile(struct shader *s, int tile)
{
    const struct cpu_tiling *tiling = &s->bins->tiling;
    s->target = s->call->target;
    s->draw = *(const rg_draw_state *)s->call->params;
    s->texel_words = texel_words(s->draw.colour_format);
    s->recorded_lights = s->program->light_size ? s->program->lights(s->call) : 0;
    s->drops_hidden = s->draw.depth_mode != RG_DEPTH_IS_OFF && s->program->lights &&
                      s->program->lights(s->call) >= WORTH_LIGHTS;
    s->x0 = tile % tiling->across << tiling->log2_width;
    s->y0 = tile / tiling->across << tiling->log2_height;
    s->x1 = s->x0 + (1 << tiling->log2_width);
    s->y1 = s->y0 + (1 << tiling->log2_height);
    s->lists[0].count = s->lists[1].count = s->drawn = 0;
    // Vectors reach beyond the last pixel, where they must find initialised memory.
    memset(&s->pixels, 0, sizeof(s->pixels));
    begin_listing(s);
}

static void draw_refs(struct shader *s, const struct cpu_ref *ref, const struct cpu_ref *end)
{
    for (; ref < end; ref++) {
        if (end - ref > REFS_AHEAD && ref[REFS_AHEAD].place < 0)
            __builtin_prefetch(s->bins->corners + (ref[REFS_AHEAD].prim & (CPU_PLAIN - 1)));
        if (ref->place < 0)
            draw_corners(s, ref->prim);
        else
            list_mask(s, ref);
    }
}

static void shade_tile(const struct cpu_program *program, const struct cpu_call *call,
                       const struct cpu_bins *bins, int tile)
{
    struct shader s;
    const int *first = bins->firsts + tile * CPU_MOST_CHUNKS, *end = first + CPU_MOST_CHUNKS;
    int refs = 0;
    for (int c = 0; c < bins->chunk_count; c++)
        refs += end[c] - first[c];
    if (!refs)
        return;
    s.program = program;
    s.call = call;
    s.bins = bins;
    begin_tile(&s, tile);
    for (int c = 0; c < bins->chunk_count; c++) {
        if (c + 2 < bins->chunk_count)
            __builtin_prefetch(bins->refs + first[c + 2]);
        draw_refs(&s, bins->refs + first[c], bins->refs + end[c]);
    }
    flush(&s);
}

#endif
