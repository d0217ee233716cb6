// What core/scene/mesh/mesh.h promises of every mesh, checked.
#ifndef RG_TESTS_CORE_SCENE_MESH_FAULT_H
#define RG_TESTS_CORE_SCENE_MESH_FAULT_H

#include "core/scene/mesh/mesh.h"

// NULL, or what is wrong with the mesh.
const char *mesh_fault(const struct rg_mesh *mesh);

#endif
