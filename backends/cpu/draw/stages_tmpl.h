// The loops of the DRAW program that was just included: the part of cpu's drawing that depends on
// the program.
//
// They run to a multiple of CPU_LANES, which avoids a remainder loop. The additional elements
// repeat the last one, since no other may be read.
#include "backends/cpu/draw/program.h"
#include "backends/cpu/kernels/bind_tmpl.h"

#if defined(RG_GROUP_ITEMS)

// Lists items that may be seen; returns the first item after the groups that were asked. Groups
// begin at multiples of RG_GROUP_ITEMS, and each is asked as a whole. A place outside the range
// repeats the nearest item, and is not listed.
static int list_items(const struct cpu_call *call, int begin, int end, struct cpu_items *items)
{
    const rg_ctx rg = bind_context(call);
    const RG_PARAMS p = ((const rg_draw_call *)call->params)->program;
    int from = begin;
    items->count = 0;
    RG_GROUP next = rg_program_group(rg, p, begin / RG_GROUP_ITEMS);
    while (from < end && items->count <= CPU_BATCH - RG_GROUP_ITEMS) {
        const int first = from & -RG_GROUP_ITEMS, last = rg_imin(first + RG_GROUP_ITEMS, end) - 1;
        const RG_GROUP group = next; // asked one turn ahead, so that the data that it fetches has
                                     // arrived
        next = rg_program_group(rg, p, rg_imin(last + 1, end - 1) / RG_GROUP_ITEMS);
        int unseen[RG_GROUP_ITEMS];
#pragma omp simd
        for (int i = 0; i < RG_GROUP_ITEMS; i++)
            unseen[i] = rg_program_unseen(rg, p, group, rg_iclamp(first + i, begin, last));
        for (; from <= last; from++) {
            items->item[items->count] = from;
            items->count += unseen[from - first] == 0 ? 1 : 0;
        }
    }
    return from;
}

#define LISTED_ITEM(items, begin, i) (items)->item[i]

#else

static int list_items(const struct cpu_call *call RG_UNUSED, int begin, int end,
                      struct cpu_items *items)
{
    items->count = rg_imin(end - begin, CPU_BATCH);
    for (int i = 0; i < items->count; i++)
        items->item[i] = begin + i;
    return begin + items->count;
}

#define LISTED_ITEM(items, begin, i) ((begin) + (i))

#endif

static int make_items(const struct cpu_call *call, int begin, int end, struct cpu_items *items)
{
    const rg_ctx rg = bind_context(call);
    const rg_draw_call p = *(const rg_draw_call *)call->params;
    const int next = list_items(call, begin, end, items);
    const int last = items->count - 1, padded = cpu_padded(items->count);
#pragma omp simd
    for (int i = 0; i < padded; i++) {
        const int item = LISTED_ITEM(items, begin, rg_imin(i, last));
        const rg_item t = rg_item_closed(rg_program_item(rg, p.draw, p.program, item), RG_CORNERS);
        const rg_projected s = rg_project(p.draw, t);
        items->fate[i] = s.fate;
        items->x[0][i] = s.corners.x0;
        items->y[0][i] = s.corners.y0;
        items->x[1][i] = s.corners.x1;
        items->y[1][i] = s.corners.y1;
        items->x[2][i] = s.corners.x2;
        items->y[2][i] = s.corners.y2;
        items->x[3][i] = s.corners.x3;
        items->y[3][i] = s.corners.y3;
    }
    return next;
}

static int clip_item(const struct cpu_call *call, int item, rg_snapped parts[CPU_MOST_PARTS])
{
    const rg_ctx rg = bind_context(call);
    const rg_draw_call p = *(const rg_draw_call *)call->params;
    const rg_item t = rg_item_closed(rg_program_item(rg, p.draw, p.program, item), RG_CORNERS);
    const rg_polygon g = rg_clip(p.draw, t, RG_CORNERS, RG_FATE_CLIP);
    const int count = rg_polygon_prims(g, RG_CORNERS);
    for (int k = 0; k < count; k++)
        parts[k] = rg_polygon_prim(p.draw, g, RG_CORNERS, k);
    return count;
}

