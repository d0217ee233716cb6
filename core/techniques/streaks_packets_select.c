#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/log.h"
#include "core/techniques/streaks_packets_inner.h"

// Particles that follow each other in one buffer, drawn with the same shift and turn.
struct run {
    int64_t slot; // of the first, of all buffers counted through
    int32_t count;
    float shift_x, shift_y, turn;
    int64_t block; // where its blocks begin in the list
};

enum { SELECTED, DRAWS, BLOCKS, RUNS, MASKS };

// Makes room for `count` elements; what an array held is lost only where `keep` is false.
static bool reserve(struct streaks_selection *s, int array, void **memory, int64_t count,
                    size_t size, bool keep)
{
    if (count <= s->reserved[array])
        return true;
    const int64_t wanted = count > 2 * s->reserved[array] ? count : 2 * s->reserved[array];
    if (!keep) {
        free(*memory);
        *memory = NULL;
        s->reserved[array] = 0;
    }
    void *grown = realloc(*memory, (size_t)wanted * size);
    if (!grown)
        return rg_error("rain: no memory for a list of %lld selected; use larger packets or a "
                        "smaller radius",
                        (long long)wanted);
    *memory = grown;
    s->reserved[array] = wanted;
    return true;
}

static bool reserve_more(struct streaks_selection *s, int array, void **memory, int64_t count,
                         size_t size)
{
    return reserve(s, array, memory, count, size, true);
}

void streaks_selection_release(struct streaks_selection *selection)
{
    free(selection->selected);
    free(selection->draws);
    free(selection->blocks);
    free(selection->scratch[0]);
    free(selection->scratch[1]);
    memset(selection, 0, sizeof(*selection));
}

static bool add_place(struct streaks_selection *s, int place, int64_t particles)
{
    void *memory = s->selected;
    const bool good = reserve_more(s, SELECTED, &memory, s->packets + 1, sizeof(*s->selected));
    s->selected = memory;
    if (good) {
        s->selected[s->packets++] = place;
        s->particles += particles;
    }
    return good;
}

// --- which packets ---

static double metres(uint32_t lattice, double half_m)
{
    return ((double)lattice / (1 << (STREAKS_LATTICE_BITS - 1)) - 1) * half_m;
}

static bool descend(const struct streaks_packets *p, const struct streaks_area *area, int32_t index,
                    struct streaks_selection *s)
{
    const struct streaks_node *node = &p->nodes[index];
    if (p->info.scheme != STREAKS_WORLD &&
        !streaks_area_meets(area, metres(node->left, p->half_x_m), metres(node->top, p->half_y_m),
                            metres(node->right, p->half_x_m), metres(node->bottom, p->half_y_m)))
        return true;
    if (node->packet >= 0)
        return add_place(s, node->packet, p->packets[node->packet].count);
    return node->second < 0 ||
           (descend(p, area, index + 1, s) && descend(p, area, node->second, s));
}

// Cells that an interval of metres meets, borders included: clamped to 0 and count - 1.
static void cells_along(double low, double high, double half_m, int count, int *first, int *last)
{
    const double scale = count / (2 * half_m);
    const double from = ceil((low + half_m) * scale) - 1, to = floor((high + half_m) * scale);
    *first = from > 0 ? (int)fmin(from, count) : 0;
    *last = to < count - 1 ? (int)fmax(to, -1) : count - 1;
}

static bool select_cells(const struct streaks_packets *p, const struct streaks_area *area,
                         struct streaks_selection *s)
{
    int left, right, top, bottom;
    cells_along(area->left, area->right, p->half_x_m, p->grid.across, &left, &right);
    cells_along(area->top, area->bottom, p->half_y_m, p->grid.down, &top, &bottom);
    for (int row = top; row <= bottom; row++)
        for (int column = left; column <= right; column++) {
            const int cell = row * p->grid.across + column;
            const int level = p->grid.levels[cell];
            double r[4];
            streaks_packets_rectangle(p, cell, r);
            if (level == 0 || !streaks_area_meets(area, r[0], r[1], r[2], r[3]))
                continue;
            if (!add_place(s, cell, p->grid.buckets[level].count))
                return false;
        }
    return true;
}

void streaks_packets_rectangle(const struct streaks_packets *p, int place, double rectangle_m[4])
{
    if (p->info.scheme == STREAKS_GRID) {
        const double wide = 2 * p->half_x_m / p->grid.across, high = 2 * p->half_y_m / p->grid.down;
        const int column = place % p->grid.across, row = place / p->grid.across;
        const double r[4] = {column * wide - p->half_x_m, row * high - p->half_y_m,
                             (column + 1) * wide - p->half_x_m, (row + 1) * high - p->half_y_m};
        memcpy(rectangle_m, r, sizeof(r));
        return;
    }
    const struct streaks_node *node = &p->nodes[p->packets[place].node];
    rectangle_m[0] = metres(node->left, p->half_x_m);
    rectangle_m[1] = metres(node->top, p->half_y_m);
    rectangle_m[2] = metres(node->right, p->half_x_m);
    rectangle_m[3] = metres(node->bottom, p->half_y_m);
}

