#include "core/image/disc.h"

#include <math.h>
#include <stdlib.h>

#include "core/base/log.h"

// --- half the size ---

static float mean_of_four(const struct rg_picture *p, int x, int y, int channel)
{
    const int right = x + 1 < p->width ? x + 1 : x, below = y + 1 < p->height ? y + 1 : y;
    const float *top = p->texels + (int64_t)y * p->width * p->channels + channel;
    const float *bottom = p->texels + (int64_t)below * p->width * p->channels + channel;
    const int64_t here = (int64_t)x * p->channels, beside = (int64_t)right * p->channels;
    return 0.25f * ((top[here] + top[beside]) + (bottom[here] + bottom[beside]));
}

bool rg_picture_halve(struct rg_picture *picture)
{
    struct rg_picture half;
    const int width = picture->width / 2, height = picture->height / 2;
    if (!rg_picture_create(&half, width ? width : 1, height ? height : 1, picture->channels,
                           "picture of half the size"))
        return false;
    float *to = half.texels;
    for (int y = 0; y < half.height; y++)
        for (int x = 0; x < half.width; x++)
            for (int c = 0; c < half.channels; c++)
                *to++ = mean_of_four(picture, 2 * x, 2 * y, c);
    half.decoded = picture->decoded;
    rg_picture_destroy(picture);
    *picture = half;
    return true;
}

// --- a disc ---

// A row of texels that repeats mirrored without end, as prefix sums for each channel.
struct mirrored_row {
    const double *sums; // [texel][channel], one texel more than the row has
    int width, channels;
};

// The integral from the row's left edge to `x`.
static double integral(const struct mirrored_row *row, int channel, double x)
{
    const double period = 2.0 * row->width, turns = floor(x / period);
    const double whole = row->sums[(size_t)row->width * (size_t)row->channels + (size_t)channel];
    double at = x - turns * period;
    const bool is_back = at > row->width;
    at = is_back ? period - at : at;
    int texel = (int)at;
    texel = texel < row->width ? texel : row->width - 1;
    const double *low = row->sums + (size_t)texel * (size_t)row->channels + channel;
    const double part = low[0] + (low[row->channels] - low[0]) * (at - texel);
    return turns * 2 * whole + (is_back ? 2 * whole - part : part);
}

static void sum_rows(const struct rg_picture *p, double *sums)
{
    const size_t channels = (size_t)p->channels;
    const float *from = p->texels;
    for (int y = 0; y < p->height; y++) {
        for (size_t c = 0; c < channels; c++)
            *sums++ = 0;
        for (size_t i = 0; i < (size_t)p->width * channels; i++, sums++)
            *sums = sums[-(ptrdiff_t)channels] + (double)*from++;
    }
}

static int mirrored(int y, int height)
{
    const int period = 2 * height, at = (y % period + period) % period;
    return at < height ? at : period - 1 - at;
}

// Adds a disc's chord of a row of the sharp picture to a row of the blurred one.
static void add_chord(const struct mirrored_row *row, double half_chord, double share,
                      double *blurred)
{
    for (int x = 0; x < row->width; x++)
        for (int c = 0; c < row->channels; c++)
            *blurred++ += share * (integral(row, c, x + 0.5 + half_chord) -
                                   integral(row, c, x + 0.5 - half_chord));
}

// The area of half a disc between its centre and a chord at this height.
static double area_up_to(double radius, double height)
{
    const double y = fmin(fmax(height, -radius), radius);
    return (y * sqrt(radius * radius - y * y) + radius * radius * asin(y / radius)) / 2;
}

// Half the length of a disc's chord in the row `dy` from its centre, averaged over the row.
static double chord_of(double radius, int dy)
{
    return area_up_to(radius, dy + 0.5) - area_up_to(radius, dy - 0.5);
}

bool rg_picture_blur(struct rg_picture *picture, double diameter_px)
{
    const double radius = diameter_px / 2;
    const size_t row_values = (size_t)picture->width * (size_t)picture->channels;
    const size_t row_sums = row_values + (size_t)picture->channels;
    double *sums = malloc((size_t)picture->height * row_sums * sizeof(*sums));
    double *blurred = malloc(row_values * sizeof(*blurred));
    const bool ok = sums && blurred;
    const int reach = (int)(radius + 0.5);
    const double area = M_PI * radius * radius;
    if (ok)
        sum_rows(picture, sums);
    for (int y = 0; ok && area > 0 && y < picture->height; y++) {
        for (size_t i = 0; i < row_values; i++)
            blurred[i] = 0;
        for (int dy = -reach; dy <= reach; dy++)
            add_chord(
                &(struct mirrored_row){sums + (size_t)mirrored(y + dy, picture->height) * row_sums,
                                       picture->width, picture->channels},
                chord_of(radius, dy), 1 / area, blurred);
        for (size_t i = 0; i < row_values; i++)
            picture->texels[(size_t)y * row_values + i] = (float)blurred[i];
    }
    free(sums);
    free(blurred);
    return ok || rg_harness_error("a picture of %dx%d texels: no memory to blur it", picture->width,
                                  picture->height);
}
