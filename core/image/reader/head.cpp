// Reads a file's header: attributes, and what OpenImageIO (2.4) does not report.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <unistd.h>
#include <vector>
#include <xxhash.h>

#include "core/image/reader/reader.h"

extern "C" {
#include "core/base/cage/cage.h"
}

using OIIO::TypeDesc;

namespace
{

std::vector<unsigned char> bytes_at(uint64_t at, size_t count)
{
    std::vector<unsigned char> bytes(count);
    const ssize_t got = pread(RG_CAGE_FILE, bytes.data(), count, (off_t)at);
    bytes.resize(got > 0 ? (size_t)got : 0);
    return bytes;
}

template <class... Values> std::string printed(const char *format, Values... values)
{
    char text[300];
    snprintf(text, sizeof(text), format, values...);
    return text;
}

// --- HDR: lines of text, an empty one, and the resolution ---

// "-Y 6 +X 8": the axis along which scan lines step comes first, and -Y begins at the top.
int hdr_orientation(const std::string &line)
{
    static const struct {
        const char *signs;
        int orientation;
    } known[] = {{"-Y+X", 1}, {"-Y-X", 2}, {"+Y-X", 3}, {"+Y+X", 4},
                 {"+X-Y", 5}, {"-X-Y", 6}, {"-X+Y", 7}, {"+X+Y", 8}};
    const size_t other = line.find_first_of("+-", 1);
    if (other == std::string::npos)
        return 1;
    const std::string signs = line.substr(0, 2) + line.substr(other, 2);
    for (const auto &one : known)
        if (signs == one.signs)
            return one.orientation;
    return 1;
}

// Whether a factor is 1 and changes nothing.
bool is_one(const std::string &text)
{
    const char *at = text.c_str();
    char *end;
    double value = strtod(at, &end);
    for (; end != at && value == 1; value = strtod(at, &end))
        at = end;
    return end == at && std::string(at).find_first_not_of(" \t\r") == std::string::npos;
}

// A file may have several exposures, each of which was multiplied into its texels.
int read_hdr_head(Reading &reading)
{
    static const char *const names[] = {"COLORCORR", "PRIMARIES", "PIXASPECT", "GAMMA"};
    const std::vector<unsigned char> bytes = bytes_at(0, 1 << 16);
    const std::string text(bytes.begin(), bytes.end());
    double exposure = 1;
    for (size_t at = 0, end; (end = text.find('\n', at)) != std::string::npos; at = end + 1) {
        const std::string line = text.substr(at, end - at);
        const size_t equals = line.find('=');
        if (line.empty()) {
            if (exposure != 1)
                reading.tell(true, "EXPOSURE", printed("%.9g", exposure));
            const size_t last = text.find('\n', end + 1);
            return hdr_orientation(text.substr(end + 1, last - end - 1));
        }
        if (equals == std::string::npos)
            continue;
        const std::string name = line.substr(0, equals), value = line.substr(equals + 1);
        if (name == "EXPOSURE")
            exposure *= atof(value.c_str());
        const bool is_known =
            std::find(std::begin(names), std::end(names), name) != std::end(names);
        if (is_known && !is_one(value))
            reading.tell(name == "PIXASPECT", name, value.substr(0, 200));
    }
    return 1;
}

// --- TIFF: the tags of its first directory ---

// Reads integers in the file's byte order.
struct Tiff {
    bool is_big_endian, is_big; // is_big: BigTIFF, with 64-bit offsets

