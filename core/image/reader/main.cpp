// raingauge_picture_reader: reads one picture with OpenImageIO, and returns its texels and what
// else the file holds (reply.h). It reads HDR and TIFF, and EXR files that core/image/files/exr.c
// cannot read.
//
// OpenImageIO 2.4 writes beyond its memory with some files, such as a tiled TIFF of signed 8-bit
// CMYK; the cage makes that harmless.
#include <OpenImageIO/filesystem.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <memory>
#include <new>
#include <sys/stat.h>
#include <unistd.h>

#include "core/image/reader/reader.h"

extern "C" {
#include "core/base/cage/cage.h"
}

using OIIO::ImageInput;
using OIIO::ImageSpec;
using OIIO::TypeDesc;

namespace
{

// A second of time for 20 megabytes of a file, and memory for the most that it may hold: once as
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

// Keeps readers from falling back to another format's reader and from starting threads.
void set_library()
{
    OIIO::attribute("try_all_readers", 0);
    OIIO::attribute("threads", 1);
    OIIO::attribute("exr_threads", -1);
    OIIO::attribute("limits:imagesize_MB", 16384);
}

bool read_file(Reading &reading)
try {
    OIIO::Filesystem::IOFile proxy(fdopen(RG_CAGE_FILE, "rb"), OIIO::Filesystem::IOProxy::Read);
    ImageSpec hints;
    hints["oiio:UnassociatedAlpha"] = 1;
    OIIO::Filesystem::IOProxy *source = &proxy;
    hints.attribute("oiio:ioproxy", TypeDesc::PTR, &source); // some readers look for it only here
    std::unique_ptr<ImageInput> input =
        ImageInput::open("picture." + reading.extension, &hints, &proxy);
    if (!input)
        return reading.refuse(OIIO::geterror());
    return read_all(reading, *input);
} catch (const std::bad_alloc &) {
    _exit(RG_CAGE_NO_MEMORY);
} catch (const std::exception &e) {
    return reading.refuse(e.what());
}

bool put_reply(Reading &reading)
{
    if (reading.extras.size() > RG_PICTURE_EXTRAS_BYTES)
        reading.refuse("has too many parts or channels; keep those that count");
    if (reading.reply.why[0] || !reading.texels)
        return rg_cage_reply(&reading.reply, sizeof(reading.reply));
    reading.reply.extras_bytes = (uint32_t)reading.extras.size();
    return rg_cage_reply(&reading.reply, sizeof(reading.reply)) &&
           rg_cage_reply(reading.texels, (size_t)rg_picture_reply_texel_bytes(&reading.reply)) &&
           rg_cage_reply(reading.extras.data(), reading.extras.size());
}

} // namespace

int main(int argc, char **argv)
{
    struct stat st;
    if (argc != 3 || fstat(RG_CAGE_FILE, &st)) {
        fputs("raingauge_picture_reader is started by raingauge\n", stderr);
        return 2;
    }
    Reading reading = {};
    reading.reply.magic = RG_PICTURE_REPLY_MAGIC;
    reading.pages = 1;
    reading.most_bytes = strtoll(argv[2], nullptr, 10);
    const char *extension = strrchr(argv[1], '.');
    for (const char *c = extension ? extension + 1 : ""; *c; c++)
        reading.extension += (char)tolower((unsigned char)*c);
    reading.file_bytes = st.st_size;
    if (reading.is_exr() && reading.file_bytes < RG_PICTURE_EXR_BYTES)
        reading.file_bytes = RG_PICTURE_EXR_BYTES;
    set_limits(reading.file_bytes);
    set_library();
    if (!rg_cage_shut())
        _exit(RG_CAGE_REFUSED);
    read_file(reading);
    const bool put = put_reply(reading);
    _exit(put ? 0 : 1); // _exit skips the destructors of libraries
}
