// What raingauge_importer replies in its cage (core/base/cage/cage.h), and what it is asked.
//
// Command line: raingauge_importer PATH [MEMBER]. The reply is this header, then vertex_count
// positions and as many normals (three floats each; a normal of 0 is an absent one), then
// face_count faces (three 32-bit indices each). `error` is "" or the line to show instead, and then
// nothing follows. The reader trusts none of it.
#ifndef RG_CORE_SCENE_MESH_REPLY_H
#define RG_CORE_SCENE_MESH_REPLY_H

#include <stdint.h>

enum { RG_REPLY_MAGIC = 0x4d524731 }; // "1GRM"

// The largest file that is read, and the memory that may be taken for it: ten million faces take
// Assimp 3 GB, as OBJ.
#define RG_IMPORT_MAX_FILE_BYTES   ((int64_t)1 << 30)
#define RG_IMPORT_MAX_MEMORY_BYTES ((int64_t)4 << 30)

struct rg_import_reply {
    uint32_t magic, vertex_count, face_count, reserved;
    char error[496];
};

#endif
