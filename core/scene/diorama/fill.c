// Brings a diorama to its published numbers of vertices and faces.
//
// A pebble is closed and smooth: F faces have F/2 + 2 vertices. A blade is a strip of F + 2
// vertices. So A pebbles of P faces together and B blades of S add P + S faces and (P + S)/2 + S/2
// + 2 (A + B) vertices; solving for S gives S = 2 vertices - faces - 4 (A + B).
#include <math.h>
#include <stdlib.h>

#include "core/base/log.h"
#include "core/scene/diorama/build.h"

enum { MOST = 600, PEBBLE_LEAST = 6, PEBBLE_MOST = 96, BLADE_MOST = 7 };

struct shares {
    int pebbles, pebble_faces, blades, blade_faces;
};

// Whether these faces can make this many pebbles and blades; a lower `cost` looks better.
static bool judge(const struct shares *s, int *cost)
{
    const bool pebbles_fit = s->pebble_faces % 2 == 0 &&
                             s->pebble_faces >= PEBBLE_LEAST * s->pebbles &&
                             s->pebble_faces <= PEBBLE_MOST * s->pebbles;
    const bool blades_fit = s->blade_faces >= s->blades && s->blade_faces <= BLADE_MOST * s->blades;
    *cost = abs(s->pebble_faces - 30 * s->pebbles) + 4 * abs(s->blade_faces - 4 * s->blades);
    return pebbles_fit && blades_fit;
}

static bool share_out(int vertices, int faces, struct shares *best)
{
    int least = -1;
    for (int a = 0; a <= MOST; a++) {
        for (int n = 0; n <= MOST; n++) {
            const int blade_faces = 2 * vertices - faces - 4 * (a + n);
            const struct shares s = {a, faces - blade_faces, n, blade_faces};
            int cost;
            if (!judge(&s, &cost) || (least >= 0 && cost >= least))
                continue;
            least = cost;
            *best = s;
        }
    }
    return least >= 0;
}

// A pseudo-random place in the ring, uniform over its area.
static point place_of(const struct leftover *l, uint32_t what, uint32_t which)
{
    const double inner = l->inner_m * l->inner_m, outer = l->outer_m * l->outer_m;
    const double turn = 360 * chance(what, 2 * which);
    const double radius = sqrt(inner + (outer - inner) * chance(what, 2 * which + 1));
    return (point){l->middle.x + radius * sine(turn), l->middle.y,
                   l->middle.z + radius * cosine(turn)};
}

static void add_pebbles(struct builder *b, const struct leftover *l, const struct shares *s)
{
    int left = s->pebble_faces / 2;
    for (int i = 0; i < s->pebbles; i++) {
        const int pairs = left / (s->pebbles - i);
        left -= pairs;
        const double radius = l->pebble_m * (0.5 + chance(300, (uint32_t)i));
        pebble(b, place_of(l, 301, (uint32_t)i), radius, 2 * pairs, 1000 + (uint32_t)i, l->pebble);
    }
}

// Adds blades in tufts of five.
static void add_blades(struct builder *b, const struct leftover *l, const struct shares *s)
{
    int left = s->blade_faces;
    for (int i = 0; i < s->blades; i++) {
        const int faces = left / (s->blades - i);
        left -= faces;
        const uint32_t id = (uint32_t)i;
        const double turn = 72.0 * (i % 5) + 50 * chance(302, id), off = 0.15 * l->blade_m;
        const point tuft = place_of(l, 303, id / 5);
        const point at = {tuft.x + off * sine(turn), tuft.y, tuft.z + off * cosine(turn)};
        blade(b, at, l->blade_m * (0.6 + 0.6 * chance(304, id)), turn, faces, l->blade);
    }
}

bool fill(struct builder *b, const struct leftover *leftover, int vertices, int faces)
{
    struct rg_mesh *mesh = builder_mesh(b);
    if (!mesh)
        return false;
    const int more_vertices = vertices - mesh->vertex_count, more = faces - mesh->face_count;
    rg_mesh_destroy(mesh);
    struct shares s;
    if (!share_out(more_vertices, more, &s))
        return rg_error("%s: %d vertices and %d faces are left over, which no pebbles and blades "
                        "have; make its parts smaller",
                        b->name, more_vertices, more);
    add_pebbles(b, leftover, &s);
    add_blades(b, leftover, &s);
    return !b->has_failed;
}
