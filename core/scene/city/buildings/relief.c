// Adds relief, first near the streets in the middle, until all triangles are used.
#include "core/scene/city/buildings/relief.h"

#include <math.h>
#include <stdlib.h>

#include "core/base/alloc.h"
#include "core/base/log.h"

// A part of the relief, which is built whole or not at all.
enum part_kind { PART_BAND, PART_PIER, PART_WINDOW, PART_FRAME };
struct part {
    double order; // parts with lower values come first
    int facade, kind, bay, floor;
};

enum { BAND_FACES = 3, END_FACES = 2, PIER_FACES = 3, SILL_FACES = 5, BAR_FACES = 3 };
enum { WINDOW_FACES = 2 * SILL_FACES + 2 * BAR_FACES, FRAME_FACES = 4 * BAR_FACES };

// A box on the facade's plane: front and some sides, no back.
enum { SIDE_LEFT = 1, SIDE_RIGHT = 2, SIDE_LOWER = 4, SIDE_UPPER = 8 };
struct bar {
    double u0, u1, y0, y1, back, front;
};

static void build_bar(struct city_builder *b, const struct city_facade *f, const struct bar *r,
                      int sides, const struct look *look, const uint32_t *painted)
{
    point back[4], front[4]; // lower left, lower right, upper right, upper left
    const double u[4] = {r->u0, r->u1, r->u1, r->u0}, y[4] = {r->y0, r->y0, r->y1, r->y1};
    for (int i = 0; i < 4; i++) {
        back[i] = city_facade_at(f, u[i], y[i], r->back);
        front[i] = city_facade_at(f, u[i], y[i], r->front);
    }
    if (painted)
        city_quad_on(b, front, *painted);
    else
        city_quad(b, front[0], front[1], front[2], front[3], look);
    const int which[4] = {SIDE_LOWER, SIDE_RIGHT, SIDE_UPPER, SIDE_LEFT};
    for (int i = 0; i < 4; i++)
        if (sides & which[i])
            city_quad(b, back[i], back[(i + 1) % 4], front[(i + 1) % 4], front[i], look);
}

// The wall between the windows of one floor and those of the next.
static void build_band(struct city_builder *b, const struct city_facade *f, int floor)
{
    const double top = f->y0 + f->height_m, y = f->y0 + floor * f->floor_m;
    const struct bar r = {0,
                          f->length,
                          fmax(f->y0, y - (1 - f->style.top) * f->floor_m),
                          fmin(top, y + f->style.bottom * f->floor_m),
                          f->core,
                          f->front};
    // Without posts at its ends, the ends are visible.
    const int ends = b->settings.size == CITY_FULL ? 0 : SIDE_LEFT | SIDE_RIGHT;
    build_bar(b, f, &r, ends | SIDE_LOWER | SIDE_UPPER, &f->wall, &f->painted);
}

static void build_pier(struct city_builder *b, const struct city_facade *f, int bay)
{
    const double u = bay * f->bay_m;
    const struct bar r = {u - (1 - f->style.right) * f->bay_m,
                          u + f->style.left * f->bay_m,
                          f->y0,
                          f->y0 + f->height_m,
                          f->core,
                          f->front + 0.02};
    build_bar(b, f, &r, SIDE_LEFT | SIDE_RIGHT, &f->wall, &f->painted);
}

static void build_window(struct city_builder *b, const struct city_facade *f, int bay, int floor)
{
    const struct look frame = {PAINT_METAL, SCENERY_KIND_METAL, 1, 0, 0};
    const struct facade_style *s = &f->style;
    const double u0 = (bay + s->left) * f->bay_m, u1 = (bay + s->right) * f->bay_m;
    const double y0 = f->y0 + (floor + s->bottom) * f->floor_m;
    const double y1 = f->y0 + (floor + s->top) * f->floor_m;
    const double back = f->core, middle = (u0 + u1) / 2, across = y0 + 0.66 * (y1 - y0);
    const struct bar sill = {u0 - 0.08, u1 + 0.08, y0 - 0.09, y0, back, f->front + 0.12};
    const struct bar upright = {middle - 0.03, middle + 0.03, y0, y1, back, back + 0.06};
    const struct bar level = {u0, u1, across - 0.03, across + 0.03, back, back + 0.05};
    build_bar(b, f, &sill, SIDE_LEFT | SIDE_RIGHT | SIDE_LOWER | SIDE_UPPER, &f->wall, NULL);
    const struct bar lintel = {u0 - 0.06, u1 + 0.06, y1, y1 + 0.14, back, f->front + 0.07};
    build_bar(b, f, &lintel, SIDE_LEFT | SIDE_RIGHT | SIDE_LOWER | SIDE_UPPER, &f->wall, NULL);
    build_bar(b, f, &upright, SIDE_LEFT | SIDE_RIGHT, &frame, NULL);
    build_bar(b, f, &level, SIDE_LOWER | SIDE_UPPER, &frame, NULL);
}

// A frame around a window, behind its bars.
static void build_frame(struct city_builder *b, const struct city_facade *f, int bay, int floor)
{
    const struct look frame = {PAINT_METAL, SCENERY_KIND_METAL, 1, 0, 0};
    const struct facade_style *s = &f->style;
    const double u0 = (bay + s->left) * f->bay_m, u1 = (bay + s->right) * f->bay_m;
    const double y0 = f->y0 + (floor + s->bottom) * f->floor_m;
    const double y1 = f->y0 + (floor + s->top) * f->floor_m;
    const double back = f->core, front = back + 0.04, wide = 0.05;
    build_bar(b, f, &(struct bar){u0, u0 + wide, y0, y1, back, front}, SIDE_LEFT | SIDE_RIGHT,
              &frame, NULL);
    build_bar(b, f, &(struct bar){u1 - wide, u1, y0, y1, back, front}, SIDE_LEFT | SIDE_RIGHT,
              &frame, NULL);
    build_bar(b, f, &(struct bar){u0, u1, y0, y0 + wide, back, front}, SIDE_LOWER | SIDE_UPPER,
              &frame, NULL);
    build_bar(b, f, &(struct bar){u0, u1, y1 - wide, y1, back, front}, SIDE_LOWER | SIDE_UPPER,
              &frame, NULL);
}

