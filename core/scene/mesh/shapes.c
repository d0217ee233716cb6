// Computed models: grids of quads, each two triangles, bent into shape.
#include <math.h>
#include <stdlib.h>

#include "core/base/alloc.h"
#include "core/scene/mesh/models.h"

enum { SPHERE_CELLS = 48, TORUS_AROUND = 256, TORUS_THROUGH = 64 };

// u and v go from -1 to 1. Points where patches meet must be bitwise equal, so that they are
// joined.
typedef void (*surface_fn)(int patch, double u, double v, float position[3], float normal[3]);

// Makes the cells of a cube's side nearly equal on the sphere; keeps -1, 0 and 1.
static double spread(double u)
{
    return fabs(u) < 1 ? tan(u * M_PI / 4) : u;
}

// A side of a cube, projected to a sphere of radius 1.
static void sphere_point(int patch, double u, double v, float position[3], float normal[3])
{
    const int axis = patch / 2;
    const double side = patch % 2 ? -1 : 1;
    double p[3], length;
    p[axis] = side;
    p[(axis + 1) % 3] = side * spread(u);
    p[(axis + 2) % 3] = spread(v);
    length = sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]);
    for (int c = 0; c < 3; c++)
        position[c] = normal[c] = (float)(p[c] / length);
}

// A torus about the y axis, with radii 0.7 and 0.3.
static void torus_point(int patch, double u, double v, float position[3], float normal[3])
{
    (void)patch;
    const double a = (u < 1 ? u : -1) * M_PI, b = (v < 1 ? v : -1) * M_PI;
    const double n[3] = {cos(b) * sin(a), sin(b), cos(b) * cos(a)};
    for (int c = 0; c < 3; c++)
        normal[c] = (float)n[c];
    position[0] = (float)((0.7 + 0.3 * cos(b)) * sin(a));
    position[1] = (float)(0.3 * sin(b));
    position[2] = (float)((0.7 + 0.3 * cos(b)) * cos(a));
}

static void add_cell(uint32_t *face, uint32_t corner, uint32_t row)
{
    const uint32_t cell[6] = {corner,           corner + 1,   corner + row + 1,
                              corner + row + 1, corner + row, corner};
    for (int i = 0; i < 6; i++)
        face[i] = cell[i];
}

static struct rg_mesh *bend(const char *name, int patches, int columns, int rows, surface_fn point)
{
    const int patch_vertices = (columns + 1) * (rows + 1), faces = patches * columns * rows * 2;
    const size_t vertices = (size_t)patches * (size_t)patch_vertices;
    float *positions = rg_alloc(vertices, 3 * sizeof(float), name);
    float *normals = positions ? rg_alloc(vertices, 3 * sizeof(float), name) : NULL;
    uint32_t *indices = normals ? rg_alloc((size_t)faces, 3 * sizeof(uint32_t), name) : NULL;
    uint32_t *next = indices;
    struct rg_mesh *mesh = NULL;
    for (size_t i = 0; normals && i < vertices; i++) {
        const int place = (int)i % patch_vertices;
        const int x = place % (columns + 1), y = place / (columns + 1);
        point((int)i / patch_vertices, (double)(2 * x - columns) / columns,
              (double)(2 * y - rows) / rows, positions + 3 * i, normals + 3 * i);
    }
    for (int i = 0; indices && i < patches * columns * rows; i++, next += 6) {
        const int patch = i / (columns * rows), y = i / columns % rows, x = i % columns;
        add_cell(next, (uint32_t)(patch * patch_vertices + y * (columns + 1) + x),
                 (uint32_t)columns + 1);
    }
    if (indices)
        mesh = rg_mesh_create(name, (int)vertices, faces, positions, normals, indices);
    free(positions);
    free(normals);
    free(indices);
    return mesh;
}

struct rg_mesh *rg_mesh_make_sphere(void)
{
    return bend("sphere", 6, SPHERE_CELLS, SPHERE_CELLS, sphere_point);
}

struct rg_mesh *rg_mesh_make_torus(void)
{
    return bend("torus", 1, TORUS_AROUND, TORUS_THROUGH, torus_point);
}
