// a * b + c at every place where the dialect allows an expression: tests that none is fused.
#include "tests/kernels/precise_params.h"

#define RG_PARAMS test_precise_params
#define RG_SLOTS  IN(1, float, source) OUT(2, float, target)
#include "kernels/dialect/slots/slots.h"

RG_STRUCT(rg_line)
{
    float slope;
    float start;
};
RG_STRUCT_SIZE(rg_line, 2)

RG_FN float rg_fused(float a, float b, float c)
{
    return a * b + c;
}

RG_FN rg_line rg_make_line(float slope, float start)
{
    rg_line line;
    line.slope = slope;
    line.start = start;
    line.start += slope * 0.1f;
    return line;
}

RG_FN int rg_cell(float a, float b)
{
    return rg_to_int(rg_floor(a * b + 0.25f));
}

RG_FN int rg_is_above(float a, float b, float limit)
{
    if (a * b + 0.5f > limit)
        return 1;
    else if (a * b - 0.5f > limit)
        return 2;
    return 0;
}

RG_PROC void rg_put_scaled(rg_ctx rg, RG_PARAMS p, int i, float v)
{
    target_put(rg, i, v * p.scale + p.offset);
}

// target: 8 floats an item.
RG_GRID_KERNEL(test_precise)
{
    float a = source_at(rg, x);
    float b = source_at(rg, (x + 1) % p.count);
    int to = x * 8;
    target_put(rg, to, a * b + p.offset);
    rg_put_scaled(rg, p, to + 1, -(a * b - 1.0f));
    target_put(rg, to + 2, rg_make_line(a * b + p.scale, b).start);
    target_put(rg, to + 3, rg_to_float(rg_cell(a, b * p.scale + a) + rg_is_above(a, b, p.offset)));
    float sum = 0.0f;
    for (int i = 0; i < 8 && sum * a + b < p.scale; i++)
        sum += a * b + rg_to_float(i);
    target_put(rg, to + 4, sum);
    int steps = 0;
    while (steps < 8 && sum * 1.5f + a < p.offset) {
        sum = sum * 1.25f + 0.5f;
        steps++;
    }
    target_put(rg, to + 5, rg_max(a * p.scale + b, sum));
    target_put(rg, to + 6, a * b + p.offset < p.scale ? rg_fused(a, b, a * p.scale - b) : a / b);
    target_put(rg, to + 7, rg_sqrt(rg_abs(a * a - b * b)));
}
