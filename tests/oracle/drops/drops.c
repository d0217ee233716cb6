#include "tests/oracle/drops/drops.h"

#include <math.h>
#include <stdlib.h>

#include "tests/oracle/drops/map.h"
#include "tests/oracle/drops/merge.h"
#include "tests/oracle/drops/particles.h"

enum { AFFINITY_STREAM, RAIN_STREAM };

struct oracle_drops_settings oracle_drops_defaults(void)
{
    return (struct oracle_drops_settings){
        .columns = 1000,
        .rows = 600,
        .cell_mm = 0.5,
        .max_drops = 700,
        .drops_a_step = 0.2,
        .critical_mass_mg = 20,
        .max_mass_mg = 100,
        .tilt_deg = 90,
        .step_s = 1.0 / 60,
        .substeps = 4,
        .meander_rad = 0.3,
        .residual_beta = 3,
        .residual_tau_max_s = 0.1,
        .residual_share_low = 0.1,
        .residual_share_high = 0.3,
        .erode_threshold_mm = 0.01,
        .id_threshold_mm = 0.5,
        .erode = true,
        .smooth = true,
        .residual = true,
        .merge = true,
        .trail = true,
        .seed = 1,
    };
}

void oracle_drops_open(struct oracle_drops *o, const struct oracle_drops_settings *settings)
{
    *o = (struct oracle_drops){.settings = *settings, .next_id = 1};
    const size_t cells = (size_t)settings->columns * (size_t)settings->rows;
    o->height_mm = calloc(cells, sizeof(*o->height_mm));
    o->id = calloc(cells, sizeof(*o->id));
    o->affinity = calloc(cells, sizeof(*o->affinity));
    o->stack = calloc(cells, sizeof(*o->stack));
    for (int i = 0; i < 3; i++)
        o->sums[i] = calloc((size_t)settings->columns, sizeof(*o->sums[i]));
    struct oracle_random random = oracle_random_open(settings->seed, AFFINITY_STREAM);
    for (size_t i = 0; i < cells; i++)
        o->affinity[i] = fmin(fmax(oracle_random_normal(&random, 0.5, 1.5), 0), 1);
    o->random = oracle_random_open(settings->seed, RAIN_STREAM);
    oracle_drops_find_wet(o);
}

void oracle_drops_close(struct oracle_drops *o)
{
    free(o->height_mm);
    free(o->id);
    free(o->affinity);
    free(o->stack);
    for (int i = 0; i < 3; i++)
        free(o->sums[i]);
    free(o->drops);
    free(o->place);
    *o = (struct oracle_drops){0};
}

// The paper's figure 1.
void oracle_drops_step(struct oracle_drops *o)
{
    oracle_drops_generate(o);
    oracle_drops_move(o);
    if (o->settings.merge)
        oracle_drops_merge(o);
    oracle_drops_clear_away(o);
    oracle_drops_place_static(o);
    if (o->settings.smooth)
        oracle_drops_smooth(o);
    if (o->settings.erode)
        oracle_drops_erode(o);
}

uint32_t oracle_drops_add(struct oracle_drops *o, double x_mm, double y_mm, double mass_mg)
{
    o->ledger.generated_mg += mass_mg;
    o->ledger.generated_drops++;
    return oracle_drops_insert(
        o, (struct oracle_drop){.x_mm = x_mm, .y_mm = y_mm, .mass_mg = mass_mg});
}

void oracle_drops_delete(struct oracle_drops *o)
{
    for (int i = 0; i < o->count; i++) {
        o->ledger.deleted_mg += o->drops[i].mass_mg;
        oracle_drops_end(o, &o->drops[i]);
    }
    oracle_drops_clear_away(o);
}

struct oracle_drops_measures oracle_drops_measure(const struct oracle_drops *o)
{
    struct oracle_drops_measures m = {
        .drops = o->count, .drained_mg = o->ledger.drained_mg, .trail_mm = o->ledger.trail_mm};
    for (int i = 0; i < o->count; i++)
        m.mass_mg += o->drops[i].mass_mg;
    const int cells = o->settings.columns * o->settings.rows;
    for (int i = 0; i < cells; i++)
        m.wet_cells += o->height_mm[i] > 0;
    return m;
}
