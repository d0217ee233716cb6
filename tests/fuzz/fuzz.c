#include "tests/fuzz/fuzz.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "tests/core/scene/mesh/fault.h"

static int lines;
static char last_line[1024];

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

static void listen(enum rg_log_level level, const char *line, void *user)
{
    (void)level;
    (void)user;
    lines++;
    snprintf(last_line, sizeof(last_line), "%s", line);
}

void fuzz_listen(void)
{
    lines = 0;
    rg_log_listen(listen, NULL);
}

static void complain(const char *fault)
{
    fprintf(stderr, "fault: %s; %d lines, the last: %s\n", fault, lines, last_line);
    abort();
}

void fuzz_judge(struct rg_mesh *mesh)
{
    const char *fault = mesh ? mesh_fault(mesh) : NULL;
    if (fault)
        complain(fault);
    if (lines != (mesh ? 0 : 1))
        complain(mesh ? "loaded, with words" : "refused, not in one line");
    rg_mesh_destroy(mesh);
}
