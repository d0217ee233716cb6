// The texels of a file: those of the picture, and digests of all others.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <functional>
#include <unistd.h>
#include <vector>
#include <xxhash.h>

#include "core/image/reader/reader.h"

extern "C" {
#include "core/base/cage/cage.h"
#include "core/image/half.h"
#include "core/image/srgb.h"
}

using OIIO::ImageInput;
using OIIO::ImageSpec;
using OIIO::TypeDesc;

namespace
{

enum { BAND_LINES = 64, MOST_PARTS = 4096 };

// --- bands of texels, as doubles ---

// The largest code of integers, 0 for floats.
double largest_code(TypeDesc type)
{
    static const struct {
        TypeDesc::BASETYPE type;
        double largest;
    } known[] = {{TypeDesc::UINT8, 255},
                 {TypeDesc::INT8, 127},
                 {TypeDesc::UINT16, 65535},
                 {TypeDesc::INT16, 32767},
                 {TypeDesc::UINT32, 4294967295.0},
                 {TypeDesc::INT32, 2147483647.0},
                 {TypeDesc::UINT64, 18446744073709551615.0},
                 {TypeDesc::INT64, 9223372036854775807.0}};
    for (const auto &one : known)
        if (type.basetype == one.type)
            return one.largest;
    return 0;
}

struct Band {
    int first_line, lines; // of the data window
    const double *values;  // of all channels
};

bool is_readable(const ImageSpec &spec)
{
    return spec.width > 0 && spec.height > 0 && spec.nchannels > 0 &&
           (double)spec.width * spec.nchannels * 8 * BAND_LINES < 2e9;
}

double number_of(const unsigned char *at, TypeDesc type)
{
    const auto as = [at](auto value) {
        memcpy(&value, at, sizeof(value));
        return value;
    };
    switch (type.basetype) {
    case TypeDesc::UINT8:
        return as(uint8_t());
    case TypeDesc::INT8:
        return as(int8_t());
    case TypeDesc::UINT16:
        return as(uint16_t());
    case TypeDesc::INT16:
        return as(int16_t());
    case TypeDesc::UINT32:
        return as(uint32_t());
    case TypeDesc::INT32:
        return as(int32_t());
    case TypeDesc::HALF:
        return (double)rg_float_of_half(as(uint16_t()));
    case TypeDesc::FLOAT:
        return (double)as(float());
    case TypeDesc::DOUBLE:
        return as(double());
    default:
        return 0;
    }
}

// Texels as the file has them, made doubles: OpenImageIO itself would round them to floats. Codes
// become quotients by the largest code, but those of EXR stay whole numbers.
class Converter
{
  public:
    Converter(const ImageSpec &spec, bool is_exr)
    {
        for (int c = 0; c < spec.nchannels; c++) {
            const TypeDesc type = spec.channelformat(c);
            types.push_back(type);
            most.push_back(is_exr ? 0 : largest_code(type));
            is_known = is_known && (number_types >> type.basetype & 1);
        }
    }

    void convert(const std::vector<unsigned char> &from, std::vector<double> &to) const
    {
        const unsigned char *at = from.data();
        for (size_t i = 0; i < to.size(); i += types.size())
            for (size_t c = 0; c < types.size(); at += types[c].size(), c++) {
                const double number = number_of(at, types[c]);
                to[i + c] = most[c] > 0 ? number / most[c] : number;
            }
    }

    bool is_known = true; // every type is

  private:
    static constexpr unsigned number_types =
        1u << TypeDesc::UINT8 | 1u << TypeDesc::INT8 | 1u << TypeDesc::UINT16 |
        1u << TypeDesc::INT16 | 1u << TypeDesc::UINT32 | 1u << TypeDesc::INT32 |
        1u << TypeDesc::HALF | 1u << TypeDesc::FLOAT | 1u << TypeDesc::DOUBLE;
    std::vector<TypeDesc> types;
    std::vector<double> most;
};

// Reads a part's texels band by band.
bool each_band(Reading &reading, ImageInput &input, int part, int level,
               const std::function<void(const Band &)> &take)
{
    const ImageSpec spec = input.spec(part, level);
    const Converter converter(spec, reading.is_exr());
    if (!is_readable(spec))
        return reading.refuse("its rows are too large; cut it into pieces");
    if (!converter.is_known)
        return reading.refuse(
            "holds integers of 64 bits, or no numbers; write it with 32 or fewer");
    const bool is_tiled = spec.tile_width > 0;
    const int step = is_tiled ? spec.tile_height : std::min<int>(BAND_LINES, spec.height);
    const size_t row = (size_t)spec.width * (size_t)spec.nchannels;
    std::vector<unsigned char> native((size_t)spec.width * spec.pixel_bytes(true) * (size_t)step);
    std::vector<double> values(row * (size_t)step);
    for (int y = 0; y < spec.height; y += step) {
        const int lines = std::min(step, spec.height - y), top = spec.y + y;
        const bool good =
            is_tiled ? input.read_tiles(part, level, spec.x, spec.x + spec.width, top, top + lines,
                                        spec.z, spec.z + 1, 0, spec.nchannels, TypeDesc::UNKNOWN,
                                        native.data())
                     : input.read_scanlines(part, level, top, top + lines, spec.z, 0,
                                            spec.nchannels, TypeDesc::UNKNOWN, native.data());
        if (!good || input.has_error())
            return reading.refuse(input.geterror());
        values.resize(row * (size_t)lines);
        converter.convert(native, values);
        take({y, lines, values.data()});
    }
    return true;
}

// --- digests ---

// One for each channel, of its values with their places in the display window: the same of a half
// and of a float, and of a data window that leaves out nothing but zeros.
class Digests
{
  public:
    explicit Digests(int channels) : states((size_t)channels)
    {
        for (XXH3_state_t *&state : states) {
            state = XXH3_createState();
            XXH3_64bits_reset(state);
        }
    }

