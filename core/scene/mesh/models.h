// Models by name: the Debian package and file of each name.
#ifndef RG_CORE_SCENE_MESH_MODELS_H
#define RG_CORE_SCENE_MESH_MODELS_H

#include "core/scene/mesh/mesh.h"

// The names that rg_mesh_load takes:
//     "sphere", "torus"    computed, always available
//     "bunny", "horse"...  a row of the table below, from a Debian package, turned so that y is up
//     "cow", "homer"...    any other mesh of libcgal-demo's archive, without its ".off", not turned
//     any path             a file (a name with a '.' or a '/' in it)
// In the folder RG_MODEL_DIR, if that variable is set, NAME.obj, .ply, .off, .stl, .gltf, .glb or
// .3ds has priority over the packages.
struct rg_model {
    const char *name;
    const char *file;       // in glmark2-data's folder or in libcgal-demo's archive
    bool in_archive;        // the file is in the archive
    int quarter_turns;      // about the x axis, from y to z, to set it upright
    int faces;              // as the paper prints; 0: as many as the file has
    const char *stands_for; // the paper's model that it replaces; NULL: none
};

// A row of the table by index; NULL after the last.
const struct rg_model *rg_model_at(int index);

// The computed models: closed, with about 28,000 and 33,000 faces and an extent of 2.
struct rg_mesh *rg_mesh_make_sphere(void);
struct rg_mesh *rg_mesh_make_torus(void);

#endif
