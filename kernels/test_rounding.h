// Expressions that a compiler likes to contract or to approximate: tests that each operation
// rounds.
#include "test_rounding_params.h"

#define RG_PARAMS test_rounding_params
#define RG_SLOTS  IN(1, float, inputs) OUT(2, float, results)
#include "slots.h"

RG_FN float times_plus(float a, float b, float c)
{
    return a * b + c;
}

RG_FN rgba scaled_minus(rgba v, float scale, float less)
{
    return rg_rgba(v.r * scale - less, v.g, v.b, v.a);
}

// inputs: all a, all b, all c. results: a kind after the other.
RG_GRID_KERNEL(test_rounding)
{
    float a = inputs_at(rg, x);
    float b = inputs_at(rg, p.count + x);
    float c = inputs_at(rg, 2 * p.count + x);
    float product = a * b;
    results_put(rg, x, a * b + c);
    results_put(rg, p.count + x, times_plus(a, b, c));
    results_put(rg, 2 * p.count + x, scaled_minus(rg_rgba(a, 0.0f, 0.0f, 1.0f), b, c).r);
    results_put(rg, 3 * p.count + x, c - product);
    results_put(rg, 4 * p.count + x, a / b);
    results_put(rg, 5 * p.count + x, rg_sqrt(rg_abs(a)));
}
