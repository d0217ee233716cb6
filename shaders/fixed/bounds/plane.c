// Attributes of a triangle at places of the target.
//
// With corners snapped by at most a step of the grid, a place inside the snapped triangle has the
// value that the plane through the true corners has at most that step away: both are the same mean
// of corners. So the interval of a value is that of the true plane over a small square. All sums
// are as devices compute them, in single precision.
#include "shaders/fixed/bounds/scene.h"

enum { X, Y, W };

// Corners before the division by w, whose x and y are in pixels.
static void project(const struct rg_scene *scene, const struct rg_primitive *primitive,
                    double p[3][3])
{
    int viewport[4];
    rg_fixed_viewport(scene->state, primitive->layer, viewport);
    for (int i = 0; i < 3; i++) {
        const double *place = primitive->corners[i].place;
        p[i][W] = place[3];
        for (int c = X; c <= Y; c++)
            p[i][c] = (place[c] + place[3]) * viewport[2 + c] / 2 + viewport[c] * place[3];
    }
}

bool rg_plane_of(const struct rg_scene *scene, const struct rg_primitive *primitive, double slack,
                 struct rg_plane *plane)
{
    const double rounding = ldexp(4, -24);
    double p[3][3], determinant = 0;
    project(scene, primitive, p);
    plane->slack = slack;
    for (int i = 0; i < 3; i++) {
        const double *j = p[(i + 1) % 3], *k = p[(i + 2) % 3];
        for (int c = 0; c < 3; c++) {
            const int d = (c + 1) % 3, e = (c + 2) % 3;
            plane->b[i][c] = j[d] * k[e] - j[e] * k[d];
            plane->b_error[i][c] = rounding * (fabs(j[d] * k[e]) + fabs(j[e] * k[d]));
        }
        plane->w[i] = p[i][W];
    }
    for (int c = 0; c < 3; c++)
        determinant += plane->b[0][c] * p[0][c];
    for (int i = 0; i < 3; i++)
        for (int c = 0; c < 3; c++) {
            plane->b[i][c] /= determinant;
            plane->b_error[i][c] /= fabs(determinant);
        }
    return fabs(determinant) > 1e-9;
}

static double weight(const struct rg_plane *plane, int i, double x, double y)
{
    return plane->b[i][X] * x + plane->b[i][Y] * y + plane->b[i][W];
}

static double weight_error(const struct rg_plane *plane, int i, double x, double y)
{
    return plane->b_error[i][X] * fabs(x) + plane->b_error[i][Y] * fabs(y) + plane->b_error[i][W];
}

static double error_of(const struct rg_plane *plane, const double values[3], double x, double y)
{
    double sum = 0;
    for (int i = 0; i < 3; i++)
        sum += fabs(values[i]) * weight_error(plane, i, x, y);
    return sum;
}

static double sum_of(const struct rg_plane *plane, const double values[3], double x, double y)
{
    double sum = 0;
    for (int i = 0; i < 3; i++)
        sum += values[i] * weight(plane, i, x, y);
    return sum;
}

// A place outside the triangle moves farther: its weights do not add up as absolute values.
static double reach_of(const struct rg_plane *plane, double x, double y)
{
    double sum = 0;
    for (int i = 0; i < 3; i++)
        sum += fabs(weight(plane, i, x, y) * plane->w[i]);
    return plane->slack * rg_greater(sum, 1);
}

void rg_plane_at(const struct rg_plane *plane, double x, double y, double reach,
                 struct rg_place *place)
{
    const double far = reach + reach_of(plane, x, y);
    place->least = INFINITY;
    place->error = 0;
    for (int i = 0; i < 3; i++) {
        place->errors[i] = weight_error(plane, i, x, y);
        place->error += place->errors[i];
        for (int corner = 0; corner < 4; corner++)
            place->weights[i][corner] =
                weight(plane, i, x + (corner & 1 ? far : -far), y + (corner & 2 ? far : -far));
    }
    for (int corner = 0; corner < 4; corner++) {
        place->over[corner] =
            place->weights[0][corner] + place->weights[1][corner] + place->weights[2][corner];
        place->least = rg_lesser(place->least, place->over[corner]);
    }
}

// Sums of values by their weights at the four corners, and these sums' error.
static double sums_of(const struct rg_place *place, const double values[3], double sums[4])
{
    double error = 0;
    for (int corner = 0; corner < 4; corner++)
        sums[corner] = 0;
    for (int i = 0; i < 3; i++) {
        error += fabs(values[i]) * place->errors[i];
        for (int corner = 0; corner < 4; corner++)
            sums[corner] += values[i] * place->weights[i][corner];
    }
    return error;
}

static struct rg_span all_of(const double sums[4])
{
    struct rg_span all = {INFINITY, -INFINITY};
    for (int corner = 0; corner < 4; corner++)
        all = rg_span_reach(all, sums[corner]);
    return all;
}

