#include "core/scene/density.h"

#include <math.h>
#include <stdlib.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "core/image/files/io.h"
#include "core/image/srgb.h"

// Weights are whole numbers, whose sums stay below 2^53 and so are exact in doubles: 16-bit codes
// (an 8-bit code times 257), or floats rounded to 24 bits.
enum { CODES = 65535, FLOAT_STEPS = 1 << 24, GRADIENT_PX = 1024 };

static struct rg_density *make(int width, int height, double unit)
{
    struct rg_density *density = rg_alloc(1, sizeof(*density), "density map");
    if (!density)
        return NULL;
    *density = (struct rg_density){.width = width, .height = height, .unit = unit};
    density->sums =
        rg_alloc((size_t)(width + 1) * (size_t)(height + 1), sizeof(*density->sums), "density map");
    if (density->sums)
        return density;
    rg_density_destroy(density);
    return NULL;
}

void rg_density_destroy(struct rg_density *density)
{
    if (!density)
        return;
    free(density->sums);
    free(density);
}

// Call it row by row, and in each row from the left.
static void set_weight(struct rg_density *density, int column, int row, double weight)
{
    const size_t pitch = (size_t)density->width + 1;
    double *at = density->sums + (size_t)(row + 1) * pitch + (size_t)column + 1;
    *at = weight + at[-1] + at[-(ptrdiff_t)pitch] - at[-(ptrdiff_t)pitch - 1];
}

struct rg_density *rg_density_gradient(void)
{
    struct rg_density *density = make(GRADIENT_PX, GRADIENT_PX, 1.0 / FLOAT_STEPS);
    if (!density)
        return NULL;
    for (int row = 0; row < GRADIENT_PX; row++)
        for (int column = 0; column < GRADIENT_PX; column++) {
            const double x = (column + 0.5) * 2 / GRADIENT_PX - 1;
            const double y = (row + 0.5) * 2 / GRADIENT_PX - 1;
            const double value = fmax(1 - sqrt(x * x + y * y), 0);
            set_weight(density, column, row, rint(value * FLOAT_STEPS));
        }
    return density;
}

// --- pictures ---

// A channel's value as stored in the file: reading made integer codes linear, but densities are the
// codes.
static double value_of(const struct rg_picture *picture, float linear)
{
    return picture->decoded ? rint(rg_srgb_encode((double)linear) * CODES) / CODES : (double)linear;
}

static double grey_of(const struct rg_picture *picture, int column, int row)
{
    const float *texel =
        picture->texels + ((int64_t)row * picture->width + column) * picture->channels;
    const int colours = rg_picture_colours(picture);
    double grey = value_of(picture, texel[0]);
    if (colours == 3)
        grey = 0.2126 * grey + 0.7152 * value_of(picture, texel[1]) +
               0.0722 * value_of(picture, texel[2]);
    return picture->channels > colours ? grey * (double)texel[colours] : grey;
}

// The largest value; NaN, with one logged line, if the picture is no map.
static double check(const struct rg_picture *picture, const char *name)
{
    double largest = 0;
    for (int row = 0; row < picture->height; row++)
        for (int column = 0; column < picture->width; column++) {
            const double grey = grey_of(picture, column, row);
            if (!(grey >= 0 && isfinite(grey))) {
                rg_error("density map %s: the value at x %d, y %d is %g; densities are numbers "
                         "from 0 up: mend the picture",
                         name, column, row, grey);
                return NAN;
            }
            largest = fmax(largest, grey);
        }
    if (largest > 0)
        return largest;
    rg_error(
        "density map %s: black everywhere, so that it never rains; draw some rain, white being "
        "the densest",
        name);
    return NAN;
}

struct rg_density *rg_density_from_picture(const struct rg_picture *picture, const char *name)
{
    const int64_t texels = (int64_t)picture->width * picture->height;
    if (texels < 1 || texels > RG_DENSITY_MAX_TEXELS)
        return rg_error_null("density map %s: %dx%d texels; use a picture of 1 to %lld texels",
                             name, picture->width, picture->height,
                             (long long)RG_DENSITY_MAX_TEXELS);
    const double largest = check(picture, name);
    if (isnan(largest))
        return NULL;
    const int steps = picture->decoded ? CODES : FLOAT_STEPS;
    const double scale = picture->decoded ? steps : steps / largest;
    struct rg_density *density = make(picture->width, picture->height, 1.0 / steps);
    for (int row = 0; density && row < picture->height; row++)
        for (int column = 0; column < picture->width; column++)
            set_weight(density, column, row, rint(grey_of(picture, column, row) * scale));
    return density;
}

struct rg_density *rg_density_read(const char *path)
{
    struct rg_picture picture;
    if (!rg_picture_read(path, &picture))
        return NULL;
    struct rg_density *density = rg_density_from_picture(&picture, path);
    rg_picture_destroy(&picture);
    return density;
}

// --- sums of the map over areas ---

// A range of whole texels, and the share of each of them that counts.
struct piece {
    int begin, end;
    double share;
};

// Cuts a range of an axis at the texels' borders into a part of a texel, whole texels, a part of a
// texel.
static int cut(double begin, double end, int texels, struct piece pieces[3])
{
    if (!(end > begin))
        return 0;
    int first = (int)begin;
    first = first < texels ? first : texels - 1;
    if (end <= first + 1) {
        pieces[0] = (struct piece){first, first + 1, end - begin};
        return 1;
    }
    int last = (int)end, count = 0;
    last = last < texels ? last : texels;
    if (begin > first)
        pieces[count++] = (struct piece){first, first + 1, first + 1 - begin};
    const int whole = begin > first ? first + 1 : first;
    if (last > whole)
        pieces[count++] = (struct piece){whole, last, 1};
    if (end > last)
        pieces[count++] = (struct piece){last, last + 1, end - last};
    return count;
}

static double weights(const struct rg_density *density, struct piece x, struct piece y)
{
    const size_t pitch = (size_t)density->width + 1;
    const double *top = density->sums + (size_t)y.begin * pitch;
    const double *bottom = density->sums + (size_t)y.end * pitch;
    return (bottom[x.end] - top[x.end]) - (bottom[x.begin] - top[x.begin]);
}

double rg_density_mass(const struct rg_density *density, double left, double top, double right,
                       double bottom)
{
    struct piece x[3], y[3];
    const int across = cut(left, right, density->width, x);
    const int down = cut(top, bottom, density->height, y);
    double mass = 0;
    for (int j = 0; j < down; j++)
        for (int i = 0; i < across; i++)
            mass += x[i].share * y[j].share * weights(density, x[i], y[j]);
    return mass * density->unit;
}

double rg_density_at(const struct rg_density *density, int column, int row)
{
    return density->unit *
           weights(density, (struct piece){column, column + 1, 1}, (struct piece){row, row + 1, 1});
}

double rg_density_mean(const struct rg_density *density)
{
    return rg_density_mass(density, 0, 0, density->width, density->height) /
           ((double)density->width * density->height);
}
