#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>

#include <cstdio>
#include <exception>
#include <memory>

#include "core/image/files/oiio.h"

using OIIO::ImageBuf;
using OIIO::ImageOutput;
using OIIO::ImageSpec;
using OIIO::TypeDesc;

namespace
{

void say(char *why, size_t size, const std::string &text)
{
    snprintf(why, size, "%s", text.c_str());
}

// OpenImageIO does not check that closing a file wrote its last bytes, so we open and close the
// file.
bool write_to(FILE *file, ImageOutput *output, const char *path, ImageSpec &spec,
              const float *texels)
{
    OIIO::Filesystem::IOFile proxy(file, OIIO::Filesystem::IOProxy::Write);
    OIIO::Filesystem::IOProxy *target = &proxy;
    spec.attribute("oiio:ioproxy", TypeDesc::PTR, &target);
    output->set_ioproxy(target);
    const bool good = output->open(path, spec) && output->write_image(TypeDesc::FLOAT, texels);
    return output->close() && good;
}

bool write_file(const char *path, const char *format, int width, int height, int channels,
                const float *texels, char *why, int why_size) noexcept
try {
    std::string kind = format;
    bool tiff = kind.compare(0, 4, "tiff") == 0;
    std::unique_ptr<ImageOutput> output = ImageOutput::create(tiff ? "tiff" : kind);
    if (!output) {
        say(why, why_size, OIIO::geterror());
        return false;
    }
    ImageSpec spec(width, height, channels, kind == "tiff" ? TypeDesc::HALF : TypeDesc::FLOAT);
    if (channels == 2) { // with four, the last is alpha by default
        spec.channelnames = {"Y", "A"};
        spec.alpha_channel = 1;
    }
    spec["oiio:UnassociatedAlpha"] = 1;
    spec["oiio:ColorSpace"] = "linear";
    FILE *file = fopen(path, "wb");
    bool good = file && write_to(file, output.get(), path, spec, texels);
    const bool whole = file && fflush(file) == 0 && !ferror(file);
    good = file && fclose(file) == 0 && whole && good;
    if (!good)
        say(why, why_size,
            whole && output->has_error() ? output->geterror() : "the disk may be full");
    return good;
} catch (const std::exception &e) {
    say(why, why_size, e.what());
    return false;
}

bool compare(const float *a, const float *b, int width, int height, int channels,
             float fail_threshold, float warn_threshold, rg_oiio_comparison *comparison) noexcept
try {
    ImageSpec spec(width, height, channels, TypeDesc::FLOAT);
    ImageBuf buf_a(spec, const_cast<float *>(a)), buf_b(spec, const_cast<float *>(b));
    OIIO::ImageBufAlgo::CompareResults r =
        OIIO::ImageBufAlgo::compare(buf_a, buf_b, fail_threshold, warn_threshold);
    *comparison = {r.meanerror, r.rms_error, r.PSNR,           r.maxerror,      r.maxx,
                   r.maxy,      r.maxc,      (int64_t)r.nfail, (int64_t)r.nwarn};
    return true;
} catch (const std::exception &) {
    return false;
}

} // namespace

extern "C" __attribute__((visibility("default"))) const rg_oiio_functions *rg_oiio_module() noexcept
{
    static const rg_oiio_functions functions = {write_file, compare};
    try {
        OIIO::attribute("threads", 1);
        OIIO::attribute("tiff:half", 1);
    } catch (const std::exception &) {
        return nullptr;
    }
    return &functions;
}
