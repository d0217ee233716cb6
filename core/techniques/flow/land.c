// Drops that land on panes of sliding drops. A drop brings its volume to the droplet: the host
// divides it among texels, and a kernel adds what each gets.
#include <math.h>

#include "core/base/alloc.h"
#include "core/techniques/flow/instance.h"

// Drops that one run lands. No two of them share a texel.
enum { MOST_DROPS = 64, SPARE_TEXELS = 1 << 14 };

// The texels that a drop may cover: from the first to before the last, with its middle's.
struct footprint {
    int pane, x, y, x0, y0, x1, y1;
};

struct landing {
    struct flow *flow;
    struct footprint drops[MOST_DROPS];
    int drop_count, texels;
};

static struct footprint footprint_of(const struct flow *flow, const struct flow_drop *drop)
{
    const int n = flow->settings.resolution_px;
    const double mm = flow_texel_mm(&flow->settings), r = drop->radius_mm;
    const int x = flow_clamp(drop->x_mm / mm, 0, n - 1), y = flow_clamp(drop->y_mm / mm, 0, n - 1);
    return (struct footprint){.pane = drop->pane,
                              .x = x,
                              .y = y,
                              .x0 = flow_clamp((drop->x_mm - r) / mm, 0, x),
                              .y0 = flow_clamp((drop->y_mm - r) / mm, 0, y),
                              .x1 = flow_clamp((drop->x_mm + r) / mm + 1, x + 1, n),
                              .y1 = flow_clamp((drop->y_mm + r) / mm + 1, y + 1, n)};
}

static int area_of(const struct footprint *f)
{
    return (f->x1 - f->x0) * (f->y1 - f->y0);
}

static bool overlap(const struct footprint *a, const struct footprint *b)
{
    return a->pane == b->pane && a->x0 < b->x1 && b->x0 < a->x1 && a->y0 < b->y1 && b->y0 < a->y1;
}

// Texels that one run reaches at most.
static int64_t landing_texels(const struct flow *flow)
{
    const double n = flow->finest_px;
    const double across = 2 * flow_largest_radius_mm(&flow->rain) * n / flow->settings.pane_mm;
    const double side = fmin(across + 2, n);
    return (int64_t)(side * side) + SPARE_TEXELS;
}

void flow_open_landing(struct flow *flow)
{
    struct rg_instance *i = &flow->base;
    const size_t texels = (size_t)(flow->landing_texels = landing_texels(flow));
    flow->landing = rg_add_buf(i, "landing", 2 * flow->landing_texels, NULL);
    flow->landing_words = rg_alloc(texels, 2 * sizeof(*flow->landing_words), "landing drops");
    flow->landing_mm = rg_alloc(texels, sizeof(*flow->landing_mm), "landing drops");
    i->has_failed |= !flow->landing_words || !flow->landing_mm;
    flow->landed = rg_tell(i, "landed_mm3", 0);
}

// --- a drop's water by texel ---

// The mean height on a texel, from more samples where texels are wide for the drop.
static double mean_height_mm(const struct flow *flow, const struct flow_drop *drop, int x, int y)
{
    const double mm = flow_texel_mm(&flow->settings);
    const int samples = flow_clamp(ceil(4 * mm / drop->radius_mm), 1, 8);
    double sum = 0;
    for (int row = 0; row < samples; row++)
        for (int column = 0; column < samples; column++) {
            const double dx = (x + (column + 0.5) / samples) * mm - drop->x_mm;
            const double dy = (y + (row + 0.5) / samples) * mm - drop->y_mm;
            sum += flow_cap_height_mm(&flow->rain, drop->radius_mm, dx * dx + dy * dy);
        }
    return sum / (samples * samples);
}

// Writes the heights on a footprint's texels to flow->landing_mm, and returns their sum. All
// samples may miss a small drop, which is then on its middle's texel.
static double put_heights(struct flow *flow, const struct flow_drop *drop,
                          const struct footprint *f)
{
    double sum_mm = 0, *mm = flow->landing_mm;
    for (int y = f->y0; y < f->y1; y++)
        for (int x = f->x0; x < f->x1; x++)
            sum_mm += *mm++ = mean_height_mm(flow, drop, x, y);
    if (sum_mm == 0)
        sum_mm = flow->landing_mm[(f->y - f->y0) * (f->x1 - f->x0) + f->x - f->x0] = 1;
    return sum_mm;
}

