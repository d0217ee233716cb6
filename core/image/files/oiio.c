#include "core/image/files/oiio.h"

#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/base/cage/cage.h"
#include "core/base/memory.h"
#include "core/base/program.h"
#include "core/image/files/format.h"
#include "core/image/reader/reply.h"

static pthread_once_t once = PTHREAD_ONCE_INIT;
static const struct rg_oiio_functions *functions;
static char load_error[300];

static void load(void)
{
    char path[PATH_MAX];
    const bool found = rg_program_part("raingauge_oiio.so", path, sizeof(path));
    void *module = found ? dlopen(path, RTLD_LAZY | RTLD_LOCAL) : NULL;
    const struct rg_oiio_functions *(*entry)(void) = NULL;
    if (module) {
        void *symbol = dlsym(module, "rg_oiio_module");
        memcpy(&entry, &symbol, sizeof(entry)); // ISO C has no cast from object to function
    }
    functions = entry ? entry() : NULL;
    const char *error = !found ? "raingauge_oiio.so is not beside raingauge; install it again, or "
                                 "Debian's raingauge-oiio"
                        : functions ? NULL
                                    : dlerror();
    if (!functions)
        snprintf(load_error, sizeof(load_error), "OpenImageIO cannot be loaded: %s",
                 error ? error : "it does not start");
}

const struct rg_oiio_functions *rg_oiio(char *why, int why_size)
{
    pthread_once(&once, load);
    if (!functions)
        snprintf(why, (size_t)why_size, "%s", load_error);
    return functions;
}

// --- reading, in the reader's process ---

// Takes the extras, a text after the texels.
static bool take_extras(const char *extras, uint32_t bytes, struct rg_picture *picture,
                        struct rg_why *why)
{
    if (!bytes)
        return true;
    picture->extras = malloc((size_t)bytes + 1);
    if (!picture->extras)
        return rg_why_system(why, ENOMEM,
                             "no memory for what it holds besides; close other programs");
    memcpy(picture->extras, extras, bytes);
    picture->extras[bytes] = 0;
    return true;
}

// Takes the texels and extras after the header into the picture, whose memory is allocated.
static bool take_rest(const char *rest, size_t bytes, const struct rg_picture_reply *header,
                      struct rg_picture *picture, struct rg_why *why)
{
    const size_t texels_bytes = (size_t)rg_picture_reply_texel_bytes(header);
    if (header->extras_bytes > RG_PICTURE_EXTRAS_BYTES ||
        bytes != texels_bytes + header->extras_bytes)
        return rg_why_set(why, "raingauge_picture_reader handed back a part of it; build "
                               "raingauge again");
    picture->decoded = header->is_decoded != 0;
    picture->is_associated = header->is_associated != 0;
    memcpy(picture->texels, rest, texels_bytes);
    return take_extras(rest + texels_bytes, header->extras_bytes, picture, why);
}

bool rg_oiio_take_reply(const void *reply, size_t bytes, int64_t file_bytes, int64_t most_bytes,
                        struct rg_picture *picture, struct rg_why *why)
{
    struct rg_picture_reply header;
    if (bytes < sizeof(header))
        return rg_why_set(why, "raingauge_picture_reader gave no reply; build raingauge again");
    memcpy(&header, reply, sizeof(header));
    if (header.magic != RG_PICTURE_REPLY_MAGIC)
        return rg_why_set(why, "raingauge_picture_reader is of another version; build raingauge "
                               "again");
    header.why[sizeof(header.why) - 1] = 0;
    if (header.why[0])
        return rg_why_set(why, "cannot be read: %s; write it again", header.why);
    if (!rg_picture_reply_fits(&header, file_bytes))
        return rg_why_set(
            why, "promises %.0f values, more than its %lld bytes can hold; write it again",
            (double)header.width * header.height * header.channels, (long long)file_bytes);
    if (rg_picture_reply_texel_bytes(&header) > most_bytes)
        return rg_why_set(why,
                          "no memory for %d x %d pixels (%lld MiB, and as much while it is read); "
                          "crop it, or allow more with --memory",
                          header.width, header.height,
                          (long long)(rg_picture_reply_texel_bytes(&header) >> 20));
    return rg_why_allocate(picture, header.width, header.height, header.channels, why) &&
           take_rest((const char *)reply + sizeof(header), bytes - sizeof(header), &header, picture,
                     why);
}

