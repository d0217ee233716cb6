// Models by name: which file of which Debian package a name stands for.
#ifndef RG_CORE_SCENE_MESH_MODELS_H
#define RG_CORE_SCENE_MESH_MODELS_H

#include "core/scene/mesh/mesh.h"

// What rg_mesh_load takes:
//   "sphere", "torus"   computed, always there
//   "bunny", "horse"... a row of the table below, from a Debian package, upright: y points up
//   "cow", "homer"...   any other mesh of libcgal-demo's archive, without its ".off", as it lies
//   any path            a file (a name with a '.' or a '/' in it)
// In the folder RG_MODEL_DIR, if that variable is set, NAME.obj, .ply, .off, .stl, .gltf, .glb or
// .3ds comes before the packages.
struct rg_model {
    const char *name;
    const char *file;       // in glmark2-data's folder or in libcgal-demo's archive
    bool in_archive;        // the latter
    int quarter_turns;      // about the x axis, from y to z, that set it upright
    int faces;              // as a paper says; 0: as many as the file has
    const char *stands_for; // the paper's model that it is shown for, NULL: itself
};

// The names of the table, in order; NULL after the last.
const struct rg_model *rg_model_at(int index);

// The computed models: closed, of about 28,000 and 33,000 faces, of extent 2.
struct rg_mesh *rg_mesh_make_sphere(void);
struct rg_mesh *rg_mesh_make_torus(void);

#endif