    void add(const ImageSpec &spec, const Band &band)
    {
        const double *value = band.values;
        for (int line = 0; line < band.lines; line++)
            for (int x = 0; x < spec.width; x++)
                for (size_t c = 0; c < states.size(); c++, value++)
                    add_value(c, spec.x + x - spec.full_x,
                              spec.y + band.first_line + line - spec.full_y, *value);
    }

    void add_value(size_t channel, int x, int y, double value)
    {
        const double told[] = {(double)x, (double)y, value};
        if (value != 0 || std::signbit(value))
            XXH3_64bits_update(states[channel], told, sizeof(told));
    }

    std::string text(size_t channel) const
    {
        return digest_text(XXH3_64bits_digest(states[channel]));
    }

    std::string text_of_all() const
    {
        std::string all;
        for (size_t c = 0; c < states.size(); c++)
            all += text(c);
        return digest_text(XXH3_64bits(all.data(), all.size()));
    }

  private:
    std::vector<XXH3_state_t *> states;
};

// --- the picture ---

// Which of a file's channels is which of the picture's; -1: none of it.
struct Picture {
    ImageSpec spec; // of the data window
    std::vector<int> slots;
    int channels = 0, colours = 0, orientation = 1;
    int x = 0, y = 0, width = 0, height = 0; // of what is shown, as it stands in the file
    float *texels = nullptr;
    float *light = nullptr; // of codes of 8 or 16 bits
    double largest = 0;
    Digests outside{4}; // of what lies there
    bool loses = false;
    int64_t values_outside = 0;
};

// EXR: by names, as core/image/files/exr.c. Others: by place.
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

// What is shown of an EXR is its display window. Others are shown whole, wherever they lie.
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

// A value as a texel has it, and whether that is the value.
float texel_of(Picture &p, double value, int slot)
{
    const float nearest = (float)value;
    if (p.largest == 0 || p.largest > 65535) // less are told apart as floats
        p.loses = p.loses || (double)nearest < value || (double)nearest > value;
    if (slot >= p.colours || p.largest == 0)
        return nearest;
    return p.light ? p.light[(size_t)std::rint(value * p.largest)] : (float)rg_srgb_decode(value);
}

// Where a texel of the file is shown: Exif's orientations, by the corner of the first one.
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
        else if (values[c] != 0) { // of 0 is what lies around a smaller data window, too
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
    // Of 0 is what a data window leaves out.
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

// --- what is left ---

// Parts of EXR, pages of TIFF, smaller levels of either.
bool tell_part(Reading &reading, ImageInput &input, int part, int level)
{
    const ImageSpec spec = input.spec(part, level);
    if (spec.deep || spec.depth > 1)
        return reading.refuse("is a volume or deep; flatten it");
    Digests digests(spec.nchannels);
    if (!each_band(reading, input, part, level, [&](const Band &band) { digests.add(spec, band); }))
        return false;
    std::string names;
    for (const std::string &name : spec.channelnames)
        names += (names.empty() ? "" : ",") + name;
    char shape[80];
    snprintf(shape, sizeof(shape), "%dx%d at %d, %d, ", spec.full_width, spec.full_height,
             spec.full_x, spec.full_y);
    const std::string what = reading.is_exr() ? "part " : "page ";
    const std::string of_level = level ? "level " + std::to_string(level + 1) + " of " : "";
    reading.tell(true, of_level + what + std::to_string(part + 1),
                 shape + names.substr(0, 160) + ", " + digests.text_of_all());
    return true;
}

bool tell_parts(Reading &reading, ImageInput &input)
{
    const int promised =
        reading.is_exr() ? input.spec(0, 0).get_int_attribute("oiio:subimages", 1) : reading.pages;
    int part = 0;
    for (; part < promised && input.seek_subimage(part, 0); part++) {
        if (part >= MOST_PARTS || reading.extras.size() > RG_PICTURE_EXTRAS_BYTES)
            return reading.refuse("has too many parts or channels; keep those that count");
        const std::string name = input.spec(part, 0).get_string_attribute("oiio:subimagename");
        if (!name.empty() && promised > 1)
            reading.tell(true, "name of part " + std::to_string(part + 1), name.substr(0, 200));
        for (int level = part ? 0 : 1; input.seek_subimage(part, level); level++)
            if (!tell_part(reading, input, part, level))
                return false;
    }
    return part >= promised ||
           reading.refuse("its page " + std::to_string(part + 1) + " cannot be read");
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
        !rg_picture_reply_fits(&reading.reply, reading.file_bytes))
        return true; // the receiver says so
    take_memory(reading, p);
    return read_picture(reading, input, p) && tell_parts(reading, input);
}
