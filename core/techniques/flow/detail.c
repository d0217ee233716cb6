// The level of detail: the number of texels of a pane, which follows the camera's distance. Buffers
// have the size of the finest level; coarser levels use their beginning.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "core/techniques/flow/instance.h"
#include "kernels/flow/panes/normal_map.h"

// A coarser level must suffice by this factor, so that a camera at the border does not switch
// levels each frame.
#define SPARE 1.1

static int wanted_texels(const struct flow *flow, double spare)
{
    struct flow_settings s = flow->settings;
    s.resolution_px = flow->finest_px;
    s.texels_a_pixel *= spare;
    return flow_texels(&s, flow->base.frame, flow->base.target->desc.height);
}

void flow_open_detail(struct flow *flow)
{
    flow->finest_px = flow->settings.resolution_px;
    flow->settings.resolution_px = wanted_texels(flow, 1);
    if (flow->settings.camera_mm_s == 0)
        flow->finest_px = flow->settings.resolution_px; // fixed from here on
}

struct flow_sizes flow_most_sizes(const struct flow *flow)
{
    struct flow_sizes most = {0, 0, 0};
    struct flow_settings s = flow->settings;
    const int coarsest = s.camera_mm_s == 0 ? flow->finest_px : 4 * FLOW_MARGIN;
    for (int n = flow->finest_px; n >= coarsest; n /= 2) {
        s.resolution_px = n;
        const int cells = flow_lattice_cells(&s);
        const int64_t texels = flow_map_length(n), all = flow_map_length(cells),
                      rows = (int64_t)(cells + 2) * (n + 2 * FLOW_MARGIN);
        most.texels = texels > most.texels ? texels : most.texels;
        most.cells = all > most.cells ? all : most.cells;
        most.rows = rows > most.rows ? rows : most.rows;
    }
    most.texels *= flow->pane_count;
    most.cells *= flow->pane_count;
    most.rows *= flow->pane_count;
    return most;
}

static void set_items(struct flow *flow, const char *name, int width, int height)
{
    struct rg_asset *asset = rg_asset_find(&flow->base, name);
    if (asset)
        rg_set_items(asset, width, height, flow->pane_count);
}

void flow_use_detail(struct flow *flow)
{
    const int n = flow->settings.resolution_px, cells = flow_lattice_cells(&flow->settings);
    set_items(flow, "given", n, n);
    set_items(flow, "arriving", n, FLOW_STRIPS);
    set_items(flow, "level", cells, cells);
    set_items(flow, "close_rows", n, cells);
    for (int k = 0; k < flow->base.state_count; k++)
        if (flow->base.state[k].row)
            flow->base.state[k].row = n + 2 * FLOW_MARGIN;
    if (flow->texels)
        flow->texels->number = n;
}

// --- from one level to the next ---

// Panes of n x n texels in whole droplets, without margins. A droplet has a quarter of the volume
// of the next coarser level's.
struct panes {
    int n, count;
    int64_t *droplets;
};

static int64_t at(const struct panes *p, int pane, int x, int y)
{
    x = x < 0 ? 0 : x < p->n ? x : p->n - 1;
    y = y < 0 ? 0 : y < p->n ? y : p->n - 1;
    return p->droplets[((int64_t)pane * p->n + y) * p->n + x];
}

static int64_t magnitude(int64_t a)
{
    return a < 0 ? -a : a;
}

// A quarter of the smaller of two slopes, 0 at an extremum, so that no texel overshoots or falls
// below 0.
static int64_t limited(int64_t before, int64_t here, int64_t after)
{
    const int64_t a = here - before, b = after - here;
    if ((a > 0) != (b > 0))
        return 0;
    return (magnitude(a) < magnitude(b) ? a : b) / 4;
}

// Splits each texel into four, which slope as its neighbours do and hold four times as many
// droplets.
static void refine(const struct panes *from, struct panes *to)
{
    for (int i = 0; i < from->count * from->n * from->n; i++) {
        const int x = i % from->n, y = i / from->n % from->n, pane = i / (from->n * from->n);
        const int64_t here = at(from, pane, x, y);
        const int64_t across = limited(at(from, pane, x - 1, y), here, at(from, pane, x + 1, y));
        const int64_t down = limited(at(from, pane, x, y - 1), here, at(from, pane, x, y + 1));
        for (int k = 0; k < 4; k++)
            to->droplets[((int64_t)pane * to->n + 2 * y + k / 2) * to->n + 2 * x + k % 2] =
                here + (k % 2 ? across : -across) + (k / 2 ? down : -down);
    }
}

// Merges four texels into one. Remainders of the division carry over to the next texel, so that a
// pane loses less than a droplet.
static void coarsen(const struct panes *from, struct panes *to)
{
    for (int pane = 0; pane < to->count; pane++) {
        int64_t left = 0;
        for (int i = 0; i < to->n * to->n; i++) {
            const int x = i % to->n, y = i / to->n;
            int64_t sum = left;
            for (int k = 0; k < 4; k++)
                sum += at(from, pane, 2 * x + k % 2, 2 * y + k / 2);
            to->droplets[((int64_t)pane * to->n + y) * to->n + x] = sum / 4;
            left = sum % 4;
        }
    }
}

