#include "tests/oracle/raster.h"

#include <math.h>
#include <stdlib.h>

// --- exact integers ---

static int64_t cross(struct oracle_point a, struct oracle_point b, struct oracle_point c)
{
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

static struct oracle_point centre_of(int px, int py)
{
    return (struct oracle_point){256 * (int64_t)px + 128, 256 * (int64_t)py + 128};
}

// A centre is inside if the number of edges to its right is odd. The centre counts as a trifle
// lower than its integer, so an edge is met if one end is below it. It also counts as a greater
// trifle further right, so an edge through it is to its left.
bool oracle_covers(const struct oracle_point *corners, int count, int px, int py)
{
    const struct oracle_point p = centre_of(px, py);
    bool inside = false;
    for (int i = 0; i < count; i++) {
        const struct oracle_point a = corners[i], b = corners[(i + 1) % count];
        if ((a.y > p.y) == (b.y > p.y))
            continue;
        const bool down = b.y > a.y;
        const int64_t side = cross(a, b, p);
        if (down ? side > 0 : side < 0)
            inside = !inside;
    }
    return inside;
}

int64_t oracle_turn(const struct oracle_point corners[3])
{
    return cross(corners[0], corners[1], corners[2]);
}

// --- distances ---

static double to_segment(double px, double py, double ax, double ay, double bx, double by)
{
    const double dx = bx - ax, dy = by - ay, square = dx * dx + dy * dy;
    double t = square > 0 ? ((px - ax) * dx + (py - ay) * dy) / square : 0;
    t = fmin(fmax(t, 0), 1);
    return hypot(px - ax - t * dx, py - ay - t * dy);
}

double oracle_outline_px(const struct oracle_point *corners, int count, int px, int py)
{
    double least = INFINITY;
    for (int i = 0; i < count; i++) {
        const struct oracle_point a = corners[i], b = corners[(i + 1) % count];
        least = fmin(least, to_segment(px + 0.5, py + 0.5, (double)a.x / 256, (double)a.y / 256,
                                       (double)b.x / 256, (double)b.y / 256));
    }
    return least;
}

double oracle_margin(const struct oracle_outline *outline, int px, int py)
{
    double least = INFINITY;
    bool inside = false;
    for (int i = 0; i < outline->count; i++) {
        const int j = (i + 1) % outline->count;
        const double ax = outline->x[i], ay = outline->y[i], bx = outline->x[j], by = outline->y[j];
        least = fmin(least, to_segment(px + 0.5, py + 0.5, ax, ay, bx, by));
        if ((ay > py + 0.5) != (by > py + 0.5) &&
            ax + (py + 0.5 - ay) * (bx - ax) / (by - ay) > px + 0.5)
            inside = !inside;
    }
    return inside ? least : -least;
}

// --- convex polygons ---

static int by_x(const void *a, const void *b)
{
    const struct oracle_place *p = a, *q = b;
    return p->x < q->x ? -1 : p->x > q->x ? 1 : p->y < q->y ? -1 : p->y > q->y;
}

static double turn_of(struct oracle_place a, struct oracle_place b, struct oracle_place c)
{
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Andrew's monotone chain: the upper chain, then the lower one.
int oracle_hull(struct oracle_place *places, int count, struct oracle_place *corners)
{
    int n = 0;
    qsort(places, (size_t)count, sizeof(*places), by_x);
    for (int chain = 0; chain < 2; chain++) {
        const int first = n;
        for (int i = 0; i < count; i++) {
            const struct oracle_place p = places[chain ? count - 1 - i : i];
            while (n >= first + 2 && turn_of(corners[n - 2], corners[n - 1], p) <= 0)
                n--;
            corners[n++] = p;
        }
        n--;
    }
    return n;
}

double oracle_inside_px(const struct oracle_place *corners, int count, struct oracle_place at)
{
    double least = INFINITY, turn = 0;
    for (int i = 2; i < count; i++)
        turn += turn_of(corners[0], corners[i - 1], corners[i]);
    for (int i = 0; i < count; i++) {
        const struct oracle_place a = corners[i], b = corners[(i + 1) % count];
        least = fmin(least, copysign(1, turn) * turn_of(a, b, at) / hypot(b.x - a.x, b.y - a.y));
    }
    return least;
}

// --- faces in clip space ---

struct oracle_face oracle_face_at(const float *matrix, const float *positions,
                                  const uint32_t face[3], int width, int height)
{
    struct oracle_face f = {.width = width, .height = height};
    for (int k = 0; k < 3; k++) {
        const float *p = positions + 3 * (uint64_t)face[k];
        for (int row = 0; row < 4; row++) {
            const float *m = matrix + 4 * row;
            f.corners[k][row] = (double)m[0] * (double)p[0] + (double)m[1] * (double)p[1] +
                                (double)m[2] * (double)p[2] + (double)m[3];
        }
    }
    return f;
}

static void add_corner(struct oracle_outline *o, const struct oracle_face *f, const double c[4])
{
    o->x[o->count] = (c[0] / c[3] + 1) / 2 * f->width;
    o->y[o->count] = (c[1] / c[3] + 1) / 2 * f->height;
    o->count++;
}

struct oracle_outline oracle_outline_of(const struct oracle_face *f)
{
    struct oracle_outline o = {.count = 0};
    for (int i = 0; i < 3; i++) {
        const double *a = f->corners[i], *b = f->corners[(i + 1) % 3];
        if (a[2] >= 0)
            add_corner(&o, f, a);
        if ((a[2] >= 0) != (b[2] >= 0)) {
            const double t = a[2] / (a[2] - b[2]);
            double cut[4];
            for (int c = 0; c < 4; c++)
                cut[c] = a[c] + t * (b[c] - a[c]);
            add_corner(&o, f, cut);
        }
    }
    for (int i = 0; i < o.count; i++) {
        const int j = (i + 1) % o.count;
        o.turn += o.x[i] * o.y[j] - o.x[j] * o.y[i];
    }
    return o;
}

static double determinant(const double a[3], const double b[3], const double c[3])
{
    return a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) +
           a[2] * (b[0] * c[1] - b[1] * c[0]);
}

// The weighted mean of the corners lies on the ray: three linear equations, by Cramer's rule.
bool oracle_hit(const struct oracle_face *f, int px, int py, struct oracle_hit *hit)
{
    const double x = 2 * (px + 0.5) / f->width - 1, y = 2 * (py + 0.5) / f->height - 1;
    double along_x[3], along_y[3];
    const double ones[3] = {1, 1, 1};
    for (int k = 0; k < 3; k++) {
        along_x[k] = f->corners[k][0] - x * f->corners[k][3];
        along_y[k] = f->corners[k][1] - y * f->corners[k][3];
    }
    const double whole = determinant(along_x, along_y, ones);
    if (whole == 0)
        return false;
    double z = 0, w = 0;
    for (int k = 0; k < 3; k++) {
        const int l = (k + 1) % 3, m = (k + 2) % 3;
        hit->weights[k] = (along_x[l] * along_y[m] - along_x[m] * along_y[l]) / whole;
        z += hit->weights[k] * f->corners[k][2];
        w += hit->weights[k] * f->corners[k][3];
    }
    hit->depth = z / w;
    return w > 0;
}
