// The blocks of the packets that a frame draws.
#include <math.h>
#include <string.h>

#include "core/base/array.h"
#include "core/techniques/streaks/packets/inner.h"

// --- packets to runs ---

static float turn_of(double turns)
{
    const float turn = (float)(turns - floor(turns));
    return turn < 1 ? turn : 0;
}

static struct streaks_run run_of(const struct streaks_packets *p, const struct streaks_view *view,
                                 int place)
{
    if (p->info.scheme != STREAKS_GRID)
        return (struct streaks_run){.slot = p->packets[place].first,
                                    .count = p->packets[place].count,
                                    .turn = turn_of(view->run)};
    const struct streaks_packet *bucket = &p->grid.buckets[p->grid.levels[place]];
    return (struct streaks_run){
        .slot = bucket->first,
        .place = place,
        .count = bucket->count,
        .shift_x = (float)(2.0 * (place % p->grid.across) / p->grid.across),
        .shift_y = (float)(2.0 * (place / p->grid.across) / p->grid.down),
        .turn = turn_of(view->run + streaks_cell_turn(p->settings.seed, place))};
}

// Splits a run at the ends of buffers. Returns the number of runs.
static int cut_run(struct streaks_run whole, struct streaks_run *runs)
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
        if (!rg_array_fit(&s->draws, &s->room[STREAKS_DRAWS], s->draw_count + 1, sizeof(*s->draws),
                          "rain: draws"))
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
    const bool good =
        rg_array_fit(&s->blocks, &s->room[STREAKS_BLOCKS], count,
                     STREAKS_BLOCK_WORDS * sizeof(*s->blocks), "rain: blocks of particles");
    s->block_count = good ? count : 0;
    s->draw_count = good ? s->draw_count : 0;
    return good;
}

static void write_block(uint32_t *to, int64_t slot, uint32_t mask, const struct streaks_run *run)
{
    to[0] = (uint32_t)(slot % STREAKS_BUFFER_PARTICLES);
    to[1] = mask;
    memcpy(to + 2, &run->shift_x, 4);
    memcpy(to + 3, &run->shift_y, 4);
    memcpy(to + 4, &run->turn, 4);
}

// Writes the visible blocks of a run.
static void write_run(const struct streaks_run *run, const uint8_t *seen, uint32_t *to)
{
    const int64_t blocks = streaks_blocks_in(run);
    for (int64_t i = 0; i < blocks; i++) {
        const int64_t left = run->count - i * STREAKS_BLOCK;
        if (!seen[i])
            continue;
        write_block(to, run->slot + i * STREAKS_BLOCK,
                    left < STREAKS_BLOCK ? ((uint32_t)1 << left) - 1 : UINT32_MAX, run);
        to += STREAKS_BLOCK_WORDS;
    }
}

// Whether sparse rain keeps a block, numbered through all buffers. A bucket's blocks occur at many
// places, each of which keeps other ones.
static bool is_kept(int64_t block, int place, int sparse)
{
    return sparse <= 1 || (block + place) % sparse == 0;
}

// Thins out the visible blocks of a run.
static void thin_out(struct streaks_run *run, int sparse, uint8_t *seen)
{
    const int64_t blocks = streaks_blocks_in(run);
    run->block = 0;
    for (int64_t i = 0; i < blocks; i++) {
        seen[i] = seen[i] && is_kept(run->slot / STREAKS_BLOCK + i, run->place, sparse);
        run->block += seen[i];
    }
}

// Sets which blocks are visible; run->block gets the number of a run's visible ones.
static void cull(const struct streaks_packets *p, const struct streaks_view *view,
                 struct streaks_run *runs, int64_t count, uint8_t *seen)
{
    if (view->whole) {
        for (int64_t i = 0; i < count; i++) {
            runs[i].block = streaks_blocks_in(&runs[i]);
            memset(seen + runs[i].first, 1, (size_t)runs[i].block);
        }
        return;
    }
    struct streaks_sight sight;
    streaks_sight_of(p, view, &sight);
#pragma omp parallel for schedule(dynamic, 8)
    for (int64_t i = 0; i < count; i++)
        runs[i].block = streaks_bounds_seen(p, &sight, &runs[i], seen + runs[i].first);
}

