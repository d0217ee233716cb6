#include "tests/oracle/flow/picture.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// A normal in the pane's plane displaces the picture behind the pane by a fifth of the view's
// height; bars reflect this share of the light.
static const double LENS_REACH = 0.2, BAR_LIGHT = 0.06;

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void add(double to[3], const double a[3], double times)
{
    for (int i = 0; i < 3; i++)
        to[i] += a[i] * times;
}

static void direction_of(double azimuth_deg, double elevation_deg, double d[3])
{
    const double a = azimuth_deg * 3.14159265358979323846 / 180;
    const double e = elevation_deg * 3.14159265358979323846 / 180;
    d[0] = sin(a) * cos(e);
    d[1] = sin(e);
    d[2] = cos(a) * cos(e);
}

struct camera {
    double eye[3], right[3], down[3], ahead[3]; // of unit length
    double half;                                // half of the view's height at distance 1
    int width, height;
};

static struct camera camera_of(const struct picture_oracle *p, int width, int height)
{
    struct camera c = {.half = tan(p->view_angle_deg * 3.14159265358979323846 / 360),
                       .width = width,
                       .height = height};
    if (p->one_pane) {
        memcpy(c.right, p->box.frames[BOX_FRONT][0], sizeof(c.right));
        memcpy(c.down, p->box.frames[BOX_FRONT][1], sizeof(c.down));
        add(c.ahead, p->box.frames[BOX_FRONT][2], -1);
        return c;
    }
    double away[3];
    direction_of(p->azimuth_deg, p->elevation_deg, away);
    add(c.eye, away, p->distance);
    add(c.ahead, away, -1);
    const double level = hypot(away[0], away[2]);
    c.right[0] = away[2] / level;
    c.right[2] = -away[0] / level;
    for (int i = 0; i < 3; i++) // down = ahead x right
        c.down[i] = c.ahead[(i + 1) % 3] * c.right[(i + 2) % 3] -
                    c.ahead[(i + 2) % 3] * c.right[(i + 1) % 3];
    return c;
}

static void ray_of(const struct camera *c, int x, int y, double ray[3])
{
    memcpy(ray, c->ahead, sizeof(c->ahead));
    add(ray, c->right, (2 * (x + 0.5) - c->width) / c->height * c->half);
    add(ray, c->down, (2 * (y + 0.5) - c->height) / c->height * c->half);
}

void picture_oracle_project(const struct picture_oracle *p, int width, int height,
                            const double point[3], double pixel[2])
{
    const struct camera c = camera_of(p, width, height);
    double from_eye[3];
    memcpy(from_eye, point, sizeof(from_eye));
    add(from_eye, c.eye, -1);
    const double px = height / (2 * c.half * dot(from_eye, c.ahead));
    pixel[0] = 0.5 * width + dot(from_eye, c.right) * px;
    pixel[1] = 0.5 * height + dot(from_eye, c.down) * px;
}

static void mirrored(const double ray[3], const double normal[3], double to[3])
{
    memcpy(to, ray, 3 * sizeof(*to));
    add(to, normal, -2 * dot(ray, normal));
}

// --- the model ---

// The blurred water at the place where the way from a point inside the box to the lamp leaves the
// box.
static double water_before(const struct picture_oracle *p, const double at[3], const double lamp[3])
{
    double nearest = INFINITY, hit[3];
    int pane = 0;
    for (int i = 0; i < BOX_PANES; i++) {
        const double *n = p->box.frames[i][2];
        const double way = (1 - dot(at, n)) / dot(lamp, n);
        if (dot(lamp, n) > 0 && way < nearest) {
            nearest = way;
            pane = i;
        }
    }
    memcpy(hit, at, sizeof(hit));
    add(hit, lamp, nearest);
    const int n = p->panes[pane].size;
    const int x = (int)floor((dot(hit, p->box.frames[pane][0]) + 1) / 2 * n);
    const int y = (int)floor((dot(hit, p->box.frames[pane][1]) + 1) / 2 * n);
    return light_blurred(&p->panes[pane], x, y);
}

// The model is matt, with half the sheen of water.
static void shade_model(const struct picture_oracle *p, const double at[3], const double ray[3],
                        double light[3])
{
    double n[3], to[3], lamp[3], around[3], sheen[3];
    for (int i = 0; i < 3; i++)
        n[i] = at[i] / p->radius;
    direction_of(p->lamp_azimuth_deg, p->lamp_elevation_deg, lamp);
    mirrored(ray, n, to);
    light_from_cube(&p->ambient, n, around);
    light_from_cube(&p->reflection, to, sheen);
    const double wet = fmin(water_before(p, at, lamp) / p->panes[0].wet_height, 1);
    const double lit = p->lamp * fmax(dot(n, lamp), 0) * (1 - p->drop_shadow * wet);
    const double reflectance = light_reflectance(&p->fresnel, ray, n) / 2;
    for (int i = 0; i < 3; i++)
        light[i] = (around[i] + lit) * p->grey * (1 - reflectance) + sheen[i] * reflectance;
}

