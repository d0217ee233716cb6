// Gathers pixels of small primitives and short spans in a list that many primitives share, until a
// pixel repeats. Then computes, tests and blends their fragments together.
#ifndef RG_BACKENDS_CPU_DRAW_LIST_TMPL_H
#define RG_BACKENDS_CPU_DRAW_LIST_TMPL_H

#include "backends/cpu/draw/bins.h"
#include "backends/cpu/draw/blend_tmpl.h"

enum {
    LISTED_PX = 128,   // side of the square of pixels that a list distinguishes
    FETCHED_PX = 16384 // after so many listed pixels a tile's texels are presumed to be in cache
};

// State of shading a tile.
struct shader {
    const struct cpu_program *program;
    const struct cpu_call *call;
    const struct cpu_bins *bins;
    struct cpu_target target;
    rg_draw_state draw;
    int texel_words;          // of the colour target; 0: none
    int x0, y0, x1, y1;       // the tile's pixels
    struct cpu_list lists[2]; // of plain records the second
    struct cpu_columns columns;
    struct cpu_fragments fragments;
    struct pixels pixels;
    int drawn;           // listed pixels so far
    bool drops_hidden;   // drops hidden fragments before lighting them
    int recorded_lights; // lights with records
    // The last list that each pixel was in, by the low bits of x and y; pixels that share an entry
    // count as the same.
    uint16_t listing; // number of the current list, from 1 on
    uint16_t listed[LISTED_PX][LISTED_PX];
};

// Tests and blends the fragments with the gathered pixels.
static void meet(struct shader *s)
{
    test_fragments(&s->fragments, &s->pixels, s->draw.depth_mode);
    if (s->texel_words)
        blend_fragments(&s->fragments, &s->pixels, s->draw.colour_format, s->draw.blend);
}

static void count_sample(const struct shader *s, int prim, int samples)
{
    if (samples)
        __atomic_fetch_add(&s->target.samples[s->bins->items[prim]], (uint)samples,
                           __ATOMIC_RELAXED);
}

// `words` must be a constant in each call.
static inline __attribute__((always_inline)) void gather(uint *to, const uint *from,
                                                         const size_t *texel, int count, int words)
{
    for (int i = 0; i < count; i++)
        memcpy(to + i * words, from + texel[i] * (size_t)words, (size_t)words * sizeof(uint));
}

static inline __attribute__((always_inline)) void scatter(uint *to, const uint *from,
                                                          const size_t *texel, int count, int words)
{
    for (int i = 0; i < count; i++)
        memcpy(to + texel[i] * (size_t)words, from + i * words, (size_t)words * sizeof(uint));
}

static void gather_texels(struct shader *s, const size_t *texel, int count)
{
    if (s->texel_words == 1)
        gather(s->pixels.texels, s->target.colour, texel, count, 1);
    else if (s->texel_words == 2)
        gather(s->pixels.texels, s->target.colour, texel, count, 2);
    else if (s->texel_words == 4)
        gather(s->pixels.texels, s->target.colour, texel, count, 4);
    if (s->draw.depth_mode != RG_DEPTH_IS_OFF)
        gather(s->pixels.depth, s->target.depth, texel, count, 1);
}

// Prefetches the texels for gather_texels while the fragments are computed.
static void fetch_texels(const struct shader *s, const size_t *texel, int count)
{
    for (int i = 0; i < count; i++) {
        __builtin_prefetch(s->target.colour + texel[i] * (size_t)s->texel_words, 1);
        __builtin_prefetch(s->target.depth + texel[i], 1);
    }
}

static void scatter_texels(struct shader *s, const size_t *texel, int count)
{
    if (s->texel_words == 1)
        scatter(s->target.colour, s->pixels.texels, texel, count, 1);
    else if (s->texel_words == 2)
        scatter(s->target.colour, s->pixels.texels, texel, count, 2);
    else if (s->texel_words == 4)
        scatter(s->target.colour, s->pixels.texels, texel, count, 4);
    if (s->draw.depth_mode == RG_DEPTH_IS_WRITE)
        scatter(s->target.depth, s->pixels.depth, texel, count, 1);
}

// Repeats the last pixel up to a multiple of CPU_LANES.
static void pad_list(struct cpu_list *list)
{
    for (int i = list->count; i < cpu_padded(list->count); i++) {
        list->at[i] = list->at[i - 1];
        list->prim[i] = list->prim[i - 1];
    }
}

static inline size_t texel_of(const struct shader *s, int at)
{
    return (size_t)((at >> 16) * s->draw.width + (at & 0xffff));
}

static inline bool is_seen(const struct shader *s, int i, size_t texel)
{
    return s->fragments.kept[i] && s->fragments.depth[i] < rg_bits_float(s->target.depth[texel]);
}

// Removes fragments from the list that will fail the depth test.
static void drop_hidden(struct shader *s, struct cpu_list *list)
{
    int seen = 0;
    pad_list(list);
    s->program->list_depth(s->call, s->bins->records, list, &s->fragments);
    for (int i = 0; i < list->count; i++) {
        list->at[seen] = list->at[i];
        list->prim[seen] = list->prim[i];
        seen += is_seen(s, i, texel_of(s, list->at[i]));
    }
    list->count = seen;
}

