#include "tests/oracle/flow_oracle.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double PI_ = 3.14159265358979323846;

// --- the pane in the world: x right, y up, z towards the viewer ---

// Turns `v` about the unit axis `k` by an angle, right-handed (Rodrigues).
static void turn(double v[3], const double k[3], double degrees)
{
    const double c = cos(degrees * PI_ / 180), s = sin(degrees * PI_ / 180);
    const double along = (k[0] * v[0] + k[1] * v[1] + k[2] * v[2]) * (1 - c);
    const double turned[3] = {v[0] * c + (k[1] * v[2] - k[2] * v[1]) * s + k[0] * along,
                              v[1] * c + (k[2] * v[0] - k[0] * v[2]) * s + k[1] * along,
                              v[2] * c + (k[0] * v[1] - k[1] * v[0]) * s + k[2] * along};
    memcpy(v, turned, sizeof(turned));
}

void oracle_frame(const struct oracle_settings *s, double frame[3][3])
{
    static const double rest[3][3] = {{1, 0, 0}, {0, -1, 0}, {0, 0, 1}};
    static const double right[3] = {1, 0, 0}, up[3] = {0, 1, 0}, out[3] = {0, 0, 1};
    for (int i = 0; i < 3; i++) {
        memcpy(frame[i], rest[i], sizeof(rest[i]));
        turn(frame[i], out, -s->roll_deg);    // clockwise, as one sees it who looks along -z
        turn(frame[i], right, -s->pitch_deg); // 90 turns the normal up
        turn(frame[i], up, s->yaw_deg);
    }
}

// Where water goes: one or two of the eight neighbours, and how fast.
struct descent {
    int count, dx[2], dy[2];
    double share; // of the second
    double speed; // cos(alpha)
};

static struct descent descent_of(const struct oracle_settings *s)
{
    double frame[3][3];
    oracle_frame(s, frame);
    // Equation 1, the matrix of tangent, binormal and normal times gravity.
    const double g[3] = {0, -1, 0};
    double tangent[3];
    for (int i = 0; i < 3; i++)
        tangent[i] = frame[i][0] * g[0] + frame[i][1] * g[1] + frame[i][2] * g[2];
    // Equation 2: the angle between gravity and the surface.
    struct descent d = {.count = 1, .speed = hypot(tangent[0], tangent[1])};
    if (d.speed < 1e-6)
        d.speed = 0;
    double degrees = atan2(tangent[1], tangent[0]) * 180 / PI_;
    double first = s->split ? 45 * floor((degrees + 1e-7) / 45) : 45 * floor(degrees / 45 + 0.5);
    for (int i = 0; i < 2; i++) {
        d.dx[i] = (int)lround(cos((first + 45 * i) * PI_ / 180) * 1.2);
        d.dy[i] = (int)lround(sin((first + 45 * i) * PI_ / 180) * 1.2);
    }
    if (s->split) {
        d.count = 2;
        d.share = fmax((degrees - first) / 45, 0);
    }
    return d;
}

// --- water ---

void oracle_open(struct oracle *o, const struct oracle_settings *settings)
{
    *o = (struct oracle){.settings = *settings};
    o->water = calloc((size_t)settings->size * (size_t)settings->size, sizeof(*o->water));
}

void oracle_close(struct oracle *o)
{
    free(o->water);
    o->water = NULL;
}

void oracle_land(struct oracle *o, double x, double y, double radius, double height)
{
    const int n = o->settings.size;
    const int64_t capacity = (int64_t)(o->settings.capacity * ORACLE_DROPLETS);
    for (int j = 0; j < n; j++) {
        for (int i = 0; i < n; i++) {
            double off = hypot(i + 0.5 - x, j + 0.5 - y) / radius;
            if (off >= 1)
                continue;
            int64_t added = (int64_t)floor(height * sqrt(1 - off * off) * ORACLE_DROPLETS);
            int64_t *water = &o->water[j * n + i];
            if (added > capacity - *water)
                added = capacity > *water ? capacity - *water : 0;
            *water += added;
            o->sourced += added;
        }
    }
}

// A map's texel under a point of a window that scrolls over it and wraps.
static int wrapped(double scrolled, double window, int i, int size, int map_size)
{
    double begin = (scrolled - floor(scrolled)) * map_size;
    return (int)floor(begin + window * map_size * i / size) % map_size;
}

static double noise_at(const struct oracle *o, int x, int y)
{
    const struct oracle_settings *s = &o->settings;
    int nx =
        wrapped(s->noise_scroll_x * (double)o->frame, s->noise_window, x, s->size, s->noise_size);
    int ny =
        wrapped(s->noise_scroll_y * (double)o->frame, s->noise_window, y, s->size, s->noise_size);
    return (double)s->noise[ny * s->noise_size + nx];
}