#if defined(RG_LIGHT_RECORD)

static inline __attribute__((always_inline)) RG_LIGHT_RECORD *
light_records(struct cpu_records records, int light)
{
    RG_LIGHT_RECORD *first =
        (RG_LIGHT_RECORD *)(records.of_items + (size_t)records.room * sizeof(RG_RECORD));
    return first + (size_t)light * (size_t)records.room;
}

// The records' indices come from an array, because gcc gathers from unknown addresses. If it knew
// that the records are a fixed distance apart, it would read one item at a time.
static void make_light_records(rg_ctx rg, RG_PARAMS p, const RG_RECORD *of, const int *begin,
                               int count, int light, RG_LIGHT_RECORD *made)
{
#pragma omp simd
    for (int i = 0; i < count; i++) {
        const RG_RECORD *r = (const RG_RECORD *)((const char *)of + begin[i]);
        made[i] = rg_program_record_light(rg, p, *r, light);
    }
}

// The record of a listed fragment's item and a light; `by` has the records of all.
static inline __attribute__((always_inline)) const RG_LIGHT_RECORD *
light_record_of(const RG_LIGHT_RECORD *by, const struct cpu_list *list, int i)
{
    const int begin = list->prim[i] * (int)sizeof(RG_LIGHT_RECORD);
    return (const RG_LIGHT_RECORD *)((const char *)by + begin);
}

#define RG_LIGHT_RECORDS(name, records, light)                                                     \
    const RG_LIGHT_RECORD *name = light_records(records, light);
#define RG_BY(by, list, i)   , *light_record_of(by, list, i)
#define RG_BY_PRIM(by, prim) , (by)[prim]

#else

#define RG_LIGHT_RECORDS(name, records, light)
#define RG_BY(by, list, i)
#define RG_BY_PRIM(by, prim)

#endif

static inline __attribute__((always_inline)) void
make_item_records(rg_ctx rg, rg_draw_call p, const int *items, int count, RG_RECORD *made)
{
#pragma omp simd
    for (int i = 0; i < count; i++)
        made[i] = rg_program_record(rg, p.draw, p.program, items[i]);
}

#if defined(RG_LIGHT_RECORD)

// Makes items' and the first light's records in one loop, which saves gathering the records just
// made.
static inline __attribute__((always_inline)) void make_lit_records(rg_ctx rg, rg_draw_call p,
                                                                   const int *items, int count,
                                                                   RG_RECORD *made,
                                                                   RG_LIGHT_RECORD *first)
{
#pragma omp simd
    for (int i = 0; i < count; i++) {
        const RG_RECORD r = rg_program_record(rg, p.draw, p.program, items[i]);
        made[i] = r;
        first[i] = rg_program_record_light(rg, p.program, r, 0);
    }
}

#endif

static inline __attribute__((always_inline)) void make_all_records(const struct cpu_call *call,
                                                                   const int *items, int count,
                                                                   struct cpu_records records,
                                                                   int first)
{
    const rg_ctx rg = bind_context(call);
    const rg_draw_call p = *(const rg_draw_call *)call->params;
    RG_RECORD *made = (RG_RECORD *)records.of_items + first;
#if defined(RG_LIGHT_RECORD)
    if (p.program.lights > 0) {
        make_lit_records(rg, p, items, count, made, light_records(records, 0) + first);
        int begin[CPU_PLACES];
        for (int i = 0; i < count; i++)
            begin[i] = i * (int)sizeof(RG_RECORD);
        for (int light = 1; light < p.program.lights; light++)
            make_light_records(rg, p.program, made, begin, count, light,
                               light_records(records, light) + first);
        return;
    }
#endif
    make_item_records(rg, p, items, count, made);
}

