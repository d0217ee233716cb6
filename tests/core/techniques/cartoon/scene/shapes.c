#include "tests/core/techniques/cartoon/scene/shapes.h"
#include "tests/tools/expect.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <math.h>

static uint32_t add_vertex(struct shape *s, double x, double y, double z)
{
    const double p[3] = {x, y, z};
    assert_below(s->vertices, SHAPE_MOST);
    for (int c = 0; c < 3; c++)
        s->positions[3 * s->vertices + c] = (float)p[c];
    return (uint32_t)s->vertices++;
}

static void add_face(struct shape *s, uint32_t a, uint32_t b, uint32_t c)
{
    assert_below(s->faces, SHAPE_MOST);
    const uint32_t corners[3] = {a, b, c};
    for (int k = 0; k < 3; k++)
        s->indices[3 * s->faces + k] = corners[k];
    s->faces++;
}

void shape_quad(struct shape *s, const double corners[4][3])
{
    uint32_t at[4];
    for (int k = 0; k < 4; k++)
        at[k] = add_vertex(s, corners[k][0], corners[k][1], corners[k][2]);
    add_face(s, at[0], at[1], at[2]);
    add_face(s, at[0], at[2], at[3]);
}

void shape_box(struct shape *s, const double low[3], const double high[3])
{
    for (int axis = 0; axis < 3; axis++) {
        for (int end = 0; end < 2; end++) {
            double corners[4][3];
            for (int k = 0; k < 4; k++) {
                const int turn = end ? k : 3 - k;
                corners[k][axis] = end ? high[axis] : low[axis];
                corners[k][(axis + 1) % 3] =
                    turn == 1 || turn == 2 ? high[(axis + 1) % 3] : low[(axis + 1) % 3];
                corners[k][(axis + 2) % 3] = turn >= 2 ? high[(axis + 2) % 3] : low[(axis + 2) % 3];
            }
            shape_quad(s, corners);
        }
    }
}

void shape_ball(struct shape *s, double radius, int rings, int around)
{
    const uint32_t low = add_vertex(s, 0, -radius, 0), first = low + 1;
    for (int i = 1; i < rings; i++)
        for (int j = 0; j < around; j++) {
            const double up = M_PI * i / rings - M_PI / 2, turn = 2 * M_PI * j / around;
            add_vertex(s, radius * cos(up) * sin(turn), radius * sin(up),
                       radius * cos(up) * cos(turn));
        }
    const uint32_t high = add_vertex(s, 0, radius, 0);
    const uint32_t row = (uint32_t)around, last = first + (uint32_t)(rings - 2) * row;
    for (uint32_t j = 0; j < row; j++) {
        const uint32_t next = (j + 1) % row;
        add_face(s, low, first + next, first + j);
        for (uint32_t r = first; r < last; r += row) {
            add_face(s, r + j, r + next, r + row + next);
            add_face(s, r + j, r + row + next, r + row + j);
        }
        add_face(s, high, last + j, last + next);
    }
}

struct rg_mesh *shape_mesh(const struct shape *s)
{
    struct rg_mesh *mesh =
        rg_mesh_create("shape", s->vertices, s->faces, s->positions, NULL, s->indices);
    assert_non_null(mesh);
    return mesh;
}
