#include "core/image/files/oiio.h"

#include <dlfcn.h>
#include <pthread.h>
#include <stdio.h>
#include <string.h>

#include "core/image/files/format.h"
#include "core/image/srgb.h"

static pthread_once_t once = PTHREAD_ONCE_INIT;
static const struct rg_oiio_functions *functions;
static char load_error[300];

static void load(void)
{
    // Found through the executable's run path: beside the build's or the installation's files.
    void *module = dlopen("raingauge_oiio.so", RTLD_LAZY | RTLD_LOCAL);
    const struct rg_oiio_functions *(*entry)(void) = NULL;
    if (module) {
        void *symbol = dlsym(module, "rg_oiio_module");
        memcpy(&entry, &symbol, sizeof(entry)); // ISO C has no cast from object to function
    }
    functions = entry ? entry() : NULL;
    const char *error = functions ? NULL : dlerror();
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

// Values of integer files are sRGB-encoded: bends them to linear light, alpha excepted.
static bool decode(struct rg_picture *picture)
{
    picture->decoded = true;
    int colours = rg_picture_colours(picture);
    int64_t values = rg_picture_values(picture);
    for (int64_t i = 0; i < values; i++)
        if (i % picture->channels < colours)
            picture->texels[i] = (float)rg_srgb_decode(picture->texels[i]);
    return true;
}

static bool read_open_file(const struct rg_oiio_functions *oiio, struct rg_oiio_file *file,
                           int64_t file_bytes, struct rg_picture *picture, struct rg_why *why)
{
    int64_t bytes = (int64_t)file->width * file->height * file->channels;
    if (bytes / 1040 > file_bytes)
        return rg_why_set(why,
                          "promises %lld values, more than its %lld bytes can hold; write it "
                          "again",
                          (long long)bytes, (long long)file_bytes);
    if (!rg_picture_allocate(picture, file->width, file->height, file->channels, why->text,
                             sizeof(why->text)))
        return false;
    if (!oiio->read(file, picture->texels))
        return rg_why_set(why, "cannot be read: %s; write it again", file->why);
    return file->integer ? decode(picture) : true;
}

bool rg_oiio_read(const char *path, int64_t file_bytes, struct rg_picture *picture,
                  struct rg_why *why)
{
    const struct rg_oiio_functions *oiio = rg_oiio(why->text, sizeof(why->text));
    if (!oiio)
        return false;
    struct rg_oiio_file file = {0};
    bool good = oiio->open(path, &file)
                    ? read_open_file(oiio, &file, file_bytes, picture, why)
                    : rg_why_set(why, "cannot be read: %s; write it again", file.why);
    oiio->close(&file);
    if (!good)
        rg_picture_destroy(picture);
    return good;
}

static bool write_as(const char *path, const char *format, const struct rg_picture *picture,
                     struct rg_why *why)
{
    const struct rg_oiio_functions *oiio = rg_oiio(why->text, sizeof(why->text));
    char reason[400];
    return oiio && (oiio->write(path, format, picture->width, picture->height, picture->channels,
                                picture->texels, reason, sizeof(reason)) ||
                    rg_why_set(why, "cannot be written: %s", reason));
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
