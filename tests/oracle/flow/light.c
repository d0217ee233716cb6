#include "tests/oracle/flow/light.h"

#include <math.h>
#include <string.h>

static double face_value(const struct light_cube *cube, int face, int x, int y, int channel)
{
    const int n = cube->size;
    x = x < n ? x : n - 1;
    y = y < n ? y : n - 1;
    return (double)
        cube->light[(((size_t)face * (size_t)n + (size_t)y) * (size_t)n + (size_t)x) * 3 +
                    (size_t)channel];
}

// By OpenGL's table of cube map faces.
void light_from_cube(const struct light_cube *cube, const double d[3], double light[3])
{
    static const struct {
        int major, sign, s_axis, s_sign, t_axis, t_sign;
    } faces[6] = {{0, 1, 2, -1, 1, -1}, {0, -1, 2, 1, 1, -1}, {1, 1, 0, 1, 2, 1},
                  {1, -1, 0, 1, 2, -1}, {2, 1, 0, 1, 1, -1},  {2, -1, 0, -1, 1, -1}};
    int face = 0;
    for (int f = 1; f < 6; f++)
        if (d[faces[f].major] * faces[f].sign > d[faces[face].major] * faces[face].sign)
            face = f;
    const double major = fabs(d[faces[face].major]);
    const double s =
        (d[faces[face].s_axis] * faces[face].s_sign / major + 1) / 2 * (cube->size - 1);
    const double t =
        (d[faces[face].t_axis] * faces[face].t_sign / major + 1) / 2 * (cube->size - 1);
    const int x = (int)floor(s), y = (int)floor(t);
    for (int c = 0; c < 3; c++) {
        const double above = face_value(cube, face, x, y, c) * (1 - (s - x)) +
                             face_value(cube, face, x + 1, y, c) * (s - x);
        const double below = face_value(cube, face, x, y + 1, c) * (1 - (s - x)) +
                             face_value(cube, face, x + 1, y + 1, c) * (s - x);
        light[c] = above * (1 - (t - y)) + below * (t - y);
    }
}

double light_blurred(const struct light_surface *surface, int x, int y)
{
    const int n = surface->size;
    if (x < 0 || y < 0 || x >= n || y >= n)
        return 0;
    if (surface->sharp)
        return (double)surface->water[y * n + x] / 65536;
    int64_t sum = 0;
    for (int j = y - 1; j <= y + 1; j++)
        for (int i = x - 1; i <= x + 1; i++)
            if (i >= 0 && j >= 0 && i < n && j < n)
                sum += surface->water[j * n + i];
    return (double)sum / 9 / 65536;
}

// A texel of the normal map: the normal's x and y in steps of 1/2047, wetness in steps of 1/255.
static void normal_texel(const struct light_surface *w, int x, int y, double normal[3])
{
    const int n = w->size;
    memset(normal, 0, 3 * sizeof(*normal));
    if (x < 0 || y < 0 || x >= n || y >= n)
        return;
    const double two_texels_mm = 2 * w->pane_mm / n;
    double sx =
        (light_blurred(w, x + 1, y) - light_blurred(w, x - 1, y)) * w->relief / two_texels_mm;
    double sy =
        (light_blurred(w, x, y + 1) - light_blurred(w, x, y - 1)) * w->relief / two_texels_mm;
    double length = sqrt(sx * sx + sy * sy + 1);
    normal[0] = floor(-sx / length * 2047 + 0.5) / 2047;
    normal[1] = floor(-sy / length * 2047 + 0.5) / 2047;
    normal[2] = floor(fmin(light_blurred(w, x, y) / w->wet_height, 1) * 255 + 0.5) / 255;
}

void light_normal(const struct light_surface *surface, double u, double v, double normal[3])
{
    const double s = u * surface->size - 0.5, t = v * surface->size - 0.5;
    const int x = (int)floor(s), y = (int)floor(t);
    memset(normal, 0, 3 * sizeof(*normal));
    for (int corner = 0; corner < 4; corner++) {
        const int i = x + (corner & 1), j = y + (corner >> 1);
        double texel[3];
        normal_texel(surface, i, j, texel);
        double weight = (1 - fabs(s - i)) * (1 - fabs(t - j));
        for (int c = 0; c < 3; c++)
            normal[c] += weight * texel[c];
    }
}

double light_reflectance(const struct light_fresnel *f, const double view[3],
                         const double normal[3])
{
    double towards = 0, length = 0;
    for (int i = 0; i < 3; i++) {
        towards += view[i] * normal[i];
        length += view[i] * view[i];
    }
    const double grazing = fmin(fmax(1 + towards / sqrt(length), 0), 1);
    return fmin(f->bias + f->scale * pow(grazing, f->power), 1);
}
