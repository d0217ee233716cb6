// Which places of the target a primitive covers, wherever a device's grid snaps its corners.
//
// Corners move by at most a step of the grid in x and y, and so does every point of an edge. A
// place that is farther than that from all edges is covered or not whatever the device does.
#include <string.h>

#include "shaders/fixed/bounds/scene.h"

// --- clipping ---

enum { PLANES = 8 };

// How far a corner lies on the kept side of a plane.
static double inside(const struct rg_scene *scene, const struct rg_corner *corner, int plane)
{
    const double *p = corner->place;
    switch (plane) {
    case 0:
        return scene->state->depth_clamp ? 1 : p[2];
    case 1:
        return scene->state->depth_clamp ? 1 : p[3] - p[2];
    case 2:
        return p[3] - 1e-6;
    case 3:
        return corner->cut;
    case 4:
        return p[3] + p[0];
    case 5:
        return p[3] - p[0];
    case 6:
        return p[3] + p[1];
    default:
        return p[3] - p[1];
    }
}

static struct rg_corner between(const struct rg_corner *a, const struct rg_corner *b, double t)
{
    struct rg_corner corner = {.cut = a->cut + (b->cut - a->cut) * t};
    for (int c = 0; c < 4; c++)
        corner.place[c] = a->place[c] + (b->place[c] - a->place[c]) * t;
    return corner;
}

// Sutherland and Hodgman: keeps what lies on a plane's side.
static int clip(const struct rg_scene *scene, int plane, int count, struct rg_corner *corners)
{
    struct rg_corner kept[3 + PLANES];
    int used = 0;
    for (int i = 0; i < count; i++) {
        const struct rg_corner *a = &corners[i], *b = &corners[(i + 1) % count];
        const double in_a = inside(scene, a, plane), in_b = inside(scene, b, plane);
        if (in_a >= 0)
            kept[used++] = *a;
        if ((in_a < 0) != (in_b < 0))
            kept[used++] = between(a, b, in_a / (in_a - in_b));
    }
    memcpy(corners, kept, (size_t)used * sizeof(*kept));
    return used;
}

// --- the outline ---

static void project(const struct rg_scene *scene, int layer, const struct rg_corner *corner,
                    double place[2])
{
    int viewport[4];
    rg_fixed_viewport(scene->state, layer, viewport);
    for (int c = 0; c < 2; c++)
        place[c] = viewport[c] + (corner->place[c] / corner->place[3] + 1) * viewport[2 + c] / 2;
}

// The farthest coordinate, which single precision holds to one part in 2^24.
static double farthest(const struct rg_scene *scene, int layer, const struct rg_corner *corners,
                       int count)
{
    double most = 0, place[2];
    for (int i = 0; i < count; i++) {
        project(scene, layer, &corners[i], place);
        most = fmax(most, fmax(fabs(place[0]), fabs(place[1])));
    }
    return most;
}

static double area_of(const struct rg_outline *outline, double *length)
{
    double area = 0;
    *length = 0;
    for (int i = 0; i < outline->count; i++) {
        const double *a = outline->corners[i], *b = outline->corners[(i + 1) % outline->count];
        area += a[0] * b[1] - b[0] * a[1];
        *length += fabs(b[0] - a[0]) + fabs(b[1] - a[1]);
    }
    return area / 2;
}

bool rg_outline_of(const struct rg_scene *scene, const struct rg_primitive *primitive,
                   struct rg_outline *outline)
{
    const double most_px = 32768; // a device clips triangles that reach farther
    struct rg_corner corners[3 + PLANES];
    int count = 3;
    memcpy(corners, primitive->corners, 3 * sizeof(*corners));
    for (int plane = 0; plane < 4 && count; plane++)
        count = clip(scene, plane, count, corners);
    outline->slack =
        scene->grid + ldexp(fmin(farthest(scene, primitive->layer, corners, count), most_px), -22);
    for (int plane = 4; plane < PLANES && count; plane++)
        count = clip(scene, plane, count, corners);
    outline->count = count;
    for (int i = 0; i < count; i++)
        project(scene, primitive->layer, &corners[i], outline->corners[i]);
    double length;
    const double area = area_of(outline, &length);
    outline->facing = fabs(area) <= length * outline->slack ? 0 : area > 0 ? 1 : -1;
    return count > 0;
}

// --- places ---

// Twice the area between an edge and a place, and by how much slack changes it.
static double edge(const struct rg_outline *outline, int i, double x, double y, double *slack)
{
    const double *a = outline->corners[i], *b = outline->corners[(i + 1) % outline->count];
    const double dx = b[0] - a[0], dy = b[1] - a[1];
    *slack = outline->slack * (fabs(dx) + fabs(dy));
    return dx * (y - a[1]) - dy * (x - a[0]);
}

static bool is_far(const struct rg_outline *outline, double x, double y)
{
    double least[2] = {INFINITY, INFINITY}, most[2] = {-INFINITY, -INFINITY};
    for (int i = 0; i < outline->count; i++)
        for (int c = 0; c < 2; c++) {
            least[c] = fmin(least[c], outline->corners[i][c]);
            most[c] = fmax(most[c], outline->corners[i][c]);
        }
    const double slack = outline->slack;
    return x < least[0] - slack || x > most[0] + slack || y < least[1] - slack ||
           y > most[1] + slack;
}

enum rg_cover rg_outline_cover(const struct rg_outline *outline, double x, double y)
{
    double length;
    const double side = area_of(outline, &length) < 0 ? -1 : 1;
    enum rg_cover cover = outline->facing ? RG_COVER_YES : RG_COVER_MAYBE;
    if (is_far(outline, x, y))
        return RG_COVER_NO;
    for (int i = 0; i < outline->count; i++) {
        double slack;
        const double distance = side * edge(outline, i, x, y, &slack);
        if (outline->facing && distance < -slack)
            return RG_COVER_NO;
        if (distance <= slack)
            cover = RG_COVER_MAYBE;
    }
    return cover;
}
