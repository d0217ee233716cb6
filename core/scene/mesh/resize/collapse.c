// Edges collapse in rounds, cheapest first, by the quadric error of M. Garland and P. Heckbert,
// "Surface Simplification Using Quadric Error Metrics" (1997). In a round no two collapses touch
// the same faces, so that each is judged by what is there.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/scene/mesh/resize/resize.h"

enum { NONE = -1, QUADRIC = 10 };

// Planes' weight at a border, which keeps it where it is, and of length, which decides where the
// surface is flat.
#define BORDER_WEIGHT 10.0
#define LENGTH_WEIGHT 1e-5
// The cosine by which a face may turn.
#define LEAST_TURN 0.2
// How much dearer than the last that is needed a collapse may be in the same round.
#define SLACK 1.5

struct collapse {
    double cost;
    uint32_t from, to;
};

struct state {
    const float *positions;
    size_t vertex_count;
    uint32_t *indices;
    int face_count, wanted;
    double (*quadrics)[QUADRIC]; // by vertex: xx xy xz xw yy yz yw zz zw ww of weighted planes
    double *weights;             // by vertex: of its planes
    uint32_t *first;             // by vertex: its faces in `around`, one more at the end
    uint32_t *around;            // faces
    int *seen;                   // by vertex: the last vertex whose neighbour it was, or NONE
    bool *touched, *fixed;       // by vertex: in this round; more than two faces share an edge
    bool *border;                // by vertex
    struct collapse *collapses;
};

static void position_of(const struct state *s, uint32_t vertex, double p[3])
{
    for (int c = 0; c < 3; c++)
        p[c] = (double)s->positions[3 * (size_t)vertex + (size_t)c];
}

