#include "core/techniques/scenery/cull.h"

#include <math.h>

// --- outside, and turned away ---

// The eye in homogeneous coordinates: for parallel rays w is 0, and the rest points towards smaller
// depth.
static void find_eye(const m4 *m, double eye[4])
{
    const double r[3][4] = {{(double)m->xx, (double)m->xy, (double)m->xz, (double)m->xw},
                            {(double)m->yx, (double)m->yy, (double)m->yz, (double)m->yw},
                            {(double)m->wx, (double)m->wy, (double)m->wz, (double)m->ww}};
    for (int i = 0; i < 4; i++) {
        const int a = (i + 1) % 4, b = (i + 2) % 4, c = (i + 3) % 4;
        const double det = r[0][a] * (r[1][b] * r[2][c] - r[1][c] * r[2][b]) -
                           r[0][b] * (r[1][a] * r[2][c] - r[1][c] * r[2][a]) +
                           r[0][c] * (r[1][a] * r[2][b] - r[1][b] * r[2][a]);
        eye[i] = i % 2 ? det : -det;
    }
    const double depth = (double)m->zx * eye[0] + (double)m->zy * eye[1] + (double)m->zz * eye[2];
    const double turn = fabs(eye[3]) > 1e-12 ? eye[3] : -depth;
    for (int i = 0; turn < 0 && i < 4; i++)
        eye[i] = -eye[i];
}

// Whether all faces of a chunk are back faces: the eye is on the back of all their planes.
static bool turns_away(const struct city_chunk *chunk, const double eye[4])
{
    double towards = 0; // for the bounds' corner whose plane is farthest back
    bool alike = false;
    for (int c = 0; c < 3; c++) {
        const double n = (double)chunk->normal[c];
        const double corner = (double)(n > 0 ? chunk->low[c] : chunk->high[c]);
        towards += n * (eye[c] - eye[3] * corner);
        alike |= n != 0;
    }
    return alike && towards < 0;
}

// A corner of bounds in clip space.
struct corner {
    float x, y, z, w;
};

static struct corner corner_of(const float low[3], const float high[3], int i, const m4 *m)
{
    const rg_corner c = m4_project(
        *m, v3_make(i & 1 ? high[0] : low[0], i & 2 ? high[1] : low[1], i & 4 ? high[2] : low[2]));
    return (struct corner){c.x, c.y, c.z, c.w};
}

// The bits of the view's sides beyond which a corner lies.
static int outside(const struct corner *c)
{
    return (c->x < -c->w) | (c->x > c->w) << 1 | (c->y < -c->w) << 2 | (c->y > c->w) << 3 |
           (c->z < 0) << 4;
}

// --- hidden ---

// A convex polygon on the view, in cells, with depth: a face of a box, beyond the near plane.
struct polygon {
    int count;
    float x[5], y[5], z[5];
};

static void add_point(struct polygon *g, const struct corner *c)
{
    g->x[g->count] = (c->x / c->w + 1) * 0.5f * SCENERY_CULL_ACROSS;
    g->y[g->count] = (c->y / c->w + 1) * 0.5f * SCENERY_CULL_DOWN;
    g->z[g->count] = c->z / c->w;
    g->count++;
}

static void clip_face(const struct corner corners[4], struct polygon *g)
{
    g->count = 0;
    for (int i = 0; i < 4; i++) {
        const struct corner *a = &corners[i], *b = &corners[(i + 1) % 4];
        if (a->z >= 0)
            add_point(g, a);
        if ((a->z >= 0) != (b->z >= 0)) {
            const float t = a->z / (a->z - b->z);
            add_point(g, &(struct corner){a->x + (b->x - a->x) * t, a->y + (b->y - a->y) * t, 0,
                                          a->w + (b->w - a->w) * t});
        }
    }
}

// Twice the area; positive if corners turn clockwise on the screen.
static float area_of(const struct polygon *g)
{
    float area = 0;
    for (int i = 1; i + 1 < g->count; i++)
        area += (g->x[i] - g->x[0]) * (g->y[i + 1] - g->y[0]) -
                (g->x[i + 1] - g->x[0]) * (g->y[i] - g->y[0]);
    return area;
}

// The interval in which a horizontal line at y crosses the polygon; false if it misses.
static bool cross(const struct polygon *g, float y, float *left, float *right)
{
    *left = INFINITY;
    *right = -INFINITY;
    for (int i = 0; i < g->count; i++) {
        const int k = (i + 1) % g->count;
        if ((g->y[i] < y && g->y[k] < y) || (g->y[i] > y && g->y[k] > y) || g->y[i] == g->y[k])
            continue;
        const float x = g->x[i] + (g->x[k] - g->x[i]) * ((y - g->y[i]) / (g->y[k] - g->y[i]));
        *left = rg_min(*left, x);
        *right = rg_max(*right, x);
    }
    return *left <= *right;
}

