// flow's remainder and noise maps: generated, or any image of the user's own (section 4.2.3).
#include "core/techniques/flow/inputs/flow.h"

#include <math.h>
#include <stdlib.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "core/image/files/io.h"
#include "core/image/srgb.h"
#include "kernels/dialect/rng.h"

enum { NOISE_SIZE = 512, NOISE_OCTAVES = 5, NOISE_COARSEST = 16, STREAM_NOISE = 3 };
enum { MAX_NOISE_PX = 4096 };

static double smooth(double t)
{
    t = fmin(fmax(t, 0), 1);
    return t * t * (3 - 2 * t);
}

static float clamp_unit(double value)
{
    return (float)fmin(fmax(value, 0), 1);
}

// The mean of a texel's colours, as the file's codes: a map is data, not light.
static double grey_at(const struct rg_picture *picture, int x, int y)
{
    const int colours = rg_picture_colours(picture);
    const float *texel = picture->texels + ((int64_t)y * picture->width + x) * picture->channels;
    double sum = 0;
    for (int c = 0; c < colours; c++)
        sum += picture->decoded ? rg_srgb_encode((double)texel[c]) : (double)texel[c];
    return sum / colours;
}

static float *read_remainder(const char *path)
{
    struct rg_picture picture;
    if (!rg_picture_read(path, &picture))
        return NULL;
    float *map = rg_alloc(FLOW_REMAINDER_ENTRIES, sizeof(float), path);
    for (int i = 0; map && i < FLOW_REMAINDER_ENTRIES; i++)
        map[i] = clamp_unit(grey_at(&picture, i * picture.width / FLOW_REMAINDER_ENTRIES, 0));
    rg_picture_destroy(&picture);
    return map;
}

float *flow_remainder_map(const struct flow_settings *s)
{
    if (*s->remainder_map)
        return read_remainder(s->remainder_map);
    float *map = rg_alloc(FLOW_REMAINDER_ENTRIES, sizeof(float), "remainder map");
    for (int i = 0; map && i < FLOW_REMAINDER_ENTRIES; i++) {
        double height = s->remainder_max_height * i / (FLOW_REMAINDER_ENTRIES - 1);
        double fall = fmax(s->remainder_low_height - s->move_threshold, 1e-9);
        map[i] =
            clamp_unit(1 - (1 - s->remainder_low) * smooth((height - s->move_threshold) / fall));
    }
    return map;
}

// Reads a user's image, made square by nearest sampling; its longer side is kept.
static float *read_noise(const char *path, int *size)
{
    struct rg_picture picture;
    if (!rg_picture_read(path, &picture))
        return NULL;
    *size = picture.width > picture.height ? picture.width : picture.height;
    if (*size > MAX_NOISE_PX) {
        rg_error("%s: a noise map of %dx%d; at most %d pixels along a side", path, picture.width,
                 picture.height, MAX_NOISE_PX);
        rg_picture_destroy(&picture);
        return NULL;
    }
    float *map = rg_alloc((size_t)*size * (size_t)*size, sizeof(float), path);
    for (int y = 0; map && y < *size; y++)
        for (int x = 0; x < *size; x++)
            map[(size_t)y * (size_t)*size + (size_t)x] = clamp_unit(
                grey_at(&picture, x * picture.width / *size, y * picture.height / *size));
    rg_picture_destroy(&picture);
    return map;
}

// One octave's lattice of cells x cells random values.
static float *make_lattice(int cells, int octave, int seed)
{
    float *values = rg_alloc((size_t)cells * (size_t)cells, sizeof(float), "noise map");
    for (int i = 0; values && i < cells * cells; i++)
        values[i] = rg_uniform(rg_random((uint)seed, (uint)i, (uint)octave, STREAM_NOISE).x);
    return values;
}

// The lattice at (x, y), in cells, interpolated smoothly; it tiles.
static double lattice_at(const float *values, int cells, double x, double y)
{
    const int x0 = (int)x, y0 = (int)y, x1 = (x0 + 1) % cells, y1 = (y0 + 1) % cells;
    const double fx = smooth(x - x0), fy = smooth(y - y0);
    const double top =
        (double)values[y0 * cells + x0] * (1 - fx) + (double)values[y0 * cells + x1] * fx;
    const double bottom =
        (double)values[y1 * cells + x0] * (1 - fx) + (double)values[y1 * cells + x1] * fx;
    return top * (1 - fy) + bottom * fy;
}

static bool add_octave(float *map, int octave, double weight, int seed)
{
    const int cells = NOISE_COARSEST << octave;
    const double step = (double)cells / NOISE_SIZE;
    float *values = make_lattice(cells, octave, seed);
    if (!values)
        return false;
    for (int y = 0; y < NOISE_SIZE; y++)
        for (int x = 0; x < NOISE_SIZE; x++)
            map[y * NOISE_SIZE + x] +=
                (float)(weight * lattice_at(values, cells, x * step, y * step));
    free(values);
    return true;
}

float *flow_bead_map(const struct flow_settings *s)
{
    // The upper half of the noise's range holds water, the highest tenth a full bead.
    const double from = 0.5, rise = 0.4;
    const int n = s->resolution_px;
    const int cells = (int)fmin(fmax(floor(s->pane_mm / s->bead_spacing_mm + 0.5), 1), n);
    float *values = make_lattice(cells, NOISE_OCTAVES, s->seed);
    float *map = values ? rg_alloc((size_t)n * (size_t)n, sizeof(float), "bead map") : NULL;
    for (int y = 0; map && y < n; y++)
        for (int x = 0; x < n; x++) {
            const double u = (x + 0.5) * cells / n, v = (y + 0.5) * cells / n;
            const double share = fmin(fmax((lattice_at(values, cells, u, v) - from) / rise, 0), 1);
            map[(size_t)y * (size_t)n + (size_t)x] = (float)(share * s->bead_mm / s->relief);
        }
    free(values);
    return map;
}

float *flow_noise_map(const struct flow_settings *s, int *size)
{
    if (*s->noise_map)
        return read_noise(s->noise_map, size);
    *size = NOISE_SIZE;
    float *map = rg_alloc(NOISE_SIZE * NOISE_SIZE, sizeof(float), "noise map");
    bool ok = map != NULL;
    double weight = 1, total = 0;
    for (int octave = 0; ok && octave < NOISE_OCTAVES; octave++, weight *= 0.6) {
        ok = add_octave(map, octave, weight, s->seed);
        total += weight;
    }
    if (!ok) {
        free(map);
        return NULL;
    }
    // Octaves average out, so the middle half of their range is stretched to the whole.
    for (int i = 0; i < NOISE_SIZE * NOISE_SIZE; i++)
        map[i] = (float)(s->noise_low +
                         (1 - s->noise_low) * (double)clamp_unit((double)map[i] / total * 2 - 0.5));
    return map;
}