static bool change_level(struct panes *panes, int n)
{
    const size_t texels = (size_t)panes->count * (size_t)n * (size_t)n;
    struct panes to = {n, panes->count, rg_alloc(texels, sizeof(*to.droplets), "flow's water")};
    if (!to.droplets)
        return false;
    if (n > panes->n)
        refine(panes, &to);
    else
        coarsen(panes, &to);
    free(panes->droplets);
    *panes = to;
    return true;
}

// --- the device's maps ---

static bool read_panes(const struct flow *flow, struct panes *panes)
{
    const int n = flow->settings.resolution_px;
    const int64_t length = (int64_t)flow->pane_count * flow_map_length(n);
    float *maps = rg_alloc((size_t)length, sizeof(*maps), "flow's water");
    *panes = (struct panes){n, flow->pane_count,
                            maps ? rg_alloc((size_t)flow->pane_count * (size_t)n * (size_t)n,
                                            sizeof(*panes->droplets), "flow's water")
                                 : NULL};
    const bool ok = panes->droplets && rg_buf_read(flow->water->buf, 0, maps, length * 4);
    for (int i = 0; ok && i < panes->count * n * n; i++)
        panes->droplets[i] = llrintf(maps[flow_pane_index(n, i / (n * n), i % n, i / n % n)] *
                                     FLOW_DROPLETS_PER_UNIT);
    free(maps);
    return ok;
}

// Resets all maps to dry.
static bool clear_maps(struct flow *flow)
{
    static const char *const names[] = {
        "water", "moved", "given", "arriving",   "blurred",    "kept", "heading", "level",  "close",
        "wide",  "pace",  "ridge", "close_rows", "ridge_rows", "pull", "paced",   "normals"};
    const struct flow_sizes most = flow_most_sizes(flow);
    const int64_t longest = most.texels > most.cells ? most.texels : most.cells;
    const size_t words = (size_t)(longest > most.rows ? longest : most.rows);
    uint32_t *zeroes = rg_alloc(words, sizeof(*zeroes), "flow's water");
    bool ok = zeroes != NULL;
    for (size_t k = 0; ok && k < sizeof(names) / sizeof(names[0]); k++) {
        const struct rg_asset *asset = rg_asset_find(&flow->base, names[k]);
        for (size_t i = 0; !strcmp(names[k], "normals") && i < words; i++)
            zeroes[i] = wet_normal_pack(0, 0, 0);
        ok = !asset || rg_buf_write(asset->buf, 0, zeroes, asset->buf->size);
    }
    free(zeroes);
    return ok;
}

// Writes the map of beads twice, side by side, so that a pane with shifted beads can read beyond
// its right edge.
bool flow_write_beads(struct flow *flow)
{
    const struct rg_asset *beads = rg_asset_find(&flow->base, "beads");
    const size_t n = (size_t)flow->settings.resolution_px;
    if (!beads)
        return true;
    float *map = flow_bead_map(&flow->settings);
    float *twice = map ? rg_alloc(2 * n * n, sizeof(*twice), "bead map") : NULL;
    for (size_t row = 0; twice && row < 2 * n; row++)
        memcpy(twice + row * n, map + row / 2 * n, n * sizeof(*map));
    const bool ok = twice && rg_buf_write(beads->buf, 0, twice, (int64_t)(2 * n * n * 4));
    free(map);
    free(twice);
    return ok;
}

static bool write_panes(struct flow *flow, const struct panes *panes)
{
    const int n = panes->n;
    const int64_t length = (int64_t)panes->count * flow_map_length(n);
    float *maps = rg_alloc((size_t)length, sizeof(*maps), "flow's water");
    uint32_t ledger[FLOW_LEDGER_WORDS] = {0}; // restarts the counts, in droplets of this level
    for (int i = 0; maps && i < panes->count * n * n; i++) {
        maps[flow_pane_index(n, i / (n * n), i % n, i / n % n)] =
            (float)panes->droplets[i] / FLOW_DROPLETS_PER_UNIT;
        ledger[FLOW_LEDGER_SOURCED] += (uint32_t)panes->droplets[i];
    }
    const bool ok =
        maps && rg_buf_write(flow->water->buf, 0, maps, length * 4) &&
        rg_buf_write(rg_asset_find(&flow->base, "ledger")->buf, 0, ledger, sizeof(ledger));
    free(maps);
    return ok;
}

bool flow_change_detail(struct flow *flow, int texels)
{
    struct panes panes;
    bool ok = read_panes(flow, &panes);
    while (ok && panes.n != texels)
        ok = change_level(&panes, texels > panes.n ? 2 * panes.n : panes.n / 2);
    flow->settings.resolution_px = texels;
    flow_use_detail(flow);
    ok = ok && clear_maps(flow) && flow_write_beads(flow) && write_panes(flow, &panes);
    free(panes.droplets);
    return ok;
}

bool flow_follow_camera(struct flow *flow)
{
    const int now = flow->settings.resolution_px;
    if (flow->settings.camera_mm_s == 0 || flow->settings.texels_a_pixel <= 0)
        return true;
    const int due = wanted_texels(flow, 1), spare = wanted_texels(flow, SPARE);
    const int texels = due > now ? due : spare < now ? spare : now;
    return texels == now || flow_change_detail(flow, texels);
}
