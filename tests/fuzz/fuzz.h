// The common part of the fuzz targets of meshes.
#ifndef RG_TESTS_FUZZ_FUZZ_H
#define RG_TESTS_FUZZ_FUZZ_H

#include "core/scene/mesh/mesh.h"
#include "tests/fuzz/heard.h"

// A file name for these bytes, by their beginning: "fuzz.ply".
const char *fuzz_name(const uint8_t *data, size_t size);

// Aborts unless the mesh keeps mesh.h's promises and no line was logged, or it is NULL and a line
// was. Then destroys it.
void fuzz_judge(struct rg_mesh *mesh);

#endif
