// The share of a shape's convex hull that the shape covers, in texels.
#include "core/techniques/flow/survey/convex.h"

#include <stdint.h>
#include <stdlib.h>

#include "core/base/alloc.h"

struct place {
    int64_t x, y;
};

static int by_row(const void *a, const void *b)
{
    const struct place *p = a, *q = b;
    return p->y != q->y ? (p->y > q->y) - (p->y < q->y) : (p->x > q->x) - (p->x < q->x);
}

// Twice the area of a triangle; above 0 if it turns one way, below if the other.
static int64_t turn(const struct place *a, const struct place *b, const struct place *c)
{
    return (b->x - a->x) * (c->y - a->y) - (b->y - a->y) * (c->x - a->x);
}

static int64_t common_divisor(int64_t a, int64_t b)
{
    return b ? common_divisor(b, a % b) : a;
}

// Adds one side of the hull to `hull`: the places in order, without those that lie inside.
static int add_side(const struct place *places, int count, int step, struct place *hull)
{
    int corners = 0;
    for (int i = 0; i < count; i++, places += step) {
        while (corners > 1 && turn(&hull[corners - 2], &hull[corners - 1], places) <= 0)
            corners--;
        hull[corners++] = *places;
    }
    return corners - 1; // the last one begins the other side
}

// Pick's theorem: places in the hull and on its rim.
static double places_in(const struct place *hull, int corners)
{
    int64_t area2 = 0, rim = 0;
    for (int i = 0; i < corners; i++) {
        const struct place *a = &hull[i], *b = &hull[(i + 1) % corners];
        area2 += a->x * b->y - a->y * b->x;
        rim += common_divisor(llabs(b->x - a->x), llabs(b->y - a->y));
    }
    return (double)llabs(area2) / 2 + (double)rim / 2 + 1;
}

double flow_convexity(const int *texels, int count, int row)
{
    struct place *places = rg_alloc((size_t)count, sizeof(*places), "survey");
    struct place *hull = rg_alloc(2 * (size_t)count, sizeof(*hull), "survey");
    double share = -1;
    for (int i = 0; places && i < count; i++)
        places[i] = (struct place){texels[i] % row, texels[i] / row};
    if (places && hull) {
        qsort(places, (size_t)count, sizeof(*places), by_row);
        int corners = add_side(places, count, 1, hull);
        corners += add_side(places + count - 1, count, -1, hull + corners);
        share = count / places_in(hull, corners);
    }
    free(places);
    free(hull);
    return share;
}