// In each cell that is wholly inside the polygon, hides everything beyond the polygon's farthest
// point in that cell.
static void hide(struct scenery_cull *cull, const struct polygon *g, float slack)
{
    float low = INFINITY, high = -INFINITY, farthest = 0;
    for (int i = 0; i < g->count; i++) {
        low = rg_min(low, g->y[i]);
        high = rg_max(high, g->y[i]);
        farthest = rg_max(farthest, g->z[i]);
    }
    const float area = area_of(g);
    // depth = z0 + ax (x - x0) + ay (y - y0), from the corners' largest triangle
    const float *x = g->x, *y = g->y, *z = g->z;
    float ax = 0, ay = 0, most = 0;
    for (int i = 1; i + 1 < g->count; i++) {
        const float ux = x[i] - x[0], uy = y[i] - y[0], uz = z[i] - z[0];
        const float vx = x[i + 1] - x[0], vy = y[i + 1] - y[0], vz = z[i + 1] - z[0];
        const float det = ux * vy - vx * uy;
        if (fabsf(det) > most) {
            most = fabsf(det);
            ax = (uz * vy - vz * uy) / det;
            ay = (ux * vz - vx * uz) / det;
        }
    }
    if (!(most > 1e-3f) || area == 0)
        return;
    const int first = (int)ceilf(rg_clamp(low, 0, SCENERY_CULL_DOWN)),
              end = (int)floorf(rg_clamp(high, 0, SCENERY_CULL_DOWN));
    for (int row = first; row < end; row++) {
        float l0, r0, l1, r1;
        if (!cross(g, (float)row, &l0, &r0) || !cross(g, (float)row + 1, &l1, &r1))
            continue;
        const int from = (int)ceilf(rg_clamp(rg_max(l0, l1) + slack, 0, SCENERY_CULL_ACROSS));
        const int to = (int)floorf(rg_clamp(rg_min(r0, r1) - slack, 0, SCENERY_CULL_ACROSS));
        const float at_row = z[0] + ay * ((float)row + (ay > 0 ? 1.0f : 0.0f) - y[0]);
        for (int column = from; column < to; column++) {
            const float depth =
                at_row + ax * ((float)column + (ax > 0 ? 1.0f : 0.0f) - x[0]) + 1e-6f;
            float *cell = &cull->hidden[row][column];
            *cell = rg_min(*cell, rg_min(depth, farthest + 1e-6f));
        }
    }
}

// Hides everything beyond the faces of a box that face the viewer.
static void hide_box(struct scenery_cull *cull, const struct city_box *box, const m4 *m)
{
    static const int faces[6][4] = {{0, 4, 6, 2}, {5, 1, 3, 7}, {0, 1, 5, 4},
                                    {6, 7, 3, 2}, {1, 0, 2, 3}, {4, 5, 7, 6}};
    struct corner corners[8];
    int all = 31;
    for (int i = 0; i < 8; i++) {
        corners[i] = corner_of(box->low, box->high, i, m);
        all &= outside(&corners[i]);
    }
    for (int i = 0; i < 6 && !all; i++) {
        const int *k = faces[i];
        const struct corner four[4] = {corners[k[0]], corners[k[1]], corners[k[2]], corners[k[3]]};
        struct polygon g;
        clip_face(four, &g);
        if (g.count > 2 && area_of(&g) < 0)
            hide(cull, &g, 0.01f);
    }
}

// The cell of a coordinate over w; beyond the view the outermost one.
static int cell_of(float over_w, int cells)
{
    return (int)rg_clamp((over_w + 1) * 0.5f * (float)cells, 0, (float)(cells - 1));
}

// Whether boxes hide the whole chunk.
static bool hidden(const struct scenery_cull *cull, const struct corner corners[8])
{
    float x0 = INFINITY, x1 = -INFINITY, y0 = INFINITY, y1 = -INFINITY, nearest = INFINITY;
    for (int i = 0; i < 8; i++) {
        const struct corner *c = &corners[i];
        if (!(c->z > 0 && c->w > 1e-6f))
            return false;
        x0 = rg_min(x0, c->x / c->w);
        x1 = rg_max(x1, c->x / c->w);
        y0 = rg_min(y0, c->y / c->w);
        y1 = rg_max(y1, c->y / c->w);
        nearest = rg_min(nearest, c->z / c->w);
    }
    const int first_x = cell_of(x0, SCENERY_CULL_ACROSS), last_x = cell_of(x1, SCENERY_CULL_ACROSS);
    const int first_y = cell_of(y0, SCENERY_CULL_DOWN), last_y = cell_of(y1, SCENERY_CULL_DOWN);
    for (int y = first_y; y <= last_y; y++)
        for (int x = first_x; x <= last_x; x++)
            if (cull->hidden[y][x] >= nearest)
                return false;
    return true;
}

void scenery_cull(struct scenery_cull *cull, m4 to_clip, bool backs_culled, bool *seen)
{
    const struct city_faces *f = cull->faces;
    double eye[4];
    find_eye(&to_clip, eye);
    for (int y = 0; y < SCENERY_CULL_DOWN; y++)
        for (int x = 0; x < SCENERY_CULL_ACROSS; x++)
            cull->hidden[y][x] = INFINITY;
    for (int i = 0; i < cull->box_count; i++)
        hide_box(cull, &cull->boxes[i], &to_clip);
    for (int i = 0; i < f->chunk_count; i++) {
        const struct city_chunk *chunk = &f->chunks[i];
        struct corner corners[8];
        int all = 31;
        for (int k = 0; k < 8; k++) {
            corners[k] = corner_of(chunk->low, chunk->high, k, &to_clip);
            all &= outside(&corners[k]);
        }
        seen[i] = !all && !(backs_culled && turns_away(chunk, eye)) && !hidden(cull, corners);
    }
}
