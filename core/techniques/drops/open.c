// Opens drops on a device: maps, drops, stages.
#include <math.h>
#include <stdlib.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "core/techniques/drops/instance.h"
#include "kernels/drops/sets/hot.h"

#define AT(field) offsetof(struct drops, field)
#define PARAMS    .params = AT(params)
#define AT_REST   .named = {{"height", "still"}, {"ids", "still_ids"}}

static int view_of(const struct rg_instance *instance)
{
    return ((const struct drops *)instance)->settings.view;
}

static bool shows_pane(const struct rg_instance *i)
{
    return view_of(i) == DROPS_VIEW_PANE;
}

static bool shows_maps(const struct rg_instance *i)
{
    return !shows_pane(i);
}

static bool shows_discs(const struct rg_instance *i)
{
    return view_of(i) == DROPS_VIEW_PARTICLES;
}

static bool has_beads(const struct rg_instance *i)
{
    return ((const struct drops *)i)->settings.trail == DROPS_TRAIL_BEADS;
}

static bool has_no_beads(const struct rg_instance *i)
{
    return !has_beads(i);
}

static const struct rg_stage stages[DROPS_STAGES] = {
    [DROPS_RUN_AFFINITY] = {"drops_affinity", PARAMS},
    [DROPS_RUN_BEADS] = {"drops_beads", has_beads, PARAMS},
    [DROPS_RUN_RUN] = {"drops_run", PARAMS},
    [DROPS_RUN_TRAIL] = {"drops_trail", PARAMS},
    [DROPS_RUN_CLAIM] = {"drops_claim", PARAMS},
    [DROPS_RUN_MEET] = {"drops_meet", PARAMS},
    [DROPS_RUN_PART] = {"drops_part", PARAMS},
    [DROPS_RUN_LABEL] = {"drops_label", PARAMS},
    [DROPS_RUN_LINK] = {"drops_link", PARAMS},
    [DROPS_RUN_SIDE] = {"drops_side", PARAMS},
    [DROPS_RUN_LEAD] = {"drops_lead", PARAMS},
    [DROPS_RUN_GATHER] = {"drops_gather", PARAMS},
    [DROPS_RUN_LOWEST] = {"drops_lowest", PARAMS},
    [DROPS_RUN_MERGE] = {"drops_merge", PARAMS},
    [DROPS_RUN_SETTLE] = {"drops_settle", PARAMS},
    [DROPS_RUN_PACK] = {"drops_pack", PARAMS},
    [DROPS_RUN_RECOLOUR] = {"drops_recolour", PARAMS},
    [DROPS_RUN_DISBAND] = {"drops_disband", PARAMS},
    [DROPS_RUN_COUNT] = {"drops_count", PARAMS},
    [DROPS_RUN_CLEAR] = {"drops_clear", PARAMS},
    [DROPS_RUN_PLACE] = {"drops_place", PARAMS, AT_REST},
    [DROPS_RUN_OWN] = {"drops_own", PARAMS, AT_REST},
    [DROPS_RUN_FLATTEN] = {"drops_flatten", has_no_beads, PARAMS},
    [DROPS_RUN_FLATTEN_BEADS] = {"drops_flatten_beads", has_beads, PARAMS},
    [DROPS_RUN_DOZE] = {"drops_doze", PARAMS, .over = "tiles"},
    [DROPS_RUN_PANE] = {"drops_pane", shows_pane, .params = AT(pane), .colour = "target"},
    [DROPS_RUN_SHOW] = {"drops_show", shows_maps, .params = AT(show), .colour = "target"},
    [DROPS_RUN_DISCS] = {"drops_discs", shows_discs, .params = AT(show), .colour = "target",
                         .blend = RG_BLEND_OVER},
};

static const char *const counter_names[DROPS_COUNTERS] = {"drops_stepped", "cells_stepped",
                                                          "merging_steps"};

static int parts(int whole, int part)
{
    return (whole + part - 1) / part;
}

// Replaces a sine or cosine that rounding left near 0 by 0.
static float exact(double value)
{
    return (float)(fabs(value) < 1e-9 ? 0 : value);
}

