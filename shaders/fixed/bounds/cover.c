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

// Which way it turns, and whether slack of its edges decides that.
static void turn(struct rg_outline *outline)
{
    double area = 0, length = 0;
    for (int i = 0; i < outline->count; i++) {
        const double *a = outline->corners[i], *b = outline->corners[(i + 1) % outline->count];
        area += a[0] * b[1] - b[0] * a[1];
        length += fabs(b[0] - a[0]) + fabs(b[1] - a[1]);
    }
    area /= 2;
    outline->side = area < 0 ? -1 : 1;
    outline->facing = fabs(area) <= length * outline->slack ? 0 : area > 0 ? 1 : -1;
}

// What no place changes: the edges, and the box around them.
static void measure(struct rg_outline *outline)
{
    const double slack = outline->slack;
    for (int c = 0; c < 2; c++) {
        struct rg_span all = {INFINITY, -INFINITY};
        for (int i = 0; i < outline->count; i++) {
            all = rg_span_reach(all, outline->corners[i][c]);
            outline->edges[i][c] =
                outline->corners[(i + 1) % outline->count][c] - outline->corners[i][c];
        }
        outline->box[c] = rg_span_widen(all, slack);
    }
    for (int i = 0; i < outline->count; i++)
        outline->slacks[i] = slack * (fabs(outline->edges[i][0]) + fabs(outline->edges[i][1]));
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
    turn(outline);
    measure(outline);
    return count > 0;
}

// --- places ---

// Twice the area between an edge and a place.
static double edge(const struct rg_outline *outline, int i, double x, double y)
{
    const double *a = outline->corners[i], *step = outline->edges[i];
    return step[0] * (y - a[1]) - step[1] * (x - a[0]);
}

static bool is_far(const struct rg_outline *outline, double x, double y)
{
    const struct rg_span *box = outline->box;
    return x < box[0].low || x > box[0].high || y < box[1].low || y > box[1].high;
}

enum rg_cover rg_outline_cover(const struct rg_outline *outline, double x, double y)
{
    enum rg_cover cover = outline->facing ? RG_COVER_YES : RG_COVER_MAYBE;
    if (is_far(outline, x, y))
        return RG_COVER_NO;
    for (int i = 0; i < outline->count; i++) {
        const double distance = outline->side * edge(outline, i, x, y);
        const double slack = outline->slacks[i]; // by how much the edge's own changes that
        if (outline->facing && distance < -slack)
            return RG_COVER_NO;
        if (distance <= slack)
            cover = RG_COVER_MAYBE;
    }
    return cover;
}
