// Edges collapse in rounds, cheapest first, by the quadric error of M. Garland and P. Heckbert,
// "Surface Simplification Using Quadric Error Metrics" (1997). In a round no two collapses touch
// the same faces, so that each is judged by what is there.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/scene/mesh/resize/resize.h"
#include "core/scene/vector.h"

enum { NONE = -1, QUADRIC = 10, DIGIT_BITS = 8, DIGITS = 1 << DIGIT_BITS };

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
    uint32_t faces; // at this edge
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
    struct rg_side *sides;       // sorted, as they were when the round began
    uint32_t *ends;              // by vertex: of the sides whose lower vertex it is
    uint32_t *sharing;           // by corner: the faces at the side from it to the next
    uint64_t *seen;              // by vertex: the last attempt in which it was a neighbour
    uint64_t attempts;
    bool *touched, *fixed; // by vertex: in this round; more than two faces share an edge
    bool *border;          // by vertex
    struct collapse *collapses, *sorted; // of this round; `sorted` is room
};

static void position_of(const struct state *s, uint32_t vertex, double p[3])
{
    for (int c = 0; c < 3; c++)
        p[c] = (double)s->positions[3 * (size_t)vertex + (size_t)c];
}

// The normal of a triangle, as long as twice its area.
static void normal_of(const double a[3], const double b[3], const double c[3], double n[3])
{
    double u[3], v[3];
    for (int i = 0; i < 3; i++) {
        u[i] = b[i] - a[i];
        v[i] = c[i] - a[i];
    }
    rg_cross(u, v, n);
}

// --- quadrics ---