// The width of a cell by which the rules go: the paper's or the pane's own.
static double ruling_cell_mm(const struct drops_settings *s)
{
    return s->rules == DROPS_PHYSICAL ? DROPS_PAPER_CELL_MM : s->cell_mm;
}

// Whether water flattens once a step; if not, tiles never sleep.
static bool has_one_pass(const struct drops_settings *s)
{
    return s->rules == DROPS_PAPER || fabs(s->step_s / DROPS_PAPER_STEP_S - 1) < 1e-6;
}

drops_params drops_params_of(const struct drops_settings *s)
{
    const double gravity_mm_s2 = 9800, turn = s->turn_deg * M_PI / 180;
    const double along = sin(s->tilt_deg * M_PI / 180); // share of gravity along the pane
    const int tile_columns = parts(s->columns, DROPS_TILE_COLUMNS);
    const int stride = tile_columns * DROPS_TILE_COLUMNS + 2 * DROPS_MARGIN;
    const double l = s->cell_mm, ruling = ruling_cell_mm(s);
    drops_params p = {
        .columns = s->columns,
        .rows = s->rows,
        .stride = stride,
        .tile_columns = tile_columns,
        .tile_rows = parts(s->rows, DROPS_TILE_ROWS),
        .cell_mm = (float)l,
        .seed = (uint32_t)s->seed,
        .step_s = (float)s->step_s,
        .substep_s = (float)(s->step_s / s->substeps),
        .substeps = s->substeps,
        .most = s->max_drops,
        .least_mg = (float)(2 * ruling * ruling * ruling),
        .most_mg = (float)s->max_mass_mg,
        .down_x = exact(-sin(turn)),
        .down_y = exact(cos(turn)),
        .gravity_mm_s2 = (float)(gravity_mm_s2 * along),
        .held_mg_mm_s2 = (float)(s->critical_mass_mg * gravity_mm_s2),
        .critical = along > 1e-6
                        ? (uint32_t)fmin(s->critical_mass_mg / along * DROPS_QUANTA_MG, 4e9)
                        : UINT32_MAX,
        .meander_rad = (float)s->meander_rad,
        .residual = s->residual,
        .residual_beta = (float)s->residual_beta,
        .residual_max_s = (float)s->residual_max_s,
        .residual_low = (float)s->residual_low,
        .residual_high = (float)s->residual_high,
        .ahead_mm = (float)(3 * ruling),
        .beside_mm = (float)(2 * ruling),
        .patch_mm = (float)ruling,
        .reach_cells = (int)lround((3 * ruling / l - 1) / 2),
        .lines = s->trail == DROPS_LINES,
        .spacing_mm = (float)(1.5 * l),
        .apart = (int)lround(ruling / l),
        .does_sleep = s->sleep && has_one_pass(s),
    };
    const bool is_upright = fabs(cos(turn)) >= fabs(sin(turn)) - 1e-9;
    const int sign = (is_upright ? cos(turn) : -sin(turn)) < 0 ? -1 : 1;
    p.is_upright = is_upright;
    p.down_cell = sign * (is_upright ? stride : 1) * p.apart;
    p.right_cell = (is_upright ? sign : -sign * stride) * p.apart;
    return p;
}

// The cells of a map: whole tiles and margins.
static int64_t cells_of(const struct drops *d)
{
    return (int64_t)d->params.stride * (d->params.tile_rows * DROPS_TILE_ROWS + 2 * DROPS_MARGIN);
}

static void add_maps(struct drops *d)
{
    struct rg_instance *i = &d->base;
    const int64_t cells = cells_of(d);
    uint32_t *nobody = rg_alloc((size_t)cells, sizeof(*nobody), "map of drops");
    i->has_failed |= !nobody;
    for (int64_t cell = 0; nobody && cell < cells; cell++)
        nobody[cell] = DROPS_NOBODY;
    d->height = rg_add_buf(i, "height", cells, NULL);
    d->ids = rg_add_buf(i, "ids", cells, NULL);
    d->next_height = rg_add_buf(i, "next_height", cells, NULL);
    d->next_ids = rg_add_buf(i, "next_ids", cells, NULL);
    rg_add_buf(i, "still", cells, NULL);
    rg_add_buf(i, "still_ids", cells, NULL);
    rg_add_buf(i, "affinity", cells, NULL);
    if (has_beads(i))
        rg_add_buf(i, "held", cells, NULL);
    rg_add_buf(i, "labels", cells, NULL);
    rg_add_buf(i, "leaders", cells, nobody);
    rg_add_state(i, d->height, "height", d->params.stride, DROPS_MARGIN);
    rg_add_state(i, d->ids, "ids", d->params.stride, DROPS_MARGIN);
    free(nobody);
}

