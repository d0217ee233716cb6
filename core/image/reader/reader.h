// The parts of raingauge_picture_reader: what a file's pixels are, and what it holds besides.
//
// It runs alone in its process, so it leaves memory to the end of the process.
#ifndef RG_CORE_IMAGE_READER_READER_H
#define RG_CORE_IMAGE_READER_READER_H

#include <OpenImageIO/imageio.h>

#include <cstdint>
#include <string>

extern "C" {
#include "core/image/reader/reply.h"
}

struct Reading {
    std::string extension; // without its dot, in small letters
    int64_t file_bytes;
    rg_picture_reply reply;
    float *texels;      // NULL: none, as where the reply alone shows that none can be
    std::string extras; // core/image/extras.h
    int pages;          // of a TIFF, as its directories follow each other; of others 1

    // Sets the reply's reason, without the file's name; false.
    bool refuse(const std::string &why);
    // Adds an extra. `is_applied`: the texels are what they are with it.
    void tell(bool is_applied, const std::string &name, const std::string &value);
    bool is_exr() const
    {
        return extension == "exr";
    }
};

// How the texels stand in the file, as Exif numbers it from 1, and what else its head says that
// OpenImageIO (2.4) does not hand on: of HDR the lines of text, of TIFF the tags of colour.
int read_head(Reading &reading, const OIIO::ImageSpec &spec);

// Colours, profile and shape of texels, as OpenImageIO names them.
void tell_attributes(Reading &reading, const OIIO::ImageSpec &spec);

// Extras of further parts, pages and levels. False where one is refused.
bool tell_parts(Reading &reading, OIIO::ImageInput &input);

// The texels, and extras of further channels, of texels outside the display window, and of what
// tell_parts tells. Ends the process where there is no memory for the texels.
bool read_all(Reading &reading, OIIO::ImageInput &input);

// A digest as extras print it.
std::string digest_text(uint64_t digest);
// Eight coordinates of colours: white, red, green and blue. Told where they are not Rec. 709's.
void tell_primaries(Reading &reading, const double of[8]);

#endif