// The drop's volume in whole droplets; what is cut off goes to the pane's next drop.
static double droplets_of(struct flow *flow, const struct flow_drop *drop)
{
    const double mm = flow_texel_mm(&flow->settings);
    const double droplet_mm3 = mm * mm * flow->settings.relief / (double)FLOW_DROPLETS_PER_UNIT;
    double *owed_mm3 = &flow->owed_mm3[drop->pane];
    *owed_mm3 += drop->volume_mm3;
    const double whole = floor(*owed_mm3 / droplet_mm3);
    *owed_mm3 -= whole * droplet_mm3;
    return whole;
}

// Writes each texel and its droplets. Sums are rounded, not parts, so that all get the whole.
static void put_texels(struct landing *l, const struct flow_drop *drop, const struct footprint *f)
{
    struct flow *flow = l->flow;
    const int width = f->x1 - f->x0, count = area_of(f);
    const double droplets = droplets_of(flow, drop), all_mm = put_heights(flow, drop, f);
    double sum_mm = 0, before = 0;
    for (int k = 0; k < count; k++) {
        sum_mm += flow->landing_mm[k];
        const double until = k == count - 1 ? droplets : floor(droplets * sum_mm / all_mm);
        uint32_t *words = flow->landing_words + 2 * (ptrdiff_t)l->texels++;
        words[0] = (uint32_t)flow_pane_index(flow->settings.resolution_px, f->pane,
                                             f->x0 + k % width, f->y0 + k / width);
        words[1] = (uint32_t)(until - before);
        before = until;
    }
}

// --- runs ---

static bool land(struct landing *l)
{
    struct flow *flow = l->flow;
    const int count = l->texels;
    if (count == 0)
        return true;
    flow->base.counters[FLOW_DROPS].value += l->drop_count;
    l->texels = l->drop_count = 0;
    return rg_buf_write(flow->landing->buf, 0, flow->landing_words,
                        2 * (int64_t)count * (int64_t)sizeof(*flow->landing_words)) &&
           rg_stage_over(&flow->base, FLOW_LAND, (struct rg_extent){0, 0, 0},
                         (struct rg_extent){count, 1, 1});
}

static bool add(struct landing *l, const struct flow_drop *drop)
{
    const struct footprint f = footprint_of(l->flow, drop);
    bool fits = l->drop_count < MOST_DROPS && l->texels + area_of(&f) <= l->flow->landing_texels;
    for (int i = 0; fits && i < l->drop_count; i++)
        fits = !overlap(&f, &l->drops[i]);
    if (!fits && !land(l))
        return false;
    l->drops[l->drop_count++] = f;
    put_texels(l, drop, &f);
    l->flow->landed->number += drop->volume_mm3;
    return true;
}

bool flow_land_initial(struct flow *flow)
{
    struct landing l = {.flow = flow};
    bool ok = true;
    for (int pane = 0; pane < flow->pane_count; pane++)
        for (int i = 0; ok && i < flow->settings.drops; i++) {
            const struct flow_drop drop = flow_initial_drop(&flow->rain, pane, i);
            ok = add(&l, &drop);
        }
    return ok && land(&l);
}

bool flow_land_rain(struct flow *flow)
{
    struct landing l = {.flow = flow};
    const int64_t first = flow_fallen_before(&flow->rain, flow->base.frame);
    const int64_t end = first + flow_drops_at(&flow->rain, flow->base.frame);
    bool ok = true;
    for (int pane = 0; pane < flow->pane_count; pane++)
        for (int64_t number = first; ok && number < end; number++) {
            const struct flow_drop drop = flow_falling_drop(&flow->rain, pane, number);
            ok = add(&l, &drop);
        }
    return ok && land(&l);
}
