// The texels of a part of a file, band by band, and digests of them.
#ifndef RG_CORE_IMAGE_READER_BANDS_H
#define RG_CORE_IMAGE_READER_BANDS_H

#include <OpenImageIO/imageio.h>

#include <functional>
#include <string>
#include <vector>
#include <xxhash.h>

#include "core/image/reader/reader.h"

// The largest code of an integer type, 0 for floats.
double largest_code(OIIO::TypeDesc type);

struct Band {
    int first_line, lines; // lines of the data window
    const double *values;  // values of all channels
};

// Reads a part's texels band by band, from the top. Integers become quotients by the largest code,
// except EXR's, which stay whole numbers. False where reading fails.
bool each_band(Reading &reading, OIIO::ImageInput &input, int part, int level,
               const std::function<void(const Band &)> &take);

// One digest for each channel, of its values and their places in the display window. It is the same
// for halves and floats, and for data windows that differ only in zeros left out.
class Digests
{
  public:
    explicit Digests(int channels);

    void add(const OIIO::ImageSpec &spec, const Band &band);
    void add_value(size_t channel, int x, int y, double value);
    std::string text(size_t channel) const;
    std::string text_of_all() const;

  private:
    std::vector<XXH3_state_t *> states;
};

#endif
