// Raster's camera, and what moves from frame to frame.
#include <math.h>

#include "core/scene/camera.h"
#include "core/scene/matrix.h"
#include "core/techniques/raster/raster.h"

static double radians(double degrees)
{
    return degrees / 180 * M_PI;
}

static double smaller(double a, double b)
{
    return a < b ? a : b;
}

// --- billboards ---

// How far something has fallen, modulo a box's size, as a share of it.
static float fallen(double speed_m_s, double seconds, double size_m)
{
    const double boxes = speed_m_s * seconds / size_m;
    return (float)(boxes - floor(boxes));
}

raster_streaks_params raster_streaks_at(const struct raster_settings *s, int width, int height,
                                        int64_t frame)
{
    const double seconds = (double)frame * s->step_s;
    const double speed = hypot(s->fall_m_s, s->wind_m_s);
    const double length_s = s->streak_length_mm / 1000 / speed; // time to fall a streak's length
    const double scale = 1 / tan(radians(s->view_angle_deg) / 2);
    const double near_m = 0.1, far_m = 2 * s->reach_m;
    return (raster_streaks_params){
        .count = s->billboards,
        .corner_x = (float)(-s->air_width_m / 2),
        .corner_y = (float)(-s->air_height_m / 2),
        .size_x = (float)s->air_width_m,
        .size_y = (float)s->air_height_m,
        .size_z = (float)s->reach_m,
        .fallen_x = fallen(s->wind_m_s, seconds, s->air_width_m),
        .fallen_y = fallen(s->fall_m_s, seconds, s->air_height_m),
        .streak_x = (float)(-s->wind_m_s * length_s),
        .streak_y = (float)(-s->fall_m_s * length_s),
        .radius_m = (float)(s->streak_radius_mm / 1000),
        .scale_x = (float)(scale * height / width),
        .scale_y = (float)scale,
        .depth_scale = (float)(far_m / (far_m - near_m)),
        .depth_offset = (float)(-far_m * near_m / (far_m - near_m)),
        .light = 0.7f * (float)s->opacity,
        .opacity = (float)s->opacity,
    };
}

// --- meshes ---

// Directions to the corners of a dodecahedron; the best-looking one is first.
static void direction_of(int view, double direction[3])
{
    const double golden = (1 + sqrt(5)) / 2, length = sqrt(3);
    const double a = (view & 1 ? -1 : 1), b = (view & 2 ? -1 : 1), c = (view & 4 ? -1 : 1);
    double corner[3] = {a, c, b};
    if (view >= 8) {
        const int axis = (view - 8) / 4;
        corner[axis] = 0;
        corner[(axis + 1) % 3] = a / golden;
        corner[(axis + 2) % 3] = b * golden;
    }
    for (int i = 0; i < 3; i++)
        direction[i] = corner[i] / length;
}

static struct rg_camera camera_of(const struct raster_settings *s, const struct raster_mesh *shape,
                                  int width, int height)
{
    const double angle_deg = s->inside ? 90 : 30;
    const double half = radians(angle_deg) / 2, radius = shape->radius;
    const double narrowest = atan(tan(half) * smaller(1, (double)width / height));
    const double distance = s->inside ? 0 : 1.03 * radius / sin(narrowest) / s->zoom;
    struct rg_camera camera = {
        .up = {0, 1, 0},
        .angle_deg = (float)(s->inside ? 2 * atan(tan(half) / s->zoom) / M_PI * 180 : angle_deg),
        .near_plane = (float)s->near_plane,
        .far_plane = (float)(distance + radius + s->near_plane),
    };
    double direction[3];
    direction_of(s->view, direction);
    for (int i = 0; i < 3; i++) {
        camera.position[i] = (float)(direction[i] * distance);
        camera.target[i] = s->inside ? (float)direction[i] : 0;
    }
    return camera;
}

// Lights the mesh from over the viewer's left shoulder, in the mesh's own space.
static void light(const float view[16], raster_mesh_params *p)
{
    static const double towards[3] = {-0.6, 0.6, 0.53};
    double own[3] = {0}, length = 0;
    for (int i = 0; i < 3; i++) {
        for (int row = 0; row < 3; row++)
            own[i] += (double)view[4 * row + i] * towards[row];
        length += own[i] * own[i];
    }
    length = sqrt(length);
    p->light_x = (float)(own[0] / length);
    p->light_y = (float)(own[1] / length);
    p->light_z = (float)(own[2] / length);
}

bool raster_mesh_at(const struct raster_settings *s, const struct raster_mesh *shape, int width,
                    int height, int64_t frame, raster_mesh_params *p)
{
    const struct rg_camera camera = camera_of(s, shape, width, height);
    const struct rg_placement placement = {
        .size = 2,
        .turn_deg = {0, (float)fmod((double)frame * s->turn_deg, 360), 0},
    };
    float place[16], view[16], to_clip[16];
    if (!rg_camera_matrix(&camera, (float)width / (float)height, to_clip) ||
        !rg_camera_view(&camera, view))
        return false;
    rg_place(shape->low, shape->high, &placement, place);
    rg_matrix_multiply(to_clip, place, to_clip);
    rg_matrix_multiply(view, place, view);
    const float shift = (float)(2 * s->shift_px / width);
    for (int i = 0; i < 4; i++)
        to_clip[i] += shift * to_clip[12 + i];
    p->to_clip = rg_m4_of(to_clip);
    light(view, p);
    p->ambient = 0.15f;
    return true;
}

// --- quads ---

raster_quads_params raster_quads_at(const struct raster_settings *s, int width, int height,
                                    int64_t frame)
{
    return (raster_quads_params){
        .aspect = (float)width / (float)height,
        .turned = (float)radians(fmod((double)frame * s->turn_deg, 360)),
    };
}
