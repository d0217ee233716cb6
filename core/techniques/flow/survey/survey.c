// Tells facts about flow's panes: the wet share, the place of the water, drops by size, and how
// many of those that rest have the shape that surface tension allows.
#include <math.h>
#include <stdlib.h>

#include "core/base/alloc.h"
#include "core/techniques/flow/survey/convex.h"
#include "core/techniques/flow/instance.h"

// Upper bounds of the size classes: diameters of circles of a drop's area; the last class has none.
static const double below_mm[FLOW_DROP_SIZES - 1] = {1, 2, 4, 8};
// Drops at rest that are wider must cover more than this share of their convex hulls.
#define RESTING_MM 2.0
#define CONVEX     0.95
static const char *const size_names[FLOW_DROP_SIZES] = {
    "drops_below_1_mm", "drops_1_to_2_mm", "drops_2_to_4_mm", "drops_4_to_8_mm", "drops_above_8_mm",
};

void flow_add_survey(struct flow *flow)
{
    struct rg_instance *i = &flow->base;
    flow->told.wet = rg_tell(i, "wet_percent", 0);
    flow->told.centre = rg_tell(i, "centre_percent", 0);
    for (int size = 0; size < FLOW_DROP_SIZES; size++)
        flow->told.drops[size] = rg_tell(i, size_names[size], 0);
    if (flow->settings.move == FLOW_MOVE_PAPER)
        return;
    flow->told.resting = rg_tell(i, "resting_above_2_mm", 0);
    flow->told.convex = rg_tell(i, "resting_convex_percent", 0);
}

// A pane without its margin.
struct pane {
    int size;
    double texel_mm;
    float wet;            // height from which a texel counts as wet
    float *water;         // a map with margins; counted drops are set to dry
    int *texels;          // of the drop that was taken last, by index
    double (*room)[2];    // for its convexity
    const uint32_t *pace; // of the lattice's cells; NULL: nothing slides
    int cells, texels_a_cell;
};

// Lists the connected wet texels around (x, y) and dries them.
static int take_drop(const struct pane *p, int x, int y)
{
    const int stride = p->size + 2 * FLOW_MARGIN, beside[4] = {1, -1, stride, -stride};
    int count = 0;
    p->texels[count++] = flow_index(p->size, x, y);
    p->water[p->texels[0]] = 0;
    for (int i = 0; i < count; i++) {
        for (int side = 0; side < 4; side++) {
            const int next = p->texels[i] + beside[side];
            if (p->water[next] >= p->wet) {
                p->water[next] = 0;
                p->texels[count++] = next;
            }
        }
    }
    return count;
}

static bool is_resting(const struct pane *p, int count)
{
    const int stride = p->size + 2 * FLOW_MARGIN;
    bool rests = true;
    for (int i = 0; i < count && rests; i++) {
        const int x = p->texels[i] % stride - FLOW_MARGIN, y = p->texels[i] / stride - FLOW_MARGIN;
        rests = !p->pace[flow_index(p->cells, x / p->texels_a_cell, y / p->texels_a_cell)];
    }
    return rests;
}

static double diameter_mm(int texels, double texel_mm)
{
    return 2 * texel_mm * sqrt(texels / M_PI);
}

static int size_of(int texels, double texel_mm)
{
    int size = 0;
    while (size < FLOW_DROP_SIZES - 1 && diameter_mm(texels, texel_mm) >= below_mm[size])
        size++;
    return size;
}

struct sums {
    double wet, water, down; // wet: texels; water: units of height; down: water weighted by the
                             // share of the pane above it
    int64_t drops[FLOW_DROP_SIZES];
    int64_t resting, convex; // drops wider than RESTING_MM; and those of them without dents
};

static void survey_drop(const struct pane *p, int x, int y, struct sums *sums)
{
    const int count = take_drop(p, x, y);
    sums->drops[size_of(count, p->texel_mm)]++;
    if (!p->pace || diameter_mm(count, p->texel_mm) < RESTING_MM || !is_resting(p, count))
        return;
    const int row = p->size + 2 * FLOW_MARGIN;
    sums->resting++;
    sums->convex += flow_convexity(p->texels, count, row, p->room) > CONVEX;
}

static void survey_pane(const struct pane *p, struct sums *sums)
{
    for (int y = 0; y < p->size; y++)
        for (int x = 0; x < p->size; x++) {
            const double water = (double)p->water[flow_index(p->size, x, y)];
            sums->wet += water >= (double)p->wet;
            sums->water += water;
            sums->down += water * (y + 0.5) / p->size;
        }
    for (int y = 0; y < p->size; y++)
        for (int x = 0; x < p->size; x++)
            if (p->water[flow_index(p->size, x, y)] >= p->wet)
                survey_drop(p, x, y, sums);
}

static void tell(struct flow *flow, const struct sums *sums)
{
    const double n = flow->settings.resolution_px;
    flow->told.wet->number = 100 * sums->wet / (n * n * flow->pane_count);
    flow->told.centre->number = sums->water > 0 ? 100 * sums->down / sums->water : 0;
    for (int size = 0; size < FLOW_DROP_SIZES; size++)
        flow->told.drops[size]->number = (double)sums->drops[size];
    if (!flow->told.resting)
        return;
    flow->told.resting->number = (double)sums->resting;
    flow->told.convex->number =
        sums->resting > 0 ? 100 * (double)sums->convex / (double)sums->resting : 100;
}

// Reads all panes' maps of one buffer, of so many words a pane.
static void *read_maps(const struct flow *flow, const struct rg_asset *asset, int length)
{
    const size_t words = (size_t)flow->pane_count * (size_t)length;
    uint32_t *map = rg_alloc(words, sizeof(*map), "survey");
    if (map && rg_buf_read(asset->buf, 0, map, (int64_t)(words * sizeof(*map))))
        return map;
    free(map);
    return NULL;
}

// Surveys all panes, with room for a drop's texels and for its convexity.
static bool survey_panes(struct flow *flow, float *water, uint32_t *pace)
{
    const int n = flow->settings.resolution_px, length = flow_map_length(n);
    const int cells = flow_lattice_cells(&flow->settings), cell_length = flow_map_length(cells);
    int *texels = rg_alloc((size_t)length, sizeof(*texels), "survey");
    double(*room)[2] = rg_alloc(FLOW_CONVEX_ROOM * (size_t)n, sizeof(*room), "survey");
    const bool ok = texels && room;
    struct sums sums = {0};
    for (int i = 0; ok && i < flow->pane_count; i++)
        survey_pane(&(struct pane){.size = n,
                                   .texel_mm = flow_texel_mm(&flow->settings),
                                   .wet = (float)flow->settings.wet_height,
                                   .water = water + (int64_t)i * length,
                                   .texels = texels,
                                   .room = room,
                                   .pace = pace ? pace + (int64_t)i * cell_length : NULL,
                                   .cells = cells,
                                   .texels_a_cell = (n + cells - 1) / cells},
                    &sums);
    if (ok)
        tell(flow, &sums);
    free(texels);
    free(room);
    return ok;
}

bool flow_survey(struct flow *flow)
{
    if (!flow->settings.survey)
        return true;
    const int n = flow->settings.resolution_px, cells = flow_lattice_cells(&flow->settings);
    float *water = read_maps(flow, flow->water, flow_map_length(n));
    uint32_t *pace = flow->pace ? read_maps(flow, flow->pace, flow_map_length(cells)) : NULL;
    const bool ok = water && (pace || !flow->pace) && survey_panes(flow, water, pace);
    free(water);
    free(pace);
    return ok;
}
