// raingauge_importer: reads one mesh with Assimp and returns plain arrays
// (core/scene/mesh/reply.h).
//
// Assimp reads 40 formats, and crashes or loops on some damaged files, which does no harm in a
// process of its own.
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "core/base/cage/cage.h"
#include "core/scene/mesh/importer/importer.h"

// Limits CPU time to two seconds and one more for each megabyte; Assimp reads ten or more in a
// second. Limits memory as core/scene/mesh/reply.h says.
static void set_limits(size_t file_bytes)
{
    rg_cage_limit(&(struct rg_cage_limits){
        .cpu_s = 2 + (int64_t)file_bytes / 1000000,
        .memory_bytes = RG_IMPORT_MAX_MEMORY_BYTES,
    });
}

static bool put_reply(const struct import *import)
{
    const struct rg_import_reply *reply = &import->reply;
    const size_t vertices = reply->vertex_count, faces = reply->face_count;
    return rg_cage_reply(reply, sizeof(*reply)) &&
           rg_cage_reply(import->positions, vertices * 3 * sizeof(float)) &&
           rg_cage_reply(import->normals, vertices * 3 * sizeof(float)) &&
           rg_cage_reply(import->indices, faces * 3 * sizeof(uint32_t));
}

int main(int argc, char **argv)
{
    static struct import import = {.reply = {.magic = RG_REPLY_MAGIC}};
    if (argc < 2 || argc > 3) {
        fputs("raingauge_importer is started by raingauge\n", stderr);
        return 2;
    }
    set_limits(0);
    const bool opened = import_open(&import, argv[1], argc > 2 ? argv[2] : NULL);
    set_limits(import.size);
    if (opened && !rg_cage_shut())
        _exit(RG_CAGE_REFUSED);
    if (!opened || !import_read_member(&import) || !import_load(&import))
        import.reply.vertex_count = import.reply.face_count = 0;
    // _exit skips the destructors of libraries.
    _exit(put_reply(&import) ? 0 : 1);
}
