#include <math.h>
#include <string.h>

#include "core/scene/mesh/hull.h"
#include "core/techniques/streaks/packets/inner.h"

enum { CORNERS = 8, POINTS = CORNERS + CORNERS * (CORNERS - 1) };

// An upper bound of float rounding on devices, as a share of the rain space's size.
#define ROUNDING 1e-5

static double largest_of(double a, double b, double c)
{
    return fmax(fmax(a, b), c);
}

// --- both rectangles, as Creus has it ---

static void bound(const double (*points)[2], int count, double box[4])
{
    box[0] = box[1] = INFINITY;
    box[2] = box[3] = -INFINITY;
    for (int i = 0; i < count; i++) {
        box[0] = fmin(box[0], points[i][0]);
        box[1] = fmin(box[1], points[i][1]);
        box[2] = fmax(box[2], points[i][0]);
        box[3] = fmax(box[3], points[i][1]);
    }
}

// --- the hull ---

// Cuts a convex body, given by its corners, at two planes across the fall, and finds the corners of
// the slice. They are the body's corners in it, and the points where its edges meet the planes. All
// pairs of corners are treated as edges; false edges give inner points, which the hull drops.
static int slice(const double corners[CORNERS][3], double above, double below, double (*points)[2])
{
    const double planes[2] = {above, below};
    int count = 0;
    for (int i = 0; i < CORNERS; i++) {
        if (corners[i][2] >= above && corners[i][2] <= below)
            memcpy(points[count++], corners[i], sizeof(*points));
        for (int k = 0; k < i; k++)
            for (int side = 0; side < 2; side++) {
                const double from = corners[i][2] - planes[side];
                const double to = corners[k][2] - planes[side];
                if ((from < 0) == (to < 0))
                    continue;
                const double t = from / (from - to);
                for (int axis = 0; axis < 2; axis++)
                    points[count][axis] =
                        corners[i][axis] + t * (corners[k][axis] - corners[i][axis]);
                count++;
            }
    }
    return count;
}

// Clips a polygon by Sutherland and Hodgman's method: keeps the part on one side of a line across
// an axis.
static int clip(double (*corners)[2], int count, int axis, double border, double sign)
{
    double kept[80][2];
    int size = 0;
    for (int i = 0; i < count; i++) {
        const double *a = corners[i], *b = corners[(i + 1) % count];
        const double from = sign * (a[axis] - border), to = sign * (b[axis] - border);
        if (from <= 0)
            memcpy(kept[size++], a, sizeof(*kept));
        if ((from < 0 && to > 0) || (from > 0 && to < 0)) {
            const double t = from / (from - to);
            kept[size][0] = a[0] + t * (b[0] - a[0]);
            kept[size][1] = a[1] + t * (b[1] - a[1]);
            size++;
        }
    }
    memcpy(corners, kept, (size_t)size * sizeof(*kept));
    return size;
}

static void make_hull(const struct streaks_view *view, double local_height_m, double rounding,
                      struct streaks_area *area)
{
    double points[POINTS][2], hull[2 * POINTS][2];
    const int count = slice(view->corners, view->top_m - view->above_m - rounding,
                            view->top_m + local_height_m + view->below_m + rounding, points);
    int size = rg_hull(points, count, hull);
    for (int side = 0; side < 4 && size > 0; side++)
        if (isfinite(area->prism[side]))
            size = clip(hull, size, side % 2,
                        area->prism[side] + (side < 2 ? -1 : 1) * area->margin, side < 2 ? -1 : 1);
    area->corner_count = size;
    memcpy(area->corners, hull, (size_t)size * sizeof(*hull));
}

void streaks_area_of(const struct streaks_view *view, double half_x_m, double half_y_m,
                     double local_height_m, struct streaks_area *area)
{
    memset(area, 0, sizeof(*area));
    const double rounding = ROUNDING * largest_of(half_x_m, half_y_m, local_height_m);
    area->margin = view->across_m + rounding;
    const double radius = view->radius_m + rounding;
    area->prism[0] = view->eye[0] - radius;
    area->prism[1] = view->eye[1] - radius;
    area->prism[2] = view->eye[0] + radius;
    area->prism[3] = view->eye[1] + radius;
    double points[POINTS][2], box[4];
    for (int i = 0; i < CORNERS; i++)
        memcpy(points[i], view->corners[i], sizeof(*points));
    bound(points, CORNERS, box);
    if (view->hull) {
        make_hull(view, local_height_m, rounding, area);
        bound(area->corners, area->corner_count, box);
    }
    area->left = fmax(box[0] - area->margin, area->prism[0]);
    area->top = fmax(box[1] - area->margin, area->prism[1]);
    area->right = fmin(box[2] + area->margin, area->prism[2]);
    area->bottom = fmin(box[3] + area->margin, area->prism[3]);
}

// Whether the line along an edge of the hull separates the rectangle from the hull.
static bool separates(const double a[2], const double b[2], const double box[4])
{
    const double out_x = b[1] - a[1], out_y = a[0] - b[0];
    const double x = out_x > 0 ? box[0] : box[2], y = out_y > 0 ? box[1] : box[3];
    return out_x * (x - a[0]) + out_y * (y - a[1]) > 0;
}

bool streaks_area_meets(const struct streaks_area *area, double left, double top, double right,
                        double bottom)
{
    if (!(left <= area->right && right >= area->left && top <= area->bottom && bottom >= area->top))
        return false;
    if (area->corner_count == 0)
        return true;
    const double box[4] = {
        fmax(left, area->prism[0]) - area->margin, fmax(top, area->prism[1]) - area->margin,
        fmin(right, area->prism[2]) + area->margin, fmin(bottom, area->prism[3]) + area->margin};
    for (int i = 0; i < area->corner_count; i++)
        if (separates(area->corners[i], area->corners[(i + 1) % area->corner_count], box))
            return false;
    return true;
}
