#include "core/scene/mesh/read.h"

#include <errno.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/base/cage/cage.h"
#include "core/base/log.h"
#include "core/base/memory.h"
#include "core/base/program.h"
#include "core/base/text/limits.h"
#include "core/scene/mesh/reply.h"

// --- the reply ---

// Logs the importer's error. Under low limits the importer has less memory than it thinks.
static void *refused(const char *name, const char *error)
{
    char limits[RG_LIMITS_TEXT];
    if (strstr(error, "memory") && rg_limits_low(limits))
        return rg_harness_error_null("%s: Assimp cannot read it %s; allow more", name, limits);
    return rg_error_null("%s: %s", name, error);
}

struct rg_mesh *rg_mesh_from_reply(const char *name, const void *reply, size_t bytes)
{
    struct rg_import_reply header;
    if (bytes < sizeof(header))
        return rg_error_null("%s: raingauge_importer gave no reply; build raingauge again", name);
    memcpy(&header, reply, sizeof(header));
    header.error[sizeof(header.error) - 1] = 0;
    if (header.magic != RG_REPLY_MAGIC)
        return rg_error_null("%s: raingauge_importer is of another version; build raingauge again",
                             name);
    if (header.error[0])
        return refused(name, header.error);
    const uint64_t vertices = header.vertex_count, faces = header.face_count;
    if (vertices > INT_MAX || faces > INT_MAX ||
        bytes != sizeof(header) + vertices * 6 * sizeof(float) + faces * 3 * sizeof(uint32_t))
        return rg_error_null("%s: raingauge_importer's reply has %zu bytes, not those of %llu "
                             "vertices and %llu faces; build raingauge again",
                             name, bytes, (unsigned long long)vertices, (unsigned long long)faces);
    const float *positions = (const float *)((const char *)reply + sizeof(header));
    const float *normals = positions + 3 * vertices;
    return rg_mesh_create(name, (int)vertices, (int)faces, positions, normals,
                          (const uint32_t *)(normals + 3 * vertices));
}

// --- the process ---

struct rg_mesh *rg_mesh_read_by(const char *program, int timeout_s, const char *name,
                                const char *path, const char *member)
{
    char why[300];
    struct rg_caged caged;
    struct rg_mesh *mesh = NULL;
    const int error = rg_caged_run((const char *const[]){program, path, member, NULL}, -1,
                                   timeout_s, RG_IMPORT_MAX_MEMORY_BYTES, &caged);
    const enum rg_caged_end end =
        error ? RG_CAGED_LACKING : rg_caged_end(&caged, "Assimp", why, sizeof(why));
    if (error)
        rg_harness_error("%s: %s could not be started: %s; %s", name, program, strerror(error),
                         rg_program_mend(error));
    else if (end == RG_CAGED_MACHINE)
        rg_unsupported("%s: %s", name, why);
    else if (end == RG_CAGED_LACKING)
        rg_harness_error("%s: %s", name, why);
    else if (end == RG_CAGED_FILE)
        rg_error("%s: %s", name, why);
    else
        mesh = rg_mesh_from_reply(name, caged.reply, caged.bytes);
    free(caged.reply);
    return mesh;
}

// --- files ---

static bool find_importer(char *path, size_t size)
{
    return rg_program_part("raingauge_importer", path, size) ||
           rg_error("meshes are read by raingauge_importer, which is not beside raingauge in %s; "
                    "build or install it again",
                    path);
}

// Memory grows with the file: ten million faces of a binary PLY (190 MB) took five times its size,
// two million of an OBJ (59 MB) nine times.
enum { MEMORY_A_BYTE = 4 };

// Refuses bad paths before anything is opened.
static bool check_file(const char *path, int64_t *bytes)
{
    struct stat st;
    if (stat(path, &st))
        return rg_system_error(errno, "%s: %s; check the name", path, strerror(errno));
    if (S_ISDIR(st.st_mode))
        return rg_error("%s: is a folder; name a mesh in it", path);
    if (!S_ISREG(st.st_mode))
        return rg_error("%s: is not a regular file; copy the mesh to one", path);
    if (access(path, R_OK))
        return rg_system_error(errno, "%s: %s; change the file's permissions", path,
                               strerror(errno));
    if (st.st_size == 0)
        return rg_error("%s: is empty; write it again", path);
    if (st.st_size > RG_IMPORT_MAX_FILE_BYTES)
        return rg_error("%s: has %lld bytes; at most %lld are read: decimate the mesh first", path,
                        (long long)st.st_size, (long long)RG_IMPORT_MAX_FILE_BYTES);
    *bytes = st.st_size;
    return rg_memory_allows_piece(MEMORY_A_BYTE * st.st_size) ||
           rg_memory_refuse(path, MEMORY_A_BYTE * st.st_size, "a coarser mesh");
}

struct rg_mesh *rg_mesh_read(const char *path, const char *member)
{
    char program[PATH_MAX];
    int64_t bytes = 0;
    if (!check_file(path, &bytes) || !find_importer(program, sizeof(program)))
        return NULL;
    // Long enough for the CPU time that the importer allows itself, even on a busy machine.
    struct rg_mesh *mesh =
        rg_mesh_read_by(program, (int)(60 + 10 * bytes / 1000000), path, path, member);
    if (mesh) {
        const char *file = member ? member : path, *slash = strrchr(file, '/');
        snprintf(mesh->name, sizeof(mesh->name), "%s", slash ? slash + 1 : file);
    }
    return mesh;
}