static double remainder_at(const struct oracle_settings *s, double water)
{
    const int last = s->remainder_entries - 1;
    double entry = floor(water / s->remainder_max_height * last + 0.5);
    return (double)s->remainder[entry > last ? last : (int)entry];
}

// Puts droplets down, or counts them where they leave the pane.
static void put(struct oracle *o, int64_t *moved, int x, int y, int64_t droplets)
{
    const int n = o->settings.size;
    if (x >= 0 && y >= 0 && x < n && y < n)
        moved[y * n + x] += droplets;
    else
        o->drained += droplets;
}

// One texel's part of equation 3, as figure 13 extends it.
static void flow_from(struct oracle *o, const struct descent *d, int64_t *moved, int x, int y)
{
    const struct oracle_settings *s = &o->settings;
    const int64_t droplets = o->water[y * s->size + x];
    const double water = (double)droplets / ORACLE_DROPLETS;
    double leaves = 1 - remainder_at(s, water) * noise_at(o, x, y);
    int64_t given = (int64_t)floor((double)droplets * leaves * d->speed);
    int64_t spilled = droplets - (int64_t)(s->capacity * ORACLE_DROPLETS);
    if (given < spilled)
        given = spilled;
    if (!(water > s->threshold))
        given = 0;
    put(o, moved, x, y, droplets - given);
    int64_t second = d->count == 2 ? (int64_t)floor((double)given * d->share) : 0;
    int64_t parts[2] = {given - second, second};
    for (int i = 0; i < d->count; i++) {
        int64_t far = water > s->fast ? (int64_t)floor((double)parts[i] * s->far_share) : 0;
        put(o, moved, x + d->dx[i], y + d->dy[i], parts[i] - far);
        put(o, moved, x + 2 * d->dx[i], y + 2 * d->dy[i], far);
    }
}

void oracle_step(struct oracle *o)
{
    const int n = o->settings.size;
    const struct descent d = descent_of(&o->settings);
    int64_t *moved = calloc((size_t)n * (size_t)n, sizeof(*moved));
    for (int y = 0; y < n; y++)
        for (int x = 0; x < n; x++)
            flow_from(o, &d, moved, x, y);
    free(o->water);
    o->water = moved;
    o->frame++;
}

// --- light ---

// The blurred height; beyond the edge the pane is dry.
static double blurred_at(const struct oracle *o, int x, int y)
{
    const int n = o->settings.size;
    if (x < 0 || y < 0 || x >= n || y >= n)
        return 0;
    int64_t sum = 0;
    for (int j = y - 1; j <= y + 1; j++)
        for (int i = x - 1; i <= x + 1; i++)
            if (i >= 0 && j >= 0 && i < n && j < n)
                sum += o->water[j * n + i];
    return (double)sum / 9 / ORACLE_DROPLETS;
}

// A texel of the normal map: the normal's x and y in steps of 1/2047, wetness in steps of 1/255.
static void normal_texel(const struct oracle *o, const struct oracle_lighting *l, int x, int y,
                         double normal[3])
{
    const int n = o->settings.size;
    memset(normal, 0, 3 * sizeof(*normal));
    if (x < 0 || y < 0 || x >= n || y >= n)
        return;
    const double two_texels_mm = 2 * l->pane_mm / n;
    double sx = (blurred_at(o, x + 1, y) - blurred_at(o, x - 1, y)) * l->relief / two_texels_mm;
    double sy = (blurred_at(o, x, y + 1) - blurred_at(o, x, y - 1)) * l->relief / two_texels_mm;
    double length = sqrt(sx * sx + sy * sy + 1);
    normal[0] = floor(-sx / length * 2047 + 0.5) / 2047;
    normal[1] = floor(-sy / length * 2047 + 0.5) / 2047;
    normal[2] = floor(fmin(blurred_at(o, x, y) / l->wet_height, 1) * 255 + 0.5) / 255;
}

static void normal_between(const struct oracle *o, const struct oracle_lighting *l, double s,
                           double t, double normal[3])
{
    const int x = (int)floor(s), y = (int)floor(t);
    memset(normal, 0, 3 * sizeof(*normal));
    for (int corner = 0; corner < 4; corner++) {
        const int i = x + (corner & 1), j = y + (corner >> 1);
        double texel[3];
        normal_texel(o, l, i, j, texel);
        double weight = (1 - fabs(s - i)) * (1 - fabs(t - j));
        for (int c = 0; c < 3; c++)
            normal[c] += weight * texel[c];
    }
}

