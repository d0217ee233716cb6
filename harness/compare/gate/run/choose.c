#include "harness/compare/gate/run/choose.h"

#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "harness/devices/measure/serving/fixed_pairs.h"

// A case that the filter selects.
struct chosen {
    const struct rg_gate_cell *cell; // NULL: the fixed functions of the pair's B
    int pair;
    char *name; // owned
};

struct choosing {
    struct rg_running_gate *run;
    int count;
    struct chosen *all;
    double *seconds; // that each is expected to take; 0: unknown
    int *shard_of;
};

// --- what the filter selects ---

static bool is_selected(const struct rg_running_gate *r, const char *name)
{
    char gtest[RG_GTEST_NAME];
    rg_gtest_name(name, gtest);
    return !r->asked->filter || rg_gtest_matches(r->asked->filter, gtest);
}

static const char *device_of(const struct rg_running_gate *r, int pair)
{
    return r->sides[pair * RG_SIDES + RG_SIDE_B].name;
}

static bool select_one(struct choosing *c, const struct rg_gate_cell *cell, int pair)
{
    struct rg_running_gate *r = c->run;
    char *name = rg_gate_case_name(cell ? cell->name : RG_GATE_FIXED, device_of(r, pair));
    if (name && is_selected(r, name))
        c->all[c->count++] = (struct chosen){cell, pair, name};
    else
        free(name);
    return name != NULL;
}

// The fixed functions of a device are one more case, if they are held against others.
static bool select_all(struct choosing *c)
{
    const struct rg_gate_request *asked = c->run->asked;
    bool ok = true;
    for (int pair = 0; ok && pair < asked->pairs->count; pair++) {
        for (int64_t i = 0; ok && i < asked->cells->count; i++)
            ok = select_one(c, &asked->cells->cells[i], pair);
        if (ok && rg_gate_has_fixed(asked->baseline, &asked->pairs->all[pair]))
            ok = select_one(c, NULL, pair);
    }
    return ok;
}

// --- what the shard has ---

// The time that a case took when the baseline was made, or in an earlier gate; 0: unknown.
static double seconds_of(const struct choosing *c, const struct chosen *chosen)
{
    const struct rg_gate_request *asked = c->run->asked;
    const json_t *earlier = json_object_get(asked->times, chosen->name);
    const struct rg_baseline_row *row =
        asked->baseline && chosen->cell
            ? rg_baseline_find(asked->baseline, chosen->cell->name, device_of(c->run, chosen->pair))
            : NULL;
    return earlier ? json_number_value(earlier) : row ? row->seconds : 0;
}

// Cases of unknown time are expected to take as long as the others on average.
static void expect(struct choosing *c)
{
    double sum = 0;
    int known = 0;
    for (int i = 0; i < c->count; i++) {
        c->seconds[i] = c->run->asked->is_apart ? 0 : seconds_of(c, &c->all[i]);
        sum += c->seconds[i] > 0 ? c->seconds[i] : 0;
        known += c->seconds[i] > 0;
    }
    for (int i = 0; i < c->count; i++)
        if (!(c->seconds[i] > 0))
            c->seconds[i] = known ? sum / known : 1;
}

static void add_case(struct choosing *c, int place)
{
    struct rg_running_gate *r = c->run;
    struct chosen *chosen = &c->all[place];
    const struct rg_baseline *baseline = r->asked->baseline;
    struct rg_side *sides = &r->sides[chosen->pair * RG_SIDES];
    struct rg_gate_case *added = &r->gate->cases[r->gate->case_count++];
    *added = (struct rg_gate_case){
        .cell = chosen->cell, .name = chosen->name, .place = place, .expectation = -1};
    chosen->name = NULL;
    added->pair = baseline ? 0 : chosen->pair; // all devices of a baseline are timed together
    added->before =
        baseline ? rg_baseline_find(baseline, added->cell->name, sides[RG_SIDE_B].name) : NULL;
    for (int side = 0; side < RG_SIDES; side++) {
        if (!sides[side].name)
            continue;
        added->sides[side] = &sides[side];
        added->devices[added->device_count++] = sides[side].name;
    }
}

// Adds the shard's cases, in the order of all; counts those of each course.
static bool divide(struct choosing *c)
{
    struct rg_running_gate *r = c->run;
    const struct rg_shard *shard = &r->asked->shard;
    expect(c);
    if (!rg_shard_cut(c->seconds, c->count, shard->count, c->shard_of, NULL))
        return false;
    r->gate->chosen = c->count;
    r->gate->names = json_array();
    for (int i = 0; i < c->count; i++) {
        struct chosen *chosen = &c->all[i];
        json_array_append_new(r->gate->names, json_string(chosen->name));
        r->family[r->asked->baseline ? 0 : chosen->pair] += chosen->cell != NULL;
        if (c->shard_of[i] == shard->number && chosen->cell)
            add_case(c, i);
        else if (c->shard_of[i] == shard->number)
            r->has_fixed[chosen->pair * RG_SIDES + RG_SIDE_B] = true;
    }
    return true;
}

// All pairs become sides, even those without a chosen case.
bool rg_gate_choose(struct rg_running_gate *r)
{
    const struct rg_gate_pairs *pairs = r->asked->pairs;
    const size_t room = (size_t)((r->asked->cells->count + 1) * pairs->count);
    struct choosing c = {.run = r};
    r->side_count = pairs->count * RG_SIDES;
    for (int i = 0; i < r->side_count; i++) {
        const char *name = pairs->all[i / RG_SIDES].names[i % RG_SIDES];
        r->sides[i].name = *name ? name : NULL;
    }
    r->gate->cases = rg_alloc(room, sizeof(*r->gate->cases), "gate");
    c.all = rg_alloc(room, sizeof(*c.all), "gate");
    c.seconds = rg_alloc(room, sizeof(*c.seconds), "gate");
    c.shard_of = rg_alloc(room, sizeof(*c.shard_of), "gate");
    const bool ok =
        r->gate->cases && c.all && c.seconds && c.shard_of && select_all(&c) && divide(&c);
    for (int i = 0; i < c.count; i++)
        free(c.all[i].name);
    free(c.all);
    free(c.seconds);
    free(c.shard_of);
    return ok;
}
