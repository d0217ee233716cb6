#define _GNU_SOURCE // memfd_create
#include "core/scene/mesh/read.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "core/base/log.h"
#include "core/base/program.h"
#include "core/scene/mesh/reply.h"

// Where the importer is, seen from the folder of the running program: beside it, installed, or in
// the build, whose programs and tests lie at several depths.
static const char *const importer_places[] = {
    "raingauge_importer",
    "../lib/raingauge/raingauge_importer",
    "../" RG_LIBDIR "/raingauge/raingauge_importer",
    "../core/raingauge_importer",
    "../../core/raingauge_importer",
    "../../../core/raingauge_importer",
    "../../../../core/raingauge_importer",
    "../../../../../core/raingauge_importer",
};

// --- the reply ---

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
        return rg_error_null("%s: %s", name, header.error);
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

static struct rg_mesh *map_reply(const char *name, int fd)
{
    struct stat st;
    if (fstat(fd, &st) || st.st_size == 0)
        return rg_mesh_from_reply(name, NULL, 0);
    const size_t bytes = (size_t)st.st_size;
    void *reply = mmap(NULL, bytes, PROT_READ, MAP_PRIVATE, fd, 0);
    if (reply == MAP_FAILED)
        return rg_error_null("%s: no memory for %zu bytes: %s", name, bytes, strerror(errno));
    struct rg_mesh *mesh = rg_mesh_from_reply(name, reply, bytes);
    munmap(reply, bytes);
    return mesh;
}

// --- the process ---

// False when it had to be killed.
static bool wait_for_end(pid_t child, int alive, int timeout_s, int *status)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    const time_t deadline = now.tv_sec + timeout_s;
    int ended = 0;
    while (ended == 0 && now.tv_sec <= deadline) {
        ended = poll(&(struct pollfd){.fd = alive, .events = POLLIN}, 1, 200);
        ended = ended < 0 && errno == EINTR ? 0 : ended;
        clock_gettime(CLOCK_MONOTONIC, &now);
    }
    if (ended <= 0)
        kill(child, SIGKILL);
    while (waitpid(child, status, 0) < 0 && errno == EINTR)
        continue;
    return ended > 0;
}

static struct rg_mesh *judge(const char *name, int status, bool ended, int reply)
{
    if (!ended || (WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU))
        return rg_error_null("%s: Assimp did not come to an end with it in time; the file is "
                             "damaged or too large: repair, convert or decimate it",
                             name);
    if (WIFSIGNALED(status))
        return rg_error_null("%s: Assimp crashed on it (%s); the file is damaged: repair or "
                             "convert it",
                             name, strsignal(WTERMSIG(status)));
    if (WEXITSTATUS(status))
        return rg_error_null("%s: Assimp ended with status %d on it; the file is damaged: repair "
                             "or convert it",
                             name, WEXITSTATUS(status));
    return map_reply(name, reply);
}

struct rg_mesh *rg_mesh_read_by(const char *program, int timeout_s, const char *name,
                                const char *path, const char *member)
{
    int alive[2] = {-1, -1}, status = 0;
    const int reply = memfd_create("raingauge mesh", MFD_CLOEXEC);
    int error = reply < 0 || pipe2(alive, O_CLOEXEC) ? errno : 0;
    pid_t child = 0;
    if (!error) {
        // The end of `alive` that the process has closes when it ends.
        error = rg_program_start((const char *const[]){program, path, member, NULL},
                                 (const int[]){-1, -1, -1, [RG_REPLY_FD] = reply, alive[1]},
                                 RG_REPLY_FD + 2, &child);
        close(alive[1]);
    }
    struct rg_mesh *mesh = NULL;
    if (error) {
        rg_error("%s: %s could not be started: %s", name, program, strerror(error));
    } else {
        const bool ended = wait_for_end(child, alive[0], timeout_s, &status);
        mesh = judge(name, status, ended, reply);
    }
    if (alive[0] >= 0)
        close(alive[0]);
    if (reply >= 0)
        close(reply);
    return mesh;
}

// --- files ---

static bool find_importer(char *path, size_t size)
{
    char folder[PATH_MAX];
    const ssize_t length = readlink("/proc/self/exe", folder, sizeof(folder) - 1);
    folder[length < 0 ? 0 : length] = 0;
    char *slash = strrchr(folder, '/');
    if (slash)
        *slash = 0;
    for (size_t i = 0; i < sizeof(importer_places) / sizeof(importer_places[0]); i++) {
        const int written = snprintf(path, size, "%s/%s", folder, importer_places[i]);
        if (written > 0 && (size_t)written < size && !access(path, X_OK))
            return true;
    }
    return rg_error("meshes are read by raingauge_importer, which is not beside raingauge in %s; "
                    "build or install it again",
                    folder);
}

// What is refused before anything is opened.
static bool check_file(const char *path, int64_t *bytes)
{
    struct stat st;
    if (stat(path, &st))
        return rg_error("%s: %s; check the name", path, strerror(errno));
    if (S_ISDIR(st.st_mode))
        return rg_error("%s: is a folder; name a mesh in it", path);
    if (!S_ISREG(st.st_mode))
        return rg_error("%s: is not a regular file; copy the mesh to one", path);
    if (access(path, R_OK))
        return rg_error("%s: %s; change the file's permissions", path, strerror(errno));
    if (st.st_size == 0)
        return rg_error("%s: is empty; write it again", path);
    if (st.st_size > RG_IMPORT_MAX_FILE_BYTES)
        return rg_error("%s: has %lld bytes; at most %lld are read: decimate the mesh first", path,
                        (long long)st.st_size, (long long)RG_IMPORT_MAX_FILE_BYTES);
    *bytes = st.st_size;
    return true;
}

struct rg_mesh *rg_mesh_read(const char *path, const char *member)
{
    char program[PATH_MAX];
    int64_t bytes = 0;
    if (!check_file(path, &bytes) || !find_importer(program, sizeof(program)))
        return NULL;
    // Long enough for the CPU time that the importer allows itself, however busy the machine is.
    struct rg_mesh *mesh =
        rg_mesh_read_by(program, (int)(60 + 10 * bytes / 1000000), path, path, member);
    if (mesh) {
        const char *file = member ? member : path, *slash = strrchr(file, '/');
        snprintf(mesh->name, sizeof(mesh->name), "%s", slash ? slash + 1 : file);
    }
    return mesh;
}
