// The process that a mesh is read in.
#ifndef RG_CORE_SCENE_MESH_READ_H
#define RG_CORE_SCENE_MESH_READ_H

#include <stddef.h>

#include "core/scene/mesh/mesh.h"

// Runs `program PATH [MEMBER]` for up to `timeout_s` and makes a mesh called `name` of its reply
// (reply.h), of which it believes nothing that it has not checked. NULL and one logged
// line when the program crashes, does not end in time, or refuses the file.
struct rg_mesh *rg_mesh_read_by(const char *program, int timeout_s, const char *name,
                                const char *path, const char *member);

// A mesh of a reply's bytes.
struct rg_mesh *rg_mesh_from_reply(const char *name, const void *reply, size_t bytes);

#endif
