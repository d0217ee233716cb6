// The host's part of flow's simulation: orientation, drops, and the kernels' parameters.
#include "core/techniques/flow/inputs/flow.h"

#include <math.h>

#include "core/scene/matrix.h"
#include "core/scene/vector.h"
#include "kernels/dialect/rng.h"

// The world's x runs right, y up and z towards the viewer. Rows are a pane's tangent, binormal and
// normal before the box rotates.
static const double rest[FLOW_MAX_PANES][3][3] = {
    {{1, 0, 0}, {0, -1, 0}, {0, 0, 1}},   // front
    {{-1, 0, 0}, {0, -1, 0}, {0, 0, -1}}, // back
    {{0, 0, -1}, {0, -1, 0}, {1, 0, 0}},  // right
    {{0, 0, 1}, {0, -1, 0}, {-1, 0, 0}},  // left
    {{1, 0, 0}, {0, 0, 1}, {0, 1, 0}},    // top
    {{1, 0, 0}, {0, 0, -1}, {0, -1, 0}},  // bottom
};

int flow_pane_count(const struct flow_settings *s)
{
    return s->view == FLOW_BOX ? FLOW_MAX_PANES : 1;
}

void flow_pane_frame(const struct flow_settings *s, int pane, int64_t frame, double axes[3][3])
{
    const double t = (double)frame * s->step_s;
    const double r = (s->roll_deg + s->spin_roll_deg_s * t) * M_PI / 180;
    const double p = (s->pitch_deg + s->spin_pitch_deg_s * t) * M_PI / 180;
    const double y = (s->yaw_deg + s->spin_yaw_deg_s * t) * M_PI / 180;
    const double roll[3][3] = {{cos(r), -sin(r), 0}, {sin(r), cos(r), 0}, {0, 0, 1}};
    const double pitch[3][3] = {{1, 0, 0}, {0, cos(p), -sin(p)}, {0, sin(p), cos(p)}};
    const double yaw[3][3] = {{cos(y), 0, -sin(y)}, {0, 1, 0}, {sin(y), 0, cos(y)}};
    double rolled[3][3], pitched[3][3];
    rg_turn_multiply(rest[pane], roll, rolled);
    rg_turn_multiply(rolled, pitch, pitched);
    rg_turn_multiply(pitched, yaw, axes);
}

// One of the eight directions, in steps of 45 degrees, as (x, y), y down (figure 8).
static void direction_of(int eighth, int *dx, int *dy)
{
    static const int steps[8][2] = {{1, 0},  {1, 1},   {0, 1},  {-1, 1},
                                    {-1, 0}, {-1, -1}, {0, -1}, {1, -1}};
    *dx = steps[eighth & 7][0];
    *dy = steps[eighth & 7][1];
}

// Gravity in tangent space (equation 1), its direction among the eight, and its share in the plane,
// which is cos(alpha) (equation 2).
static void set_gravity(const struct flow_settings *s, double axes[3][3], flow_pane *pane)
{
    double gx = -axes[0][1], gy = -axes[1][1]; // (0, -1, 0) in the world
    double along = sqrt(gx * gx + gy * gy);
    pane->speed = along > 1e-6 ? (float)fmin(along, 1) : 0;
    double eighths = atan2(gy, gx) / (M_PI / 4);
    if (s->direction != FLOW_SPLIT) {
        direction_of((int)floor(eighths + 0.5), &pane->ax, &pane->ay);
        return;
    }
    // The epsilon lets an angle that is whole except for rounding count as whole.
    double whole = floor(eighths + 1e-9);
    direction_of((int)whole, &pane->ax, &pane->ay);
    direction_of((int)whole + 1, &pane->bx, &pane->by);
    pane->b_share = (float)fmax(eighths - whole, 0);
}

// The direction out of an unrotated pane over a side: 0 top, 1 bottom, 2 left, 3 right.
static void way_out(int pane, int side, double out[3])
{
    const double *axis = rest[pane][side < 2 ? 1 : 0];
    const double sign = side == 0 || side == 2 ? -1 : 1;
    for (int i = 0; i < 3; i++)
        out[i] = sign * axis[i];
}

// The neighbour beyond a pane's side: the pane whose normal points there, entered by its side that
// points back. Water drips off instead of flowing onto a pane that faces down.
static flow_neighbour neighbour_of(const struct flow_settings *s, int pane, int side, int64_t frame)
{
    flow_neighbour over = {.pane = FLOW_NO_PANE};
    double out[3], back[3], axes[3][3];
    way_out(pane, side, out);
    if (!s->run_on || flow_pane_count(s) == 1)
        return over;
    for (int q = 0; q < FLOW_MAX_PANES; q++)
        if (rg_dot(rest[q][2], out) > 0.5)
            over.pane = q;
    for (int e = 0; e < 4; e++) {
        way_out(over.pane, e, back);
        if (rg_dot(back, rest[pane][2]) > 0.5)
            over.side = e;
    }
    over.turned = rg_dot(rest[pane][side < 2 ? 0 : 1], rest[over.pane][over.side < 2 ? 0 : 1]) < 0;
    flow_pane_frame(s, over.pane, frame, axes);
    if (axes[2][1] < -0.5)
        over.pane = FLOW_NO_PANE;
    return over;
}