static void add_plane(struct state *s, uint32_t vertex, const double n[3], const double on[3],
                      double weight)
{
    const double plane[4] = {n[0], n[1], n[2], -rg_dot(n, on)};
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
    *length = sqrt(rg_dot(n, n));
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
    normal_of(p[0], p[1], p[2], n);
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
    normal_of(p[0], p[1], p[2], n);
    if (!make_unit(n, &length))
        return;
    for (int i = 0; i < 3; i++) {
        above[i] = p[0][i] + n[i];
        side2 += (p[1][i] - p[0][i]) * (p[1][i] - p[0][i]);
    }
    normal_of(p[0], p[1], above, n);
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

// Sorts the sides, and counts those of each edge: a border has one, and what more than two faces
// share may not move.
static void find_sides(struct state *s)
{
    const size_t count =
        rg_resize_sides(s->indices, s->face_count, s->vertex_count, s->ends, s->sides);
    memset(s->border, 0, s->vertex_count);
    memset(s->fixed, 0, s->vertex_count);
    for (size_t i = 0, end; i < count; i = end) {
        const uint64_t key = s->sides[i].key;
        for (end = i + 1; end < count && s->sides[end].key == key;)
            end++;
        for (size_t k = i; k < end; k++)
            s->sharing[s->sides[k].corner] = (uint32_t)(end - i);
        bool *marks = end - i == 1 ? s->border : end - i > 2 ? s->fixed : NULL;
        if (marks)
            marks[key >> 32] = marks[(uint32_t)key] = true;
    }
}

// Whether two vertices are an edge's, which none of this round's collapses has touched.
static bool are_joined(const struct state *s, uint32_t a, uint32_t b)
{
    const uint64_t key = rg_side_key(a, b);
    const uint32_t lower = (uint32_t)(key >> 32), end = s->ends[lower];
    uint32_t low = lower ? s->ends[lower - 1] : 0, high = end;
    while (low < high) {
        const uint32_t middle = low + (high - low) / 2;
        if (s->sides[middle].key < key)
            low = middle + 1;
        else
            high = middle;
    }
    return low < end && s->sides[low].key == key;
}

// --- one collapse ---

// Counts the neighbours that both have: if there are more than the faces that both share, the
// surface would be pinched. It goes around the one with fewer faces, since a fan's middle may have
// them all.
static bool keeps_topology(struct state *s, const struct collapse *c)
{
    const uint32_t by_from = s->first[c->from + 1] - s->first[c->from];
    const uint32_t by_to = s->first[c->to + 1] - s->first[c->to];
    const uint32_t few = by_from < by_to ? c->from : c->to, many = few == c->to ? c->from : c->to;
    uint32_t common = 0;
    s->attempts++;
    s->seen[few] = s->seen[many] = s->attempts;
    for (uint32_t i = s->first[few]; i < s->first[few + 1]; i++)
        for (int k = 0; k < 3; k++) {
            const uint32_t vertex = s->indices[3 * (size_t)s->around[i] + (size_t)k];
            if (s->seen[vertex] != s->attempts)
                common += are_joined(s, vertex, many);
            s->seen[vertex] = s->attempts;
        }
    return common == c->faces;
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
        normal_of(before[0], before[1], before[2], n);
        normal_of(after[0], after[1], after[2], m);
        if (rg_dot(n, m) < LEAST_TURN * sqrt(rg_dot(n, n) * rg_dot(m, m)) ||
            (rg_dot(m, m) <= 0 && rg_dot(n, n) > 0))
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
static bool may_move(const struct state *s, uint32_t from, uint32_t to, uint32_t faces)
{
    return !s->fixed[from] && (!s->border[from] || (faces == 1 && s->border[to]));
}

static size_t find_collapses(struct state *s)
{
    size_t count = 0;
    for (int i = 0; i < 3 * s->face_count; i++) {
        const uint32_t a = s->indices[i], b = s->indices[i % 3 == 2 ? i - 2 : i + 1];
        const uint32_t faces = s->sharing[i];
        if (a > b && faces > 1)
            continue; // its other face has it
        const bool there = may_move(s, a, b, faces), back = may_move(s, b, a, faces);
        const double cost = there ? cost_of(s, a, b) : 0, other = back ? cost_of(s, b, a) : 0;
        if (there && (!back || cost <= other))
            s->collapses[count++] = (struct collapse){cost, a, b, faces};
        else if (back)
            s->collapses[count++] = (struct collapse){other, b, a, faces};
    }
    return count;
}

static int compare(const void *a, const void *b)
{
    const struct collapse *x = a, *y = b;
    if (x->from != y->from)
        return x->from < y->from ? -1 : 1;
    return x->to < y->to ? -1 : x->to > y->to;
}

static unsigned digit_of(const struct collapse *c, int shift)
{
    uint64_t bits;
    memcpy(&bits, &c->cost, sizeof(bits));
    return bits >> shift & (DIGITS - 1);
}

// Sorts by cost, digit by digit, since the bits of numbers from 0 on are in the numbers' order;
// then the few of one cost among themselves.
static void sort(struct state *s, size_t count)
{
    for (int shift = 0; shift < 64; shift += DIGIT_BITS) {
        size_t ends[DIGITS] = {0}, sum = 0;
        for (size_t i = 0; i < count; i++)
            ends[digit_of(&s->collapses[i], shift)]++;
        for (int digit = 0; digit < DIGITS; digit++) {
            const size_t begin = sum;
            sum += ends[digit];
            ends[digit] = begin; // until they are filled in
        }
        for (size_t i = 0; i < count; i++)
            s->sorted[ends[digit_of(&s->collapses[i], shift)]++] = s->collapses[i];
        struct collapse *other = s->collapses;
        s->collapses = s->sorted;
        s->sorted = other;
    }
    for (size_t i = 0, end; i < count; i = end) {
        for (end = i + 1; end < count && s->collapses[end].cost == s->collapses[i].cost;)
            end++;
        if (end - i > 1)
            qsort(s->collapses + i, end - i, sizeof(*s->collapses), compare);
    }
}

// False when nothing could collapse.
static bool run_round(struct state *s)
{
    find_around(s);
    find_sides(s);
    const size_t count = find_collapses(s);
    const size_t needed = (size_t)(s->face_count - s->wanted) / 2;
    int left = s->face_count;
    double limit = INFINITY;
    sort(s, count);
    if (needed < count)
        limit = SLACK * s->collapses[needed].cost;
    memset(s->touched, 0, s->vertex_count);
    for (size_t i = 0; i < count && left > s->wanted; i++) {
        const struct collapse *c = &s->collapses[i];
        if (c->cost > limit && left < s->face_count)
            break;
        if (s->touched[c->from] || s->touched[c->to] || !keeps_topology(s, c) ||
            !keeps_facing(s, c->from, c->to))
            continue;
        left -= (int)c->faces;
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
        !(s->sides = rg_alloc(corners, sizeof(*s->sides), name)) ||
        !(s->ends = rg_alloc(vertices, sizeof(*s->ends), name)) ||
        !(s->sharing = rg_alloc(corners, sizeof(*s->sharing), name)) ||
        !(s->seen = rg_alloc(vertices, sizeof(*s->seen), name)) ||
        !(s->touched = rg_alloc(vertices, sizeof(*s->touched), name)) ||
        !(s->fixed = rg_alloc(vertices, sizeof(*s->fixed), name)) ||
        !(s->border = rg_alloc(vertices, sizeof(*s->border), name)) ||
        !(s->collapses = rg_alloc(corners, sizeof(*s->collapses), name)) ||
        !(s->sorted = rg_alloc(corners, sizeof(*s->sorted), name)))
        return false;
    drop_flat(s);
    for (int face = 0; face < s->face_count; face++)
        add_face(s, s->indices + 3 * (size_t)face);
    find_sides(s);
    for (int i = 0; i < 3 * s->face_count; i++)
        if (s->sharing[i] == 1)
            add_border(s, s->indices + i / 3 * 3, i % 3);
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
    free(s.sides);
    free(s.ends);
    free(s.sharing);
    free(s.seen);
    free(s.touched);
    free(s.fixed);
    free(s.border);
    free(s.collapses);
    free(s.sorted);
    return begun ? s.face_count : NONE;
}
