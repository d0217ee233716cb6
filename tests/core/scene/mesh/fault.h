// Checks what core/scene/mesh/mesh.h promises of every mesh.
#ifndef RG_TESTS_CORE_SCENE_MESH_FAULT_H
#define RG_TESTS_CORE_SCENE_MESH_FAULT_H

#include "core/scene/mesh/mesh.h"

// Returns NULL, or the first fault of the mesh.
const char *mesh_fault(const struct rg_mesh *mesh);

#endif