int64_t streaks_packets_count(const struct streaks_packets *p, int place)
{
    return p->info.scheme == STREAKS_GRID ? p->grid.buckets[p->grid.levels[place]].count
                                          : p->packets[place].count;
}

// --- packets to runs ---

static float turn_of(double turns)
{
    const float turn = (float)(turns - floor(turns));
    return turn < 1 ? turn : 0;
}

static struct run run_of(const struct streaks_packets *p, const struct streaks_view *view,
                         int place)
{
    if (p->info.scheme != STREAKS_GRID)
        return (struct run){.slot = p->packets[place].first,
                            .count = p->packets[place].count,
                            .turn = turn_of(view->run)};
    const struct streaks_packet *bucket = &p->grid.buckets[p->grid.levels[place]];
    return (struct run){.slot = bucket->first,
                        .count = bucket->count,
                        .shift_x = (float)(2.0 * (place % p->grid.across) / p->grid.across),
                        .shift_y = (float)(2.0 * (place / p->grid.across) / p->grid.down),
                        .turn = turn_of(view->run + streaks_cell_turn(p->settings.seed, place))};
}

static int64_t blocks_in(const struct run *run)
{
    return (run->count + STREAKS_BLOCK - 1) / STREAKS_BLOCK;
}

// Cuts a run where its buffer ends. Returns how many runs it makes.
static int cut_run(struct run whole, struct run *runs)
{
    int count = 0;
    while (whole.count > 0) {
        const int64_t left = STREAKS_BUFFER_PARTICLES - whole.slot % STREAKS_BUFFER_PARTICLES;
        runs[count] = whole;
        runs[count].count = (int32_t)(whole.count < left ? whole.count : left);
        whole.slot += runs[count].count;
        whole.count -= runs[count++].count;
    }
    return count;
}

static int buffer_of(int64_t slot)
{
    return (int)(slot / STREAKS_BUFFER_PARTICLES);
}

static bool add_draws(struct streaks_selection *s, int buffer, int64_t first, int64_t count)
{
    for (int64_t done = 0; done < count; done += STREAKS_DRAW_BLOCKS) {
        void *memory = s->draws;
        const bool good = reserve_more(s, DRAWS, &memory, s->draw_count + 1, sizeof(*s->draws));
        s->draws = memory;
        if (!good)
            return false;
        const int64_t left = count - done;
        s->draws[s->draw_count++] = (struct streaks_draw){
            .buffer = buffer,
            .first_block = first + done,
            .block_count = (int)(left < STREAKS_DRAW_BLOCKS ? left : STREAKS_DRAW_BLOCKS)};
    }
    return true;
}

static bool reserve_blocks(struct streaks_selection *s, int64_t count)
{
    void *memory = s->blocks;
    const bool good =
        reserve(s, BLOCKS, &memory, count * STREAKS_BLOCK_WORDS, sizeof(*s->blocks), false);
    s->blocks = memory;
    s->block_count = good ? count : 0;
    return good;
}

static void write_block(uint32_t *to, int64_t slot, uint32_t mask, const struct run *run)
{
    to[0] = (uint32_t)(slot % STREAKS_BUFFER_PARTICLES);
    to[1] = mask;
    memcpy(to + 2, &run->shift_x, 4);
    memcpy(to + 3, &run->shift_y, 4);
    memcpy(to + 4, &run->turn, 4);
}

static void write_run(const struct run *run, uint32_t *to)
{
    const int64_t blocks = blocks_in(run);
    for (int64_t i = 0; i < blocks; i++) {
        const int64_t left = run->count - i * STREAKS_BLOCK;
        write_block(to + i * STREAKS_BLOCK_WORDS, run->slot + i * STREAKS_BLOCK,
                    left < STREAKS_BLOCK ? ((uint32_t)1 << left) - 1 : UINT32_MAX, run);
    }
}

// Gives each run its place in the list, those of one buffer together and in their order.
static bool lay_out(const struct streaks_packets *p, struct streaks_selection *s, struct run *runs,
                    int64_t count)
{
    const int buffers = streaks_packets_buffers(p);
    int64_t next[STREAKS_MAX_BUFFERS] = {0}, first = 0;
    for (int64_t i = 0; i < count; i++)
        next[buffer_of(runs[i].slot)] += blocks_in(&runs[i]);
    for (int buffer = 0; buffer < buffers; buffer++) {
        const int64_t blocks = next[buffer];
        if (!add_draws(s, buffer, first, blocks))
            return false;
        next[buffer] = first;
        first += blocks;
    }
    for (int64_t i = 0; i < count; i++) {
        int64_t *at = &next[buffer_of(runs[i].slot)];
        runs[i].block = *at;
        *at += blocks_in(&runs[i]);
    }
    return reserve_blocks(s, first);
}