static void make_records(const struct cpu_call *call, const int *items, int count,
                         struct cpu_records records, int first, uint8_t *plain)
{
    make_all_records(call, items, count, records, first);
#if defined(RG_PLAIN)
    const RG_RECORD *made = (const RG_RECORD *)records.of_items + first;
    for (int i = 0; i < count; i++)
        plain[i] = rg_program_plain(made[i]) != 0;
#else
    memset(plain, 0, (size_t)count);
#endif
}

// Stores a fragment, except its depth.
static inline __attribute__((always_inline)) void put_fragment(struct cpu_fragments *to, int i,
                                                               rg_fragment f)
{
    to->r[i] = f.colour.r;
    to->g[i] = f.colour.g;
    to->b[i] = f.colour.b;
    to->a[i] = f.colour.a;
    to->depth[i] = f.depth;
    to->kept[i] = f.kept;
}

// A separate loop, because gcc 12 does not vectorise choices that are constant along a row, such as
// those of a billboard's depth.
static inline __attribute__((always_inline)) void settle_depths(struct cpu_fragments *fragments,
                                                                int padded)
{
#pragma omp simd
    for (int i = 0; i < padded; i++)
        fragments->depth[i] = rg_settled_depth(fragments->depth[i]);
}

#if defined(RG_LIGHTS)

// The loop over lights is outside that over fragments, which compilers then vectorise. These arrays
// alias no slot, so that a light's words stay in registers.
struct lit {
#define RG_COLUMN(part) float part[CPU_FRAGMENTS];
    RG_LIGHT_PARTS(RG_COLUMN)
};

static inline __attribute__((always_inline)) void put_light(struct lit *lit, int i, rg_lit l)
{
#define RG_PUT_PART(part) lit->part[i] = l.part;
    RG_LIGHT_PARTS(RG_PUT_PART)
}

static inline __attribute__((always_inline)) rg_lit light_of(const struct lit *lit, int i)
{
    rg_lit l;
#define RG_GET_PART(part) l.part = lit->part[i];
    RG_LIGHT_PARTS(RG_GET_PART)
    return l;
}

static inline __attribute__((always_inline)) void clear_light(struct lit *lit, int padded)
{
    for (int i = 0; i < padded; i++)
        put_light(lit, i, rg_no_light());
}

static inline __attribute__((always_inline)) void add_light(struct lit *lit, int i, rg_lit l)
{
    put_light(lit, i, rg_light_sum(light_of(lit, i), l));
}

#define RG_LIT(lit, i) , light_of(lit, i)

#else

#define RG_LIT(lit, i)

#endif

// The address of a listed fragment's record, with an offset of 32 bits, as gather instructions need
// it.
static inline __attribute__((always_inline)) const RG_RECORD *
record_of(struct cpu_records records, const struct cpu_list *list, int i)
{
    const int begin = list->prim[i] * (int)sizeof(RG_RECORD);
    return (const RG_RECORD *)(records.of_items + begin);
}

// The record of a listed fragment, and that of its item and the first light. They are gathered word
// by word, or taken from columns for programs that say that this is worth it.
#if defined(RG_COLUMNS)

// Unrolling the loop fully lets gcc keep the words in registers.
#define RG_COLUMN_WORDS(record, columns, first, i)                                                 \
    uint words[sizeof(record) / sizeof(uint)];                                                     \
    _Pragma("GCC unroll 64") for (int k = 0; k < (int)(sizeof(record) / sizeof(uint)); k++)        \
        words[k] = (columns)->words[(first) + k][i];                                               \
    memcpy(&(record), words, sizeof(record));

static inline __attribute__((always_inline)) RG_RECORD
column_record(const struct cpu_columns *columns, int i)
{
    RG_RECORD r;
    RG_COLUMN_WORDS(r, columns, 0, i)
    return r;
}

#define RG_LISTED(records, list, i) column_record(columns, i)

#if defined(RG_LIGHT_RECORD)

