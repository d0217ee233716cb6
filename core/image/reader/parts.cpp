// Describes the parts of a file other than its first picture.
#include <cstdio>

#include "core/image/reader/bands.h"

using OIIO::ImageInput;
using OIIO::ImageSpec;

namespace
{

enum { MOST_PARTS = 4096 };

// Describes one part of an EXR, page of a TIFF, or smaller level of either.
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

} // namespace

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
