#include "tests/oracle/scenery/scene.h"

#include <math.h>

#include "tests/oracle/vectors.h"

// --- the face that a ray meets ---

static bool meet_triangle(const float *a, const float *b, const float *c, const double from[3],
                          const double way[3], bool behind, double *t)
{
    double u[3], v[3], s[3], p[3], q[3];
    for (int j = 0; j < 3; j++) {
        u[j] = (double)b[j] - (double)a[j];
        v[j] = (double)c[j] - (double)a[j];
        s[j] = from[j] - (double)a[j];
    }
    cross(way, v, p);
    const double det = dot(u, p);
    if (!(det > 1e-12 || (behind && det < -1e-12)))
        return false;
    cross(s, u, q);
    const double x = dot(s, p) / det, y = dot(way, q) / det;
    *t = dot(v, q) / det;
    return x >= 0 && y >= 0 && x + y <= 1 && *t > 0;
}

int scene_meet(const struct scene *scene, const double from[3], const double way[3], bool behind,
               double *distance)
{
    int nearest = -1;
    for (int i = 0; i < scene->face_count; i++) {
        const float *c = scene->corners + 12 * (long)i;
        double t;
        for (int k = 0; k < 2; k++) {
            if (meet_triangle(c, c + 3 + 3 * k, c + 6 + 3 * k, from, way, behind, &t) &&
                (nearest < 0 || t < *distance)) {
                nearest = i;
                *distance = t;
            }
        }
    }
    return nearest;
}

// --- the sky ---

static double grain(int x, int y)
{
    uint32_t h = (uint32_t)x * 0x9e3779b1u ^ (uint32_t)y * 0x85ebca77u;
    h = (h ^ h >> 15) * 0x2c1b3c6du;
    return ((h ^ h >> 13) & 0xffff) / 65535.0;
}

static double smooth(double t)
{
    return t * t * (3 - 2 * t);
}

static double noise(double x, double y)
{
    const int ix = (int)floor(x), iy = (int)floor(y);
    const double wx = smooth(x - ix), wy = smooth(y - iy);
    return (1 - wy) * ((1 - wx) * grain(ix, iy) + wx * grain(ix + 1, iy)) +
           wy * ((1 - wx) * grain(ix, iy + 1) + wx * grain(ix + 1, iy + 1));
}

static void see_sky(const struct scene *scene, const double way[3], double light[3])
{
    const double up = fmax(way[1], 0), share = 1 - (1 - up) * (1 - up);
    const double cloud =
        noise(1.5 * (32 + way[0] / (up + 0.08)), 2.5 * (32 + way[2] / (up + 0.08)));
    const double lit = 1 + scene->clouds * fmin(4 * up, 1) * (cloud - 0.5);
    for (int c = 0; c < 3; c++)
        light[c] = lit * ((1 - share) * scene->horizon[c] + share * scene->zenith[c]);
}

// --- a surface ---

struct surface {
    double scale[2], offset[2], normal[3], wetness, glow, tint[3];
    int texture;
    bool turned;
};

static int bits(uint32_t word, int first, int count)
{
    return (int)(word >> first & ((1u << count) - 1));
}

static double signed_half(uint32_t word, int first)
{
    const int value = bits(word, first, 16);
    return value < 32768 ? value : value - 65536;
}

static struct surface surface_of(const struct scene *scene, int face)
{
    const uint32_t *w = scene->surfaces + 4 * scene->surface_of[face];
    struct surface s = {.texture = bits(w[3], 0, 8), .turned = bits(w[3], 12, 1)};
    for (int i = 0; i < 2; i++) {
        s.scale[i] = signed_half(w[0], 16 * i) / 8192;
        s.offset[i] = signed_half(w[1], 16 * i) / 65536;
    }
    for (int i = 0; i < 3; i++)
        s.normal[i] = (bits(w[2], 10 * i, 10) - 512) / 511.0;
    s.wetness = bits(w[2], 30, 2) / 3.0;
    s.glow = bits(w[3], 13, 3) / 7.0;
    s.tint[0] = bits(w[3], 16, 5) / 31.0;
    s.tint[1] = bits(w[3], 21, 6) / 63.0;
    s.tint[2] = bits(w[3], 27, 5) / 31.0;
    return s;
}

// --- its texture ---

static int wrapped(int at, int size)
{
    return ((at % size) + size) % size;
}