// Each drop has one slot for a child, and one for the drop that a merge makes of it.
static void add_drops(struct drops *d)
{
    struct rg_instance *i = &d->base;
    const int64_t most = d->settings.max_drops, slots = 3 * most;
    const int words = sizeof(drops_drop) / 4;
    const uint32_t tally[DROPS_TALLY] = {[DROPS_NEXT_ID] = 1};
    d->drops = rg_add_buf(i, "drops", slots * words, NULL);
    d->packed = rg_add_buf(i, "packed", slots * words, NULL);
    d->flags = rg_add_buf(i, "flags", slots, NULL);
    d->before = rg_add_buf(i, "before", slots + 1, NULL);
    rg_add_buf(i, "joins", most, NULL);
    rg_add_buf(i, "sums", most * DROPS_SUM, NULL);
    rg_add_buf(i, "ways", most * 2 * (d->settings.substeps + 1), NULL);
    rg_add_buf(i, "heat", (int64_t)d->params.tile_columns * d->params.tile_rows * DROPS_TILE_ROWS,
               NULL);
    rg_add_buf(i, "hot", DROPS_HOT_WORDS, NULL);
    d->tally = rg_add_buf(i, "tally", DROPS_TALLY, tally);
    rg_add_state(i, d->drops, "drops", words, 0);
    rg_add_state(i, d->tally, "tally", 0, 0);
}

// Whether settings go together; if not, one logged line says which do not.
static bool are_sound(const struct drops_settings *s)
{
    const double ruling = ruling_cell_mm(s), least_mg = 2 * ruling * ruling * ruling;
    const double ratio = DROPS_PAPER_CELL_MM / s->cell_mm;
    if (s->max_drops > s->columns * s->rows)
        return rg_error("max_drops: %d drops are more than the pane's %d x %d cells; lower it",
                        s->max_drops, s->columns, s->rows);
    if (s->max_mass_mg < least_mg)
        return rg_error(
            "max_mass_mg: %g mg is below the least mass on cells of %g mm, 2 l^3 = %g mg; "
            "raise it, or lower cell_mm",
            s->max_mass_mg, ruling, least_mg);
    if (s->residual_low > s->residual_high)
        return rg_error("residual_low: a share of %g is above residual_high=%g", s->residual_low,
                        s->residual_high);
    if (s->rules == DROPS_PHYSICAL && fabs(ratio - round(ratio)) > 1e-6 * ratio)
        return rg_error("cell_mm: %g mm is no whole part of %g mm, which rules=physical needs; "
                        "take 0.5, 0.25, 0.125 or 0.1",
                        s->cell_mm, DROPS_PAPER_CELL_MM);
    return true;
}

bool drops_open(struct rg_instance *instance)
{
    struct drops *d = (struct drops *)instance;
    const struct drops_settings *s = &d->settings;
    if (!are_sound(s))
        return false;
    d->params = drops_params_of(s);
    const int tiles = d->params.tile_columns * d->params.tile_rows;
    rg_add_counters(instance, counter_names, DROPS_COUNTERS);
    add_maps(d);
    add_drops(d);
    d->tiles = rg_add_buf(instance, "tiles", tiles, NULL);
    if (shows_pane(instance))
        drops_add_outside(d);
    if (rg_open_stages(instance, stages, DROPS_STAGES, d, NULL) < 0)
        return false;
    d->scan = rg_scan_create(instance->device, 3 * s->max_drops);
    const struct rg_extent first = {0, 0, 0}, all = {s->columns, s->rows, 1};
    return d->scan && rg_stage_over(instance, DROPS_RUN_AFFINITY, first, all) &&
           rg_stage_over(instance, DROPS_RUN_BEADS, first, all);
}

void drops_close(struct rg_instance *instance)
{
    rg_scan_destroy(((struct drops *)instance)->scan);
}