    uint64_t number(const unsigned char *at, int bytes) const
    {
        uint64_t value = 0;
        for (int i = 0; i < bytes; i++)
            value |= (uint64_t)at[i] << 8 * (is_big_endian ? bytes - 1 - i : i);
        return value;
    }
};

// The values of an entry as they lie in the file, up to `most` bytes.
std::vector<unsigned char> values_of(const Tiff &tiff, const unsigned char *entry, size_t most)
{
    static const int sizes[] = {0, 1, 1, 2, 4, 8, 1, 1, 2, 4, 8, 4, 8, 4, 0, 0, 8, 8, 8};
    const unsigned type = (unsigned)tiff.number(entry + 2, 2);
    const uint64_t count = tiff.number(entry + 4, tiff.is_big ? 8 : 4);
    const size_t inside = tiff.is_big ? 8 : 4;
    const unsigned char *value = entry + (tiff.is_big ? 12 : 8);
    if (type >= sizeof(sizes) / sizeof(sizes[0]) || count > most)
        return {};
    const size_t bytes = std::min(most, (size_t)count * (size_t)sizes[type]);
    if (bytes <= inside)
        return std::vector<unsigned char>(value, value + bytes);
    return bytes_at(tiff.number(value, (int)inside), bytes);
}

double rational(const Tiff &tiff, const unsigned char *at)
{
    const double below = (double)tiff.number(at + 4, 4);
    return below > 0 ? (double)tiff.number(at, 4) / below : 0;
}

enum Tag {
    PHOTOMETRIC = 262,
    X_POSITION = 286,
    Y_POSITION = 287,
    TRANSFER = 301,
    WHITE = 318,
    PRIMARIES = 319,
    SUB_IFDS = 330
};

void take_entry(Reading &reading, const Tiff &tiff, const unsigned char *entry, double primaries[8])
{
    const unsigned tag = (unsigned)tiff.number(entry, 2);
    const std::vector<unsigned char> values = tag >= PHOTOMETRIC && tag <= SUB_IFDS
                                                  ? values_of(tiff, entry, 1 << 19)
                                                  : std::vector<unsigned char>();
    const double first = values.size() >= 8 ? rational(tiff, values.data()) : 0;
    if (tag == PHOTOMETRIC && values.size() >= 2) {
        const uint64_t kind = tiff.number(values.data(), 2);
        if (kind >= 8 && kind <= 10)
            reading.refuse("holds L*a*b* colours; write it as red, green and blue");
    } else if ((tag == X_POSITION || tag == Y_POSITION) && first != 0) {
        reading.tell(true, tag == X_POSITION ? "XPosition" : "YPosition", printed("%.9g", first));
    } else if (tag == TRANSFER) {
        reading.tell(false, "curve (TransferFunction)",
                     digest_text(XXH3_64bits(values.data(), values.size())));
    } else if (tag == SUB_IFDS) {
        const uint64_t count = tiff.number(entry + 4, tiff.is_big ? 8 : 4);
        reading.tell(false, "pictures beside the first page (SubIFDs)", std::to_string(count));
    } else if (tag == WHITE || tag == PRIMARIES) {
        for (size_t i = 0; 8 * i + 8 <= values.size() && i < (tag == WHITE ? 2 : 6); i++)
            primaries[(tag == WHITE ? 0 : 2) + i] = rational(tiff, &values[8 * i]);
    }
}

// The entries of a directory, and the offset of the next directory; 0: none.
std::vector<unsigned char> directory_at(const Tiff &tiff, uint64_t at, uint64_t *next)
{
    const size_t counted = tiff.is_big ? 8 : 2, entry = tiff.is_big ? 20 : 12;
    const size_t pointer = tiff.is_big ? 8 : 4;
    const std::vector<unsigned char> number = bytes_at(at, counted);
    *next = 0;
    if (number.size() < counted)
        return {};
    const size_t count =
        (size_t)std::min<uint64_t>(tiff.number(number.data(), (int)counted), 65535);
    std::vector<unsigned char> entries = bytes_at(at + counted, count * entry + pointer);
    if (entries.size() == count * entry + pointer)
        *next = tiff.number(&entries[count * entry], (int)pointer);
    entries.resize(std::min(entries.size(), count * entry));
    return entries;
}

// Directories are a list, which in some damaged files is circular.
void read_tiff_head(Reading &reading)
{
    enum { MOST_PAGES = 5000 };
    double primaries[8] = {0.3127, 0.3290, 0.64, 0.33, 0.30, 0.60, 0.15, 0.06};
    const std::vector<unsigned char> head = bytes_at(0, 16);
    if (head.size() < 16)
        return;
    Tiff tiff = {head[0] == 'M', false};
    tiff.is_big = tiff.number(&head[2], 2) == 43;
    uint64_t at = tiff.is_big ? tiff.number(&head[8], 8) : tiff.number(&head[4], 4), next = 0;
    const std::vector<unsigned char> entries = directory_at(tiff, at, &next);
    const size_t entry = tiff.is_big ? 20 : 12;
    for (size_t i = 0; i + entry <= entries.size(); i += entry)
        take_entry(reading, tiff, &entries[i], primaries);
    tell_primaries(reading, primaries);
    std::vector<uint64_t> seen = {at};
    for (at = next; at && seen.size() < MOST_PAGES; at = next) {
        if (std::find(seen.begin(), seen.end(), at) != seen.end())
            break;
        seen.push_back(at);
        directory_at(tiff, at, &next);
    }
    reading.pages = (int)seen.size();
}

} // namespace

// --- common parts ---

void tell_primaries(Reading &reading, const double of[8])
{
    static const double rec709[8] = {0.3127, 0.3290, 0.64, 0.33, 0.30, 0.60, 0.15, 0.06};
    bool is_rec709 = true;
    for (int i = 0; i < 8; i++)
        is_rec709 = is_rec709 && std::fabs(of[i] - rec709[i]) <= 0.00101;
    if (!is_rec709)
        reading.tell(false, "primaries",
                     printed("white %g %g, red %g %g, green %g %g, blue %g %g", of[0], of[1], of[2],
                             of[3], of[4], of[5], of[6], of[7]));
}

void tell_attributes(Reading &reading, const OIIO::ImageSpec &spec)
{
    const float aspect = spec.get_float_attribute("PixelAspectRatio", 1.0f);
    if (aspect != 1.0f)
        reading.tell(true, "pixel aspect ratio", printed("%.9g", (double)aspect));
    const OIIO::ParamValue *colours = spec.find_attribute("chromaticities");
    if (colours && colours->type() == TypeDesc(TypeDesc::FLOAT, 8)) {
        const float *c = (const float *)colours->data();
        const double of[8] = {c[6], c[7], c[0], c[1], c[2], c[3], c[4], c[5]};
        tell_primaries(reading, of);
    }
    const OIIO::ParamValue *profile = spec.find_attribute("ICCProfile");
    if (profile)
        reading.tell(false, "ICC profile",
                     printed("%u bytes, ", (unsigned)profile->type().size()) +
                         digest_text(XXH3_64bits(profile->data(), profile->type().size())));
}

int read_head(Reading &reading, const OIIO::ImageSpec &spec)
{
    if (reading.extension == "hdr")
        return read_hdr_head(reading);
    if (reading.is_exr()) // EXR knows no orientation, whatever attribute has the name
        return 1;
    read_tiff_head(reading);
    return spec.get_int_attribute("Orientation", 1);
}
