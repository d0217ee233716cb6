// A diorama: a small scene for cartoons to be set in, as a mesh whose faces have materials, with a
// camera that shows it well. docs/cartoon.md shows them.
//
// Right-handed, y up, in metres, on a ground at y = 0 about the origin.
#ifndef RG_CORE_SCENE_DIORAMA_DIORAMA_H
#define RG_CORE_SCENE_DIORAMA_DIORAMA_H

#include <stdint.h>

#include "core/scene/mesh/mesh.h"

enum { DIORAMA_MATERIALS = 48 }; // at most

// Display values, 0 to 1, whose squares are light; and how much it shines, 0 to 1.
struct diorama_material {
    float r, g, b, shine;
};

// From where it is looked at: `distance_m` from a point, turned about the upright axis from the
// side of z, and so far above the horizon.
struct diorama_view {
    double look_at_m[3], distance_m, turn_deg, rise_deg, angle_deg;
    double pen; // how thick its lines are, of their usual width
};

struct diorama {
    struct rg_mesh *mesh;
    uint32_t *materials; // of each face
    int solid_faces;     // so many faces from the first on are seen from their outer side alone
    int material_count;
    struct diorama_material palette[DIORAMA_MATERIALS];
    struct diorama_view view;
    float sky[3], low_sky[3]; // display values, at the picture's top and bottom
};

enum diorama_scene {
    DIORAMA_CAR,
    DIORAMA_HOUSE1,
    DIORAMA_HOUSE2,
    DIORAMA_TABLE,
    DIORAMA_PARK1,
    DIORAMA_PARK2,
    DIORAMA_GROUND,
    DIORAMAS
};

// How many vertices and faces Feng et al. print of their scene, and what it is called.
struct diorama_size {
    const char *name;
    int vertices, faces;
};
extern const struct diorama_size diorama_sizes[DIORAMAS];

// A scene of exactly its published size, the same on every machine. NULL, and one logged line,
// without memory. The caller destroys it.
struct diorama *diorama_create(enum diorama_scene scene);

// A user's mesh, 4 m at its longest, standing in the middle of a round ground. `name` is what
// rg_mesh_load takes. NULL, and one logged line, on failure. The caller destroys it.
struct diorama *diorama_of_mesh(const char *name);
void diorama_destroy(struct diorama *diorama);

#endif
