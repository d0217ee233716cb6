// Reads a picture's texels, and digests what is left out of them.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <unistd.h>
#include <vector>

#include "core/image/reader/bands.h"

extern "C" {
#include "core/base/cage/cage.h"
#include "core/image/srgb.h"
}

using OIIO::ImageInput;
using OIIO::ImageSpec;
using OIIO::TypeDesc;

namespace
{

// Maps the picture's channels to the file's; -1: none.
struct Picture {
    ImageSpec spec; // of the data window
    std::vector<int> slots;
    int channels = 0, colours = 0, orientation = 1;
    int x = 0, y = 0, width = 0, height = 0; // the region shown, in the file's orientation
    float *texels = nullptr;
    float *light = nullptr; // linear values of 8- or 16-bit codes
    double largest = 0;
    Digests outside{4}; // digests of texels outside the window
    bool loses = false;
    double beyond = 0; // a value that is finite, and larger than any float
    int64_t values_outside = 0;
};

// Chooses EXR's channels by name, as core/image/files/exr.c does, and others by position.
bool choose_channels(Reading &reading, Picture &p)
{
    static const char *const sets[][4] = {{"R", "G", "B", "A"}, {"Y", "A"}, {"V", "A"}};
    p.slots.assign((size_t)p.spec.nchannels, -1);
    if (!reading.is_exr()) {
        const int alpha = p.spec.alpha_channel;
        const bool has_alpha = alpha >= 0 && alpha < p.spec.nchannels;
        p.colours = p.spec.nchannels - has_alpha >= 3 ? 3 : 1;
        for (int c = 0, slot = 0; c < p.spec.nchannels && slot < p.colours; c++)
            if (c != alpha)
                p.slots[(size_t)c] = slot++;
        if (has_alpha)
            p.slots[(size_t)alpha] = p.colours;
        p.channels = p.colours + has_alpha;
        return true;
    }
    for (const auto &set : sets) {
        int found = 0;
        for (const char *name : set)
            if (const int c = name ? p.spec.channelindex(name) : -1; c >= 0)
                p.slots[(size_t)c] = found++;
        if (found >= (set[2] ? 3 : 1)) {
            p.channels = found;
            p.colours = found >= 3 ? 3 : 1;
            return true;
        }
        std::fill(p.slots.begin(), p.slots.end(), -1);
    }
    return reading.refuse("has no channels R, G and B, nor Y; rename them");
}

// An EXR shows its display window. Other formats are shown whole, wherever their window lies.
void choose_window(Reading &reading, Picture &p)
{
    const ImageSpec &s = p.spec;
    const bool is_exr = reading.is_exr();
    p.x = is_exr ? s.full_x : s.x;
    p.y = is_exr ? s.full_y : s.y;
    p.width = is_exr ? s.full_width : s.width;
    p.height = is_exr ? s.full_height : s.height;
    if (p.x || p.y)
        reading.tell(true, is_exr ? "origin of the display window" : "offset",
                     std::to_string(p.x) + ", " + std::to_string(p.y));
    const bool is_turned = p.orientation > 4;
    reading.reply.width = is_turned ? p.height : p.width;
    reading.reply.height = is_turned ? p.width : p.height;
    reading.reply.channels = p.channels;
}

void prepare_codes(Reading &reading, Picture &p)
{
    p.largest = reading.is_exr() ? 0 : largest_code(p.spec.format);
    reading.reply.is_decoded = p.largest > 0;
    if (p.largest == 255 || p.largest == 65535)
        p.light = rg_light_of_codes((int)p.largest + 1, 0);
}

// Converts a value to a texel, and notes whether any bit was lost.
float texel_of(Picture &p, double value, int slot)
{
    const float nearest = (float)value;
    if (std::isinf(nearest) && std::isfinite(value))
        p.beyond = value;
    if (p.largest == 0 || p.largest > 65535) // less are told apart as floats
        p.loses = p.loses || (double)nearest < value || (double)nearest > value;
    if (slot >= p.colours || p.largest == 0)
        return nearest;
    return p.light ? p.light[(size_t)std::rint(value * p.largest)] : (float)rg_srgb_decode(value);
}

// The texel's place in the picture, by Exif's orientation, which tells the corner of the first one.
size_t place_of(const Picture &p, int x, int y)
{
    const int o = p.orientation;
    const int across = o == 2 || o == 3 || o == 7 || o == 8 ? p.width - 1 - x : x;
    const int down = o == 3 || o == 4 || o == 6 || o == 7 ? p.height - 1 - y : y;
    return o > 4 ? (size_t)across * (size_t)p.height + (size_t)down
                 : (size_t)down * (size_t)p.width + (size_t)across;
}

void take_texel(Picture &p, const double *values, int x, int y)
{
    const bool is_inside = x >= 0 && y >= 0 && x < p.width && y < p.height;
    float *texel = is_inside ? p.texels + place_of(p, x, y) * (size_t)p.channels : nullptr;
    for (size_t c = 0; c < p.slots.size(); c++) {
        if (p.slots[c] < 0)
            continue;
        if (is_inside)
            texel[p.slots[c]] = texel_of(p, values[c], p.slots[c]);
        else if (values[c] != 0) { // zeros also surround a smaller data window
            p.outside.add_value((size_t)p.slots[c], x, y, values[c]);
            p.values_outside++;
        }
    }
}

void take_band(Picture &p, const Band &band)
{
    const size_t channels = p.slots.size();
    for (int line = 0; line < band.lines; line++)
        for (int x = 0; x < p.spec.width; x++) {
            const double *values =
                band.values + ((size_t)line * (size_t)p.spec.width + (size_t)x) * channels;
            take_texel(p, values, p.spec.x + x - p.x, p.spec.y + band.first_line + line - p.y);
        }
}

void take_memory(Reading &reading, Picture &p)
{
    // calloc, because texels outside the data window are 0.
    p.texels = static_cast<float *>(
        calloc((size_t)rg_picture_reply_values(&reading.reply), sizeof(float)));
    if (!p.texels)
        _exit(RG_CAGE_NO_MEMORY);
    reading.texels = p.texels;
}

bool read_picture(Reading &reading, ImageInput &input, Picture &p)
{
    Digests digests(p.spec.nchannels);
    const bool has_more = std::count(p.slots.begin(), p.slots.end(), -1) > 0;
    bool may_lose = false;
    for (int c = 0; c < p.spec.nchannels; c++) {
        const TypeDesc type = p.spec.channelformat(c);
        may_lose = may_lose || type == TypeDesc::DOUBLE || largest_code(type) > 65535;
    }
    if (!each_band(reading, input, 0, 0, [&](const Band &band) {
            take_band(p, band);
            if (has_more || may_lose)
                digests.add(p.spec, band);
        }))
        return false;
    if (p.beyond != 0) {
        char why[80];
        snprintf(why, sizeof(why), "a value is %.3g, and the largest float is 3.4e38", p.beyond);
        return reading.refuse(why);
    }
    std::string exact;
    for (size_t c = 0; c < p.slots.size(); c++)
        if (p.slots[c] < 0)
            reading.tell(true, "channel " + std::string(p.spec.channel_name((int)c)),
                         digests.text(c));
        else
            exact += digests.text(c);
    if (p.loses)
        reading.tell(true, "values between floats",
                     digest_text(XXH3_64bits(exact.data(), exact.size())));
    if (p.values_outside)
        reading.tell(true, "values outside the display window",
                     std::to_string(p.values_outside) + ", " + p.outside.text_of_all());
    return true;
}

} // namespace

bool read_all(Reading &reading, ImageInput &input)
{
    Picture p;
    p.spec = input.spec(0, 0);
    if (p.spec.deep || p.spec.depth > 1)
        return reading.refuse("is a volume or deep; flatten it");
    p.orientation = read_head(reading, p.spec);
    tell_attributes(reading, p.spec);
    if (reading.reply.why[0] || !choose_channels(reading, p))
        return false;
    choose_window(reading, p);
    prepare_codes(reading, p);
    reading.reply.is_associated =
        p.channels > p.colours && !p.spec.get_int_attribute("oiio:UnassociatedAlpha", 0);
    if (!rg_picture_reply_is_possible(&reading.reply) ||
        !rg_picture_reply_fits(&reading.reply, reading.file_bytes) ||
        rg_picture_reply_texel_bytes(&reading.reply) > reading.most_bytes)
        return true; // the receiver says so
    take_memory(reading, p);
    return read_picture(reading, input, p) && tell_parts(reading, input);
}
