// The texels of a part of a file, band by band, and digests of them.
#ifndef RG_CORE_IMAGE_READER_BANDS_H
#define RG_CORE_IMAGE_READER_BANDS_H

#include <OpenImageIO/imageio.h>

#include <functional>
#include <string>
#include <vector>
#include <xxhash.h>

#include "core/image/reader/reader.h"

// The largest code of integers, 0 for floats.
double largest_code(OIIO::TypeDesc type);

struct Band {
    int first_line, lines; // of the data window
    const double *values;  // of all channels
};

// Reads a part's texels band by band, from the top. Integers are quotients by the largest code, but
// those of EXR are whole numbers. False where it is refused.
bool each_band(Reading &reading, OIIO::ImageInput &input, int part, int level,
               const std::function<void(const Band &)> &take);

// One for each channel, of its values with their places in the display window: the same of a half
// and of a float, and of a data window that leaves out nothing but zeros.
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