// The most bytes of texels for which there is memory. They exist twice for a while: as the reply,
// and as the picture. A few are always allowed.
static int64_t most_texels(void)
{
    const int64_t few = (int64_t)32 << 20, left = rg_memory_left() / 2;
    return left < few ? few : left < RG_PICTURE_MAX_BYTES ? left : RG_PICTURE_MAX_BYTES;
}

static bool read_caged(const char *path, int file, int64_t file_bytes, struct rg_picture *picture,
                       struct rg_why *why)
{
    const int64_t most_bytes = most_texels();
    char program[PATH_MAX], name[32], most[24];
    struct rg_caged caged;
    if (!rg_program_part("raingauge_picture_reader", program, sizeof(program)))
        return rg_why_set(why, "raingauge_picture_reader is not beside raingauge; install it "
                               "again, or Debian's raingauge-oiio");
    const char *extension = strrchr(path, '.');
    snprintf(name, sizeof(name), "picture%s", extension ? extension : "");
    snprintf(most, sizeof(most), "%lld", (long long)most_bytes);
    const int error = rg_caged_run(
        (const char *const[]){program, name, most, NULL}, file, (int)(60 + file_bytes / 1000000),
        (int64_t)sizeof(struct rg_picture_reply) + most_bytes + RG_PICTURE_EXTRAS_BYTES, &caged);
    const enum rg_caged_end end =
        error ? RG_CAGED_LACKING
              : rg_caged_end(&caged, "OpenImageIO", why->text, sizeof(why->text));
    if (error)
        rg_why_set(why, "%s could not be started: %s; %s", program, strerror(error),
                   rg_program_mend(error));
    why->fault = end == RG_CAGED_LACKING ? RG_FAULT_HARNESS
                 : end == RG_CAGED_FILE  ? RG_FAULT_INPUT
                                         : RG_FAULT_NONE;
    const bool good =
        end == RG_CAGED_SOUND &&
        rg_oiio_take_reply(caged.reply, caged.bytes, file_bytes, most_bytes, picture, why);
    free(caged.reply);
    return good;
}

bool rg_oiio_read(const char *path, int64_t file_bytes, struct rg_picture *picture,
                  struct rg_why *why)
{
    const int file = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    if (file < 0)
        return rg_why_system(why, errno, "%s; check the path", strerror(errno));
    const bool good = read_caged(path, file, file_bytes, picture, why);
    close(file);
    if (!good)
        rg_picture_destroy(picture);
    return good;
}

// --- writing ---

static bool write_as(const char *path, const char *format, const struct rg_picture *picture,
                     struct rg_why *why)
{
    const struct rg_oiio_functions *oiio = rg_oiio(why->text, sizeof(why->text));
    char reason[400];
    return oiio && (oiio->write(path, format, picture->width, picture->height, picture->channels,
                                picture->texels, reason, sizeof(reason)) ||
                    rg_why_unwritten(why, reason));
}

bool rg_oiio_write_hdr(const char *path, const struct rg_picture *picture,
                       const struct rg_write_options *options, struct rg_why *why)
{
    (void)options;
    if (picture->channels != 3)
        return rg_why_set(why, "HDR files hold 3 channels, not %d; write .exr", picture->channels);
    return write_as(path, "hdr", picture, why);
}

bool rg_oiio_write_tiff(const char *path, const struct rg_picture *picture,
                        const struct rg_write_options *options, struct rg_why *why)
{
    return write_as(path, options->full_float ? "tiff-float" : "tiff", picture, why);
}