static bool list_by_packet(const struct streaks_packets *p, const struct streaks_view *view,
                           struct streaks_selection *s)
{
    void *memory = s->scratch[0];
    const bool good = reserve(s, RUNS, &memory, (int64_t)s->packets + STREAKS_MAX_BUFFERS,
                              sizeof(struct run), false);
    s->scratch[0] = memory;
    if (!good)
        return false;
    struct run *runs = memory;
    int64_t count = 0;
    for (int i = 0; i < s->packets; i++)
        count += cut_run(run_of(p, view, s->selected[i]), runs + count);
    if (!lay_out(p, s, runs, count))
        return false;
#pragma omp parallel for schedule(dynamic, 64) if (s->block_count > 4096)
    for (int64_t i = 0; i < count; i++)
        write_run(&runs[i], s->blocks + runs[i].block * STREAKS_BLOCK_WORDS);
    return true;
}

// --- particles in the order of their ids: a mask of all, in which packets set their bits ---

static void set_range(uint32_t *masks, int64_t first, int64_t count)
{
    for (int64_t at = first; at < first + count;) {
        const int bit = (int)(at % 32);
        const int64_t left = first + count - at;
        const int bits = left < 32 - bit ? (int)left : 32 - bit;
        masks[at / 32] |= (bits == 32 ? UINT32_MAX : (((uint32_t)1 << bits) - 1)) << bit;
        at += bits;
    }
}

static void set_packet(const struct streaks_packets *p, const struct streaks_packet *packet,
                       uint32_t *masks)
{
    if (!p->ids) {
        set_range(masks, packet->first, packet->count);
        return;
    }
    const uint32_t *ids = p->ids + packet->first;
    for (int32_t i = 0; i < packet->count; i++)
        masks[ids[i] / 32] |= (uint32_t)1 << ids[i] % 32;
}

static bool list_by_id(const struct streaks_packets *p, const struct streaks_view *view,
                       struct streaks_selection *s)
{
    enum { BUFFER_MASKS = STREAKS_BUFFER_PARTICLES / STREAKS_BLOCK };
    const int64_t count = p->slots / STREAKS_BLOCK;
    void *memory = s->scratch[1];
    const bool good = reserve(s, MASKS, &memory, count, sizeof(uint32_t), false);
    s->scratch[1] = memory;
    if (!good)
        return false;
    uint32_t *masks = memory;
    memset(masks, 0, (size_t)count * sizeof(*masks));
    for (int i = 0; i < s->packets; i++)
        set_packet(p, &p->packets[s->selected[i]], masks);
    int64_t blocks = 0;
    for (int64_t begin = 0; begin < count; begin += BUFFER_MASKS) {
        const int64_t before = blocks, end = begin + BUFFER_MASKS;
        for (int64_t i = begin; i < end && i < count; i++)
            blocks += masks[i] != 0;
        if (!add_draws(s, (int)(begin / BUFFER_MASKS), before, blocks - before))
            return false;
    }
    if (!reserve_blocks(s, blocks))
        return false;
    const struct run all = {.turn = turn_of(view->run)};
    uint32_t *to = s->blocks;
    for (int64_t i = 0; i < count; i++)
        if (masks[i]) {
            write_block(to, i * STREAKS_BLOCK, masks[i], &all);
            to += STREAKS_BLOCK_WORDS;
        }
    return true;
}

static bool good_view(const struct streaks_view *view)
{
    bool good = view->radius_m >= 0 && isfinite(view->top_m) && isfinite(view->run) &&
                view->across_m >= 0 && view->above_m >= 0 && view->below_m >= 0;
    for (int axis = 0; axis < 3; axis++) {
        good = good && isfinite(view->eye[axis]);
        for (int corner = 0; corner < 8; corner++)
            good = good && isfinite(view->corners[corner][axis]);
    }
    return good || rg_error("rain: the view or its margins are no numbers, or negative; check the "
                            "camera and the culling radius (%g m)",
                            view->radius_m);
}

bool streaks_select(const struct streaks_packets *packets, const struct streaks_view *view,
                    struct streaks_selection *selection)
{
    selection->particles = selection->block_count = 0;
    selection->packets = selection->draw_count = 0;
    if (!good_view(view))
        return false;
    struct streaks_area area;
    streaks_area_of(view, packets->half_x_m, packets->half_y_m, packets->settings.local_height_m,
                    &area);
    const bool grid = packets->info.scheme == STREAKS_GRID;
    if (grid ? !select_cells(packets, &area, selection) : !descend(packets, &area, 0, selection))
        return false;
    return packets->settings.by_id && !grid ? list_by_id(packets, view, selection)
                                            : list_by_packet(packets, view, selection);
}
