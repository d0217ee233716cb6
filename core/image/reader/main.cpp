// raingauge_picture_reader: reads one HDR or TIFF file with OpenImageIO and hands back its texels
// (reply.h).
//
// OpenImageIO 2.4 writes past its memory with some files, such as a tiled TIFF of signed 8-bit
// CMYK. In a cage it harms nobody.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <memory>
#include <new>
#include <sys/stat.h>
#include <unistd.h>

extern "C" {
#include "core/base/cage/cage.h"
#include "core/image/reader/reply.h"
}

using OIIO::ImageInput;
using OIIO::ImageSpec;
using OIIO::TypeDesc;

namespace
{

rg_picture_reply reply = {RG_PICTURE_REPLY_MAGIC, 0, 0, 0, 0, 0, ""};
float *texels; // NULL: none

bool refuse(const std::string &why)
{
    snprintf(reply.why, sizeof(reply.why), "%s", why.empty() ? "no reason is given" : why.c_str());
    return false;
}

// Time for 20 megabytes of a file in a second, and memory for what it may hold at most: once as
// texels, once as the file's own values.
void set_limits(int64_t file_bytes)
{
    const int64_t texels =
        file_bytes < RG_PICTURE_MAX_BYTES / 4160 ? file_bytes * 4160 : RG_PICTURE_MAX_BYTES;
    rg_cage_limits limits = {};
    limits.cpu_s = 20 + file_bytes / 20000000;
    limits.memory_bytes = ((int64_t)4 << 30) + 2 * texels;
    rg_cage_limit(&limits);
}

// Readers must not fall back to another format's reader, nor start threads.
void set_library()
{
    OIIO::attribute("try_all_readers", 0);
    OIIO::attribute("threads", 1);
    OIIO::attribute("limits:imagesize_MB", 16384);
}

bool describe(const ImageSpec &spec)
{
    reply.width = spec.width;
    reply.height = spec.height;
    reply.channels = spec.nchannels;
    reply.integer = !spec.format.is_floating_point();
    return (spec.depth <= 1 && !spec.deep) || refuse("is a volume or deep; flatten it");
}

bool read_texels(ImageInput *input)
{
    texels = static_cast<float *>(calloc((size_t)rg_picture_reply_values(&reply), sizeof(float)));
    if (!texels)
        _exit(RG_CAGE_NO_MEMORY);
    return (input->read_image(0, 0, 0, reply.channels, TypeDesc::FLOAT, texels) &&
            !input->has_error()) ||
           refuse(input->geterror());
}

bool read_picture(const char *name, int64_t file_bytes)
try {
    OIIO::Filesystem::IOFile proxy(fdopen(RG_CAGE_FILE, "rb"), OIIO::Filesystem::IOProxy::Read);
    ImageSpec hints;
    hints["oiio:UnassociatedAlpha"] = 1;
    OIIO::Filesystem::IOProxy *source = &proxy;
    hints.attribute("oiio:ioproxy", TypeDesc::PTR, &source); // some readers look for it only there
    std::unique_ptr<ImageInput> input = ImageInput::open(name, &hints, &proxy);
    if (!input)
        return refuse(OIIO::geterror());
    if (!describe(input->spec()))
        return false;
    if (!rg_picture_reply_is_possible(&reply) || !rg_picture_reply_fits(&reply, file_bytes))
        return true; // the receiver says so
    return read_texels(input.get());
} catch (const std::bad_alloc &) {
    _exit(RG_CAGE_NO_MEMORY);
} catch (const std::exception &e) {
    return refuse(e.what());
}

} // namespace

int main(int argc, char **argv)
{
    struct stat st;
    if (argc != 2 || fstat(RG_CAGE_FILE, &st)) {
        fputs("raingauge_picture_reader is started by raingauge\n", stderr);
        return 2;
    }
    set_limits(st.st_size);
    set_library();
    if (!rg_cage_shut())
        _exit(RG_CAGE_REFUSED);
    const bool is_read = read_picture(argv[1], st.st_size) && texels;
    const size_t values = is_read ? (size_t)rg_picture_reply_values(&reply) : 0;
    const bool put =
        rg_cage_reply(&reply, sizeof(reply)) && rg_cage_reply(texels, values * sizeof(float));
    _exit(put ? 0 : 1); // not exit: destructors of libraries are not part of the work
}
