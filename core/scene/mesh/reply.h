// The request to raingauge_importer in its cage (core/base/cage/cage.h), and its reply.
//
// Command line: raingauge_importer PATH [MEMBER]. The reply is this header, then vertex_count
// positions and as many normals (three floats each; 0 stands for a missing normal), then face_count
// faces (three 32-bit indices each). `error` is "" or the message to show; then nothing follows.
// The reader trusts none of it.
#ifndef RG_CORE_SCENE_MESH_REPLY_H
#define RG_CORE_SCENE_MESH_REPLY_H

#include <stdint.h>

enum { RG_REPLY_MAGIC = 0x4d524731 }; // "1GRM"

// The largest file that is read, and the memory allowed for it: ten million faces as OBJ take
// Assimp 3 GB.
#define RG_IMPORT_MAX_FILE_BYTES   ((int64_t)1 << 30)
#define RG_IMPORT_MAX_MEMORY_BYTES ((int64_t)4 << 30)

struct rg_import_reply {
    uint32_t magic, vertex_count, face_count, reserved;
    char error[496];
};

#endif
