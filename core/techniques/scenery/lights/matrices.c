// Converts a scene's lights to their data for kernels, with the matrices of shadow maps, in double
// precision and rounded once.
#include <math.h>
#include <string.h>

#include "core/scene/matrix.h"
#include "core/scene/vector.h"
#include "core/techniques/scenery/lights/lights.h"

static const double degree = M_PI / 180;

struct axes {
    double right[3], down[3], ahead[3];
};

// Axes of a light with this direction, as upright as possible.
static struct axes axes_along(const float direction[3])
{
    struct axes axes;
    for (int c = 0; c < 3; c++)
        axes.ahead[c] = (double)direction[c];
    rg_to_unit(axes.ahead);
    const double up[3] = {fabs(axes.ahead[1]) < 0.99 ? 0 : 1, fabs(axes.ahead[1]) < 0.99 ? 1 : 0,
                          0};
    rg_cross(axes.ahead, up, axes.right);
    rg_to_unit(axes.right);
    rg_cross(axes.ahead, axes.right, axes.down);
    return axes;
}

// Sets a row whose product with a point is scale (axis . (point - from)) + offset.
static void put_row(float row[4], const double axis[3], double scale, const double from[3],
                    double offset)
{
    for (int c = 0; c < 3; c++)
        row[c] = (float)(scale * axis[c]);
    row[3] = (float)(offset - scale * rg_dot(axis, from));
}

// Corner k of the bounds.
static void corner(const float low[3], const float high[3], int k, double at[3])
{
    for (int c = 0; c < 3; c++)
        at[c] = (double)(k >> c & 1 ? high[c] : low[c]);
}

// The distance from `from` to the farthest corner of the bounds.
static double reach_of(const float low[3], const float high[3], const double from[3])
{
    double farthest = 0, at[3];
    for (int k = 0; k < 8; k++) {
        corner(low, high, k, at);
        for (int c = 0; c < 3; c++)
            at[c] -= from[c];
        farthest = fmax(farthest, sqrt(rg_dot(at, at)));
    }
    return farthest;
}

// Depth at a distance of w along a map's axis is scale + offset / w: 0 at `near`, 1 at `far`.
struct depth_scale {
    double scale, offset;
};

static struct depth_scale depth_between(double near, double far)
{
    return (struct depth_scale){far / (far - near), -far * near / (far - near)};
}

static struct depth_scale depth_from(const struct rg_light *light, const float low[3],
                                     const float high[3], const double from[3])
{
    const double near = (double)light->near_m;
    return depth_between(near, fmax(1.01 * reach_of(low, high, from), 10 * near));
}

// The map of a sun: the scene's bounds with a margin of one texel.
static float put_sun(const struct rg_light *light, const float low[3], const float high[3],
                     int map_px, float rows[4][4])
{
    static const double origin[3] = {0, 0, 0}, nothing[3] = {0, 0, 0};
    const struct axes axes = axes_along(light->direction);
    const double *const along[3] = {axes.right, axes.down, axes.ahead};
    double texel = 0;
    for (int row = 0; row < 3; row++) {
        double least = INFINITY, most = -INFINITY, at[3];
        for (int k = 0; k < 8; k++) {
            corner(low, high, k, at);
            least = fmin(least, rg_dot(along[row], at));
            most = fmax(most, rg_dot(along[row], at));
        }
        const double margin = row == 2 ? 1 : (most - least) / (map_px > 4 ? map_px - 2 : 2);
        least -= margin;
        most += margin;
        const double size = most - least;
        if (row == 2) {
            put_row(rows[row], along[row], 1 / size, origin, -least / size);
        } else {
            put_row(rows[row], along[row], 2 / size, origin, -(least + most) / size);
            texel = fmax(texel, size / map_px);
        }
    }
    put_row(rows[3], nothing, 0, origin, 1);
    return (float)texel;
}

static float put_spot(const struct rg_light *light, const float low[3], const float high[3],
                      int map_px, const double from[3], float rows[4][4])
{
    const struct axes axes = axes_along(light->direction);
    const double half_width = 1.01 * tan((double)light->outer_deg * degree);
    const struct depth_scale depth = depth_from(light, low, high, from);
    put_row(rows[0], axes.right, 1 / half_width, from, 0);
    put_row(rows[1], axes.down, 1 / half_width, from, 0);
    put_row(rows[2], axes.ahead, depth.scale, from, depth.offset);
    put_row(rows[3], axes.ahead, 1, from, 0);
    return (float)(2 * half_width / map_px);
}

