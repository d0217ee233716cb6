// The proof of raster: its scenes, an even distribution of drops, and mutants.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "core/techniques/proof.h"
#include "core/techniques/raster/raster.h"
#include "core/techniques/technique.h"

// The drops' coordinates are 0 to 1, all x first; their mean must be 1/2 to within five standard
// errors.
static bool axis_is_even(const float *drops, int count, const char *axis, char *detail, size_t size)
{
    double sum = 0;
    for (int i = 0; i < count; i++) {
        if (!(drops[i] >= 0 && drops[i] < 1)) {
            snprintf(detail, size, "drop %d has %s %.9g of the box", i, axis, (double)drops[i]);
            return false;
        }
        sum += (double)drops[i];
    }
    const double off = sum / count - 0.5;
    if (fabs(off) < 5 * sqrt(1.0 / 12 / count))
        return true;
    snprintf(detail, size, "%d drops have a mean %s of %.6f of the box", count, axis, off + 0.5);
    return false;
}

static bool drops_lie_evenly(const struct rg_instance *instance, char *detail, size_t size)
{
    if (!instance->state_count)
        return true; // does not apply to other scenes
    const struct rg_buf *buf = instance->state[0].asset->buf;
    const int count = instance->state[0].row;
    float *drops = rg_alloc(1, buf->size, "drops");
    const bool holds = drops &&
                       rg_buf_read(instance->state[0].asset->buf, 0, drops, (int64_t)buf->size) &&
                       axis_is_even(drops, count, "x", detail, size) &&
                       axis_is_even(drops + count, count, "y", detail, size) &&
                       axis_is_even(drops + 2 * (size_t)count, count, "z", detail, size);
    free(drops);
    return holds;
}

static const struct rg_pose poses[] = {
    {.set = ""},
    {.set = "blend=add format=rgba8 wind_m_s=-6 view_angle_deg=70"},
    {.set = "scene=mesh"},
    {.set = "scene=mesh model=torus view=13 inside=1"},
    {.set = "scene=triangles triangles=100000 near=4.5"},
    {.set = "scene=quads format=rgba32f"},
    {.set = NULL},
};

static const struct rg_law laws[] = {
    {"even drops", drops_lie_evenly},
    {NULL, NULL},
};

static const struct rg_mutant mutants[] = {
    {"another seed", "seed", 1, 1},
    {"streaks 1 % wider", "streak_radius_mm", 1.01, 0},
    {"streaks 1 % longer", "streak_length_mm", 1.01, 0},
    {"1 % slower fall", "fall_m_s", 0.99, 0},
    {"1 % more wind", "wind_m_s", 1.01, 0},
    {"steps 1 % longer", "step_s", 1.01, 0},
    {"streaks 1 % fainter", "opacity", 0.99, 0},
    {"the view 0.1 % wider", "view_angle_deg", 1.001, 0},
    {NULL, NULL, 0, 0},
};

static const struct rg_contrast contrasts[] = {
    {"a streak lost", "", "share=0.99997"},
    {"blending off", "", "blend=off"},
    {"added, not laid over", "", "blend=add"},
    {"a pixel's shift", "scene=mesh", "shift_px=1"},
    {"culling turned round", "scene=mesh", "cull=front"},
    {"depth not tested", "scene=mesh cull=none", "depth=off"},
    {"depth not kept", "scene=mesh", "depth=test"},
    {"one face in a thousand lost", "scene=mesh", "share=0.999"},
    {"a sixteenth of a pixel's shift", "scene=triangles triangles=100000", "shift_px=0.0625"},
    {"near plane 1 % farther", "scene=mesh model=torus near=4", "near=4.04"},
    {"a pane lost", "scene=quads", "share=0.9995"},
    {"depth tested", "scene=quads", "depth=write"},
    {NULL, NULL, NULL},
};

const struct rg_proof raster_proof = {
    .poses = poses,
    .dry = "share=0",
    .laws = laws,
    .mutants = mutants,
    .contrasts = contrasts,
};
