#include "tests/oracle/drops/pane/pane.h"

#include <math.h>
#include <string.h>

static const double PI = 3.14159265358979323846, BESIDE = 0.02;

// Directions are (right, up, towards the viewer), of a camera that looks at the pane.

static void mix(const double a[3], const double b[3], double t, double to[3])
{
    for (int i = 0; i < 3; i++)
        to[i] = a[i] * (1 - t) + b[i] * t;
}

// --- the environment ---

// The camera is turned in the pane's plane, and looks up by the pane's angle from the vertical.
static void to_world(const struct pane_oracle *p, const double d[3], double world[3])
{
    const double turn = p->turn_deg * PI / 180, up = (90 - p->tilt_deg) * PI / 180;
    const double x = d[0] * cos(turn) - d[1] * sin(turn);
    const double y = d[0] * sin(turn) + d[1] * cos(turn);
    world[0] = x;
    world[1] = y * cos(up) - d[2] * sin(up);
    world[2] = y * sin(up) + d[2] * cos(up);
}

static void environment_from(const struct pane_oracle *p, const double d[3], double spread,
                             double light[3])
{
    const int last = p->environment_levels - 1;
    const double texels = spread / (PI / 2) * p->environment[0].size;
    const double level = fmin(fmax(log2(texels), 0), last);
    const int fine = (int)floor(level), coarse = fine < last ? fine + 1 : last;
    double world[3], a[3], b[3];
    to_world(p, d, world);
    light_from_cube(&p->environment[fine], world, a);
    light_from_cube(&p->environment[coarse], world, b);
    mix(a, b, level - fine, light);
}

// --- the background ---

static const float *texel(const struct pane_picture *p, int x, int y)
{
    x = x < 0 ? 0 : x >= p->width ? p->width - 1 : x;
    y = y < 0 ? 0 : y >= p->height ? p->height - 1 : y;
    return p->light + (y * p->width + x) * 3;
}

// The light between four texels, at a place of 0 to 1.
static void level_light(const struct pane_picture *p, double u, double v, double light[3])
{
    const double x = u * p->width - 0.5, y = v * p->height - 0.5;
    const int i = (int)floor(x), j = (int)floor(y);
    memset(light, 0, 3 * sizeof(*light));
    for (int corner = 0; corner < 4; corner++) {
        const int cx = i + corner % 2, cy = j + corner / 2;
        for (int c = 0; c < 3; c++)
            light[c] += (double)texel(p, cx, cy)[c] * (1 - fabs(x - cx)) * (1 - fabs(y - cy));
    }
}

// Folds a number into 0 to 1, back and forth.
static double folded(double u)
{
    return fabs(remainder(u, 2));
}

// The light from a place on the pane, which is (right, up) of its middle.
static void background_from(const struct pane_oracle *p, const double place[2], const double d[3],
                            double spread, double light[3])
{
    const double turn = p->turn_deg * PI / 180, far = p->background_mm / -d[2];
    const double x = place[0] + d[0] * far, y = place[1] + d[1] * far;
    const double wide = 2 * p->background_mm * tan(p->background_deg * PI / 360);
    const double high = wide * p->background[0].height / p->background[0].width;
    const double u = folded(0.5 + (x * cos(turn) - y * sin(turn)) / wide);
    const double v = folded(0.5 - (x * sin(turn) + y * cos(turn)) / high);
    const double texels = spread * far / -d[2] / (wide / p->background[0].width);
    const int last = p->background_levels - 1;
    const double level = fmin(fmax(log2(texels), 0), last);
    const int fine = (int)floor(level), coarse = fine < last ? fine + 1 : last;
    double a[3], b[3];
    level_light(&p->background[fine], u, v, a);
    level_light(&p->background[coarse], u, v, b);
    mix(a, b, level - fine, light);
}

static void light_along(const struct pane_oracle *p, const double place[2], const double d[3],
                        double spread, double light[3])
{
    if (p->background_levels && -d[2] > 0.02)
        background_from(p, place, d, spread, light);
    else
        environment_from(p, d, spread, light);
}

// --- a ray ---

static void through_water(const struct pane_oracle *p, const double place[2], const double d[3],
                          const struct water_surface *s, double spread, double light[3])
{
    const double flat[3] = {0, 0, -1}, front[3] = {d[0], d[1], -d[2]};
    const double steep = sqrt(1 + s->slope[0] * s->slope[0] + s->slope[1] * s->slope[1]);
    const double out[3] = {-s->slope[0] / steep, s->slope[1] / steep, -1 / steep};
    double inside[3], passed[3] = {0, 0, -1}, back[3], along = 0, seen[3][3];
    const double first = water_pass(d, flat, 1, p->index, inside);
    const double second = water_pass(inside, out, p->index, 1, passed);
    for (int i = 0; i < 3; i++)
        along += inside[i] * out[i];
    for (int i = 0; i < 3; i++)
        back[i] = inside[i] - 2 * fmax(along, 0) * out[i];
    light_along(p, place, front, spread, seen[0]);
    light_along(p, place, back, spread, seen[1]);
    light_along(p, place, passed, spread, seen[2]);
    for (int i = 0; i < 3; i++)
        light[i] =
            first * seen[0][i] + (1 - first) * (second * seen[1][i] + (1 - second) * seen[2][i]);
}

static void ray_light(const struct pane_oracle *p, double x_mm, double y_mm, double step_mm,
                      double light[3], double *margin_mm)
{
    const double wide = p->water.columns * p->water.cell_mm;
    const double high = p->water.rows * p->water.cell_mm;
    if (x_mm < 0 || y_mm < 0 || x_mm >= wide || y_mm >= high) {
        for (int i = 0; i < 3; i++)
            light[i] = BESIDE;
        return;
    }
    const double place[2] = {x_mm - wide / 2, high / 2 - y_mm};
    const double length = hypot(hypot(place[0], place[1]), p->distance_mm);
    const double d[3] = {place[0] / length, place[1] / length, -p->distance_mm / length};
    const struct water_surface s = water_surface_at(&p->water, x_mm, y_mm);
    *margin_mm = fmin(*margin_mm, fabs(s.height - p->contact_mm));
    const double spread = step_mm / p->distance_mm;
    if (s.height > p->contact_mm)
        through_water(p, place, d, &s, spread + step_mm * (p->index - 1) * s.bend, light);
    else
        light_along(p, place, d, spread, light);
}

void pane_oracle_pixel(const struct pane_oracle *p, int x, int y, double light[3],
                       double *margin_mm)
{
    const double wide = p->water.columns * p->water.cell_mm;
    const double high = p->water.rows * p->water.cell_mm;
    const double mm_px = fmax(wide / p->width, high / p->height);
    *margin_mm = INFINITY;
    memset(light, 0, 3 * sizeof(*light));
    for (int ray = 0; ray < p->rays * p->rays; ray++) {
        const double px = x + (ray % p->rays + 0.5) / p->rays - p->width / 2.0;
        const double py = y + ((double)(ray / p->rays) + 0.5) / p->rays - p->height / 2.0;
        double seen[3];
        ray_light(p, wide / 2 + px * mm_px, high / 2 + py * mm_px, mm_px / p->rays, seen,
                  margin_mm);
        for (int i = 0; i < 3; i++)
            light[i] += seen[i] / (p->rays * p->rays);
    }
}
