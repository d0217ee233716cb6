#include "core/image/reader/bands.h"

#include <algorithm>
#include <cmath>
#include <cstring>

extern "C" {
#include "core/image/half.h"
}

using OIIO::ImageInput;
using OIIO::ImageSpec;
using OIIO::TypeDesc;

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

namespace
{

enum { BAND_LINES = 64 };

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

// Converts texels to doubles, because OpenImageIO would round them to floats. Codes become
// quotients by the largest code, except EXR's, which stay whole numbers.
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

    bool is_known = true; // every type is known

  private:
    static constexpr unsigned number_types =
        1u << TypeDesc::UINT8 | 1u << TypeDesc::INT8 | 1u << TypeDesc::UINT16 |
        1u << TypeDesc::INT16 | 1u << TypeDesc::UINT32 | 1u << TypeDesc::INT32 |
        1u << TypeDesc::HALF | 1u << TypeDesc::FLOAT | 1u << TypeDesc::DOUBLE;
    std::vector<TypeDesc> types;
    std::vector<double> most;
};

} // namespace

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

Digests::Digests(int channels) : states((size_t)channels)
{
    for (XXH3_state_t *&state : states) {
        state = XXH3_createState();
        XXH3_64bits_reset(state);
    }
}

void Digests::add(const ImageSpec &spec, const Band &band)
{
    const double *value = band.values;
    for (int line = 0; line < band.lines; line++)
        for (int x = 0; x < spec.width; x++)
            for (size_t c = 0; c < states.size(); c++, value++)
                add_value(c, spec.x + x - spec.full_x,
                          spec.y + band.first_line + line - spec.full_y, *value);
}

void Digests::add_value(size_t channel, int x, int y, double value)
{
    const double told[] = {(double)x, (double)y, value};
    if (value != 0 || std::signbit(value))
        XXH3_64bits_update(states[channel], told, sizeof(told));
}

std::string Digests::text(size_t channel) const
{
    return digest_text(XXH3_64bits_digest(states[channel]));
}

std::string Digests::text_of_all() const
{
    std::string all;
    for (size_t c = 0; c < states.size(); c++)
        all += text(c);
    return digest_text(XXH3_64bits(all.data(), all.size()));
}
