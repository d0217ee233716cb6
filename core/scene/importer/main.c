// raingauge_importer: reads one mesh with Assimp and hands back plain arrays (reply.h).
//
// Assimp reads 40 formats and crashes or loops on some damaged files of them. Here that harms
// nobody.
#define _DEFAULT_SOURCE // RLIMIT_AS
#include <assimp/cimport.h>
#include <assimp/postprocess.h>
#include <errno.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include "core/scene/importer/importer.h"

bool import_refuse(struct import *import, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    vsnprintf(import->reply.error, sizeof(import->reply.error), format, args);
    va_end(args);
    return false;
}

#ifdef __SANITIZE_ADDRESS__ // slower, and its shadow alone takes terabytes of addresses
enum { SLOWNESS = 10, LIMITS_MEMORY = 0 };
#else
enum { SLOWNESS = 1, LIMITS_MEMORY = 1 };
#endif

// Bounds what one file may take: two seconds of CPU time and one more a megabyte, of which Assimp
// reads ten or more in a second, and the memory of reply.h.
static void set_limits(size_t file_bytes)
{
    const rlim_t seconds = SLOWNESS * (2 + file_bytes / 1000000);
    struct rlimit cpu;
    if (!getrlimit(RLIMIT_CPU, &cpu) && (cpu.rlim_max == RLIM_INFINITY || cpu.rlim_max > seconds)) {
        cpu.rlim_cur = seconds; // the harder limit stays: at the soft one comes SIGXCPU
        setrlimit(RLIMIT_CPU, &cpu);
    }
    setrlimit(RLIMIT_CORE, &(struct rlimit){0, 0});
    if (LIMITS_MEMORY)
        setrlimit(RLIMIT_AS,
                  &(struct rlimit){RG_IMPORT_MAX_MEMORY_BYTES, RG_IMPORT_MAX_MEMORY_BYTES});
}

static bool load(struct import *import)
{
    int64_t claimed;
    if (!import_check_claim(import, &claimed))
        return false;
    struct aiFileIO files = import_files(import);
    const struct aiScene *scene = aiImportFileEx(import->name, 0, &files);
    if (!scene)
        return import_refuse(import,
                             "Assimp cannot read it (%s); use a sound OBJ, PLY, STL, glTF, "
                             "3DS or OFF file",
                             aiGetErrorString());
    if (!import_check_scene(import, scene))
        return false;
    const int64_t polygons = import_count_polygons(scene);
    if (polygons < claimed)
        return import_refuse(import,
                             "only %lld of the %lld faces that its header promises could be "
                             "read; it is cut short or unusual: export it again, as triangles",
                             (long long)polygons, (long long)claimed);
    scene = aiApplyPostProcessing(scene, aiProcess_Triangulate);
    if (!scene)
        return import_refuse(import, "Assimp cannot triangulate it; export triangles");
    return import_check_scene(import, scene) && import_gather(import, scene);
}

static bool put(const void *data, size_t bytes)
{
    for (size_t done = 0; done < bytes;) {
        const ssize_t written = write(RG_REPLY_FD, (const char *)data + done, bytes - done);
        if (written < 0 && errno != EINTR)
            return false;
        done += written > 0 ? (size_t)written : 0;
    }
    return true;
}

static bool put_reply(const struct import *import)
{
    const struct rg_import_reply *reply = &import->reply;
    const size_t vertices = reply->vertex_count, faces = reply->face_count;
    return put(reply, sizeof(*reply)) && put(import->positions, vertices * 3 * sizeof(float)) &&
           put(import->normals, vertices * 3 * sizeof(float)) &&
           put(import->indices, faces * 3 * sizeof(uint32_t));
}

int main(int argc, char **argv)
{
    static struct import import = {.reply = {.magic = RG_REPLY_MAGIC}};
    if (argc < 2 || argc > 3) {
        fputs("raingauge_importer is started by raingauge\n", stderr);
        return 2;
    }
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    set_limits(0);
    const bool read = import_read(&import, argv[1], argc > 2 ? argv[2] : NULL);
    set_limits(import.size);
    if (!read || !load(&import))
        import.reply.vertex_count = import.reply.face_count = 0;
    // Not exit: destructors of libraries are not part of the work.
    _exit(put_reply(&import) ? 0 : 1);
}