// Whether a ray meets the model; if so, `light` is the model's light.
static bool see_model(const struct picture_oracle *p, const struct camera *c, const double ray[3],
                      double light[3])
{
    const double a = dot(ray, ray), b = dot(ray, c->eye);
    const double inside = b * b - a * (dot(c->eye, c->eye) - p->radius * p->radius);
    if (p->radius <= 0 || p->one_pane || inside < 0)
        return false;
    double at[3];
    memcpy(at, c->eye, sizeof(at));
    add(at, ray, (-b - sqrt(inside)) / a);
    shade_model(p, at, ray, light);
    return true;
}

// --- panes ---

struct crossing {
    int pane;
    double u, v; // 0 to 1
    bool from_outside;
};

static bool meet(const struct picture_oracle *p, const struct camera *c, const double ray[3],
                 bool from_outside, struct crossing *at)
{
    for (int i = 0; i < BOX_PANES; i++) {
        const double(*f)[3] = p->box.frames[i];
        const double along = dot(ray, f[2]), way = (1 - dot(c->eye, f[2])) / along;
        if ((along < 0) != from_outside || way <= 0)
            continue;
        double hit[3];
        memcpy(hit, c->eye, sizeof(hit));
        add(hit, ray, way);
        *at =
            (struct crossing){i, (dot(hit, f[0]) + 1) / 2, (dot(hit, f[1]) + 1) / 2, from_outside};
        if (at->u >= 0 && at->u <= 1 && at->v >= 0 && at->v <= 1)
            return true;
    }
    return false;
}

// The water's surface: the part of its normal in the pane's plane, and the normal that faces the
// viewer.
static double surface_at(const struct picture_oracle *p, const struct crossing *at, double bend[3],
                         double normal[3])
{
    const double(*f)[3] = p->box.frames[at->pane];
    double texel[3];
    light_normal(&p->panes[at->pane], at->u, at->v, texel);
    memset(bend, 0, 3 * sizeof(*bend));
    add(bend, f[0], texel[0]);
    add(bend, f[1], texel[1]);
    memcpy(normal, bend, 3 * sizeof(*normal));
    add(normal, f[2], sqrt(fmax(1 - texel[0] * texel[0] - texel[1] * texel[1], 0)));
    if (!at->from_outside)
        for (int i = 0; i < 3; i++)
            normal[i] = -normal[i];
    if (!at->from_outside && p->mutation == PICTURE_BULGING)
        add(normal, bend, 2);
    return texel[2];
}

static bool on_bar(const struct picture_oracle *p, const struct crossing *at)
{
    return !p->one_pane && fmin(fmin(at->u, 1 - at->u), fmin(at->v, 1 - at->v)) < p->bar;
}

static double picture_value(const double *picture, const struct camera *c, int x, int y, int i)
{
    x = x < 0 ? 0 : x < c->width ? x : c->width - 1;
    y = y < 0 ? 0 : y < c->height ? y : c->height - 1;
    return picture[(y * c->width + x) * 3 + i];
}

// A picture's light between pixels, whose centres are at halves.
static void look_up(const double *picture, const struct camera *c, double x, double y,
                    double light[3])
{
    x = fmin(fmax(x, 0), c->width) - 0.5;
    y = fmin(fmax(y, 0), c->height) - 0.5;
    const int i = (int)floor(x), j = (int)floor(y);
    for (int k = 0; k < 3; k++)
        light[k] = (picture_value(picture, c, i, j, k) * (i + 1 - x) +
                    picture_value(picture, c, i + 1, j, k) * (x - i)) *
                       (j + 1 - y) +
                   (picture_value(picture, c, i, j + 1, k) * (i + 1 - x) +
                    picture_value(picture, c, i + 1, j + 1, k) * (x - i)) *
                       (y - j);
}