static double farthest(struct rg_span a)
{
    return rg_greater(fabs(a.low), fabs(a.high));
}

static struct rg_span within(struct rg_span a, const double values[3])
{
    struct rg_span all = rg_span_at(values[0]);
    for (int i = 1; i < 3; i++)
        all = rg_span_reach(all, values[i]);
    const double rounding = 0x1p-22 * farthest(all);
    return rg_span_clamp(a, all.low - rounding, all.high + rounding);
}

struct rg_span rg_plane_affine(const struct rg_place *place, const double over_w[3])
{
    double sums[4];
    const double error = sums_of(place, over_w, sums);
    return rg_span_widen(all_of(sums), error);
}

struct rg_span rg_plane_value(const struct rg_place *place, const double values[3], bool is_inside)
{
    double sums[4];
    const double error = sums_of(place, values, sums), least = place->least;
    for (int corner = 0; corner < 4; corner++)
        sums[corner] /= place->over[corner];
    struct rg_span all = all_of(sums);
    if (least <= place->error)
        all = (struct rg_span){-INFINITY, INFINITY};
    else
        all =
            rg_span_widen(all, (error + farthest(all) * (place->error + 0x1p-22 * least)) / least);
    return is_inside ? within(all, values) : all;
}

static double at(const struct rg_plane *plane, const double values[3], double x, double y)
{
    static const double one[] = {1, 1, 1};
    return sum_of(plane, values, x, y) / sum_of(plane, one, x, y);
}

struct rg_span rg_plane_step(const struct rg_plane *plane, const double values[3], double x,
                             double y, bool in_y)
{
    struct rg_span all = {INFINITY, -INFINITY};
    double moved = 0;
    // Either pixel of a quad may be the one at hand, and either row or column may be taken.
    for (int i = 0; i < 6; i++) {
        const double along = i % 2 - 1, across = i / 2 - 1; // NOLINT(bugprone-integer-division)
        const double x0 = x + (in_y ? across : along), y0 = y + (in_y ? along : across);
        const double here = at(plane, values, x0, y0), right = at(plane, values, x0 + 1, y0),
                     up = at(plane, values, x0, y0 + 1);
        all = rg_span_reach(all, (in_y ? up : right) - here);
        moved = fmax(moved, fabs(right - here) + fabs(up - here));
    }
    const double rounding =
        2 * error_of(plane, values, x, y) + ldexp(fabs(at(plane, values, x, y)), -21);
    return rg_span_widen(all, 2 * reach_of(plane, x, y) * moved + rounding);
}

// --- polygon offset (OpenGL, Depth Offset; Vulkan, Depth Bias) ---

static struct rg_span over(struct rg_span a, struct rg_span b)
{
    const struct rg_span all = {-INFINITY, INFINITY};
    return b.low <= 0 && b.high >= 0 ? all
                                     : rg_span_times(a, (struct rg_span){1 / b.high, 1 / b.low});
}

// The slope lies between the greater of both and their length; the unit is that of the greatest
// depth's exponent.
struct rg_span rg_plane_offset(const struct rg_scene *scene, const struct rg_primitive *primitive,
                               double slack)
{
    const struct rg_fixed_state *state = scene->state;
    struct rg_span side[2][2], rise[2], slope[2];
    double p[3][3], depth[3], most = 0;
    project(scene, primitive, p);
    for (int i = 0; i < 3; i++) {
        depth[i] = primitive->corners[i].place[2] / p[i][W];
        most = fmax(most, fabs(depth[i]));
    }
    for (int i = 0; i < 2; i++) {
        rise[i] = rg_span_widen(rg_span_at(depth[i + 1] - depth[0]), ldexp(most, -23));
        for (int c = X; c <= Y; c++)
            side[i][c] =
                rg_span_widen(rg_span_at(p[i + 1][c] / p[i + 1][W] - p[0][c] / p[0][W]), 2 * slack);
    }
    const struct rg_span area =
        rg_span_less(rg_span_times(side[0][X], side[1][Y]), rg_span_times(side[1][X], side[0][Y]));
    for (int c = X; c <= Y; c++)
        slope[c] = rg_span_absolute(over(
            rg_span_less(rg_span_times(rise[0], side[1][!c]), rg_span_times(rise[1], side[0][!c])),
            area));
    const struct rg_span m = {fmax(slope[X].low, slope[Y].low),
                              hypot(slope[X].high, slope[Y].high)};
    int exponent;
    frexp(most, &exponent);
    const double unit = state->depth == RG_FIXED_D16 ? ldexp(1, -16) : ldexp(1, exponent - 1 - 23);
    return rg_span_add(rg_span_scale(m, state->offset_slope_16 / 16.0),
                       rg_span_at(unit * state->offset_units));
}
