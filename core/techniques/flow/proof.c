// The proof of flow: panes, conservation in whole droplets, and mutants.
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "core/techniques/flow/instance.h"
#include "core/techniques/proof.h"
#include "core/techniques/technique.h"

// The data that laws check.
struct reading {
    int64_t length; // of all panes' maps, in texels
    int row;        // texels in a row, including margins
    float *water;
    uint32_t ledger[FLOW_LEDGER_WORDS];
};

static bool read_state(const struct rg_instance *instance, struct reading *r)
{
    const struct rg_state *water = &instance->state[FLOW_STATE_WATER];
    r->row = water->row;
    r->length = (int64_t)(water->asset->buf->size / sizeof(*r->water));
    r->water = rg_alloc(1, water->asset->buf->size, water->name);
    return r->water &&
           rg_buf_read(water->asset->buf, 0, r->water, (int64_t)water->asset->buf->size) &&
           rg_buf_read(instance->state[FLOW_STATE_LEDGER].asset->buf, 0, r->ledger,
                       sizeof(r->ledger));
}

// Every texel holds a whole number of droplets, and none in margins.
static bool droplets_are_whole(const struct reading *r, char *detail, size_t size)
{
    for (int64_t i = 0; i < r->length; i++) {
        const int at = (int)(i % ((int64_t)r->row * r->row)); // its place in its pane
        const int x = at % r->row - FLOW_MARGIN, y = at / r->row - FLOW_MARGIN;
        const float droplets = r->water[i] * FLOW_DROPLETS_PER_UNIT;
        const bool whole =
            droplets >= 0 && droplets < 16777216.0f && (float)(int32_t)droplets == droplets;
        if (whole && (droplets == 0 || flow_on_pane(r->row - 2 * FLOW_MARGIN, x, y)))
            continue;
        snprintf(detail, size, "water (%d, %d) holds %.9g droplets", x, y, (double)droplets);
        return false;
    }
    return true;
}

// The water on a pane equals the water that came less the water that left.
static bool ledger_balances(const struct reading *r, char *detail, size_t size)
{
    uint32_t sum = 0;
    for (int64_t i = 0; i < r->length; i++)
        sum += (uint32_t)(r->water[i] * FLOW_DROPLETS_PER_UNIT);
    const uint32_t due = r->ledger[FLOW_LEDGER_SOURCED] - r->ledger[FLOW_LEDGER_DRAINED];
    if (sum == due)
        return true;
    snprintf(detail, size, "the pane holds %u droplets, but %u came and %u left (modulo 2^32)", sum,
             r->ledger[FLOW_LEDGER_SOURCED], r->ledger[FLOW_LEDGER_DRAINED]);
    return false;
}

static bool water_is_conserved(const struct rg_instance *instance, char *detail, size_t size)
{
    struct reading reading;
    const bool holds = read_state(instance, &reading) &&
                       droplets_are_whole(&reading, detail, size) &&
                       ledger_balances(&reading, detail, size);
    free(reading.water);
    return holds;
}

// The box has six panes, so they are small; a single pane has the user's size. Sliding drops take
// more passes, so only two poses have them, the last in the user's size.
static const struct rg_pose poses[] = {
    {.set = "resolution_px=96 move=paper"},
    {.set = "resolution_px=96 pane_pitch_deg=40 pane_roll_deg=30 direction=split run_on=on "
            "reach_texels=4 move=paper"},
    {.set = "resolution_px=96 pane_pitch_deg=40 pane_roll_deg=30 direction=texel run_on=on "
            "move=paper"},
    {.set = "resolution_px=96 pane_pitch_deg=40 pane_roll_deg=30 run_on=on "
            "pane_rain_mm_h=300 glow=0.5 glow_threshold=0.3"},
    {.set = "resolution_px=96 panes=mirror pane_pitch_deg=-20 pane_roll_deg=180 spin_yaw_deg_s=90 "
            "move=paper glow=0.5 glow_threshold=0.3"},
    {.set = "resolution_px=96 texels_a_pixel=0.6 distance_mm=250 camera_mm_s=2000"},
    {.set = "view=pane panes=mirror move=paper"},
    {.set = NULL},
};

static const struct rg_law laws[] = {
    {"conservation", water_is_conserved},
    {NULL, NULL},
};

static const struct rg_mutant mutants[] = {
    {"one drop fewer", "drops", 1, -1},
    {"another seed", "seed", 1, 1},
    {"1 % less rain", "rain_drops_s", 0.99, 0},
    {"L 1 % higher", "move_threshold", 1.01, 0},
    {"M 1 % higher", "fast_threshold", 1.01, 0},
    {"r 1 % smaller", "far_share", 0.99, 0},
    {"1 % more stays", "remainder_low", 1.01, 0},
    {"noise scrolls 1 % faster", "noise_scroll_x", 1.01, 0},
    {"pane pitched by 1 degree", "pane_pitch_deg", 1, 1},
    {"pane rolled by 1 degree", "pane_roll_deg", 1, 1},
    {"environment shifted by 1 degree", "pane_yaw_deg", 1, 1},
    {"refraction 1 % weaker", "refraction_strength", 0.99, 0},
    {"Fresnel bias twice as high", "fresnel_bias", 2, 0},
    {"relief 1 % higher", "relief", 1.01, 0},
    {"camera turned by 0.2 degrees", "camera_azimuth_deg", 1, 0.2},
    {"model 1 % larger", "model_size", 1.01, 0},
    {"lamp 5 % brighter", "light", 1.05, 0},
    {"model 2 % darker", "model_grey", 0.98, 0},
    {"camera 0.5 % farther away", "distance_mm", 1.005, 0},
    {"view 0.5 % wider", "view_angle_deg", 1.005, 0},
    {"bars 10 % wider", "frame_mm", 1.1, 0},
    {"drops 1 % higher", "drop_height_per_mm", 1.01, 0},
    {"wet from 10 % more water on", "wet_height", 1.1, 0},
    {NULL, NULL, 0, 0},
};

#define SLIDING "move=sliding view=pane panes=mirror resolution_px=128 environment_px=64 "

static const struct rg_contrast contrasts[] = {
    {"1 % less rain on sliding panes", SLIDING, "pane_rain_mm_h=30.69"},
    {"water that levels 1 % slower", SLIDING, "levelling_mm_s=89.1"},
    {"a contact angle 1 % larger", SLIDING, "contact_deg=60.6"},
    {"drops that slide from 1 % more water on", SLIDING, "slide_above_mm3=5.05"},
    {"drops that slide 1 % faster", SLIDING, "slide_most_mm_s=70.7"},
    {"1 % more cohesion", SLIDING, "cohesion=1.515"},
    {NULL, NULL, NULL},
};

const struct rg_proof flow_proof = {
    .poses = poses,
    .dry = "drops=0 rain_drops_s=0 pane_rain_mm_h=0",
    .mutant_scene = "move=paper resolution_px=160 environment_px=256",
    .laws = laws,
    .mutants = mutants,
    .contrasts = contrasts,
};
