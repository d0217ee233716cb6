// Building blocks of dioramas: skins over rings of points, and boxes.
#include <math.h>
#include <stdlib.h>

#include "core/base/alloc.h"
#include "core/scene/diorama/build.h"

enum { MOST_AROUND = 96, MOST_RINGS = 64 };

static point plus(point a, double s, point b)
{
    return (point){a.x + s * b.x, a.y + s * b.y, a.z + s * b.z};
}

static point cross(point a, point b)
{
    return (point){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

static point unit(point a)
{
    const double length = sqrt(a.x * a.x + a.y * a.y + a.z * a.z);
    return (point){a.x / length, a.y / length, a.z / length};
}

void skin(struct builder *b, const point *points, int rings, int around, const point *first,
          const point *last, enum paint paint)
{
    for (int i = 0; i + 1 < rings; i++) {
        const point *low = points + i * around, *high = low + around;
        for (int j = 0; j < around; j++)
            builder_quad(b, low[j], low[(j + 1) % around], high[(j + 1) % around], high[j], paint);
    }
    const point *top = points + (rings - 1) * around;
    for (int j = 0; first && j < around; j++)
        builder_face(b, *first, points[(j + 1) % around], points[j], paint);
    for (int j = 0; last && j < around; j++)
        builder_face(b, *last, top[j], top[(j + 1) % around], paint);
}

void sheet(struct builder *b, const point *points, int across, int along, enum paint paint)
{
    const int row = across + 1;
    for (int i = 0; i < along; i++)
        for (int j = 0; j < across; j++)
            builder_quad(b, points[i * row + j], points[i * row + j + 1],
                         points[(i + 1) * row + j + 1], points[(i + 1) * row + j], paint);
}

// --- boxes ---

// A point on a box's side, from its place on the lines that divide the edges. Sides are given by
// axis and end.
static point on_side(int axis, const double at[3])
{
    const double p[3] = {at[(3 - axis) % 3], at[(4 - axis) % 3], at[(5 - axis) % 3]};
    return (point){p[0], p[1], p[2]};
}

// Moves a point of a box's surface onto the rounded one: to the distance `radius` from the inner
// box.
static point rounded(point p, point low, point high, double radius)
{
    const point inner = {fmin(fmax(p.x, low.x + radius), high.x - radius),
                         fmin(fmax(p.y, low.y + radius), high.y - radius),
                         fmin(fmax(p.z, low.z + radius), high.z - radius)};
    const point off = {p.x - inner.x, p.y - inner.y, p.z - inner.z};
    return radius > 0 ? plus(inner, radius, unit(off)) : p;
}

// The grid lines across a box along an axis: `steps` at either end, which divide the rounded edges.
static int lines_of(double low, double high, double radius, int steps, double *lines)
{
    for (int i = 0; i <= steps; i++) {
        lines[i] = low + (steps ? radius * i / steps : 0);
        lines[2 * steps + 1 - i] = high - (steps ? radius * i / steps : 0);
    }
    return 2 * steps + 2;
}

static void box_side(struct builder *b, int axis, int end, double lines[3][16], int count,
                     const point bounds[2], double radius, enum paint paint)
{
    const double *u = lines[(axis + 1) % 3], *v = lines[(axis + 2) % 3];
    const double w = lines[axis][end ? count - 1 : 0];
    for (int i = 0; i + 1 < count; i++) {
        for (int j = 0; j + 1 < count; j++) {
            point p[4];
            for (int k = 0; k < 4; k++) {
                const int across = k == 1 || k == 2, up = k >= 2;
                const double at[3] = {w, u[i + across], v[j + up]};
                p[k] = rounded(on_side(axis, at), bounds[0], bounds[1], radius);
            }
            if (end)
                builder_quad(b, p[0], p[1], p[2], p[3], paint);
            else
                builder_quad(b, p[3], p[2], p[1], p[0], paint);
        }
    }
}

void soft_box(struct builder *b, point low, point high, double radius, int steps, enum paint paint)
{
    double lines[3][16];
    const point bounds[2] = {low, high};
    const int count = lines_of(low.x, high.x, radius, steps, lines[0]);
    lines_of(low.y, high.y, radius, steps, lines[1]);
    lines_of(low.z, high.z, radius, steps, lines[2]);
    for (int axis = 0; axis < 3; axis++)
        for (int end = 0; end < 2; end++)
            box_side(b, axis, end, lines, count, bounds, radius, paint);
    builder_end(b, steps ? 180 : 30);
}

void box(struct builder *b, point low, point high, enum paint paint)
{
    soft_box(b, low, high, 0, 0, paint);
}

// --- round things ---

void lathe(struct builder *b, point at, const struct profile *profile, int count, int around,
           double crease_deg, enum paint paint)
{
    point points[MOST_RINGS * MOST_AROUND];
    const struct profile *low = profile, *high = profile + count - 1;
    const point first = {at.x, at.y + low->height, at.z}, last = {at.x, at.y + high->height, at.z};
    const bool starts = low->radius == 0, ends = high->radius == 0;
    const int from = starts ? 1 : 0, rings = count - from - (ends ? 1 : 0);
    for (int i = 0; i < rings; i++)
        for (int j = 0; j < around; j++)
            points[i * around + j] =
                (point){at.x + profile[from + i].radius * sine(360.0 * j / around),
                        at.y + profile[from + i].height,
                        at.z + profile[from + i].radius * cosine(360.0 * j / around)};
    skin(b, points, rings, around, starts ? &first : NULL, ends ? &last : NULL, paint);
    builder_end(b, crease_deg);
}

void ring(struct builder *b, point at, double radius, double wire, int along, int around,
          enum paint paint)
{
    struct profile profile[MOST_RINGS];
    for (int i = 0; i <= along; i++) {
        const double turn = 360.0 * (i % along) / along;
        profile[i] = (struct profile){radius + wire * cosine(turn), wire * sine(turn)};
    }
    lathe(b, at, profile, along + 1, around, 180, paint);
}

// A ring's two directions across a bar, continued from the ring before.
struct across {
    point side, up;
};

static struct across carried(point way, point side)
{
    const double along = side.x * way.x + side.y * way.y + side.z * way.z;
    struct across a;
    a.side = unit(plus(side, -along, way));
    a.up = cross(way, a.side);
    return a;
}

static point way_at(const point *points, int count, int i)
{
    const point before = points[i > 0 ? i - 1 : 0], behind = points[i + 1 < count ? i + 1 : i];
    return unit(plus(behind, -1, before));
}

void bar(struct builder *b, const point *points, int count, double radius0, double radius1,
         int around, enum paint paint)
{
    point skinned[MOST_RINGS * MOST_AROUND];
    const point way = way_at(points, count, 0);
    const point beside = fabs(way.y) < 0.9 ? (point){0, 1, 0} : (point){1, 0, 0};
    struct across a = carried(way, beside);
    for (int i = 0; i < count; i++) {
        const double radius = radius0 + (radius1 - radius0) * i / (count - 1);
        a = carried(way_at(points, count, i), a.side);
        for (int j = 0; j < around; j++) {
            const double turn = 360.0 * j / around;
            skinned[i * around + j] =
                plus(plus(points[i], radius * cosine(turn), a.side), radius * sine(turn), a.up);
        }
    }
    skin(b, skinned, count, around, &points[0], &points[count - 1], paint);
    builder_end(b, 180);
}

void ball(struct builder *b, point at, point radii, int rings, int around, double dent, uint32_t id,
          enum paint paint)
{
    point points[MOST_RINGS * MOST_AROUND];
    const point first = {at.x, at.y - radii.y, at.z}, last = {at.x, at.y + radii.y, at.z};
    for (int i = 1; i < rings; i++) {
        for (int j = 0; j < around; j++) {
            const double up = 180.0 * i / rings - 90, turn = 360.0 * j / around;
            const double out = 1 + dent * (2 * chance(id, (uint32_t)(i * around + j)) - 1);
            points[(i - 1) * around + j] = (point){
                at.x + radii.x * out * cosine(up) * sine(turn), at.y + radii.y * out * sine(up),
                at.z + radii.z * out * cosine(up) * cosine(turn)};
        }
    }
    skin(b, points, rings - 1, around, &first, &last, paint);
    builder_end(b, 180);
}

void prism(struct builder *b, const struct spot *outline, int count, double z0, double z1,
           enum paint paint)
{
    point points[2 * MOST_AROUND];
    struct spot middle = {0, 0};
    for (int i = 0; i < count; i++) {
        points[i] = (point){outline[i].x, outline[i].y, z0};
        points[count + i] = (point){outline[i].x, outline[i].y, z1};
        middle.x += outline[i].x / count;
        middle.y += outline[i].y / count;
    }
    skin(b, points, 2, count, &(point){middle.x, middle.y, z0}, &(point){middle.x, middle.y, z1},
         paint);
    builder_end(b, 30);
}

void puddle(struct builder *b, point at, double radius_x, double radius_z, int rings, int around,
            double wave, uint32_t id, enum paint paint)
{
    point points[MOST_RINGS * MOST_AROUND];
    for (int i = 0; i < rings; i++) {
        for (int j = 0; j < around; j++) {
            const double share = 1.0 - (double)i / rings, turn = 360.0 * j / around;
            const double out = share * (1 + wave * (sine(2 * turn + 360 * chance(id, 0)) +
                                                    0.6 * sine(3 * turn + 360 * chance(id, 1))));
            points[i * around + j] = (point){at.x + radius_x * out * sine(turn), at.y,
                                             at.z + radius_z * out * cosine(turn)};
        }
    }
    skin(b, points, rings, around, NULL, &at, paint);
    builder_end(b, 180);
}
