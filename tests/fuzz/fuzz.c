#include "tests/fuzz/fuzz.h"

#include <string.h>

#include "tests/core/scene/mesh/fault.h"

const char *fuzz_name(const uint8_t *data, size_t size)
{
    static const struct {
        const char *start, *name;
    } kinds[] = {{"ply", "fuzz.ply"}, {"solid", "fuzz.stl"}, {"STL", "fuzz.stl"},
                 {"OFF", "fuzz.off"}, {"{", "fuzz.gltf"},    {"glTF", "fuzz.glb"},
                 {"MM", "fuzz.3ds"}};
    for (size_t i = 0; i < sizeof(kinds) / sizeof(kinds[0]); i++)
        if (size >= strlen(kinds[i].start) && !memcmp(data, kinds[i].start, strlen(kinds[i].start)))
            return kinds[i].name;
    return "fuzz.obj";
}

void fuzz_judge(struct rg_mesh *mesh)
{
    const char *fault = mesh ? mesh_fault(mesh) : NULL;
    if (fault)
        fuzz_complain(fault);
    fuzz_judge_lines(mesh, 0);
    rg_mesh_destroy(mesh);
}