// Draws a pane of glass over the light so far.
static void cover(const struct picture_oracle *p, const struct camera *c, const double *behind,
                  const struct crossing *at, const double ray[3], const double pixel[2],
                  double light[3])
{
    double bend[3], normal[3], to[3], reflected[3], through[3];
    const double wetness = surface_at(p, at, bend, normal);
    const double reflectance = light_reflectance(&p->fresnel, ray, normal);
    const double far_px = p->refraction_strength * LENS_REACH * c->height;
    mirrored(ray, normal, to);
    light_from_cube(&p->reflection, to, reflected);
    look_up(behind, c, pixel[0] - dot(bend, c->right) * far_px,
            pixel[1] - dot(bend, c->down) * far_px, through);
    for (int i = 0; i < 3; i++) {
        const double water = reflected[i] * reflectance + through[i] * (1 - reflectance) * wetness;
        const double dry = (1 - reflectance) * (1 - wetness);
        light[i] = on_bar(p, at) ? BAR_LIGHT * water : water + light[i] * dry;
    }
}

// Draws water on a mirror over the picture of the dry one.
static void show_mirror(const struct picture_oracle *p, const struct camera *c,
                        const double *behind, const struct crossing *at, const double ray[3],
                        const double pixel[2], double light[3])
{
    double bend[3], normal[3], to[3], reflected[3], through[3];
    const double wetness = surface_at(p, at, bend, normal);
    const double reflectance = wetness * light_reflectance(&p->fresnel, ray, normal);
    const double far_px = p->refraction_strength * LENS_REACH * c->height;
    mirrored(ray, normal, to);
    light_from_cube(&p->reflection, to, reflected);
    look_up(behind, c, pixel[0] - dot(bend, c->right) * far_px,
            pixel[1] - dot(bend, c->down) * far_px, through);
    for (int i = 0; i < 3; i++)
        light[i] = (reflected[i] * reflectance + through[i] * (1 - reflectance)) *
                   (on_bar(p, at) ? BAR_LIGHT : 1);
}

// Pictures of everything that does not refract: `around` without the model, `behind` with it.
struct pictures {
    double *around, *behind;
};

static void draw_pixel(const struct picture_oracle *p, const struct camera *c,
                       const struct pictures *pictures, int x, int y, double light[3])
{
    double ray[3], ignored[3];
    const double pixel[2] = {x + 0.5, y + 0.5};
    ray_of(c, x, y, ray);
    struct crossing near_pane = {BOX_FRONT, pixel[0] / c->width, pixel[1] / c->height, true};
    struct crossing far_pane;
    const double *behind = pictures->behind;
    const double *around = p->mutation == PICTURE_NO_MASK ? behind : pictures->around;
    const bool near = p->one_pane || meet(p, c, ray, true, &near_pane);
    bool far = !p->one_pane && !p->mirror && meet(p, c, ray, false, &far_pane);
    memcpy(light, behind + (y * c->width + x) * 3, 3 * sizeof(*light));
    if (p->mutation != PICTURE_NO_DEPTH)
        far = far && !see_model(p, c, ray, ignored);
    if (near && p->mirror)
        show_mirror(p, c, behind, &near_pane, ray, pixel, light);
    if (near && !p->mirror && p->mutation == PICTURE_FAR_OVER_NEAR)
        cover(p, c, behind, &near_pane, ray, pixel, light);
    if (far && p->mutation != PICTURE_NO_FAR)
        cover(p, c, around, &far_pane, ray, pixel, light);
    if (near && !p->mirror && p->mutation != PICTURE_FAR_OVER_NEAR)
        cover(p, c, behind, &near_pane, ray, pixel, light);
}

// The sky, and dry mirrors in front of it.
static void see_around(const struct picture_oracle *p, const struct camera *c, int pixel,
                       double light[3])
{
    double ray[3], to[3];
    ray_of(c, pixel % c->width, pixel / c->width, ray);
    struct crossing at = {.pane = BOX_FRONT};
    const bool on_mirror = p->mirror && (p->one_pane || meet(p, c, ray, true, &at));
    mirrored(ray, p->box.frames[at.pane][2], to);
    light_from_cube(&p->environment, on_mirror ? to : ray, light);
    for (int i = 0; on_mirror && i < 3; i++)
        light[i] *= p->reflectivity;
}

void picture_oracle_draw(const struct picture_oracle *p, int width, int height, double *light)
{
    const struct camera c = camera_of(p, width, height);
    const size_t bytes = (size_t)(width * height * 3) * sizeof(double);
    const struct pictures pictures = {malloc(bytes), malloc(bytes)};
    for (int i = 0; i < width * height; i++) {
        double ray[3];
        see_around(p, &c, i, pictures.around + 3 * i);
        ray_of(&c, i % width, i / width, ray);
        if (!see_model(p, &c, ray, pictures.behind + 3 * i))
            memcpy(pictures.behind + 3 * i, pictures.around + 3 * i, 3 * sizeof(double));
    }
    for (int i = 0; i < width * height; i++)
        draw_pixel(p, &c, &pictures, i % width, i / width, light + 3 * i);
    free(pictures.around);
    free(pictures.behind);
}