// Linear light and, last, the share of the lamp behind, filtered between four texels: textures keep
// eight-bit roots of light.
static void read_texture(const struct scene *scene, int texture, int level, double u, double v,
                         double value[4])
{
    const int size = (int)fmax(scene->texture_px >> level, 1);
    const double x = u * size - 0.5, y = v * size - 0.5;
    const int left = (int)floor(x), top = (int)floor(y);
    for (int c = 0; c < 4; c++) {
        double sum = 0;
        for (int k = 0; k < 4; k++) {
            const uint32_t t =
                scene->texel(scene->user, texture, level, wrapped(left + k % 2, size),
                             wrapped(top + k / 2, size));
            sum += (k % 2 ? x - left : 1 - x + left) * (k / 2 ? y - top : 1 - y + top) *
                   bits(t, 8 * c, 8) / 255;
        }
        value[c] = c < 3 ? sum * sum : sum;
    }
}

static void paint(const struct scene *scene, const struct surface *s, const double at[3],
                  double pixel_m, double facing, double value[4], bool *unsure)
{
    const bool level_ground = fabs(s->normal[1]) > 0.7;
    double along[2] = {s->normal[2] * at[0] - s->normal[0] * at[2], at[1]};
    if (level_ground) {
        along[0] = s->turned ? at[2] : at[0];
        along[1] = s->turned ? at[0] : at[2];
    }
    const double slant = fmax(facing, 0.04), texel_m = 1.0 / scene->texture_px;
    // The geometric mean of a pixel's width and length, in texels.
    const double texels = pixel_m / texel_m * sqrt(fabs(s->scale[0] * s->scale[1]) / slant);
    const double exact = texels > 0 ? log2(texels) : 0;
    const int level = (int)clamped(floor(exact + 0.5), 0, scene->texture_levels - 1);
    *unsure |= fabs(exact + 0.5 - floor(exact + 1)) < 1e-3;
    read_texture(scene, s->texture, level, s->scale[0] * along[0] + s->offset[0],
                 s->scale[1] * along[1] + s->offset[1], value);
    for (int c = 0; c < 3; c++)
        value[c] *= s->tint[c];
}

// --- light on it ---

// The visible share of the sky, between eight points of a grid of 4 m.
static double openness(const struct scene *scene, const double at[3])
{
    const double x = clamped((at[0] + 200) / 4, 0, 100), z = clamped((at[2] + 200) / 4, 0, 100),
                 y = clamped(at[1] / 4, 0, 59 - 1e-3);
    double sum = 0;
    for (int k = 0; k < 8; k++) {
        const int ix = (int)floor(x), iy = (int)floor(y), iz = (int)floor(z);
        const uint32_t word = scene->openness[((iy + k / 4) * 101 + iz) * 101 + ix];
        sum += (k & 1 ? x - ix : 1 - x + ix) * (k & 2 ? z - iz : 1 - z + iz) *
               (k & 4 ? y - iy : 1 - y + iy) * bits(word, 8 * (k & 3), 8) / 255;
    }
    return sum;
}

// 1 if a light reaches a point, else 0; unsure if that changes within three texels of its map.
static double reached(const struct scene *scene, const struct scene_light *light,
                      const double at[3], const double normal[3], double distance, bool *unsure)
{
    enum { TRIED = 16 };
    const double margin = 3 * light->texel_m * (light->kind == ORACLE_SUN ? 1 : distance);
    int lit = 0;
    for (int k = 0; k < TRIED; k++) {
        const double aside[3] = {k & 1 ? margin : -margin, k & 2 ? margin : -margin,
                                 k & 4 ? margin : -margin};
        double from[3], way[3], t = 0;
        add(at, aside, 1, from);
        add(from, normal, (k & 8 ? margin : 0.02) - dot(aside, normal), from);
        for (int i = 0; i < 3; i++)
            way[i] = light->kind == ORACLE_SUN ? -light->way[i] : light->place_m[i] - from[i];
        const int face = scene_meet(scene, from, way, true, &t);
        lit += face < 0 || (light->kind != ORACLE_SUN && t > 1);
    }
    *unsure |= lit > 0 && lit < TRIED;
    return lit == TRIED ? 1 : 0;
}

static double cone(const struct scene_light *light, double cosine)
{
    return smooth(
        clamped((cosine - light->cos_outer) / (light->cos_inner - light->cos_outer), 0, 1));
}

