// Tells facts about flow's panes: the wet share, the place of the water, and drops by size.
#include <math.h>
#include <stdlib.h>

#include "core/base/alloc.h"
#include "core/techniques/flow/instance.h"

// Upper bounds of the size classes: diameters of circles of a drop's area; the last class has none.
static const double below_mm[FLOW_DROP_SIZES - 1] = {1, 2, 4, 8};
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
}

// A pane without its margin.
struct pane {
    int size;
    float *water; // a map with margins; counted drops are set to dry
    int *stack;   // texels still to visit
    float wet;    // height from which a texel counts as wet
};

// Counts the connected wet texels around (x, y) and dries them.
static int64_t take_drop(const struct pane *p, int x, int y)
{
    const int stride = p->size + 2 * FLOW_MARGIN, beside[4] = {1, -1, stride, -stride};
    int64_t count = 0;
    int height = 0;
    p->stack[height++] = flow_index(p->size, x, y);
    p->water[p->stack[0]] = 0;
    while (height > 0) {
        const int at = p->stack[--height];
        count++;
        for (int side = 0; side < 4; side++) {
            const int next = at + beside[side];
            if (p->water[next] >= p->wet) {
                p->water[next] = 0;
                p->stack[height++] = next;
            }
        }
    }
    return count;
}

static int size_of(double texels, double texel_mm)
{
    const double diameter_mm = 2 * texel_mm * sqrt(texels / M_PI);
    int size = 0;
    while (size < FLOW_DROP_SIZES - 1 && diameter_mm >= below_mm[size])
        size++;
    return size;
}

struct sums {
    double wet, water, down; // wet: texels; water: units of height; down: water weighted by the
                             // share of the pane above it
    int64_t drops[FLOW_DROP_SIZES];
};

static void survey_pane(const struct pane *p, double texel_mm, struct sums *sums)
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
                sums->drops[size_of((double)take_drop(p, x, y), texel_mm)]++;
}

static void tell(struct flow *flow, const struct sums *sums)
{
    const double n = flow->settings.resolution_px;
    flow->told.wet->number = 100 * sums->wet / (n * n * flow->pane_count);
    flow->told.centre->number = sums->water > 0 ? 100 * sums->down / sums->water : 0;
    for (int size = 0; size < FLOW_DROP_SIZES; size++)
        flow->told.drops[size]->number = (double)sums->drops[size];
}

bool flow_survey(struct flow *flow)
{
    const int n = flow->settings.resolution_px, length = flow_map_length(n);
    const double texel_mm = flow->settings.pane_mm / n;
    if (!flow->told.wet)
        return true;
    float *water = rg_alloc((size_t)flow->pane_count * (size_t)length, sizeof(*water), "survey");
    int *stack = rg_alloc((size_t)length, sizeof(*stack), "survey");
    const bool ok = water && stack &&
                    rg_buf_read(flow->water->buf, 0, water,
                                flow->pane_count * (int64_t)length * (int64_t)sizeof(*water));
    struct sums sums = {0};
    for (int pane = 0; ok && pane < flow->pane_count; pane++)
        survey_pane(&(struct pane){n, water + (int64_t)pane * length, stack,
                                   (float)flow->settings.wet_height},
                    texel_mm, &sums);
    if (ok)
        tell(flow, &sums);
    free(water);
    free(stack);
    return ok;
}
