// The importer's own code and Assimp in this process, then the mesh: quick, and sanitizers see all
// of it. It also finds Assimp's own crashes and endless loops; CONTRIBUTING.md says how to ignore
// them.
#include <assimp/cimport.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "core/scene/mesh/importer/importer.h"
#include "tests/fuzz/fuzz.h"

static struct rg_mesh *create(const struct import *import)
{
    return rg_mesh_create("fuzz", (int)import->reply.vertex_count, (int)import->reply.face_count,
                          import->positions, import->normals, import->indices);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct import import = {.bytes = malloc(size + 1), .size = size};
    if (!import.bytes)
        return 0;
    memcpy(import.bytes, data, size);
    import_name(&import, fuzz_name(data, size));
    fuzz_listen();
    if (import_load(&import))
        fuzz_judge(create(&import));
    else if (!import.reply.error[0])
        abort(); // refused without a message
    aiReleaseImport(import.scene);
    free(import.bytes);
    free(import.positions);
    free(import.normals);
    free(import.indices);
    return 0;
}