static double face_value(const struct oracle_cube *cube, int face, int x, int y, int channel)
{
    const int n = cube->size;
    x = x < 0 ? 0 : x < n ? x : n - 1;
    y = y < 0 ? 0 : y < n ? y : n - 1;
    return (double)
        cube->light[(((size_t)face * (size_t)n + (size_t)y) * (size_t)n + (size_t)x) * 3 +
                    (size_t)channel];
}

// The environment from a direction in the world: OpenGL's table of cube map faces.
static void environment_at(const struct oracle_cube *cube, const double d[3], double light[3])
{
    static const struct {
        int major, sign, s_axis, s_sign, t_axis, t_sign;
    } faces[6] = {{0, 1, 2, -1, 1, -1}, {0, -1, 2, 1, 1, -1}, {1, 1, 0, 1, 2, 1},
                  {1, -1, 0, 1, 2, -1}, {2, 1, 0, 1, 1, -1},  {2, -1, 0, -1, 1, -1}};
    int face = 0;
    for (int f = 1; f < 6; f++)
        if (d[faces[f].major] * faces[f].sign > d[faces[face].major] * faces[face].sign)
            face = f;
    const int n = cube->size;
    const double major = fabs(d[faces[face].major]);
    double s = (d[faces[face].s_axis] * faces[face].s_sign / major + 1) / 2 * n;
    double t = (d[faces[face].t_axis] * faces[face].t_sign / major + 1) / 2 * n;
    // Between four texels of the face; at its edges its own texels go on.
    s -= 0.5;
    t -= 0.5;
    const int x = (int)floor(s), y = (int)floor(t);
    for (int c = 0; c < 3; c++) {
        const double above = face_value(cube, face, x, y, c) * (1 - (s - x)) +
                             face_value(cube, face, x + 1, y, c) * (s - x);
        const double below = face_value(cube, face, x, y + 1, c) * (1 - (s - x)) +
                             face_value(cube, face, x + 1, y + 1, c) * (s - x);
        light[c] = above * (1 - (t - y)) + below * (t - y);
    }
}

static void light_from(const struct oracle *o, const struct oracle_cube *cube,
                       const double tangent[3], double light[3])
{
    double frame[3][3], world[3];
    oracle_frame(&o->settings, frame);
    for (int i = 0; i < 3; i++)
        world[i] = tangent[0] * frame[0][i] + tangent[1] * frame[1][i] + tangent[2] * frame[2][i];
    environment_at(cube, world, light);
}

// One pixel whose view has this direction in the pane's frame.
static void shade(const struct oracle *o, const struct oracle_lighting *l, const double view[3],
                  const double texel[3], double light[3])
{
    const double nx = texel[0], ny = texel[1], wetness = texel[2];
    const double n[3] = {nx, ny, sqrt(fmax(1 - nx * nx - ny * ny, 0))};
    const double towards = view[0] * n[0] + view[1] * n[1] + view[2] * n[2];
    const double length = sqrt(view[0] * view[0] + view[1] * view[1] + view[2] * view[2]);
    double grazing = fmin(fmax(1 + towards / length, 0), 1);
    double fresnel = fmin(l->fresnel_bias + l->fresnel_scale * pow(grazing, l->fresnel_power), 1);
    double mirrored[3], reflected[3], refracted[3];
    for (int i = 0; i < 3; i++)
        mirrored[i] = view[i] - 2 * towards * n[i];
    // The dry mirror's reflection, bent by the normal.
    const double bent[3] = {view[0] - nx * l->refraction_strength,
                            view[1] - ny * l->refraction_strength, -view[2]};
    light_from(o, &l->reflection, mirrored, reflected);
    light_from(o, &l->environment, bent, refracted);
    for (int i = 0; i < 3; i++)
        light[i] = wetness * fresnel * reflected[i] +
                   (1 - wetness * fresnel) * l->reflectivity * refracted[i];
}

void oracle_draw(const struct oracle *o, const struct oracle_lighting *l, int width, int height,
                 double *light)
{
    const double half = tan(l->view_angle_deg / 2 * PI_ / 180);
    for (int y = 0; y < height; y++) {
        for (int x = 0; x < width; x++) {
            const double u = (x + 0.5) / width, v = (y + 0.5) / height;
            const double view[3] = {(2 * u - 1) * half * width / height, (2 * v - 1) * half, -1};
            double texel[3];
            normal_between(o, l, u * o->settings.size - 0.5, v * o->settings.size - 0.5, texel);
            shade(o, l, view, texel, light + ((size_t)y * (size_t)width + (size_t)x) * 3);
        }
    }
}
