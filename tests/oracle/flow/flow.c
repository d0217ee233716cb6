#include "tests/oracle/flow/flow.h"

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
        turn(frame[i], out, -s->roll_deg);    // clockwise for a viewer along -z
        turn(frame[i], right, -s->pitch_deg); // 90 turns the normal up
        turn(frame[i], up, s->yaw_deg);
    }
}

// The water's way: one or two of the eight neighbours, and its speed.
struct descent {
    int count, dx[2], dy[2];
    double share; // of the second
    double speed; // cos(alpha)
    double down[2];
};

static struct descent descent_of(const struct oracle_settings *s)
{
    double frame[3][3];
    oracle_frame(s, frame);
    // Equation 1: the matrix of tangent, binormal and normal, times gravity.
    const double g[3] = {0, -1, 0};
    double tangent[3];
    for (int i = 0; i < 3; i++)
        tangent[i] = frame[i][0] * g[0] + frame[i][1] * g[1] + frame[i][2] * g[2];
    // Equation 2: the angle between gravity and the surface.
    struct descent d = {.count = 1, .speed = hypot(tangent[0], tangent[1])};
    if (d.speed < 1e-6)
        d.speed = 0;
    memcpy(d.down, tangent, sizeof(d.down));
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
    const int texels = settings->size * settings->size;
    o->water = calloc((size_t)texels, sizeof(*o->water));
    o->kept = malloc((size_t)texels * sizeof(*o->kept));
    for (int i = 0; i < texels; i++)
        o->kept[i] = -1;
}

void oracle_close(struct oracle *o)
{
    free(o->water);
    free(o->kept);
    o->water = NULL;
    o->kept = NULL;
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

// The texel of a map under a point of a window that scrolls over the map and wraps.
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

// Puts droplets down, or counts them if they leave the pane.
static void put(struct oracle *o, int64_t *moved, int x, int y, int64_t droplets)
{
    const int n = o->settings.size;
    if (x >= 0 && y >= 0 && x < n && y < n)
        moved[y * n + x] += droplets;
    else
        o->drained += droplets;
}

// The droplets that a texel gives, by equation 3.
static int64_t given_by(const struct oracle *o, double speed, int x, int y)
{
    const struct oracle_settings *s = &o->settings;
    const int64_t droplets = o->water[y * s->size + x];
    const double water = (double)droplets / ORACLE_DROPLETS;
    const double leaves = 1 - remainder_at(s, water) * noise_at(o, x, y);
    const int64_t given = (int64_t)floor((double)droplets * leaves * speed);
    const int64_t spilled = droplets - (int64_t)(s->capacity * ORACLE_DROPLETS);
    if (!(water > s->threshold))
        return 0;
    return given < spilled ? spilled : given;
}

// The given droplets go to the next texel and the one after, as in figure 13, in each direction.
static void push(struct oracle *o, const struct descent *d, int64_t *moved, int x, int y,
                 int64_t given)
{
    const struct oracle_settings *s = &o->settings;
    const int64_t droplets = o->water[y * s->size + x];
    const double water = (double)droplets / ORACLE_DROPLETS;
    put(o, moved, x, y, droplets - given);
    int64_t second = d->count == 2 ? (int64_t)floor((double)given * d->share) : 0;
    int64_t parts[2] = {given - second, second};
    for (int i = 0; i < d->count; i++) {
        int64_t far = water > s->fast ? (int64_t)floor((double)parts[i] * s->far_share) : 0;
        put(o, moved, x + d->dx[i], y + d->dy[i], parts[i] - far);
        put(o, moved, x + 2 * d->dx[i], y + 2 * d->dy[i], far);
    }
}

// --- directions of texels ---

static const int around[8][2] = {{1, 0},  {1, 1},   {0, 1},  {-1, 1},
                                 {-1, 0}, {-1, -1}, {0, -1}, {1, -1}};

// A way, in 2048ths of a turn, leads between two of the eight neighbours.
static struct descent descent_along(int way)
{
    struct descent d = {.count = 2, .share = way % 256 / 256.0};
    for (int i = 0; i < 2; i++) {
        d.dx[i] = around[(way / 256 + i) % 8][0];
        d.dy[i] = around[(way / 256 + i) % 8][1];
    }
    return d;
}

// The sum of the unit vectors of a texel and its neighbours that moved by themselves; returns their
// number.
static int sum_movers(const struct oracle *o, int x, int y, double sum[2])
{
    const int n = o->settings.size;
    int count = 0;
    sum[0] = sum[1] = 0;
    for (int v = y > 0 ? y - 1 : 0; v <= y + 1 && v < n; v++) {
        for (int u = x > 0 ? x - 1 : 0; u <= x + 1 && u < n; u++) {
            if (o->kept[v * n + u] < 0)
                continue;
            const struct descent d = descent_along(o->kept[v * n + u]);
            const double dx = d.dx[0] * (1 - d.share) + d.dx[1] * d.share;
            const double dy = d.dy[0] * (1 - d.share) + d.dy[1] * d.share;
            sum[0] += dx / hypot(dx, dy);
            sum[1] += dy / hypot(dx, dy);
            count++;
        }
    }
    return count;
}

static int way_of(const struct oracle_settings *s, const struct descent *d, const double sum[2],
                  int count)
{
    double way[2], down[2];
    for (int i = 0; i < 2; i++) {
        down[i] = d->down[i] / d->speed;
        way[i] = count ? (1 - s->sweep) * down[i] + s->sweep * sum[i] / count : down[i];
    }
    const double *to = hypot(way[0], way[1]) < 0.01 ? down : way;
    const int parts = (int)floor(atan2(to[1], to[0]) / PI_ * 1024 + 0.5);
    return (parts + 2048) % 2048;
}

// Turns a texel towards the ways of itself and its neighbours; those that moved also sweep its
// water along.
static void sweep_from(struct oracle *o, const struct descent *d, int64_t *moved, int *next, int x,
                       int y)
{
    const struct oracle_settings *s = &o->settings;
    const int i = y * s->size + x;
    double sum[2];
    const int movers = sum_movers(o, x, y, sum);
    const int64_t own = given_by(o, d->speed, x, y);
    const int64_t swept = movers ? (int64_t)floor((double)o->water[i] * s->sweep * d->speed) : 0;
    const int way = way_of(s, d, sum, movers);
    const struct descent along = descent_along(way);
    push(o, &along, moved, x, y, own > swept ? own : swept);
    next[i] = own > 0 ? way : -1;
}

static void step_keeping(struct oracle *o, const struct descent *d, int64_t *moved)
{
    const int n = o->settings.size;
    int *next = malloc((size_t)(n * n) * sizeof(*next));
    for (int y = 0; y < n; y++)
        for (int x = 0; x < n; x++)
            sweep_from(o, d, moved, next, x, y);
    free(o->kept);
    o->kept = next;
}

static void step_together(struct oracle *o, const struct descent *d, int64_t *moved)
{
    const int n = o->settings.size;
    for (int y = 0; y < n; y++)
        for (int x = 0; x < n; x++)
            push(o, d, moved, x, y, given_by(o, d->speed, x, y));
}

void oracle_step(struct oracle *o)
{
    const int n = o->settings.size;
    const struct descent d = descent_of(&o->settings);
    int64_t *moved = calloc((size_t)n * (size_t)n, sizeof(*moved));
    (o->settings.keeps ? step_keeping : step_together)(o, &d, moved);
    free(o->water);
    o->water = moved;
    o->frame++;
}
