// Reads a mesh in another process.
#ifndef RG_CORE_SCENE_MESH_READ_H
#define RG_CORE_SCENE_MESH_READ_H

#include <stddef.h>

#include "core/scene/mesh/mesh.h"

// Runs `program PATH [MEMBER]` for up to `timeout_s` and makes a mesh called `name` of its reply
// (reply.h), all of which it checks. NULL and one logged line when the program crashes, runs too
// long, or refuses the file.
struct rg_mesh *rg_mesh_read_by(const char *program, int timeout_s, const char *name,
                                const char *path, const char *member);

// Makes a mesh of a reply's bytes.
struct rg_mesh *rg_mesh_from_reply(const char *name, const void *reply, size_t bytes);

#endif
