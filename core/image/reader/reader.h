// The parts of raingauge_picture_reader: reading a file's pixels, and describing its other
// contents.
//
// The program handles one file and then exits, so it frees no memory.
#ifndef RG_CORE_IMAGE_READER_READER_H
#define RG_CORE_IMAGE_READER_READER_H

#include <OpenImageIO/imageio.h>

#include <cstdint>
#include <string>

extern "C" {
#include "core/image/reader/reply.h"
}

struct Reading {
    std::string extension;          // without its dot, in small letters
    int64_t file_bytes, most_bytes; // most_bytes: of texels
    rg_picture_reply reply;
    float *texels;      // NULL: none, where the header alone shows that the picture is refused
    std::string extras; // core/image/extras.h
    int pages;          // of a TIFF, in the order of its directories; 1 for other formats

    // Sets the reply's reason, without the file's name, and returns false.
    bool refuse(const std::string &why);
    // Adds an extra. `is_applied`: the texels already include its effect.
    void tell(bool is_applied, const std::string &name, const std::string &value);
    bool is_exr() const
    {
        return extension == "exr";
    }
};

// Reads from the header what OpenImageIO (2.4) does not report: HDR's lines of text, TIFF's colour
// tags. Returns the orientation of the texels, as Exif numbers it from 1.
int read_head(Reading &reading, const OIIO::ImageSpec &spec);

// Adds colours, profile and shape of texels as extras, by OpenImageIO's names.
void tell_attributes(Reading &reading, const OIIO::ImageSpec &spec);

// Adds extras for further parts, pages and levels. False where one cannot be read.
bool tell_parts(Reading &reading, OIIO::ImageInput &input);

// Reads the texels, and adds extras for further channels, texels outside the display window, and
// what tell_parts finds. Ends the process when memory for the texels runs out.
bool read_all(Reading &reading, OIIO::ImageInput &input);

// A digest as extras print it.
std::string digest_text(uint64_t digest);
// Adds an extra for the coordinates of white, red, green and blue, unless they are Rec. 709's.
void tell_primaries(Reading &reading, const double of[8]);

#endif
