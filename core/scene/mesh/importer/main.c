// raingauge_importer: reads one mesh with Assimp and hands back plain arrays (reply.h).
//
// Assimp reads 40 formats, and crashes or loops on some damaged files. In a process of its own it
// harms nobody.
#define _DEFAULT_SOURCE // RLIMIT_AS
#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include "core/scene/mesh/importer/importer.h"

#if defined(__has_feature)
#if __has_feature(address_sanitizer) // clang's name for it
#define __SANITIZE_ADDRESS__
#endif
#endif
#ifdef __SANITIZE_ADDRESS__ // slower, and its shadow alone takes terabytes of addresses
enum { SLOWNESS = 3, LIMITS_MEMORY = 0 };
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
    if (!read || !import_load(&import))
        import.reply.vertex_count = import.reply.face_count = 0;
    // Not exit: destructors of libraries are not part of the work.
    _exit(put_reply(&import) ? 0 : 1);
}
