#include "tests/oracle/cartoon/scene.h"

#include <math.h>

static struct vec plus(struct vec a, double s, struct vec b)
{
    return (struct vec){a.x + s * b.x, a.y + s * b.y, a.z + s * b.z};
}

static struct vec cross(struct vec a, struct vec b)
{
    return (struct vec){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static double dot(struct vec a, struct vec b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static struct vec unit(struct vec a)
{
    return plus((struct vec){0, 0, 0}, 1 / sqrt(dot(a, a)), a);
}

static struct vec word(const float *array, uint32_t i)
{
    const float *v = array + 3 * (uint64_t)i;
    return (struct vec){(double)v[0], (double)v[1], (double)v[2]};
}

static double mix(double a, double b, double t)
{
    return a * (1 - t) + b * t;
}

static double clamped(double a)
{
    return fmin(fmax(a, 0), 1);
}

// --- rays ---

static struct vec ray_of(const struct scene_oracle *o, double x_px, double y_px)
{
    const double u = 2 * x_px / o->width - 1, v = 2 * y_px / o->height - 1;
    return plus(plus(o->ahead, u, o->right), v, o->down);
}

// The distance of a face along a ray, with the weights of its second and third corner (Moeller and
// Trumbore, 1997). Below 0 the ray misses the face.
static double meet(const struct scene_oracle *o, struct vec ray, int face, double weights[2])
{
    const uint32_t *k = o->indices + 3 * (uint64_t)face;
    const struct vec a = word(o->positions, k[0]);
    const struct vec u = plus(word(o->positions, k[1]), -1, a),
                     v = plus(word(o->positions, k[2]), -1, a), p = cross(ray, v);
    const double det = dot(u, p);
    if (fabs(det) < 1e-15)
        return -1;
    const struct vec t = plus(o->eye, -1, a), q = cross(t, u);
    weights[0] = dot(t, p) / det;
    weights[1] = dot(ray, q) / det;
    if (weights[0] < 0 || weights[1] < 0 || weights[0] + weights[1] > 1)
        return -1;
    return dot(v, q) / det;
}

static struct vec normal_at(const struct scene_oracle *o, struct vec ray, int face,
                            const double weights[2])
{
    const uint32_t *k = o->indices + 3 * (uint64_t)face;
    const struct vec a = word(o->positions, k[0]);
    const struct vec flat =
        cross(plus(word(o->positions, k[1]), -1, a), plus(word(o->positions, k[2]), -1, a));
    struct vec n = {0, 0, 0};
    n = plus(n, 1 - weights[0] - weights[1], word(o->normals, k[0]));
    n = plus(n, weights[0], word(o->normals, k[1]));
    n = unit(plus(n, weights[1], word(o->normals, k[2])));
    return plus((struct vec){0, 0, 0}, dot(flat, ray) > 0 ? -1 : 1, n);
}

struct scene_hit scene_cast(const struct scene_oracle *o, double x_px, double y_px)
{
    const struct vec ray = ray_of(o, x_px, y_px);
    struct scene_hit hit = {.face = -1, .ahead_m = o->far_m, .depth = 1};
    double found[2] = {0, 0};
    for (int face = 0; face < o->face_count; face++) {
        double weights[2] = {0, 0};
        const double ahead_m = meet(o, ray, face, weights);
        if (ahead_m < o->near_m || ahead_m >= hit.ahead_m)
            continue;
        hit.face = face;
        hit.ahead_m = ahead_m;
        found[0] = weights[0];
        found[1] = weights[1];
    }
    if (hit.face < 0)
        return hit;
    hit.depth = o->far_m / (o->far_m - o->near_m) * (1 - o->near_m / hit.ahead_m);
    hit.at = plus(o->eye, hit.ahead_m, ray);
    hit.normal = normal_at(o, ray, hit.face, found);
    return hit;
}

bool scene_cast_pixel(const struct scene_oracle *o, int px, int py, struct scene_hit *hit)
{
    static const double beside[4][2] = {{-1, -1}, {1, -1}, {-1, 1}, {1, 1}};
    const double x = px + 0.5, y = py + 0.5, off = 0.03; // more than a grid of 1/256 pixel
    *hit = scene_cast(o, x, y);
    for (int i = 0; i < 4; i++)
        if (scene_cast(o, x + off * beside[i][0], y + off * beside[i][1]).face != hit->face)
            return false;
    return true;
}

struct vec scene_place(const struct scene_oracle *o, int px, int py, double depth)
{
    const double ahead_m = o->near_m / (1 - depth * (o->far_m - o->near_m) / o->far_m);
    return plus(o->eye, ahead_m, ray_of(o, px + 0.5, py + 0.5));
}

// --- styles ---

double surface_highlight(const struct surface *s, const struct look *l)
{
    const double facing = dot(s->normal, l->to_light);
    const struct vec view = unit(plus(l->eye, -1, s->at));
    const struct vec mirrored =
        plus(plus((struct vec){0, 0, 0}, 2 * facing, s->normal), -1, l->to_light);
    return facing > 0 ? pow(fmax(dot(mirrored, view), 0), 32) : 0;
}

struct vec gooch_colour(const struct surface *s, const struct look *l, const struct gooch *g)
{
    const struct vec none = {0, 0, 0}, k = s->colour;
    const struct vec cool = plus((struct vec){0, 0, g->blue}, g->alpha, k);
    const struct vec warm = plus((struct vec){g->yellow, g->yellow, 0}, g->beta, k);
    const double t = (1 + dot(s->normal, l->to_light)) / 2;
    const struct vec c = plus(plus(none, 1 - t, cool), t, warm);
    const double shine = s->shine * surface_highlight(s, l);
    return (struct vec){clamped(c.x + shine), clamped(c.y + shine), clamped(c.z + shine)};
}

static double step(double value, double edge, double softness)
{
    return clamped((value - (edge - softness / 2)) / softness);
}

struct vec tones_colour(const struct surface *s, const struct look *l, const struct tones *t)
{
    const double u = fmax(dot(s->normal, l->to_light), 0);
    const double middle = step(u, t->middle_from, t->softness);
    const double lit = step(u, t->lit_from, t->softness);
    const double tone = mix(mix(t->shadow, t->middle, middle), 1, lit);
    const double glint =
        s->shine * step(s->shine * surface_highlight(s, l), t->glint_from, t->softness);
    return (struct vec){clamped(mix(s->colour.x * tone, 1, glint)),
                        clamped(mix(s->colour.y * tone, 1, glint)),
                        clamped(mix(s->colour.z * tone + t->shadow_blue * (1 - tone), 1, glint))};
}

// A byte of a level at a whole texel; levels repeat.
static double stroke(const struct hatching *h, int level, int x, int y, int tone)
{
    const int size = h->size_px >> level;
    const int column = (x % size + size) % size, row = (y % size + size) % size;
    return h->bytes[level][((int64_t)row * size + column) * 7 + tone];
}

static double level_at(const struct hatching *h, int level, double u, double v, double tones)
{
    const int size = h->size_px >> level;
    const double x = u * size - 0.5, y = v * size - 0.5;
    const int left = (int)floor(x), top = (int)floor(y);
    const int tone = tones >= 6 ? 5 : (int)tones;
    double sum = 0;
    for (int i = 0; i < 4; i++) {
        const double across = i % 2 ? x - left : 1 - (x - left);
        const double along = i / 2 ? y - top : 1 - (y - top);
        const int column = left + i % 2, row = top + i / 2;
        sum += across * along *
               mix(stroke(h, level, column, row, tone), stroke(h, level, column, row, tone + 1),
                   tones - tone);
    }
    return sum / 255;
}

struct vec hatching_colour(const struct surface *s, const struct look *l, const struct hatching *h)
{
    const struct vec n = {fabs(s->normal.x), fabs(s->normal.y), fabs(s->normal.z)};
    const bool is_level = n.y >= n.x && n.y >= n.z;
    const double u = (is_level || n.x <= n.z ? s->at.x : s->at.z) / h->tile_m;
    const double v = (is_level ? s->at.z : s->at.y) / h->tile_m;
    const struct vec view = plus(s->at, -1, l->eye);
    const double distance_m = sqrt(dot(view, view));
    const double slant = fmax(fabs(dot(view, s->normal)) / distance_m, 0.05);
    // Texels in a pixel: the geometric mean of its width and its length, which grows with the
    // slant.
    const double texels = h->size_px / h->tile_m * distance_m / h->focal_px / sqrt(slant);
    const double fine = fmin(fmax(log2(texels), 0), h->levels - 1);
    const int level = fine >= h->levels - 1 ? h->levels - 2 : (int)fine;
    const double grey = 0.3 * s->colour.x + 0.6 * s->colour.y + 0.1 * s->colour.z;
    const double light =
        mix(h->ambient, h->lit, fmax(dot(s->normal, l->to_light), 0)) * (0.5 + grey / 2);
    const double tones = 6 * clamped(light);
    const double bare =
        mix(level_at(h, level, u, v, tones), level_at(h, level + 1, u, v, tones), fine - level);
    return (struct vec){mix(h->ink.x, h->paper.x * mix(1, s->colour.x, h->wash), bare),
                        mix(h->ink.y, h->paper.y * mix(1, s->colour.y, h->wash), bare),
                        mix(h->ink.z, h->paper.z * mix(1, s->colour.z, h->wash), bare)};
}
