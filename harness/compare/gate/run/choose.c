#include <stdlib.h>

#include "core/base/alloc.h"
#include "harness/compare/gate/run/running.h"
#include "harness/devices/measure/serving/fixed_pairs.h"

// --- what the filter selects ---

static bool is_selected(const struct rg_running_gate *r, const char *name)
{
    char gtest[RG_GTEST_NAME];
    rg_gtest_name(name, gtest);
    return !r->asked->filter || rg_gtest_matches(r->asked->filter, gtest);
}

// Adds the case of a cell, or, with NULL, of the fixed functions of the pair's B.
static void add_case(struct rg_running_gate *r, const struct rg_gate_cell *cell, int pair,
                     char *name)
{
    const struct rg_baseline *baseline = r->asked->baseline;
    struct rg_side *sides = &r->sides[pair * RG_SIDES];
    struct rg_gate_case *added = &r->gate->cases[r->gate->case_count++];
    *added = (struct rg_gate_case){.cell = cell, .name = name, .expectation = -1};
    added->pair = baseline ? 0 : pair; // all devices of a baseline are timed together
    added->before =
        baseline && cell ? rg_baseline_find(baseline, cell->name, sides[RG_SIDE_B].name) : NULL;
    for (int side = 0; side < RG_SIDES; side++) {
        if (!sides[side].name)
            continue;
        added->sides[side] = &sides[side];
        added->devices[added->device_count++] = sides[side].name;
    }
}

static bool select_one(struct rg_running_gate *r, const struct rg_gate_cell *cell, int pair)
{
    char *name = rg_gate_case_name(cell ? cell->name : RG_GATE_FIXED,
                                   r->sides[pair * RG_SIDES + RG_SIDE_B].name);
    if (name && is_selected(r, name))
        add_case(r, cell, pair, name);
    else
        free(name);
    return name != NULL;
}

// The fixed functions of a device are one more case, if they are held against others.
static bool select_all(struct rg_running_gate *r)
{
    const struct rg_gate_request *asked = r->asked;
    bool ok = true;
    for (int pair = 0; ok && pair < asked->pairs->count; pair++) {
        for (int64_t i = 0; ok && i < asked->cells->count; i++)
            ok = select_one(r, &asked->cells->cells[i], pair);
        if (ok && rg_gate_has_fixed(asked->baseline, &asked->pairs->all[pair]))
            ok = select_one(r, NULL, pair);
    }
    return ok;
}

// --- what the shard has ---

// The time that a case took when the baseline was made, or in an earlier gate; 0: unknown.
static double seconds_of(const struct rg_gate_request *asked, const struct rg_gate_case *c)
{
    const json_t *earlier = json_object_get(asked->times, c->name);
    return earlier ? json_number_value(earlier) : c->before ? c->before->seconds : 0;
}

// Cases of unknown time are expected to take as long as the others on average.
static void expect(const struct rg_running_gate *r, double *seconds)
{
    double sum = 0;
    int known = 0;
    for (int i = 0; i < r->gate->case_count; i++) {
        seconds[i] = r->asked->is_apart ? 0 : seconds_of(r->asked, &r->gate->cases[i]);
        sum += seconds[i] > 0 ? seconds[i] : 0;
        known += seconds[i] > 0;
    }
    for (int i = 0; i < r->gate->case_count; i++)
        if (!(seconds[i] > 0))
            seconds[i] = known ? sum / known : 1;
}

// Keeps the shard's cases of cells, in the order of all; counts those of each course.
static void keep(struct rg_running_gate *r, const int *shard_of)
{
    struct rg_gate *gate = r->gate;
    const int count = gate->case_count;
    gate->names = json_array();
    gate->case_count = 0;
    for (int i = 0; i < count; i++) {
        struct rg_gate_case c = gate->cases[i];
        const bool is_here = shard_of[i] == r->asked->shard.number;
        json_array_append_new(gate->names, json_string(c.name));
        r->family[c.pair] += c.cell != NULL;
        c.place = i;
        if (is_here && c.cell) {
            gate->cases[gate->case_count++] = c;
            continue;
        }
        c.sides[RG_SIDE_B]->has_fixed |= is_here;
        free(c.name);
    }
    gate->chosen = count;
}

bool rg_gate_choose(struct rg_running_gate *r)
{
    const struct rg_gate_pairs *pairs = r->asked->pairs;
    const size_t room = (size_t)((r->asked->cells->count + 1) * pairs->count);
    double *seconds = rg_alloc(room, sizeof(*seconds), "gate");
    int *shard_of = rg_alloc(room, sizeof(*shard_of), "gate");
    r->gate->cases = rg_alloc(room, sizeof(*r->gate->cases), "gate");
    r->side_count = pairs->count * RG_SIDES;
    for (int i = 0; i < r->side_count; i++) {
        const char *name = pairs->all[i / RG_SIDES].names[i % RG_SIDES];
        r->sides[i].name = *name ? name : NULL;
    }
    bool ok = seconds && shard_of && r->gate->cases && select_all(r);
    if (ok)
        expect(r, seconds);
    ok = ok && rg_shard_cut(seconds, r->gate->case_count, r->asked->shard.count, shard_of, NULL);
    if (ok)
        keep(r, shard_of);
    free(seconds);
    free(shard_of);
    return ok;
}

bool rg_gate_list(const struct rg_gate_request *request, struct rg_gate *gate)
{
    struct rg_running_gate r = {.asked = request, .gate = gate};
    return rg_gate_choose(&r);
}
