// What OpenImageIO reads of a file, and what raingauge reads: the same values. Without arguments,
// of EXR files of every compression, of halves and floats, in lines and in tiles; with arguments,
// of those files, with a count of them.
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <string>
#include <unistd.h>
#include <vector>

extern "C" {
#include "core/base/log.h"
#include "core/image/extras.h"
#include "core/image/files/io.h"
#include "core/image/srgb.h"
}

using OIIO::ImageBuf;
using OIIO::ImageOutput;
using OIIO::ImageSpec;
using OIIO::TypeDesc;

namespace
{

std::string last_line;

void listen(enum rg_log_level level, const char *line, void *)
{
    if (level == RG_LOG_ERROR)
        last_line = line;
}

// The value of a code as light.
double light_of(double code, double gamma)
{
    return gamma > 0 ? std::pow(code, gamma) : rg_srgb_decode(code);
}

// OpenImageIO rounds a PNG's gamma; of 2.2 it is sRGB's. What a profile says goes before it.
bool is_gamma_right(const ImageSpec &native, double ours)
{
    const double theirs = native.get_float_attribute("oiio:Gamma", 0);
    return theirs == 0 ||
           (ours > 0 ? std::fabs(ours - theirs) < 0.01 : std::fabs(theirs - 2.2) < 1e-3);
}

// The file as OpenImageIO has it: upright, and of an EXR the display window.
bool read_theirs(const std::string &path, ImageBuf &shown)
{
    ImageSpec hints;
    hints["oiio:UnassociatedAlpha"] = 1;
    ImageBuf whole(path, 0, 0, nullptr, &hints);
    if (!whole.read(0, 0, true, TypeDesc::DOUBLE) || whole.has_error())
        return false;
    if (path.size() > 4 && path.substr(path.size() - 4) == ".exr")
        whole = OIIO::ImageBufAlgo::crop(whole, whole.roi_full());
    shown = OIIO::ImageBufAlgo::reorient(whole);
    return !shown.has_error();
}

// Which of their channels is ours. EXR's whole numbers are no codes.
std::vector<int> channels_of(const ImageSpec &spec, int ours)
{
    static const std::vector<std::vector<std::string>> sets = {
        {"R", "G", "B", "A"}, {"Y", "A"}, {"V", "A"}};
    std::vector<int> at;
    for (const auto &set : sets) {
        at.clear();
        for (const std::string &name : set)
            if (spec.channelindex(name) >= 0)
                at.push_back(spec.channelindex(name));
        if ((int)at.size() == ours)
            return at;
    }
    at.clear();
    for (int c = 0; c < ours; c++)
        at.push_back(c);
    return at;
}

double expected(const ImageSpec &native, double value, bool is_colour, bool is_exr, double gamma)
{
    if (native.format.is_floating_point())
        return value;
    if (is_exr)
        return std::rint(value * 4294967295.0);
    const double most = native.format == TypeDesc::UINT8    ? 255
                        : native.format == TypeDesc::UINT16 ? 65535
                                                            : 0;
    const double code = most > 0 ? std::rint(value * most) / most : value;
    return is_colour ? light_of(code, gamma) : code;
}

// "" or where they differ.
std::string difference(const std::string &path, const rg_picture &ours, const ImageBuf &theirs,
                       const ImageSpec &native)
{
    const ImageSpec &spec = theirs.spec();
    const bool is_exr = path.size() > 4 && path.substr(path.size() - 4) == ".exr";
    const std::vector<int> at = channels_of(spec, ours.channels);
    char text[200];
    if (spec.width != ours.width || spec.height != ours.height || (int)at.size() != ours.channels ||
        spec.nchannels < ours.channels)
        return "another shape";
    if (!is_gamma_right(native, ours.gamma))
        return "another gamma";
    for (int y = 0; y < ours.height; y++)
        for (int x = 0; x < ours.width; x++)
            for (int c = 0; c < ours.channels; c++) {
                const double value = theirs.getchannel(spec.x + x, spec.y + y, 0, at[(size_t)c]);
                // getchannel rounds to floats, which is where ours end as well.
                const double own =
                    expected(native, value, c < rg_picture_colours(&ours), is_exr, ours.gamma);
                const float mine = ours.texels[((size_t)y * (size_t)ours.width + (size_t)x) *
                                                   (size_t)ours.channels +
                                               (size_t)c];
                const bool is_same = (std::isnan(own) && std::isnan(mine)) ||
                                     (double)mine == (double)(float)own ||
                                     (!native.format.is_floating_point() &&
                                      std::fabs((double)mine - own) <= 1e-6 * std::fabs(own));
                if (is_same)
                    continue;
                snprintf(text, sizeof(text), "x %d, y %d, channel %d: %.9g, not %.9g", x, y, c,
                         (double)mine, own);
                return text;
            }
    return "";
}

enum verdict { EQUAL, REFUSED, DIFFERS };

verdict judge(const std::string &path, std::string &why)
{
    rg_picture ours;
    if (!rg_picture_read(path.c_str(), &ours)) {
        why = last_line;
        return REFUSED;
    }
    ImageBuf theirs;
    ImageBuf native(path);
    why = read_theirs(path, theirs) ? difference(path, ours, theirs, native.nativespec())
                                    : "OpenImageIO refuses it";
    if (why.empty() && ours.extras)
        why = ours.extras;
    const verdict is = why.empty() || (ours.extras && why == ours.extras) ? EQUAL : DIFFERS;
    rg_picture_destroy(&ours);
    return is;
}

// --- files of every kind of EXR ---

bool write_exr(const std::string &path, const std::string &compression, bool is_half, bool is_tiled)
{
    enum { WIDTH = 83, HEIGHT = 71, CHANNELS = 4 }; // no multiple of any block
    ImageSpec spec(WIDTH, HEIGHT, CHANNELS, is_half ? TypeDesc::HALF : TypeDesc::FLOAT);
    spec["compression"] = compression;
    if (is_tiled)
        spec.tile_width = spec.tile_height = 32;
    std::vector<float> texels;
    unsigned noise = 7;
    for (int i = 0; i < WIDTH * HEIGHT * CHANNELS; i++) {
        noise = noise * 1664525u + 1013904223u;
        texels.push_back((float)(noise >> 8) * 0x1p-22f - 1.0f);
    }
    auto output = ImageOutput::create("openexr");
    return output && output->open(path, spec) &&
           output->write_image(TypeDesc::FLOAT, texels.data()) && output->close();
}

int try_kinds()
{
    static const char *const compressions[] = {"none",  "rle", "zips", "zip",  "piz",
                                               "pxr24", "b44", "b44a", "dwaa", "dwab"};
    char folder[] = "/tmp/raingauge-agrees-XXXXXX";
    int equal = 0, all = 0;
    if (!mkdtemp(folder))
        return 1;
    const std::string path = std::string(folder) + "/a.exr";
    for (const char *compression : compressions)
        for (int kind = 0; kind < 4; kind++) {
            std::string why = "cannot be written";
            const bool is = write_exr(path, compression, kind & 1, kind & 2) &&
                            judge(path, why) == EQUAL && why.empty();
            if (!is)
                printf("%s of %s in %s: %s\n", compression, kind & 1 ? "halves" : "floats",
                       kind & 2 ? "tiles" : "lines", why.c_str());
            equal += is;
            all++;
            unlink(path.c_str());
        }
    rmdir(folder);
    printf("%d of %d are equal\n", equal, all);
    return equal == all ? 0 : 1;
}

} // namespace

int main(int argc, char **argv)
{
    static const char *const names[] = {"equal", "refused", "differs"};
    int counts[3] = {0};
    rg_log_listen(listen, nullptr);
    OIIO::attribute("threads", 1);
    if (argc < 2)
        return try_kinds();
    for (int i = 1; i < argc; i++) {
        std::string why;
        const verdict is = judge(argv[i], why);
        counts[is]++;
        printf("%-8s %s%s%s\n", names[is], argv[i], why.empty() ? "" : "\n         ", why.c_str());
    }
    printf("%d equal, %d refused, %d differ\n", counts[EQUAL], counts[REFUSED], counts[DIFFERS]);
    return counts[DIFFERS] ? 1 : 0;
}