// Spreads a record's words over the columns from `column` on, for pixels from `begin` to `end`. It
// also writes some beyond, which the next record overwrites.
static inline __attribute__((always_inline)) void stage_words(struct cpu_columns *columns,
                                                              int column, const char *record,
                                                              size_t size, int begin, int end,
                                                              int lanes)
{
    for (size_t at = 0; at < size; at += sizeof(uint), column++) {
        uint word;
        memcpy(&word, record + at, sizeof(word));
        for (int i = begin; i < end; i += lanes)
            for (int lane = 0; lane < lanes; lane++)
                columns->words[column][i + lane] = word;
    }
}

// Most records have few pixels, and short vectors lie within a cache line more often.
static inline __attribute__((always_inline)) void stage_record(struct cpu_columns *columns,
                                                               int column, const char *record,
                                                               size_t size, int begin, int end)
{
    if (end - begin <= 4)
        stage_words(columns, column, record, size, begin, begin + 1, 4);
    else if (end - begin <= 8)
        stage_words(columns, column, record, size, begin, begin + 1, 8);
    else
        stage_words(columns, column, record, size, begin, end, CPU_LANES);
}

// Writes the records of a padded list into columns. Each is read once for all of its successive
// pixels.
static void stage_list(struct shader *s, const struct cpu_list *list)
{
    const size_t size = s->program->record_size;
    const size_t light_size = s->recorded_lights ? s->program->light_size : 0;
    const char *records = s->bins->records.of_items;
    const char *lights = records + (size_t)s->bins->records.room * size;
    const int padded = cpu_padded(list->count);
    for (int begin = 0, end; begin < padded; begin = end) {
        const int prim = list->prim[begin];
        for (end = begin + 1; end < padded && list->prim[end] == prim;)
            end++;
        stage_record(&s->columns, 0, records + (size_t)prim * size, size, begin, end);
        stage_record(&s->columns, (int)(size / sizeof(uint)), lights + (size_t)prim * light_size,
                     light_size, begin, end);
    }
}

// Draws the listed pixels, at least one.
static void draw_list(struct shader *s, struct cpu_list *list)
{
    const int count = list->count;
    size_t texel[CPU_FRAGMENTS];
    for (int i = 0; i < count; i++)
        texel[i] = texel_of(s, list->at[i]);
    if (s->drawn < FETCHED_PX)
        fetch_texels(s, texel, count);
    s->drawn += count;
    pad_list(list);
    if (s->program->has_columns)
        stage_list(s, list);
    const bool plain = list == &s->lists[1];
    (plain ? s->program->plain_list : s->program->list)(s->call, s->bins->records, list,
                                                        &s->columns, &s->fragments);
    gather_texels(s, texel, count);
    meet(s);
    scatter_texels(s, texel, count);
    if (s->draw.counted)
        for (int i = 0; i < count; i++)
            count_sample(s, list->prim[i], s->fragments.kept[i]);
}

static void begin_listing(struct shader *s)
{
    s->listing = 1;
    memset(s->listed, 0, sizeof(s->listed));
}

static void flush_list(struct shader *s, struct cpu_list *list)
{
    if (list->count && s->drops_hidden)
        drop_hidden(s, list);
    if (list->count)
        draw_list(s, list);
    list->count = 0;
}

// The two lists have different pixels, so that either may be drawn first.
static void flush(struct shader *s)
{
    flush_list(s, &s->lists[0]);
    flush_list(s, &s->lists[1]);
    if (++s->listing == 0)
        begin_listing(s);
}

static struct cpu_list *list_for(struct shader *s, int named)
{
    return &s->lists[(named & CPU_PLAIN) != 0 ? 1 : 0];
}

static inline void list_pixel(struct shader *s, struct cpu_list *list, int prim, int x, int y)
{
    uint16_t *listed = &s->listed[y & (LISTED_PX - 1)][x & (LISTED_PX - 1)];
    if (*listed == s->listing || list->count == CPU_FRAGMENTS)
        flush(s);
    *listed = s->listing;
    list->at[list->count] = y << 16 | x;
    list->prim[list->count] = prim;
    list->count++;
}

// Prefetches a primitive's record and its lights' records. It is always inlined, because gcc drops
// calls of a function without effect.
static inline __attribute__((always_inline)) void fetch_record(const struct shader *s, int prim)
{
    const size_t size = s->program->record_size, light_size = s->program->light_size;
    const char *record = s->bins->records.of_items + (size_t)prim * size;
    __builtin_prefetch(record);
    __builtin_prefetch(record + size - 1);
    const char *by = s->bins->records.of_items + (size_t)s->bins->records.room * size +
                     (size_t)prim * light_size;
    for (int light = 0; light < s->recorded_lights; light++)
        __builtin_prefetch(by + (size_t)light * (size_t)s->bins->records.room * light_size);
}

static void list_mask(struct shader *s, const struct cpu_ref *ref)
{
    struct cpu_list *list = list_for(s, ref->prim);
    const int x = ref->place & 0xffff, y = ref->place >> 16, prim = ref->prim & (CPU_PLAIN - 1);
    fetch_record(s, prim);
    for (uint64_t rest = ref->mask; rest; rest &= rest - 1) {
        const int bit = __builtin_ctzll(rest);
        list_pixel(s, list, prim, x + (bit & 7), y + (bit >> 3));
    }
}

#endif
