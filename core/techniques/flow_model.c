// What flow computes once a frame on the host: orientation, drops, and the kernels' parameters.
#include "core/techniques/flow.h"

#include <math.h>
#include <string.h>

#include "kernels/rng.h"

#define PI 3.14159265358979323846

static void multiply(double a[3][3], double b[3][3], double product[3][3])
{
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            product[i][j] = a[i][0] * b[0][j] + a[i][1] * b[1][j] + a[i][2] * b[2][j];
}

void flow_pane_frame(const struct flow_settings *s, double frame[3][3])
{
    // In the world x runs right, y up and z towards the viewer. The rows are the pane's tangent,
    // binormal and normal before it turns; the angles then turn them about roll, pitch and yaw.
    const double cr = cos(s->roll_deg * PI / 180), sr = sin(s->roll_deg * PI / 180);
    const double cp = cos(s->pitch_deg * PI / 180), sp = sin(s->pitch_deg * PI / 180);
    const double cy = cos(s->yaw_deg * PI / 180), sy = sin(s->yaw_deg * PI / 180);
    double rest[3][3] = {{1, 0, 0}, {0, -1, 0}, {0, 0, 1}};
    double roll[3][3] = {{cr, -sr, 0}, {sr, cr, 0}, {0, 0, 1}};
    double pitch[3][3] = {{1, 0, 0}, {0, cp, -sp}, {0, sp, cp}};
    double yaw[3][3] = {{cy, 0, -sy}, {0, 1, 0}, {sy, 0, cy}};
    double rolled[3][3], pitched[3][3];
    multiply(rest, roll, rolled);
    multiply(rolled, pitch, pitched);
    multiply(pitched, yaw, frame);
}

// The nearest of the eight directions to (x, y), y down: whole steps of 45 degrees (figure 8).
static void direction_of(int eighth, int *dx, int *dy)
{
    static const int steps[8][2] = {{1, 0},  {1, 1},   {0, 1},  {-1, 1},
                                    {-1, 0}, {-1, -1}, {0, -1}, {1, -1}};
    *dx = steps[eighth & 7][0];
    *dy = steps[eighth & 7][1];
}

// Gravity in tangent space (equation 1), its direction among the eight, and its share in the plane,
// which is cos(alpha) (equation 2).
static void set_gravity(const struct flow_settings *s, flow_params *p)
{
    double frame[3][3];
    flow_pane_frame(s, frame);
    double gx = -frame[0][1], gy = -frame[1][1]; // of (0, -1, 0) in the world
    double along = sqrt(gx * gx + gy * gy);
    p->speed = along > 1e-6 ? (float)fmin(along, 1) : 0;
    double eighths = atan2(gy, gx) / (PI / 4);
    if (s->direction == FLOW_NEAREST) {
        direction_of((int)floor(eighths + 0.5), &p->ax, &p->ay);
        return;
    }
    // A hair's breadth, so that an angle that is whole but for its last bits is whole.
    double whole = floor(eighths + 1e-9);
    direction_of((int)whole, &p->ax, &p->ay);
    direction_of((int)whole + 1, &p->bx, &p->by);
    p->b_share = (float)fmax(eighths - whole, 0);
}

static double fraction(double x)
{
    return x - floor(x);
}

flow_params flow_params_at(const struct flow_settings *s, int noise_size, int64_t frame)
{
    flow_params p = {
        .size = s->resolution_px,
        .move_threshold = (float)s->move_threshold,
        .fast_threshold = (float)s->fast_threshold,
        .far_share = (float)s->far_share,
        .capacity = (float)s->capacity,
        .remainder_scale = (float)((FLOW_REMAINDER_ENTRIES - 1) / s->remainder_max_height),
        .noise_size = noise_size,
        .noise_step = (float)(noise_size * s->noise_window / s->resolution_px),
        .noise_x = (float)(noise_size * fraction((double)frame * s->noise_scroll_x)),
        .noise_y = (float)(noise_size * fraction((double)frame * s->noise_scroll_y)),
    };
    set_gravity(s, &p);
    return p;
}

int flow_reflection_level(const struct flow_settings *s)
{
    int level = 0;
    while (s->environment_px >> (level + 1) >= s->reflection_px)
        level++;
    return level;
}

flow_light_params flow_light_params_of(const struct flow_settings *s, int width, int height)
{
    double frame[3][3];
    flow_pane_frame(s, frame);
    const double half = tan(s->view_angle_deg * PI / 360);
    const double texel_mm = s->pane_mm / s->resolution_px;
    return (flow_light_params){
        .size = s->resolution_px,
        .slope_per_height = (float)(s->relief / (2 * texel_mm)),
        .wet_per_height = (float)(1 / s->wet_height),
        .texels_x = (float)s->resolution_px / (float)width,
        .texels_y = (float)s->resolution_px / (float)height,
        .view_x = (float)(2 * half / height),
        .view_y = (float)(2 * half / height),
        .view_left = (float)(half * width / height),
        .view_top = (float)half,
        .fresnel_bias = (float)s->fresnel_bias,
        .fresnel_scale = (float)s->fresnel_scale,
        .fresnel_power = s->fresnel_power,
        .refraction_strength = (float)s->refraction_strength,
        .reflectivity = (float)s->reflectivity,
        .environment_size = s->environment_px,
        .reflection_level = flow_reflection_level(s),
        .reflection_size = s->environment_px >> flow_reflection_level(s),
        .tx = (float)frame[0][0],
        .ty = (float)frame[0][1],
        .tz = (float)frame[0][2],
        .bx = (float)frame[1][0],
        .by = (float)frame[1][1],
        .bz = (float)frame[1][2],
        .nx = (float)frame[2][0],
        .ny = (float)frame[2][1],
        .nz = (float)frame[2][2],
    };
}

// Random streams of flow; the item is a drop's number and the step its frame.
enum { STREAM_SEEDED = 1, STREAM_RAIN = 2 };

flow_splat_params flow_drop(const struct flow_settings *s, int64_t frame, int number)
{
    rg_uint4 w = rg_random((uint)s->seed, (uint)number, frame < 0 ? 0u : (uint)frame,
                           frame < 0 ? STREAM_SEEDED : STREAM_RAIN);
    const double px_per_mm = s->resolution_px / s->pane_mm;
    // Small drops are many and large ones few: the radius falls off with the square.
    const double t = (double)rg_uniform(w.z) * (double)rg_uniform(w.z);
    const double radius_mm =
        s->drop_radius_min_mm + (s->drop_radius_max_mm - s->drop_radius_min_mm) * t;
    return (flow_splat_params){
        .size = s->resolution_px,
        .centre_x = rg_uniform(w.x) * (float)s->resolution_px,
        .centre_y = rg_uniform(w.y) * (float)s->resolution_px,
        .radius_px = (float)(radius_mm * px_per_mm),
        .height = (float)(radius_mm * s->height_per_mm),
        .capacity = (float)s->capacity,
    };
}

int flow_drops_at(const struct flow_settings *s, int64_t frame)
{
    const double a_frame = s->rain_drops_s * s->step_s;
    return (int)(floor((double)(frame + 1) * a_frame) - floor((double)frame * a_frame));
}
