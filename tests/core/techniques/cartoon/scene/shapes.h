// Small meshes whose outlines are known.
#ifndef RG_TESTS_CORE_TECHNIQUES_CARTOON_SCENE_SHAPES_H
#define RG_TESTS_CORE_TECHNIQUES_CARTOON_SCENE_SHAPES_H

#include "core/scene/mesh/mesh.h"

enum { SHAPE_MOST = 20000 };
struct shape {
    int vertices, faces;
    float positions[3 * SHAPE_MOST];
    uint32_t indices[3 * SHAPE_MOST];
};

// Adds a face of four corners, counter-clockwise seen from outside, with corners of its own.
void shape_quad(struct shape *s, const double corners[4][3]);
// Adds a closed box of 12 faces.
void shape_box(struct shape *s, const double low[3], const double high[3]);
// Adds a ball about the origin, with 2 * around faces at its poles, and as many in each ring
// between.
void shape_ball(struct shape *s, double radius, int rings, int around);
// The mesh of everything added; fails the test if there is none.
struct rg_mesh *shape_mesh(const struct shape *s);

#endif