double scene_film(const double normal[3], const double way[3], const double to[3], double rough)
{
    const double pi = 3.14159265358979323846, alpha2 = rough * rough;
    double half[3];
    add(to, way, -1, half);
    make_unit(half);
    const double in = dot(normal, to), out = fmax(-dot(normal, way), 1e-3);
    const double tilt2 = 1 / pow(dot(normal, half), 2) - 1;
    const double facets = alpha2 / (pi * pow(dot(normal, half), 4) * pow(alpha2 + tilt2, 2));
    const double hidden_in = (sqrt(1 + alpha2 * (1 / (in * in) - 1)) - 1) / 2;
    const double hidden_out = (sqrt(1 + alpha2 * (1 / (out * out) - 1)) - 1) / 2;
    const double fresnel = 0.02 + 0.98 * pow(1 - dot(to, half), 5);
    return pi * facets * fresnel / (1 + hidden_in + hidden_out) / (4 * in * out) * in;
}

// The share of a light that reaches a surface times its cosine, and what water on it mirrors.
static double thrown(const struct scene *scene, const struct scene_light *light,
                     const struct surface *s, const double at[3], const double way[3],
                     struct scene_pixel *pixel, double *mirrored)
{
    double to[3], share = 1;
    *mirrored = 0;
    for (int i = 0; i < 3; i++)
        to[i] = light->kind == ORACLE_SUN ? -light->way[i] : light->place_m[i] - at[i];
    const double squared = dot(to, to);
    make_unit(to);
    if (light->kind != ORACLE_SUN)
        share = 1 / fmax(squared, 0.01);
    if (light->kind == ORACLE_SPOT)
        share *= cone(light, -dot(to, light->way));
    const double facing = fmax(dot(s->normal, to), 0);
    if (share * facing == 0)
        return 0;
    if (scene->shadows &&
        !(reached(scene, light, at, s->normal, sqrt(squared), &pixel->unsure) > 0)) {
        pixel->shadowed = true;
        return 0;
    }
    const double wet = scene->wet * s->wetness;
    *mirrored =
        share * wet * scene_film(s->normal, way, to, light->kind == ORACLE_SUN ? 0.6 : 0.25);
    return share * facing;
}

struct scene_pixel scene_see(const struct scene *scene, const double from[3], const double way[3],
                             double pixel_m, double ahead)
{
    struct scene_pixel pixel = {.sky = false};
    double distance = 0, at[3], before[3], painted[4], lamps[3] = {0}, glints[3] = {0};
    const int face = scene_meet(scene, from, way, false, &distance);
    if (face < 0) {
        see_sky(scene, way, pixel.light);
        pixel.sky = true;
        return pixel;
    }
    const struct surface s = surface_of(scene, face);
    const double facing = fabs(dot(s.normal, way)), wet = scene->wet * s.wetness;
    add(from, way, distance, at);
    add(at, s.normal, 3, before);
    paint(scene, &s, at, pixel_m * distance / ahead, facing, painted, &pixel.unsure);
    for (int i = 0; i < scene->light_count; i++) {
        double mirrored;
        const double share = thrown(scene, &scene->lights[i], &s, at, way, &pixel, &mirrored);
        for (int c = 0; c < 3; c++) {
            lamps[c] += share * scene->lights[i].colour[c];
            glints[c] += mirrored * scene->lights[i].colour[c];
        }
    }
    const double open = openness(scene, before), own = (1 - 0.45 * wet) * (1 - 0.7 * painted[3]);
    const double mirrored = open * wet * (0.02 + 0.6 * pow(1 - facing, 5));
    const double haze = 1 - exp(-distance * scene->haze_per_m);
    for (int c = 0; c < 3; c++) {
        const double falls = scene->ambient * open * scene->zenith[c] +
                             scene->bounced * (1 - open) * scene->horizon[c] + lamps[c];
        const double shown = painted[c] * (own * falls + scene->glow * painted[3] + s.glow) +
                             mirrored * scene->horizon[c] + glints[c] * (1 - 0.7 * painted[3]);
        pixel.light[c] = shown + haze * (scene->horizon[c] - shown);
        pixel.slack[c] = (own * falls + scene->glow * painted[3] + s.glow) * (1 - haze) * 2 *
                         sqrt(painted[c] * s.tint[c]) * 1.5 / 255;
    }
    return pixel;
}