static inline __attribute__((always_inline)) RG_LIGHT_RECORD
column_light_record(const struct cpu_columns *columns, int i)
{
    RG_LIGHT_RECORD r;
    RG_COLUMN_WORDS(r, columns, sizeof(RG_RECORD) / sizeof(uint), i)
    return r;
}

#define RG_BY_FIRST(by, list, i) , column_light_record(columns, i)
#define RG_ALL_WORDS             ((sizeof(RG_RECORD) + sizeof(RG_LIGHT_RECORD)) / sizeof(uint))
#else
#define RG_BY_FIRST(by, list, i)
#define RG_ALL_WORDS (sizeof(RG_RECORD) / sizeof(uint))
#endif
static_assert(RG_ALL_WORDS <= CPU_MOST_WORDS, "each word of a record has a column");

#else
#define RG_LISTED(records, list, i) *record_of(records, list, i)
#define RG_BY_FIRST(by, list, i)    RG_BY(by, list, i)
#endif

#if defined(RG_LIGHTS)

// A single light is added in the loop that makes colours, so that common terms are computed once.
static inline __attribute__((always_inline)) void
shade_lit_list(rg_ctx rg, RG_PARAMS p, struct cpu_records records RG_UNUSED,
               const struct cpu_list *list, const struct cpu_columns *columns RG_UNUSED, int padded,
               struct cpu_fragments *fragments)
{
    RG_LIGHT_RECORDS(by RG_UNUSED, records, 0)
#pragma omp simd
    for (int i = 0; i < padded; i++) {
        const int x = list->at[i] & 0xffff, y = list->at[i] >> 16;
        const RG_RECORD r = RG_LISTED(records, list, i);
        const rg_lit l = rg_program_light(rg, p, r, x, y, 0 RG_BY_FIRST(by, list, i));
        put_fragment(fragments, i,
                     rg_program_fragment(rg, p, r, x, y, rg_light_sum(rg_no_light(), l)));
    }
    settle_depths(fragments, padded);
}

#endif

static inline __attribute__((always_inline)) void
shade_any_list(const struct cpu_call *call, struct cpu_records records RG_UNUSED,
               const struct cpu_list *list, const struct cpu_columns *columns RG_UNUSED,
               struct cpu_fragments *fragments, int plain)
{
    rg_ctx rg = bind_context(call);
    rg.plain = plain;
    const RG_PARAMS p = ((const rg_draw_call *)call->params)->program;
    const int padded = cpu_padded(list->count);
    fragments->count = list->count;
#if defined(RG_LIGHTS)
    if (p.lights == 1) {
        shade_lit_list(rg, p, records, list, columns, padded, fragments);
        return;
    }
    struct lit lit;
    clear_light(&lit, padded);
    for (int light = 0; light < p.lights; light++) {
        RG_LIGHT_RECORDS(by, records, light)
#pragma omp simd
        for (int i = 0; i < padded; i++) {
            const int at = list->at[i];
            add_light(&lit, i,
                      rg_program_light(rg, p, RG_LISTED(records, list, i), at & 0xffff, at >> 16,
                                       light RG_BY(by, list, i)));
        }
    }
#endif
#pragma omp simd
    for (int i = 0; i < padded; i++) {
        const int at = list->at[i];
        put_fragment(fragments, i,
                     rg_program_fragment(rg, p, RG_LISTED(records, list, i), at & 0xffff,
                                         at >> 16 RG_LIT(&lit, i)));
    }
    settle_depths(fragments, padded);
}

static void shade_list(const struct cpu_call *call, struct cpu_records records,
                       const struct cpu_list *list, const struct cpu_columns *columns,
                       struct cpu_fragments *fragments)
{
    shade_any_list(call, records, list, columns, fragments, 0);
}

#if defined(RG_PLAIN)

static void shade_plain_list(const struct cpu_call *call, struct cpu_records records,
                             const struct cpu_list *list, const struct cpu_columns *columns,
                             struct cpu_fragments *fragments)
{
    shade_any_list(call, records, list, columns, fragments, 1);
}

