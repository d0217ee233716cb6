#include "tests/oracle/drops/particles.h"

#include <math.h>
#include <stdlib.h>

#include "tests/oracle/drops/map.h"

static const double AHEAD_CELLS = 3, ASIDE_CELLS = 2, TRAIL_CELLS = 1.5;

// --- the list of drops ---

static double pull(const struct oracle_drops *o)
{
    return sin(o->settings.tilt_deg * M_PI / 180);
}

bool oracle_drops_runs(const struct oracle_drops *o, double mass_mg)
{
    return mass_mg * pull(o) > o->settings.critical_mass_mg;
}

uint32_t oracle_drops_insert(struct oracle_drops *o, struct oracle_drop drop)
{
    if (o->count == o->room) {
        o->room = 2 * o->room + 64;
        o->drops = realloc(o->drops, (size_t)o->room * sizeof(*o->drops));
    }
    if (o->next_id >= o->id_room) {
        o->id_room = 2 * o->id_room + 64;
        o->place = realloc(o->place, o->id_room * sizeof(*o->place));
    }
    drop.id = o->next_id++;
    drop.is_static = !oracle_drops_runs(o, drop.mass_mg);
    o->place[drop.id] = o->count;
    o->drops[o->count++] = drop;
    return drop.id;
}

void oracle_drops_end(struct oracle_drops *o, struct oracle_drop *drop)
{
    drop->gone = true;
    o->place[drop->id] = -1;
}

struct oracle_drop *oracle_drops_find(const struct oracle_drops *o, uint32_t id)
{
    return o->place[id] < 0 ? NULL : &o->drops[o->place[id]];
}

void oracle_drops_clear_away(struct oracle_drops *o)
{
    int kept = 0;
    for (int i = 0; i < o->count; i++) {
        if (o->drops[i].gone)
            continue;
        o->place[o->drops[i].id] = kept;
        o->drops[kept++] = o->drops[i];
    }
    o->count = kept;
}

void oracle_drops_place_static(struct oracle_drops *o)
{
    for (int i = 0; i < o->count; i++) {
        const struct oracle_drop *drop = &o->drops[i];
        if (drop->is_static)
            oracle_drops_place(o, drop->id, drop->x_mm, drop->y_mm, drop->mass_mg);
    }
}

// --- birth ---

static double generated_mass(struct oracle_drops *o)
{
    const struct oracle_drops_settings *s = &o->settings;
    const double least = 2 * s->cell_mm * s->cell_mm * s->cell_mm * ORACLE_DROPS_DENSITY_MG_MM3;
    const double mean = least + (s->max_mass_mg - least) / 5;
    return fmin(fmax(oracle_random_normal(&o->random, mean, 1.5), least), s->max_mass_mg);
}

void oracle_drops_generate(struct oracle_drops *o)
{
    const struct oracle_drops_settings *s = &o->settings;
    const double whole = floor(s->drops_a_step);
    const bool another = oracle_random_uniform(&o->random, 0, 1) < s->drops_a_step - whole;
    for (int left = (int)whole + another; left > 0 && o->count < s->max_drops; left--) {
        struct oracle_drop drop = {.mass_mg = generated_mass(o)};
        drop.x_mm = oracle_random_uniform(&o->random, 0, s->columns * s->cell_mm);
        drop.y_mm = oracle_random_uniform(&o->random, 0, s->rows * s->cell_mm);
        oracle_drops_insert(o, drop);
        o->ledger.generated_mg += drop.mass_mg;
        o->ledger.generated_drops++;
    }
}

// Equation 6. Drops that have left in this step do not count.
static void leave_residue(struct oracle_drops *o, int index, int *living)
{
    const struct oracle_drops_settings *s = &o->settings;
    struct oracle_drop *parent = &o->drops[index];
    const double since = fmin(1, parent->tau_s / s->residual_tau_max_s);
    const double chance = fmin(1, s->residual_beta * s->step_s / s->residual_tau_max_s * since);
    if (oracle_random_uniform(&o->random, 0, 1) >= chance) {
        parent->tau_s += s->step_s;
        return;
    }
    parent->tau_s = 0;
    if (*living >= s->max_drops)
        return;
    const double share =
        oracle_random_uniform(&o->random, s->residual_share_low, s->residual_share_high);
    const struct oracle_drop child = {.parent_id = parent->id,
                                      .x_mm = parent->x_mm,
                                      .y_mm = parent->y_mm,
                                      .mass_mg =
                                          fmin(s->critical_mass_mg, share * parent->mass_mg)};
    parent->mass_mg -= child.mass_mg;
    oracle_drops_insert(o, child);
    o->ledger.residuals++;
    ++*living;
}