// Gives each run its place in the list, grouped by buffer, in order.
static bool lay_out(const struct streaks_packets *p, struct streaks_selection *s,
                    struct streaks_run *runs, int64_t count)
{
    const int buffers = streaks_packets_buffers(p);
    int64_t next[STREAKS_BUFFER_LIMIT] = {0}, first = 0;
    for (int64_t i = 0; i < count; i++)
        next[buffer_of(runs[i].slot)] += runs[i].block;
    for (int buffer = 0; buffer < buffers; buffer++) {
        const int64_t blocks = next[buffer];
        if (!add_draws(s, buffer, first, blocks))
            return false;
        next[buffer] = first;
        first += blocks;
    }
    for (int64_t i = 0; i < count; i++) {
        int64_t *at = &next[buffer_of(runs[i].slot)];
        const int64_t blocks = runs[i].block;
        runs[i].block = *at;
        *at += blocks;
    }
    return reserve_blocks(s, first);
}

// Makes runs of the selected packets, and returns their number of blocks.
static int64_t make_runs(const struct streaks_packets *p, const struct streaks_view *view,
                         const struct streaks_selection *s, struct streaks_run *runs,
                         int64_t *blocks)
{
    int64_t count = 0;
    *blocks = 0;
    for (int i = 0; i < s->packets; i++)
        count += cut_run(run_of(p, view, s->selected[i]), runs + count);
    for (int64_t i = 0; i < count; i++) {
        runs[i].first = *blocks;
        *blocks += streaks_blocks_in(&runs[i]);
    }
    return count;
}

bool streaks_list_by_packet(const struct streaks_packets *p, const struct streaks_view *view,
                            struct streaks_selection *s)
{
    if (!rg_array_fit(&s->runs, &s->room[STREAKS_RUNS], (int64_t)s->packets + STREAKS_BUFFER_LIMIT,
                      sizeof(*s->runs), "rain: runs of particles"))
        return false;
    struct streaks_run *runs = s->runs;
    int64_t blocks;
    const int64_t count = make_runs(p, view, s, runs, &blocks);
    if (!rg_array_fit(&s->seen, &s->room[STREAKS_SEEN], blocks, sizeof(*s->seen),
                      "rain: blocks of particles"))
        return false;
    uint8_t *seen = s->seen;
    cull(p, view, runs, count, seen);
    for (int64_t i = 0; view->sparse > 1 && i < count; i++)
        thin_out(&runs[i], view->sparse, seen + runs[i].first);
    if (!lay_out(p, s, runs, count))
        return false;
#pragma omp parallel for schedule(dynamic, 8)
    for (int64_t i = 0; i < count; i++)
        write_run(&runs[i], seen + runs[i].first, s->blocks + runs[i].block * STREAKS_BLOCK_WORDS);
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

bool streaks_list_by_id(const struct streaks_packets *p, const struct streaks_view *view,
                        struct streaks_selection *s)
{
    enum { BUFFER_MASKS = STREAKS_BUFFER_PARTICLES / STREAKS_BLOCK };
    const int64_t count = p->slots / STREAKS_BLOCK;
    if (!rg_array_fit(&s->masks, &s->room[STREAKS_MASKS], count, sizeof(*s->masks),
                      "rain: blocks of particles"))
        return false;
    uint32_t *masks = s->masks;
    memset(masks, 0, (size_t)count * sizeof(*masks));
    for (int i = 0; i < s->packets; i++)
        set_packet(p, &p->packets[s->selected[i]], masks);
    for (int64_t i = 0; i < count; i++)
        masks[i] = is_kept(i, 0, view->sparse) ? masks[i] : 0;
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
    const struct streaks_run all = {.turn = turn_of(view->run)};
    uint32_t *to = s->blocks;
    for (int64_t i = 0; i < count; i++)
        if (masks[i]) {
            write_block(to, i * STREAKS_BLOCK, masks[i], &all);
            to += STREAKS_BLOCK_WORDS;
        }
    return true;
}