#else
#define shade_plain_list shade_list
#endif

static void shade_row(const struct cpu_call *call, struct cpu_records records, int prim, int x,
                      int y, int count, struct cpu_fragments *fragments)
{
    const rg_ctx rg = bind_context(call);
    const RG_PARAMS p = ((const rg_draw_call *)call->params)->program;
    const RG_RECORD r = ((const RG_RECORD *)records.of_items)[prim];
    const int last = count - 1, padded = cpu_padded(count);
    fragments->count = count;
#if defined(RG_LIGHTS)
    struct lit lit;
    clear_light(&lit, padded);
    for (int light = 0; light < p.lights; light++) {
        RG_LIGHT_RECORDS(by, records, light)
#pragma omp simd
        for (int i = 0; i < padded; i++)
            add_light(
                &lit, i,
                rg_program_light(rg, p, r, x + rg_imin(i, last), y, light RG_BY_PRIM(by, prim)));
    }
#endif
    // Whole vectors read texels that lie side by side; only the last one clamps its pixels.
    const int whole = count - count % CPU_LANES;
#pragma omp simd
    for (int i = 0; i < whole; i++)
        put_fragment(fragments, i, rg_program_fragment(rg, p, r, x + i, y RG_LIT(&lit, i)));
#pragma omp simd
    for (int i = whole; i < padded; i++)
        put_fragment(fragments, i,
                     rg_program_fragment(rg, p, r, x + rg_imin(i, last), y RG_LIT(&lit, i)));
    settle_depths(fragments, padded);
}

#if defined(RG_LIGHTS)

static inline __attribute__((always_inline)) void put_depth(struct cpu_fragments *to, int i,
                                                            rg_fragment f)
{
    to->depth[i] = f.depth;
    to->kept[i] = f.kept;
}

static int count_lights(const struct cpu_call *call)
{
    return ((const rg_draw_call *)call->params)->program.lights;
}

static void list_depth(const struct cpu_call *call, struct cpu_records records,
                       const struct cpu_list *list, struct cpu_fragments *fragments)
{
    const rg_ctx rg = bind_context(call);
    const RG_PARAMS p = ((const rg_draw_call *)call->params)->program;
    const rg_lit dark = rg_no_light();
    const int padded = cpu_padded(list->count);
#pragma omp simd
    for (int i = 0; i < padded; i++) {
        const int at = list->at[i];
        put_depth(
            fragments, i,
            rg_program_fragment(rg, p, *record_of(records, list, i), at & 0xffff, at >> 16, dark));
    }
    settle_depths(fragments, padded);
}

static void row_depth(const struct cpu_call *call, struct cpu_records records, int prim, int x,
                      int y, int count, struct cpu_fragments *fragments)
{
    const rg_ctx rg = bind_context(call);
    const RG_PARAMS p = ((const rg_draw_call *)call->params)->program;
    const RG_RECORD r = ((const RG_RECORD *)records.of_items)[prim];
    const rg_lit dark = rg_no_light();
    const int last = count - 1, padded = cpu_padded(count);
#pragma omp simd
    for (int i = 0; i < padded; i++)
        put_depth(fragments, i, rg_program_fragment(rg, p, r, x + rg_imin(i, last), y, dark));
    settle_depths(fragments, padded);
}

#endif

static const struct cpu_program program = {
    .corners = RG_CORNERS,
    .record_size = sizeof(RG_RECORD),
#if defined(RG_LIGHT_RECORD)
    .light_size = sizeof(RG_LIGHT_RECORD),
#endif
    .items = make_items,
    .clip = clip_item,
    .records = make_records,
    .list = shade_list,
    .plain_list = shade_plain_list,
#if defined(RG_COLUMNS)
    .has_columns = true,
#endif
    .row = shade_row,
#if defined(RG_LIGHTS)
    .lights = count_lights,
    .list_depth = list_depth,
    .row_depth = row_depth,
#endif
};

RG_EXPORT_KERNEL = {.program = &program};