// --- movement ---

// A map's mean over the 3 x 3 cells around a cell.
static double region(const struct oracle_drops *o, const double *map, int row, int column)
{
    if (!oracle_drops_on_pane(o, (struct oracle_drops_cell){row, column}))
        return 0;
    double sum = 0;
    int cells = 0;
    for (int i = row - 1; i <= row + 1; i++) {
        for (int j = column - 1; j <= column + 1; j++) {
            if (!oracle_drops_on_pane(o, (struct oracle_drops_cell){i, j}))
                continue;
            sum += map[i * o->settings.columns + j];
            cells++;
        }
    }
    return sum / cells;
}

// The way in which a map draws a drop: -1, 0 or 1 for south-west, south or south-east. `any`:
// whether the map is not 0 there.
static int drawn(const struct oracle_drops *o, const double *map, struct oracle_drops_cell at,
                 bool *any)
{
    const int row = at.row + (int)AHEAD_CELLS, aside = (int)ASIDE_CELLS;
    const double west = region(o, map, row, at.column - aside);
    const double south = region(o, map, row, at.column);
    const double east = region(o, map, row, at.column + aside);
    *any = west != 0 || south != 0 || east != 0;
    if (south >= west && south >= east)
        return 0;
    return east > west ? 1 : -1;
}

// Chooses a drop's way, a unit vector.
static void choose_way(struct oracle_drops *o, const struct oracle_drop *drop, double way[2])
{
    const struct oracle_drops_cell at = oracle_drops_cell_at(o, drop->x_mm, drop->y_mm);
    bool any;
    int aside = drawn(o, o->height_mm, at, &any);
    if (!any)
        aside = drawn(o, o->affinity, at, &any);
    if (aside != 0) {
        const double length = hypot(ASIDE_CELLS, AHEAD_CELLS);
        way[0] = aside * ASIDE_CELLS / length;
        way[1] = -AHEAD_CELLS / length;
        return;
    }
    const double meander = o->settings.meander_rad;
    const double angle = oracle_random_uniform(&o->random, -meander, meander);
    way[0] = sin(angle);
    way[1] = -cos(angle);
}

// Equations 2 to 5, then wets the pane.
static void move_drop(struct oracle_drops *o, struct oracle_drop *drop, double dt)
{
    const struct oracle_drops_settings *s = &o->settings;
    double way[2];
    choose_way(o, drop, way);
    const double held = ORACLE_DROPS_GRAVITY_MM_S2 * s->critical_mass_mg / drop->mass_mg;
    const double acceleration = ORACLE_DROPS_GRAVITY_MM_S2 * pull(o) - held;
    const double speed = hypot(drop->vx_mm_s, drop->vy_mm_s - acceleration * dt);
    drop->vx_mm_s = speed * way[0];
    drop->vy_mm_s = speed * way[1];
    const double path = speed * dt, spacing = TRAIL_CELLS * s->cell_mm;
    for (int i = 1; s->trail && i * spacing < path; i++)
        oracle_drops_place(o, drop->id, drop->x_mm + i * spacing * way[0],
                           drop->y_mm + i * spacing * way[1], drop->mass_mg);
    drop->x_mm += drop->vx_mm_s * dt;
    drop->y_mm += drop->vy_mm_s * dt;
    o->ledger.trail_mm += path;
    oracle_drops_place(o, drop->id, drop->x_mm, drop->y_mm, drop->mass_mg);
}

static bool has_left(const struct oracle_drops *o, const struct oracle_drop *drop)
{
    return !oracle_drops_on_pane(o, oracle_drops_cell_at(o, drop->x_mm, drop->y_mm));
}

void oracle_drops_move(struct oracle_drops *o)
{
    const struct oracle_drops_settings *s = &o->settings;
    const int count = o->count; // residual drops come after these, and rest
    int living = count;
    for (int i = 0; i < count; i++) {
        o->drops[i].is_static = !oracle_drops_runs(o, o->drops[i].mass_mg);
        if (o->drops[i].is_static) {
            o->drops[i].vx_mm_s = o->drops[i].vy_mm_s = 0;
            continue;
        }
        if (s->residual)
            leave_residue(o, i, &living);
        struct oracle_drop *drop = &o->drops[i];
        for (int substep = 0; substep < s->substeps && !drop->gone; substep++) {
            move_drop(o, drop, s->step_s / s->substeps);
            if (has_left(o, drop)) {
                o->ledger.drained_mg += drop->mass_mg;
                o->ledger.drained_drops++;
                oracle_drops_end(o, drop);
                living--;
            }
        }
    }
}
