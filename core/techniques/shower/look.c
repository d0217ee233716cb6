// The viewer's part of a frame: the visible body (up to the horizon) and the region of births.
#include <math.h>

#include "core/base/log.h"
#include "core/techniques/shower/instance.h"

// A side of the body, from a unit normal that points inwards and a point on it.
static shower_plane plane_of(const double normal[3], const double point[3])
{
    const double at = normal[0] * point[0] + normal[1] * point[1] + normal[2] * point[2];
    return (shower_plane){(float)normal[0], (float)normal[1], (float)normal[2], (float)-at};
}

// The view in double precision.
struct outlook {
    double eye[3], ahead_x, ahead_z;
    double half_across_rad, half_above_rad;
    double near_m, far_m;
};

static void set_ends(shower_params *p, const struct outlook *o)
{
    const double on[3] = {o->ahead_x, 0, o->ahead_z}, back[3] = {-o->ahead_x, 0, -o->ahead_z};
    double first[3], last[3];
    for (int i = 0; i < 3; i++) {
        first[i] = o->eye[i] + on[i] * o->near_m;
        last[i] = o->eye[i] + on[i] * o->far_m;
    }
    p->front = plane_of(on, first);
    p->back = plane_of(back, last);
}

// The sides contain the eye. The right is (-ahead z, ahead x).
static void set_sides(shower_params *p, const struct outlook *o)
{
    const double s = sin(o->half_across_rad), c = cos(o->half_across_rad);
    const double up_s = sin(o->half_above_rad), up_c = cos(o->half_above_rad);
    const double x = o->ahead_x, z = o->ahead_z;
    const double left[3] = {s * x - c * z, 0, s * z + c * x};
    const double right[3] = {s * x + c * z, 0, s * z - c * x};
    const double top[3] = {up_s * x, -up_c, up_s * z}, bottom[3] = {up_s * x, up_c, up_s * z};
    p->left = plane_of(left, o->eye);
    p->right = plane_of(right, o->eye);
    p->top = plane_of(top, o->eye);
    p->bottom = plane_of(bottom, o->eye);
}

// Eqs. 6 to 8. A level view looks along phi = pi / 2.
static void set_region(shower_params *p, const struct shower_settings *set, const struct outlook *o)
{
    const double beta = 2 * o->half_above_rad, alpha = 2 * o->half_across_rad;
    p->phi_rad = (float)((M_PI - beta) / 2);
    p->phi_span_rad = (float)(set->birth == SHOWER_PAPER ? beta / 2 : beta);
    p->theta_rad = (float)(set->heading_deg * M_PI / 180 - M_PI - alpha / 2);
    p->theta_span_rad = (float)alpha;
    p->is_even = set->birth == SHOWER_VOLUME;
    p->eye_x = (float)o->eye[0];
    p->eye_y = (float)o->eye[1];
    p->eye_z = (float)o->eye[2];
    p->ahead_x = (float)o->ahead_x;
    p->ahead_z = (float)o->ahead_z;
    p->across = (float)tan(o->half_across_rad);
    p->above = (float)tan(o->half_above_rad);
    p->near_m = (float)o->near_m;
    p->far_m = (float)o->far_m;
}

// The view of a frame for a picture of width x height pixels. Eq. 2 gives the largest distance, at
// which a drop is one pixel high.
static struct outlook outlook_of(const struct shower_settings *set, int width, int height,
                                 int64_t frame)
{
    const double heading = set->heading_deg * M_PI / 180;
    const double walked_m = set->walk_m_s * set->step_s * (double)frame;
    const double half_above = set->view_angle_deg * M_PI / 360;
    const double x = -sin(heading), z = -cos(heading);
    return (struct outlook){
        .eye = {set->eye_x_m + x * walked_m, set->eye_y_m, set->eye_z_m + z * walked_m},
        .ahead_x = x,
        .ahead_z = z,
        .half_across_rad = atan(tan(half_above) * width / height),
        .half_above_rad = half_above,
        .near_m = set->near_m,
        .far_m = height * set->drop_height_m / (2 * tan(half_above)),
    };
}

// The fraction of the particles leaving through one side that the wind brings in through the other,
// by their speeds across the sides. 0 if they leave through both.
static float share_of(double in_m_s, double out_m_s)
{
    return out_m_s > 0 ? (float)fmax(fmin(in_m_s / out_m_s, 1), 0) : 0;
}

// The wind is relative to the viewer, who may walk. Particles carried away from the viewer become
// relatively denser, since the view widens, and leave room at the sides.
static void set_inflow(shower_params *p, const struct shower_settings *set)
{
    const double x = (double)p->wind_x - set->walk_m_s * (double)p->ahead_x;
    const double z = (double)p->wind_z - set->walk_m_s * (double)p->ahead_z;
    const double into_left = x * (double)p->left.x + z * (double)p->left.z;
    const double into_right = x * (double)p->right.x + z * (double)p->right.z;
    const double away = x * (double)p->ahead_x + z * (double)p->ahead_z;
    const double in = fmax(into_left, 0) + fmax(into_right, 0);
    p->left_to_right = share_of(into_right, -into_left);
    p->right_to_left = share_of(into_left, -into_right);
    p->thinning_m = (float)(fmax(away, 0) * set->step_s);
    p->to_left = share_of(fmax(into_left, 0), in);
}

static void set_camera(struct shower *s, const struct outlook *o)
{
    const double ahead[3] = {o->ahead_x, 0, o->ahead_z}, reach_m = 40;
    s->camera = (struct rg_camera){.up = {0, 1, 0},
                                   .angle_deg = (float)s->settings.view_angle_deg,
                                   .near_plane = 0.1f,
                                   .far_plane = 1000};
    for (int i = 0; i < 3; i++) {
        s->camera.position[i] = (float)o->eye[i];
        s->camera.target[i] = (float)(o->eye[i] + ahead[i] * reach_m);
    }
}

bool shower_look(struct shower *s, int64_t frame)
{
    const struct shower_settings *set = &s->settings;
    const struct rg_image_desc *d = &s->base.target->desc;
    const struct outlook o = outlook_of(set, d->width, d->height, frame);
    if (set->eye_y_m < 0)
        return rg_error("eye_y_m: the viewer is %g m below the ground; raise it", -set->eye_y_m);
    if (o.far_m <= o.near_m)
        return rg_error("near_m: at %g m and more a drop is less than a pixel high in a picture of "
                        "%d rows; lower near_m, or raise drop_height_m",
                        o.far_m, d->height);
    set_ends(&s->params, &o);
    set_sides(&s->params, &o);
    set_region(&s->params, set, &o);
    set_inflow(&s->params, set);
    set_camera(s, &o);
    return true;
}
