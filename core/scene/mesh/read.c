#include "core/scene/mesh/read.h"

#include <errno.h>
#include <limits.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <time.h>
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
static bool check_file(const char *path, struct stat *st)
{
    if (stat(path, st))
        return rg_system_error(errno, "%s: %s; check the name", path, strerror(errno));
    if (S_ISDIR(st->st_mode))
        return rg_error("%s: is a folder; name a mesh in it", path);
    if (!S_ISREG(st->st_mode))
        return rg_error("%s: is not a regular file; copy the mesh to one", path);
    if (access(path, R_OK))
        return rg_system_error(errno, "%s: %s; change the file's permissions", path,
                               strerror(errno));
    if (st->st_size == 0)
        return rg_error("%s: is empty; write it again", path);
    if (st->st_size > RG_IMPORT_MAX_FILE_BYTES)
        return rg_error("%s: has %lld bytes; at most %lld are read: decimate the mesh first", path,
                        (long long)st->st_size, (long long)RG_IMPORT_MAX_FILE_BYTES);
    return rg_memory_allows_piece(MEMORY_A_BYTE * st->st_size) ||
           rg_memory_refuse(path, MEMORY_A_BYTE * st->st_size, "a coarser mesh");
}

// The last mesh that was read stays for the next session of its model, of which a command opens
// many; one reading takes as long as some frames.
static struct {
    char path[PATH_MAX], member[512];
    struct stat file;
    struct rg_mesh *mesh; // NULL: none
} kept;
static pthread_mutex_t kept_lock = PTHREAD_MUTEX_INITIALIZER;
enum { KEPT_MAX_BYTES = 1 << 24, GRAIN_S = 2 };

static void *copy_of(const void *from, size_t bytes)
{
    void *to = from ? malloc(bytes) : NULL;
    return to ? memcpy(to, from, bytes) : NULL;
}

// To the bit. NULL when there is no memory, which is no error: the file can be read.
static struct rg_mesh *copy(const struct rg_mesh *mesh)
{
    const size_t vectors = 3 * sizeof(float) * (size_t)mesh->vertex_count;
    struct rg_mesh *made = copy_of(mesh, sizeof(*mesh));
    if (!made)
        return NULL;
    made->positions = copy_of(mesh->positions, vectors);
    made->normals = copy_of(mesh->normals, vectors);
    made->indices = copy_of(mesh->indices, 3 * sizeof(uint32_t) * (size_t)mesh->face_count);
    if (made->positions && made->normals && made->indices)
        return made;
    rg_mesh_destroy(made);
    return NULL;
}

static struct rg_mesh *take_kept(const char *path, const char *member, const struct stat *st)
{
    pthread_mutex_lock(&kept_lock);
    const struct stat *was = &kept.file;
    const bool is_same = kept.mesh && !strcmp(kept.path, path) && !strcmp(kept.member, member) &&
                         was->st_dev == st->st_dev && was->st_ino == st->st_ino &&
                         was->st_ctim.tv_sec == st->st_ctim.tv_sec &&
                         was->st_ctim.tv_nsec == st->st_ctim.tv_nsec;
    struct rg_mesh *mesh = is_same ? copy(kept.mesh) : NULL;
    pthread_mutex_unlock(&kept_lock);
    return mesh;
}

// Whether another content would show, asked before the file is read: it last changed longer ago
// than the grain of that time, and is no .gltf file, which names others.
static bool shows_changes(const char *path, const struct stat *st)
{
    const char *end = strrchr(path, '.');
    return st->st_ctim.tv_sec + GRAIN_S <= time(NULL) && !(end && !strcasecmp(end, ".gltf"));
}

static void keep(const char *path, const char *member, const struct stat *st,
                 const struct rg_mesh *mesh)
{
    const int64_t bytes = 24 * (int64_t)mesh->vertex_count + 12 * (int64_t)mesh->face_count;
    if (bytes > KEPT_MAX_BYTES || strlen(path) >= sizeof(kept.path) ||
        strlen(member) >= sizeof(kept.member))
        return;
    pthread_mutex_lock(&kept_lock);
    rg_mesh_destroy(kept.mesh);
    snprintf(kept.path, sizeof(kept.path), "%s", path);
    snprintf(kept.member, sizeof(kept.member), "%s", member);
    kept.file = *st;
    kept.mesh = copy(mesh);
    pthread_mutex_unlock(&kept_lock);
}

struct rg_mesh *rg_mesh_read(const char *path, const char *member)
{
    char program[PATH_MAX];
    struct stat st;
    if (!check_file(path, &st) || !find_importer(program, sizeof(program)))
        return NULL;
    struct rg_mesh *mesh = take_kept(path, member ? member : "", &st);
    if (mesh)
        return mesh;
    const bool may_be_kept = shows_changes(path, &st);
    // Long enough for the CPU time that the importer allows itself, even on a busy machine.
    const int timeout_s = (int)(60 + 10 * (int64_t)st.st_size / 1000000);
    if ((mesh = rg_mesh_read_by(program, timeout_s, path, path, member))) {
        const char *file = member ? member : path, *slash = strrchr(file, '/');
        snprintf(mesh->name, sizeof(mesh->name), "%s", slash ? slash + 1 : file);
        if (may_be_kept)
            keep(path, member ? member : "", &st, mesh);
    }
    return mesh;
}