// A thin bar of one face in front of a window, which uses up the last triangles.
static void build_rung(struct city_builder *b, const struct city_facade *f, int bay, int floor,
                       int k)
{
    const struct look frame = {PAINT_METAL, SCENERY_KIND_METAL, 1, 0, 0};
    const struct facade_style *s = &f->style;
    const double u0 = (bay + s->left) * f->bay_m, u1 = (bay + s->right) * f->bay_m;
    const double y = f->y0 + (floor + s->bottom) * f->floor_m + 0.15 * (k + 1);
    build_bar(b, f, &(struct bar){u0, u1, y, y + 0.03, f->core, f->core + 0.1}, 0, &frame, NULL);
}

static int faces_of(const struct city_builder *b, int kind)
{
    const bool ends = kind == PART_BAND && b->settings.size != CITY_FULL;
    static const int faces[] = {BAND_FACES, PIER_FACES, WINDOW_FACES, FRAME_FACES};
    return faces[kind] + (ends ? END_FACES : 0);
}

static void build_part(struct city_builder *b, const struct city_facade *f, const struct part *p)
{
    if (p->kind == PART_BAND)
        build_band(b, f, p->floor);
    else if (p->kind == PART_PIER)
        build_pier(b, f, p->bay);
    else if (p->kind == PART_WINDOW)
        build_window(b, f, p->bay, p->floor);
    else
        build_frame(b, f, p->bay, p->floor);
}

static int compare_parts(const void *a, const void *b)
{
    const struct part *x = a, *y = b;
    if (x->order != y->order)
        return x->order < y->order ? -1 : 1;
    if (x->facade != y->facade)
        return x->facade < y->facade ? -1 : 1;
    const int i = (x->kind * 1024 + x->floor) * 1024 + x->bay;
    const int k = (y->kind * 1024 + y->floor) * 1024 + y->bay;
    return i < k ? -1 : i > k;
}

// The priority of a place for relief: low places near the avenue come first.
static double order_of(const struct city_facade *f, double u, double y)
{
    const point p = city_facade_at(f, u, y, 0);
    return y + 0.5 * fabs(p.x) + 0.1 * fabs(p.z);
}

// Bands come before piers, piers before windows, windows before their frames.
static void add_part(struct part *parts, int *count, const struct city_facades *all, int facade,
                     enum part_kind kind, int bay, int floor)
{
    const struct city_facade *f = &all->facades[facade];
    const double u = kind == PART_BAND ? f->length / 2 : (bay + 0.5) * f->bay_m;
    const double order = 1000 * (double)kind + order_of(f, u, f->y0 + floor * f->floor_m);
    parts[(*count)++] = (struct part){order, facade, (int)kind, bay, floor};
}

static int list_parts(const struct city_facades *all, struct part *parts)
{
    int count = 0;
    for (int i = 0; i < all->count; i++) {
        const struct city_facade *f = &all->facades[i];
        for (int floor = 0; floor <= f->floors; floor++)
            add_part(parts, &count, all, i, PART_BAND, 0, floor);
        for (int bay = 1; bay < f->bays; bay++)
            add_part(parts, &count, all, i, PART_PIER, bay, 0);
        for (int k = 0; k < f->floors * f->bays; k++) {
            add_part(parts, &count, all, i, PART_WINDOW, k % f->bays, k / f->bays);
            add_part(parts, &count, all, i, PART_FRAME, k % f->bays, k / f->bays);
        }
    }
    return count;
}

static int most_parts(const struct city_facades *all)
{
    int most = 0;
    for (int i = 0; i < all->count; i++)
        most += 2 * (all->facades[i].floors + 1) * (all->facades[i].bays + 1);
    return most;
}

// The last faces go to the windows that came last.
static void build_rungs(struct city_builder *b, const struct city_facades *all,
                        const struct part *p, int faces)
{
    for (int i = 0; i < faces; i++)
        build_rung(b, &all->facades[p->facade], p->bay, p->floor, i);
}

void city_relief(struct city_builder *b, const struct city_facades *all, int triangles)
{
    struct part *parts =
        b->failed ? NULL : rg_alloc((size_t)most_parts(all), sizeof(*parts), "city");
    if (!parts) {
        b->failed = true;
        return;
    }
    const int count = list_parts(all, parts);
    qsort(parts, (size_t)count, sizeof(*parts), compare_parts);
    int left = (triangles - b->city->faces.triangle_count) / 2, i = 0;
    for (; i < count && faces_of(b, parts[i].kind) <= left; i++) {
        build_part(b, &all->facades[parts[i].facade], &parts[i]);
        left -= faces_of(b, parts[i].kind);
    }
    if (i < count && left >= 0)
        build_rungs(b, all, &parts[i], left);
    if (b->city->faces.triangle_count != triangles && !b->failed) {
        rg_error("city: seed %d makes %d triangles instead of %d; choose another seed",
                 b->settings.seed, b->city->faces.triangle_count, triangles);
        b->failed = true;
    }
    free(parts);
}