// The normal of a triangle, as long as twice its area.
static void cross_of(const double a[3], const double b[3], const double c[3], double n[3])
{
    for (int i = 0; i < 3; i++) {
        const int j = (i + 1) % 3, k = (i + 2) % 3;
        n[i] = (b[j] - a[j]) * (c[k] - a[k]) - (b[k] - a[k]) * (c[j] - a[j]);
    }
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// --- quadrics ---

static void add_plane(struct state *s, uint32_t vertex, const double n[3], const double on[3],
                      double weight)
{
    const double plane[4] = {n[0], n[1], n[2], -dot(n, on)};
    double *q = s->quadrics[vertex];
    for (int i = 0; i < 4; i++)
        for (int j = i; j < 4; j++)
            *q++ += weight * plane[i] * plane[j];
    s->weights[vertex] += weight;
}

static double error_at(const double q[QUADRIC], const double p[3])
{
    return q[0] * p[0] * p[0] + q[4] * p[1] * p[1] + q[7] * p[2] * p[2] + q[9] +
           2 * (q[1] * p[0] * p[1] + q[2] * p[0] * p[2] + q[5] * p[1] * p[2] + q[3] * p[0] +
                q[6] * p[1] + q[8] * p[2]);
}

static bool make_unit(double n[3], double *length)
{
    *length = sqrt(dot(n, n));
    for (int i = 0; i < 3 && *length > 0; i++)
        n[i] /= *length;
    return *length > 0;
}

// The plane of each face, and through each side at a border one that is upright on the face.
static void add_face(struct state *s, const uint32_t corner[3])
{
    double p[3][3], n[3], length;
    for (int k = 0; k < 3; k++)
        position_of(s, corner[k], p[k]);
    cross_of(p[0], p[1], p[2], n);
    if (!make_unit(n, &length))
        return;
    for (int k = 0; k < 3; k++)
        add_plane(s, corner[k], n, p[0], length);
}

static void add_border(struct state *s, const uint32_t corner[3], int k)
{
    const uint32_t a = corner[k], b = corner[(k + 1) % 3];
    double p[3][3], n[3], above[3], length, side2 = 0;
    for (int i = 0; i < 3; i++)
        position_of(s, corner[(k + i) % 3], p[i]);
    cross_of(p[0], p[1], p[2], n);
    if (!make_unit(n, &length))
        return;
    for (int i = 0; i < 3; i++) {
        above[i] = p[0][i] + n[i];
        side2 += (p[1][i] - p[0][i]) * (p[1][i] - p[0][i]);
    }
    cross_of(p[0], p[1], above, n);
    if (!make_unit(n, &length))
        return;
    add_plane(s, a, n, p[0], BORDER_WEIGHT * side2);
    add_plane(s, b, n, p[0], BORDER_WEIGHT * side2);
}

// --- what meets at a vertex ---

static void find_around(struct state *s)
{
    const size_t corners = 3 * (size_t)s->face_count;
    memset(s->first, 0, (s->vertex_count + 1) * sizeof(*s->first));
    for (size_t i = 0; i < corners; i++)
        s->first[s->indices[i]]++;
    for (size_t v = 0, sum = 0; v <= s->vertex_count; v++) {
        sum += v < s->vertex_count ? s->first[v] : 0;
        s->first[v] = (uint32_t)sum; // the end of its faces; filled in from there
    }
    for (size_t i = corners; i-- > 0;)
        s->around[--s->first[s->indices[i]]] = (uint32_t)(i / 3);
}

static bool has(const uint32_t corner[3], uint32_t vertex)
{
    return corner[0] == vertex || corner[1] == vertex || corner[2] == vertex;
}

// The faces that two vertices share.
static int shared(const struct state *s, uint32_t a, uint32_t b)
{
    int count = 0;
    for (uint32_t i = s->first[a]; i < s->first[a + 1]; i++)
        count += has(s->indices + 3 * (size_t)s->around[i], b);
    return count;
}

// Marks borders and what may not move; with `planes` adds those of borders.
static void find_borders(struct state *s, bool planes)
{
    memset(s->border, 0, s->vertex_count);
    memset(s->fixed, 0, s->vertex_count);
    for (int face = 0; face < s->face_count; face++) {
        const uint32_t *corner = s->indices + 3 * (size_t)face;
        for (int k = 0; k < 3; k++) {
            const uint32_t a = corner[k], b = corner[(k + 1) % 3];
            const int count = shared(s, a, b);
            if (count == 1) {
                s->border[a] = s->border[b] = true;
                if (planes)
                    add_border(s, corner, k);
            } else if (count > 2)
                s->fixed[a] = s->fixed[b] = true;
        }
    }
}

// --- one collapse ---

// Marks the neighbours of `to`, then counts those of `from` among them: if there are more than the
// faces that both share, the surface would be pinched.
static bool keeps_topology(struct state *s, uint32_t from, uint32_t to)
{
    int common = 0;
    for (uint32_t i = s->first[to]; i < s->first[to + 1]; i++)
        for (int k = 0; k < 3; k++)
            s->seen[s->indices[3 * (size_t)s->around[i] + (size_t)k]] = (int)to;
    s->seen[to] = s->seen[from] = NONE;
    for (uint32_t i = s->first[from]; i < s->first[from + 1]; i++)
        for (int k = 0; k < 3; k++) {
            int *seen = &s->seen[s->indices[3 * (size_t)s->around[i] + (size_t)k]];
            common += *seen == (int)to;
            *seen = *seen == (int)to ? NONE : *seen;
        }
    for (uint32_t i = s->first[to]; i < s->first[to + 1]; i++)
        for (int k = 0; k < 3; k++)
            s->seen[s->indices[3 * (size_t)s->around[i] + (size_t)k]] = NONE;
    return common == shared(s, from, to);
}

static bool keeps_facing(const struct state *s, uint32_t from, uint32_t to)
{
    double target[3];
    position_of(s, to, target);
    for (uint32_t i = s->first[from]; i < s->first[from + 1]; i++) {
        const uint32_t *corner = s->indices + 3 * (size_t)s->around[i];
        double before[3][3], after[3][3], n[3], m[3];
        if (has(corner, to))
            continue; // it goes
        for (int k = 0; k < 3; k++) {
            position_of(s, corner[k], before[k]);
            memcpy(after[k], corner[k] == from ? target : before[k], sizeof(after[k]));
        }
        cross_of(before[0], before[1], before[2], n);
        cross_of(after[0], after[1], after[2], m);
        if (dot(n, m) < LEAST_TURN * sqrt(dot(n, n) * dot(m, m)) ||
            (dot(m, m) <= 0 && dot(n, n) > 0))
            return false;
    }
    return true;
}

// Moves a vertex into another; the faces of both have no two equal corners before, and those that
// have them after are left out by drop_flat.
static void move(struct state *s, uint32_t from, uint32_t to)
{
    for (uint32_t i = s->first[from]; i < s->first[from + 1]; i++) {
        uint32_t *corner = s->indices + 3 * (size_t)s->around[i];
        for (int k = 0; k < 3; k++) {
            s->touched[corner[k]] = true;
            corner[k] = corner[k] == from ? to : corner[k];
        }
    }
    for (int i = 0; i < QUADRIC; i++)
        s->quadrics[to][i] += s->quadrics[from][i];
    s->weights[to] += s->weights[from];
}

static void drop_flat(struct state *s)
{
    int kept = 0;
    for (int face = 0; face < s->face_count; face++) {
        const uint32_t *c = s->indices + 3 * (size_t)face;
        if (c[0] != c[1] && c[1] != c[2] && c[2] != c[0])
            memmove(s->indices + 3 * (size_t)kept++, c, 3 * sizeof(*c));
    }
    s->face_count = kept;
}

// --- rounds ---

static double cost_of(const struct state *s, uint32_t from, uint32_t to)
{
    double p[3], q[3], length2 = 0;
    position_of(s, from, p);
    position_of(s, to, q);
    for (int c = 0; c < 3; c++)
        length2 += (p[c] - q[c]) * (p[c] - q[c]);
    const double error = error_at(s->quadrics[from], q);
    return (error > 0 ? error : 0) + LENGTH_WEIGHT * s->weights[from] * length2;
}

// A vertex of a border may only move along it.
static bool may_move(const struct state *s, uint32_t from, uint32_t to, int faces)
{
    return !s->fixed[from] && (!s->border[from] || (faces == 1 && s->border[to]));
}

static size_t find_collapses(struct state *s)
{
    size_t count = 0;
    for (int i = 0; i < 3 * s->face_count; i++) {
        const uint32_t a = s->indices[i], b = s->indices[i % 3 == 2 ? i - 2 : i + 1];
        const int faces = shared(s, a, b);
        if (a > b && faces > 1)
            continue; // its other face has it
        const bool there = may_move(s, a, b, faces), back = may_move(s, b, a, faces);
        const double cost = there ? cost_of(s, a, b) : 0, other = back ? cost_of(s, b, a) : 0;
        if (there && (!back || cost <= other))
            s->collapses[count++] = (struct collapse){cost, a, b};
        else if (back)
            s->collapses[count++] = (struct collapse){other, b, a};
    }
    return count;
}

static int compare(const void *a, const void *b)
{
    const struct collapse *x = a, *y = b;
    if (x->cost < y->cost || x->cost > y->cost)
        return x->cost < y->cost ? -1 : 1;
    if (x->from != y->from)
        return x->from < y->from ? -1 : 1;
    return x->to < y->to ? -1 : x->to > y->to;
}

// False when nothing could collapse.
static bool run_round(struct state *s)
{
    find_around(s);
    find_borders(s, false);
    const size_t count = find_collapses(s);
    const size_t needed = (size_t)(s->face_count - s->wanted) / 2;
    int left = s->face_count;
    double limit = INFINITY;
    qsort(s->collapses, count, sizeof(*s->collapses), compare);
    if (needed < count)
        limit = SLACK * s->collapses[needed].cost;
    memset(s->touched, 0, s->vertex_count);
    for (size_t i = 0; i < count && left > s->wanted; i++) {
        const struct collapse *c = &s->collapses[i];
        if (c->cost > limit && left < s->face_count)
            break;
        if (s->touched[c->from] || s->touched[c->to] || !keeps_topology(s, c->from, c->to) ||
            !keeps_facing(s, c->from, c->to))
            continue;
        left -= shared(s, c->from, c->to);
        move(s, c->from, c->to);
    }
    const bool changed = left < s->face_count;
    drop_flat(s);
    return changed;
}

static bool begin(struct state *s, const char *name)
{
    const size_t vertices = s->vertex_count, corners = 3 * (size_t)s->face_count;
    if (!(s->quadrics = rg_alloc(vertices, sizeof(*s->quadrics), name)) ||
        !(s->weights = rg_alloc(vertices, sizeof(*s->weights), name)) ||
        !(s->first = rg_alloc(vertices + 1, sizeof(*s->first), name)) ||
        !(s->around = rg_alloc(corners, sizeof(*s->around), name)) ||
        !(s->seen = rg_alloc(vertices, sizeof(*s->seen), name)) ||
        !(s->touched = rg_alloc(vertices, sizeof(*s->touched), name)) ||
        !(s->fixed = rg_alloc(vertices, sizeof(*s->fixed), name)) ||
        !(s->border = rg_alloc(vertices, sizeof(*s->border), name)) ||
        !(s->collapses = rg_alloc(corners, sizeof(*s->collapses), name)))
        return false;
    for (size_t i = 0; i < vertices; i++)
        s->seen[i] = NONE;
    drop_flat(s);
    for (int face = 0; face < s->face_count; face++)
        add_face(s, s->indices + 3 * (size_t)face);
    find_around(s);
    find_borders(s, true);
    return true;
}

int rg_resize_collapse(const struct rg_mesh *mesh, int wanted, uint32_t *indices)
{
    struct state s = {.positions = mesh->positions,
                      .vertex_count = (size_t)mesh->vertex_count,
                      .indices = indices,
                      .face_count = mesh->face_count,
                      .wanted = wanted};
    const bool begun = begin(&s, mesh->name);
    while (begun && s.face_count > wanted && run_round(&s))
        continue;
    free(s.quadrics);
    free(s.weights);
    free(s.first);
    free(s.around);
    free(s.seen);
    free(s.touched);
    free(s.fixed);
    free(s.border);
    free(s.collapses);
    return begun ? s.face_count : NONE;
}