static v3 v3_of(const double v[3])
{
    return v3_make((float)v[0], (float)v[1], (float)v[2]);
}

void flow_panes_at(const struct flow_settings *s, int noise_size, int64_t frame, flow_pane *panes)
{
    for (int i = 0; i < flow_pane_count(s); i++) {
        double axes[3][3];
        flow_pane_frame(s, i, frame, axes);
        panes[i] = (flow_pane){
            .noise_shift = (float)(noise_size * fmod(i * 0.381966, 1)),
            .top = neighbour_of(s, i, 0, frame),
            .bottom = neighbour_of(s, i, 1, frame),
            .left = neighbour_of(s, i, 2, frame),
            .right = neighbour_of(s, i, 3, frame),
            .t = v3_of(axes[0]),
            .b = v3_of(axes[1]),
            .n = v3_of(axes[2]),
        };
        set_gravity(s, axes, &panes[i]);
    }
}

double flow_texel_mm(const struct flow_settings *s)
{
    return s->pane_mm / s->resolution_px;
}

int flow_clamp(double value, int low, int high)
{
    return value < low ? low : value > high ? high : (int)value;
}

double flow_fraction(double x)
{
    return x - floor(x);
}

double flow_even(int64_t n)
{
    return flow_fraction((double)n * 0.6180339887498949);
}

// The amount of water above which a texel reaches the one `texels` below: M for two, and M - L more
// for each further one.
static float threshold_of(const struct flow_settings *s, int texels)
{
    const double never = 1e30, step = fmax(s->fast_threshold - s->move_threshold, 0);
    const int reach = s->direction == FLOW_EACH_TEXEL ? 2 : s->reach_texels;
    return (float)(texels <= reach ? s->fast_threshold + (texels - 2) * step : never);
}

flow_params flow_params_at(const struct flow_settings *s, int noise_size, int64_t frame)
{
    return (flow_params){
        .size = s->resolution_px,
        .move_threshold = (float)s->move_threshold,
        .fast_threshold = (float)s->fast_threshold,
        .third_threshold = threshold_of(s, 3),
        .fourth_threshold = threshold_of(s, 4),
        .far_share = (float)s->far_share,
        .capacity = (float)s->capacity,
        .remainder_scale = (float)((FLOW_REMAINDER_ENTRIES - 1) / s->remainder_max_height),
        .noise_size = noise_size,
        .noise_step = (float)(noise_size * s->noise_window / s->resolution_px),
        .noise_x = (float)(noise_size * flow_fraction((double)frame * s->noise_scroll_x)),
        .noise_y = (float)(noise_size * flow_fraction((double)frame * s->noise_scroll_y)),
        .sweep = (float)s->sweep,
        .blur = s->blur,
    };
}

flow_normals_params flow_normals_params_of(const struct flow_settings *s)
{
    return (flow_normals_params){
        .size = s->resolution_px,
        .slope_per_height = (float)(s->relief / (2 * flow_texel_mm(s))),
        .wet_per_height = (float)(1 / s->wet_height),
    };
}

flow_splat_params flow_drop(const struct flow_settings *s, int pane, int64_t frame, int number)
{
    const uint stream = frame < 0 ? FLOW_STREAM_SEEDED : FLOW_STREAM_RAIN;
    rg_uint4 w = rg_random((uint)s->seed, (uint)number, frame < 0 ? 0u : (uint)frame,
                           stream + FLOW_STREAMS_A_PANE * (uint)pane);
    const double px_per_mm = s->resolution_px / s->pane_mm;
    // Small drops are frequent and large ones rare: the radius is distributed as a square.
    const double t = (double)rg_uniform(w.z) * (double)rg_uniform(w.z);
    const double radius_mm =
        s->drop_radius_min_mm + (s->drop_radius_max_mm - s->drop_radius_min_mm) * t;
    return (flow_splat_params){
        .size = s->resolution_px,
        .pane = pane,
        .centre_x = rg_uniform(w.x) * (float)s->resolution_px,
        .centre_y = rg_uniform(w.y) * (float)s->resolution_px,
        .radius_px = (float)(radius_mm * px_per_mm),
        .height = (float)(radius_mm * s->height_per_mm),
        .capacity = (float)s->capacity,
    };
}
