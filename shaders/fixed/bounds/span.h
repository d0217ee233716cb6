// Intervals of real numbers: all values that a specification allows somewhere.
#ifndef RG_SHADERS_FIXED_BOUNDS_SPAN_H
#define RG_SHADERS_FIXED_BOUNDS_SPAN_H

#include <math.h>

struct rg_span {
    double low, high;
};

// As fmin and fmax, for which a number that is none loses, but without a call.
static inline double rg_lesser(double a, double b)
{
    return a < b || isnan(b) ? a : b;
}

static inline double rg_greater(double a, double b)
{
    return a > b || isnan(b) ? a : b;
}

static inline struct rg_span rg_span_at(double value)
{
    return (struct rg_span){value, value};
}

static inline struct rg_span rg_span_widen(struct rg_span a, double by)
{
    return (struct rg_span){a.low - by, a.high + by};
}

// The least interval that holds both.
static inline struct rg_span rg_span_join(struct rg_span a, struct rg_span b)
{
    return (struct rg_span){rg_lesser(a.low, b.low), rg_greater(a.high, b.high)};
}

static inline struct rg_span rg_span_reach(struct rg_span a, double value)
{
    return rg_span_join(a, rg_span_at(value));
}

static inline struct rg_span rg_span_clamp(struct rg_span a, double low, double high)
{
    return (struct rg_span){rg_lesser(rg_greater(a.low, low), high),
                            rg_lesser(rg_greater(a.high, low), high)};
}

static inline struct rg_span rg_span_add(struct rg_span a, struct rg_span b)
{
    return (struct rg_span){a.low + b.low, a.high + b.high};
}

static inline struct rg_span rg_span_less(struct rg_span a, struct rg_span b)
{
    return (struct rg_span){a.low - b.high, a.high - b.low};
}

static inline struct rg_span rg_span_scale(struct rg_span a, double by)
{
    return by < 0 ? (struct rg_span){a.high * by, a.low * by}
                  : (struct rg_span){a.low * by, a.high * by};
}

static inline struct rg_span rg_span_times(struct rg_span a, struct rg_span b)
{
    const double ll = a.low * b.low, lh = a.low * b.high, hl = a.high * b.low, hh = a.high * b.high;
    return (struct rg_span){rg_lesser(rg_lesser(ll, lh), rg_lesser(hl, hh)),
                            rg_greater(rg_greater(ll, lh), rg_greater(hl, hh))};
}

static inline struct rg_span rg_span_absolute(struct rg_span a)
{
    const double high = rg_greater(fabs(a.low), fabs(a.high));
    const double low = a.low <= 0 && a.high >= 0 ? 0 : rg_lesser(fabs(a.low), fabs(a.high));
    return (struct rg_span){low, high};
}

static inline struct rg_span rg_span_most(struct rg_span a, struct rg_span b)
{
    return (struct rg_span){rg_greater(a.low, b.low), rg_greater(a.high, b.high)};
}

static inline struct rg_span rg_span_least(struct rg_span a, struct rg_span b)
{
    return (struct rg_span){rg_lesser(a.low, b.low), rg_lesser(a.high, b.high)};
}

// --- formats ---

// Values in a format that a span may become: to either neighbour.
struct rg_span rg_round_unorm(struct rg_span a, int bits);
struct rg_span rg_round_float(struct rg_span a, int mantissa_bits, int least_exponent);
struct rg_span rg_round_small_float(struct rg_span a, int mantissa_bits);
struct rg_span rg_round_colour(int format, struct rg_span a);
struct rg_span rg_round_depth(int depth, struct rg_span a);

#endif