static float put_point(const struct rg_light *light, const float low[3], const float high[3],
                       int map_px, const double from[3], float rows[4][4])
{
    const struct depth_scale depth = depth_from(light, low, high, from);
    for (int row = 0; row < 3; row++) { // cube maps are left-handed
        const double axis[3] = {row == 0, row == 1, row == 2};
        put_row(rows[row], axis, row == 2 ? -1 : 1, from, 0);
    }
    rows[3][0] = (float)depth.scale;
    rows[3][1] = (float)depth.offset;
    rows[3][2] = rows[3][3] = 0;
    return 2.0f / (float)map_px;
}

scenery_light scenery_light_of(const struct rg_light *light, const float low_m[3],
                               const float high_m[3], int map_px, int layer)
{
    scenery_light l = {.kind = light->kind,
                       .x = light->position_m[0],
                       .y = light->position_m[1],
                       .z = light->position_m[2],
                       .dx = light->direction[0],
                       .dy = light->direction[1],
                       .dz = light->direction[2],
                       .r = light->colour[0],
                       .g = light->colour[1],
                       .b = light->colour[2],
                       .cos_inner = (float)cos((double)light->inner_deg * degree),
                       .cos_outer = (float)cos((double)light->outer_deg * degree),
                       .shadow_layer = layer,
                       .shadow_faces = light->kind == SCENERY_POINT && layer >= 0 ? 6 : 1,
                       .shadow_bias_m = 0.05f};
    const double from[3] = {(double)l.x, (double)l.y, (double)l.z};
    float rows[4][4];
    if (light->kind == SCENERY_SUN)
        l.shadow_texel = put_sun(light, low_m, high_m, map_px, rows);
    else if (light->kind == SCENERY_SPOT)
        l.shadow_texel = put_spot(light, low_m, high_m, map_px, from, rows);
    else
        l.shadow_texel = put_point(light, low_m, high_m, map_px, from, rows);
    if (light->kind == SCENERY_SUN) // a sun's texels are wide
        l.shadow_bias_m = fmaxf(l.shadow_bias_m, l.shadow_texel);
    memcpy(&l.to_shadow, rows, sizeof(rows));
    return l;
}

// --- a light in another frame ---

scenery_light scenery_light_moved(const scenery_light *light, const float matrix[16])
{
    scenery_light l = *light;
    const struct rg_matrix m = rg_matrix_of(matrix), back = rg_matrix_back(&m);
    double place[3], way[3];
    float to_shadow[16];
    const double from[3] = {(double)l.x, (double)l.y, (double)l.z},
                 direction[3] = {(double)l.dx, (double)l.dy, (double)l.dz};
    for (int c = 0; c < 3; c++) {
        place[c] = rg_dot(m.rows[c], from) + m.rows[c][3];
        way[c] = rg_dot(m.rows[c], direction);
    }
    l.x = (float)place[0];
    l.y = (float)place[1];
    l.z = (float)place[2];
    l.dx = (float)way[0];
    l.dy = (float)way[1];
    l.dz = (float)way[2];
    rg_m4_rows(&light->to_shadow, to_shadow);
    const struct rg_matrix shadow = rg_matrix_of(to_shadow);
    struct rg_matrix moved = rg_matrix_product(&shadow, &back);
    if (l.shadow_faces == 6) // the last row is data, not part of a matrix
        memcpy(moved.rows[3], shadow.rows[3], sizeof(moved.rows[3]));
    rg_matrix_round(&moved, to_shadow);
    l.to_shadow = rg_m4_of(to_shadow);
    return l;
}

// --- from a light to clip space ---

// A face of a cube map (kernels/dialect/image/cube.h): the signed rows of the cube's frame that run
// across, down and ahead.
static const struct cube_face {
    int across, down, ahead; // 1 + row, negative for the opposite direction
} cube_faces[6] = {{-3, -2, 1}, {3, -2, -1}, {1, 3, 2}, {1, -3, -2}, {1, -2, 3}, {-1, -2, -3}};

static void copy_row(float to[4], float rows[4][4], int row)
{
    const float sign = row < 0 ? -1 : 1;
    for (int c = 0; c < 4; c++)
        to[c] = sign * rows[(row < 0 ? -row : row) - 1][c];
}

void scenery_light_to_clip(const scenery_light *light, int face, float matrix[16])
{
    float rows[4][4], clip[4][4];
    memcpy(rows, &light->to_shadow, sizeof(rows));
    memcpy(clip, rows, sizeof(clip));
    if (light->shadow_faces == 6) {
        const struct cube_face *f = &cube_faces[face];
        copy_row(clip[0], rows, f->across);
        copy_row(clip[1], rows, f->down);
        copy_row(clip[3], rows, f->ahead);
        for (int c = 0; c < 4; c++)
            clip[2][c] = light->to_shadow.wx * clip[3][c] + (c == 3 ? light->to_shadow.wy : 0);
    }
    memcpy(matrix, clip, sizeof(clip));
}
