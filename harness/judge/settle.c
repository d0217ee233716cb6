#include "harness/judge/settle.h"

#include <math.h>
#include <string.h>

#include "harness/judge/deciding.h"

const struct rg_settle_rule rg_settle_rule = {
    .error = 0.01, .near = 0.04879016416943205, .look_count = 4, .looks = {12, 24, 48, 96}};

// The chance with which `needed` launches do not settle a claim.
#define MISSED 0.05

// --- one part ---

// The state of a part: the interval of its median, and the verdict of that.
struct standing {
    enum rg_settled settled;
    struct rg_interval of, strict; // strict: for a failure, which any of the parts may be
    int units;                     // launches, or groups of them
};

static double tail_of(const struct rg_settle_rule *rule)
{
    return rule->error / rule->look_count / 2;
}

// Whether an interval contains a bound and lies within `near` on both sides of it.
static bool is_at(const struct rg_interval *of, double bound, double near)
{
    return of->low <= bound && of->high >= bound && of->low >= bound - near &&
           of->high <= bound + near;
}

static enum rg_settled stands(const struct rg_settle_rule *rule, const struct rg_settle_part *part,
                              const struct standing *s)
{
    if (isnan(s->of.low))
        return RG_SETTLED_OPEN;
    if (s->of.low > part->least && s->of.high < part->most)
        return RG_SETTLED_HOLDS;
    if (s->strict.high < part->least || s->strict.low > part->most)
        return RG_SETTLED_FAILS;
    if (is_at(&s->of, part->least, rule->near) || is_at(&s->of, part->most, rule->near))
        return RG_SETTLED_AT_BOUND;
    return RG_SETTLED_OPEN;
}

// The state of a part by `count` of its launches, from number `from` on.
static struct standing stand(const struct rg_settle_rule *rule, const struct rg_settle_part *part,
                             int part_count, int from, int count)
{
    double values[RG_SETTLE_LAUNCHES];
    struct standing s;
    memcpy(values, part->values + from, (size_t)count * sizeof(*values));
    s.units = rg_gate_group(values, count);
    s.of = rg_median_at(values, s.units, tail_of(rule));
    s.strict = rg_median_sorted(values, s.units, tail_of(rule) / part_count);
    s.settled = stands(rule, part, &s);
    return s;
}

// --- all parts ---

static enum rg_settled opposite(enum rg_settled settled)
{
    return settled == RG_SETTLED_HOLDS   ? RG_SETTLED_FAILS
           : settled == RG_SETTLED_FAILS ? RG_SETTLED_HOLDS
                                         : settled;
}

// How far the part's median lies inside of its bounds, negative: outside. The part with the least
// decides.
static double inside_by(const struct rg_settle_part *part, double median)
{
    return fmin(median - part->least, part->most - median);
}

// A claim at a look: it fails if one part does, holds if all do, and is at the bound if no part is
// open.
static enum rg_settled look(const struct rg_settle_rule *rule, enum rg_settle_join join,
                            const struct rg_settle_part *parts, int part_count, int from, int count,
                            struct rg_settling *s)
{
    // Ranks of verdicts, from the best to the worst.
    static const int ranks[] = {[RG_SETTLED_HOLDS] = 0,
                                [RG_SETTLED_AT_BOUND] = 1,
                                [RG_SETTLED_OPEN] = 2,
                                [RG_SETTLED_FAILS] = 3};
    enum rg_settled worst = RG_SETTLED_HOLDS;
    double least = INFINITY;
    for (int i = 0; i < part_count; i++) {
        const struct standing one = stand(rule, &parts[i], part_count, from, count);
        const double inside = inside_by(&parts[i], one.of.median);
        const int more = ranks[one.settled] - ranks[worst];
        if (more > 0 || (!more && inside < least) || !i) {
            s->part = i;
            s->of = one.of;
            least = inside;
        }
        worst = more > 0 ? one.settled : worst;
    }
    s->launches = from + count;
    return join == RG_SETTLE_ANY ? opposite(worst) : worst;
}

// --- how many launches it would take ---

// The launches after which a claim's open part would probably be settled: its interval then
// excludes the nearest bound, or lies within `near` of it.
static int needed_for(const struct rg_settle_rule *rule, const struct rg_settle_part *part,
                      struct rg_settling *s, int count)
{
    double values[RG_SETTLE_LAUNCHES];
    memcpy(values, part->values + s->launches - count, (size_t)count * sizeof(*values));
    const int units = rg_gate_group(values, count);
    const double median = rg_median_at(values, units, 0).median;
    s->spread = rg_gate_spread(values, units, median);
    const double off = fabs(inside_by(part, median));
    const double least = fmax(off, rule->near - off); // at least half of `near`
    const double quantile = rg_gate_upper_quantile(tail_of(rule)) + rg_gate_upper_quantile(MISSED);
    const double launches =
        pow(RG_GATE_SQRT_HALF_PI * s->spread * quantile / least, 2) * count / units;
    int needed = rule->looks[0];
    while (needed < launches && needed < 1 << 20)
        needed *= 2;
    return 2 * needed; // with the confirmation
}

static struct rg_settling open(const struct rg_settle_rule *rule,
                               const struct rg_settle_part *parts, struct rg_settling s, int count,
                               int more)
{
    s.settled = RG_SETTLED_OPEN;
    s.more = more;
    if (count > 0)
        s.needed = needed_for(rule, &parts[s.part], &s, count);
    s.needed = s.needed < s.launches + more ? s.launches + more : s.needed;
    return s;
}

struct rg_settling rg_settle(const struct rg_settle_rule *rule, enum rg_settle_join join,
                             const struct rg_settle_part *parts, int part_count, int launches)
{
    enum rg_settled first = RG_SETTLED_OPEN;
    struct rg_settling s = {.of = {NAN, NAN, NAN}};
    for (int from = 0, i = 0; i < rule->look_count; i++) {
        const int count = rule->looks[i], have = launches - from;
        enum rg_settled now = RG_SETTLED_OPEN;
        if (have > 0)
            now = look(rule, join, parts, part_count, from, have < count ? have : count, &s);
        if (have < count)
            return open(rule, parts, s, have, count - have);
        const bool is_again = first != RG_SETTLED_OPEN;
        s.settled = now;
        if (now == RG_SETTLED_AT_BOUND || (is_again && now == first))
            return s;
        s.is_unconfirmed = is_again && (now != RG_SETTLED_OPEN || i + 1 == rule->look_count);
        if (is_again && now != RG_SETTLED_OPEN)
            return open(rule, parts, s, count, 0);
        if (now == RG_SETTLED_OPEN)
            continue;
        first = now;
        from = count;
        i = -1;
    }
    return open(rule, parts, s, rule->looks[rule->look_count - 1], 0);
}

enum rg_settled rg_settle_once(const struct rg_settle_rule *rule, enum rg_settle_join join,
                               const struct rg_settle_part *parts, int part_count, int *part)
{
    double least = INFINITY;
    bool is_near = false;
    *part = 0;
    for (int i = 0; i < part_count; i++) {
        const double inside = inside_by(&parts[i], parts[i].values[0]);
        if (inside < least) {
            least = inside;
            *part = i;
            is_near = fabs(inside) <= rule->near;
        }
    }
    const enum rg_settled all = is_near     ? RG_SETTLED_AT_BOUND
                                : least > 0 ? RG_SETTLED_HOLDS
                                            : RG_SETTLED_FAILS;
    return join == RG_SETTLE_ANY ? opposite(all) : all;
}
