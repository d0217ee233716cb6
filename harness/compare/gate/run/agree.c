#include "harness/compare/gate/run/agree.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/frames/session.h"

// A cell on both sides, while it is compared.
struct pair {
    const struct rg_gate_cell *cell;
    struct rg_side *sides;
    struct rg_subject subject;
    struct rg_session *sessions[RG_SIDES];
    struct rg_agreement *found;
};

static const struct rg_device_info *info_of(const struct pair *p, int side)
{
    return &p->sides[side].device->info;
}

static bool owe_bits(const struct pair *p)
{
    return rg_tier_owed(info_of(p, RG_SIDE_A), info_of(p, RG_SIDE_B)) == RG_T0;
}

// Ends it with what the last error comes to, on a side.
static bool fail_by_error(struct pair *p, int side)
{
    return rg_agreement_fails(p->found, p->sides[side].name);
}

// --- pictures ---

static bool have_alike_pictures(struct pair *p)
{
    struct rg_drawn drawn[RG_SIDES] = {{p->sides[0].name, {0}}, {p->sides[1].name, {0}}};
    bool ok = rg_alike_has_room(p->cell, p->found);
    for (int side = 0; ok && side < RG_SIDES; side++)
        ok = rg_session_read_picture(p->sessions[side], &drawn[side].picture) ||
             fail_by_error(p, side);
    ok = ok && rg_alike_pictures(p->cell, p->sides[RG_SIDE_A].device,
                                 rg_tier_owed(info_of(p, RG_SIDE_A), info_of(p, RG_SIDE_B)),
                                 &drawn[0], &drawn[1], p->found);
    for (int side = 0; side < RG_SIDES; side++)
        rg_picture_destroy(&drawn[side].picture);
    return ok;
}

// --- states ---

static bool have_alike_state(struct pair *p, int index)
{
    void *words[RG_SIDES] = {NULL, NULL};
    size_t sizes[RG_SIDES];
    struct rg_state layout;
    bool ok = true;
    for (int side = 0; ok && side < RG_SIDES; side++) {
        words[side] = rg_session_read_state(p->sessions[side], index, &layout, &sizes[side]);
        ok = words[side] || fail_by_error(p, side);
    }
    if (ok && (sizes[0] != sizes[1] || memcmp(words[0], words[1], sizes[0]) != 0))
        ok = rg_agreement_differs(p->found, "the state '%s' differs behind %d frames", layout.name,
                                  p->cell->frames);
    free(words[0]);
    free(words[1]);
    return ok;
}

static bool have_alike_states(struct pair *p)
{
    bool ok = true;
    for (int i = 0; ok && i < rg_session_state_count(p->sessions[0]); i++)
        ok = have_alike_state(p, i);
    return ok;
}

// --- counters ---

static bool have_alike_counters(struct pair *p)
{
    struct rg_counters counts[RG_SIDES];
    for (int side = 0; side < RG_SIDES; side++) {
        struct rg_account told;
        if (!rg_session_tell(p->sessions[side], &told))
            return fail_by_error(p, side);
        counts[side].count = told.counter_count;
        rg_counters_copy(counts[side].counters, told.counters, told.counter_count);
    }
    return rg_alike_counters(&counts[0], &counts[1], p->found);
}

// The work of one frame more.
static bool do_alike_work(struct pair *p)
{
    struct rg_tally tallies[RG_SIDES];
    for (int side = 0; side < RG_SIDES; side++)
        if (!rg_session_count(p->sessions[side], &tallies[side]))
            return fail_by_error(p, side);
    return rg_alike_work(&tallies[0], &tallies[1], p->found);
}

// A difference that was found outweighs that a side does not tell its code.
static bool tell_code(struct pair *p, struct rg_session_code code[RG_SIDES])
{
    for (int side = 0; side < RG_SIDES; side++)
        if (!rg_session_code(p->sessions[side], &code[side]))
            return p->found->outcome != RG_FAIL && fail_by_error(p, side);
    return true;
}

void rg_gate_agree(const struct rg_gate_cell *cell, struct rg_side sides[RG_SIDES],
                   const char *folder, const char *name, struct rg_agreement *agreement)
{
    struct pair p = {.cell = cell,
                     .sides = sides,
                     .subject = {cell->technique, cell->settings, cell->width, cell->height},
                     .found = agreement};
    *agreement =
        (struct rg_agreement){.folder = folder, .name = name, .pixels = NAN, .difference = NAN};
    bool ok = true;
    for (int side = 0; ok && side < RG_SIDES; side++) {
        p.sessions[side] = rg_session_run(sides[side].device, &p.subject, cell->frames);
        ok = p.sessions[side] || fail_by_error(&p, side);
    }
    ok = ok && have_alike_pictures(&p) && (!owe_bits(&p) || have_alike_states(&p)) &&
         have_alike_counters(&p) && do_alike_work(&p);
    if (ok || agreement->outcome == RG_FAIL)
        agreement->has_code = tell_code(&p, agreement->code);
    for (int side = 0; side < RG_SIDES; side++)
        rg_session_close(p.sessions[side]);
    if (agreement->outcome == RG_FAIL)
        rg_agreement_blame(cell, sides[RG_SIDE_B].device, sides[RG_SIDE_A].device, agreement);
}
