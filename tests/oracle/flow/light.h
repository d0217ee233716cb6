// Light on water and its bending, in double precision: environments, normals of a height map, the
// Fresnel model. Written from docs/flow.md without anything of kernels/.
#ifndef RG_TESTS_ORACLE_FLOW_LIGHT_H
#define RG_TESTS_ORACLE_FLOW_LIGHT_H

#include <stdbool.h>
#include <stdint.h>

// A cube map, borrowed: [face][y][x][rgb], faces +x -x +y -y +z -z as in OpenGL. The outermost
// texels' centres are on the cube's edges.
struct light_cube {
    const float *light;
    int size;
};

// The light from a direction of any length, between four texels.
void light_from_cube(const struct light_cube *cube, const double direction[3], double light[3]);

// A pane's water, borrowed: size x size droplets of 2^-16 of a unit each.
struct light_surface {
    const int64_t *water;
    int size;
    double pane_mm, relief, wet_height;
    bool sharp; // lit without the blur
};

// The mean of a texel and its neighbours, in units, or a sharp texel itself; beyond the edge the
// pane is dry.
double light_blurred(const struct light_surface *surface, int x, int y);
// The normal's x and y and the wetness at a point of the pane, between four texels of the normal
// map. The point is 0 to 1 from left to right and from top to bottom.
void light_normal(const struct light_surface *surface, double u, double v, double normal[3]);

struct light_fresnel {
    double bias, scale, power;
};

// The reflected share of a view onto a surface whose unit normal faces the viewer.
double light_reflectance(const struct light_fresnel *fresnel, const double view[3],
                         const double normal[3]);

#endif
