// A diorama: a small scene for cartoons, as a mesh whose faces have materials, with a camera that
// shows it well. docs/cartoon.md shows them.
#ifndef RG_CORE_SCENE_DIORAMA_DIORAMA_H
#define RG_CORE_SCENE_DIORAMA_DIORAMA_H

#include <stdint.h>

#include "core/scene/mesh/mesh.h"

enum { DIORAMA_MATERIALS = 48 }; // at most

// Display values, 0 to 1, whose squares are light; and its gloss, 0 to 1.
struct diorama_material {
    float r, g, b, shine;
};

// The camera: at `distance_m` from the point that it looks at, turned about the upright axis from
// +z, and raised above the horizon.
struct diorama_view {
    double look_at_m[3], distance_m, turn_deg, rise_deg, angle_deg;
    double pen; // width of outlines relative to the usual
};

struct diorama {
    struct rg_mesh *mesh;
    uint32_t *materials; // of each face
    int solid_faces;     // the first so many faces are visible from outside only
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

// The numbers of vertices and faces that Feng et al. print for a scene, and its name.
struct diorama_size {
    const char *name;
    int vertices, faces;
};
extern const struct diorama_size diorama_sizes[DIORAMAS];

// A scene of exactly its published size, the same on every machine. NULL, and one logged line, when
// memory runs out. The caller destroys it.
struct diorama *diorama_create(enum diorama_scene scene);

// A user's mesh, scaled to 4 m, in the middle of a round ground. `name` is as for rg_mesh_load.
// NULL, and one logged line, on failure. The caller destroys it.
struct diorama *diorama_of_mesh(const char *name);
void diorama_destroy(struct diorama *diorama);

#endif
