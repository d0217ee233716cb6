#include "tests/oracle/streaks/atlas.h"

#include <math.h>
#include <stddef.h>

static const double pi = 3.14159265358979323846;
static const double diameter_px = 23.744, fall_diameters = 42.5;
// The part of a picture above and below the drop's way: docs/streaks.md.
static const double rim_px = 19.6;
static const int starts[] = {0, 1050, 2038, 2848, 3392, 3606};

enum { CELL_PX = 32, COLUMNS = STREAK_HEIGHTS * STREAK_AZIMUTHS };

static double half_value(uint16_t half)
{
    const int exponent = half >> 10 & 31, mantissa = half & 1023;
    return exponent ? ldexp(1024 + mantissa, exponent - 25) : ldexp(mantissa, -24);
}

static double way_px(int view)
{
    return diameter_px * fall_diameters * cos(view * pi / 9);
}

// A column's rows, and the texels left and right of a place between them.
struct strip {
    const uint16_t *texels;
    int pitch, rows, left, right;
    double between;
};

static double row_value(const struct strip *strip, double row)
{
    if (row < 0 || row >= strip->rows)
        return 0;
    const uint16_t *texels = strip->texels + (ptrdiff_t)strip->pitch * (ptrdiff_t)row;
    return half_value(texels[strip->left]) * (1 - strip->between) +
           half_value(texels[strip->right]) * strip->between;
}

static double value_at(const struct strip *strip, double y)
{
    const double above = floor(y - 0.5), part = y - 0.5 - above;
    return row_value(strip, above) * (1 - part) + row_value(strip, above + 1) * part;
}

double streak_texture(const struct streak_atlas *atlas, int oscillation, int level, int view,
                      int column, double u, double swing)
{
    const int wide = CELL_PX >> level, sky = column == STREAK_SKY, start = starts[view] >> level,
              pitch = sky ? wide : wide * COLUMNS;
    const double x = fmin(fmax(u * wide, 0.5), wide - 0.5) - 0.5, left = floor(x);
    const uint16_t *texels = (sky ? atlas->skies : atlas->points)[oscillation][level];
    const int first = sky ? 0 : column * wide,
              next = (int)left + 1 < wide ? (int)left + 1 : wide - 1;
    const struct strip strip = {.texels = texels + (ptrdiff_t)start * pitch,
                                .pitch = pitch,
                                .rows = (starts[view + 1] >> level) - start,
                                .left = first + (int)left,
                                .right = first + next,
                                .between = x - left};
    const double rim = rim_px / (1 << level);
    const double y = rim + (strip.rows - 2 * rim) * swing;
    const double factor = sky ? atlas->sky_factors[oscillation][view]
                              : atlas->point_factors[oscillation][view][column / STREAK_AZIMUTHS]
                                                    [column % STREAK_AZIMUTHS];
    return value_at(&strip, y) * factor;
}

double streak_atlas_share(double view)
{
    const int lower = (int)fmin(floor(view), STREAK_VIEWS - 2);
    return diameter_px / way_px(lower) * (lower + 1 - view) +
           diameter_px / way_px(lower + 1) * (view - lower);
}
