// FLIP for low dynamic range: Andersson, Nilsson, Akenine-Moeller, Oskarsson, Astroem, Fairchild,
// "FLIP: A Difference Evaluator for Alternating Images", HPG 2020. All 2-D filters are separable,
// or sums of two that are, and tiles keep everything between reading codes and the map in cache.
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "core/image/compare/compare.h"
#include "core/image/compare/multiversion.h"
#include "core/image/srgb.h"

enum {
    TILE_WIDTH = 256, // pixels of the map
    TILE_HEIGHT = 48,
    MAX_RADIUS = 32, // of the filters, pixels; reached at 210 pixels a degree
    COLUMNS = TILE_WIDTH + 2 * MAX_RADIUS,
    ROWS = TILE_HEIGHT + 2 * MAX_RADIUS,
    LANES = 16,
};

typedef float lanes __attribute__((vector_size(LANES * 4), aligned(4), may_alias));

// Half of each symmetric 1-D filter: weight[k] belongs to offsets k and -k (slope: negated at -k).
struct filters {
    int radius;
    float achromatic[MAX_RADIUS + 1];   // contrast sensitivity of Y
    float red_green[MAX_RADIUS + 1];    // of Cx
    float blue_yellow1[MAX_RADIUS + 1]; // of Cz, which is the sum of two Gaussians
    float blue_yellow2[MAX_RADIUS + 1];
    float gauss[MAX_RADIUS + 1]; // feature detection: Gaussian, its first and second derivative
    float slope[MAX_RADIUS + 1];
    float curve[MAX_RADIUS + 1];
};

// A tile of one picture with its border: normalised luminance Y/Yn, X/Xn - Y/Yn and Y/Yn - Z/Zn.
// These are YCxCz without its factors and offset, which cancel around a linear filter.
struct planes {
    float y[ROWS][COLUMNS], cx[ROWS][COLUMNS], cz[ROWS][COLUMNS];
};

// One row after the vertical filters, and one after the horizontal filters as well.
struct vertical {
    float achromatic[COLUMNS], red_green[COLUMNS], blue_yellow1[COLUMNS], blue_yellow2[COLUMNS];
    float gauss[COLUMNS], slope[COLUMNS], curve[COLUMNS];
};
struct filtered {
    float y[TILE_WIDTH], cx[TILE_WIDTH], cz[TILE_WIDTH];
    float edge[TILE_WIDTH], point[TILE_WIDTH];
};

struct tile_memory {
    struct planes planes[2];
    struct vertical vertical;
    struct filtered filtered[2];
};

// --- the filters ---

// exp(-pi^2 x^2 / b) for x in degrees, and its sum over all offsets.
static double gaussian(double b, double pixels_per_degree, int radius, double *weights)
{
    double sum = 0;
    for (int k = 0; k <= radius; k++) {
        double x = k / pixels_per_degree;
        weights[k] = exp(-M_PI * M_PI * x * x / b);
        sum += (k ? 2 : 1) * weights[k];
    }
    return sum;
}

static int spatial_filters(double pixels_per_degree, struct filters *f)
{
    int radius = (int)ceil(3 * sqrt(0.04 / (2 * M_PI * M_PI)) * pixels_per_degree);
    double g[MAX_RADIUS + 1], h[MAX_RADIUS + 1];
    double sum = gaussian(0.0047, pixels_per_degree, radius, g);
    for (int k = 0; k <= radius; k++)
        f->achromatic[k] = (float)(g[k] / sum);
    sum = gaussian(0.0053, pixels_per_degree, radius, g);
    for (int k = 0; k <= radius; k++)
        f->red_green[k] = (float)(g[k] / sum);
    double sum1 = gaussian(0.04, pixels_per_degree, radius, g);
    double sum2 = gaussian(0.025, pixels_per_degree, radius, h);
    double scale1 = 34.1 * sqrt(M_PI / 0.04), scale2 = 13.5 * sqrt(M_PI / 0.025);
    double total = scale1 * sum1 * sum1 + scale2 * sum2 * sum2;
    for (int k = 0; k <= radius; k++) {
        f->blue_yellow1[k] = (float)(g[k] * sqrt(scale1 / total));
        f->blue_yellow2[k] = (float)(h[k] * sqrt(scale2 / total));
    }
    return radius;
}

static int feature_filters(double pixels_per_degree, struct filters *f)
{
    double deviation = 0.5 * 0.082 * pixels_per_degree;
    int radius = (int)ceil(3 * deviation);
    double sum = 0, slope_sum = 0, positive = 0, negative = 0;
    double g[MAX_RADIUS + 1], curve[MAX_RADIUS + 1];
    for (int k = 0; k <= radius; k++) {
        double x = k / deviation;
        g[k] = exp(-0.5 * x * x);
        curve[k] = (x * x - 1) * g[k];
        sum += (k ? 2 : 1) * g[k];
        slope_sum += k * g[k];
        *(curve[k] < 0 ? &negative : &positive) += (k ? 2 : 1) * fabs(curve[k]);
    }
    for (int k = 0; k <= radius; k++) {
        f->gauss[k] = (float)(g[k] / sum);
        f->slope[k] = (float)(k * g[k] / slope_sum);
        f->curve[k] = (float)(curve[k] / (curve[k] < 0 ? negative : positive));
    }
    return radius;
}

static struct filters make_filters(double pixels_per_degree)
{
    struct filters f;
    memset(&f, 0, sizeof(f));
    int spatial = spatial_filters(pixels_per_degree, &f);
    int feature = feature_filters(pixels_per_degree, &f);
    f.radius = spatial > feature ? spatial : feature;
    return f;
}

// --- filtering one row of a tile ---

RG_MULTIVERSION static void filter_columns(const struct planes *planes, const struct filters *f,
                                           int row, int columns, struct vertical *out)
{
    int r = f->radius, centre = row + r;
    for (int x = 0; x < columns; x += LANES) {
        lanes middle = *(const lanes *)&planes->y[centre][x];
        lanes achromatic = middle * f->achromatic[0], gauss = middle * f->gauss[0];
        lanes curve = middle * f->curve[0], slope = middle * 0.0f;
        for (int k = 1; k <= r; k++) {
            lanes up = *(const lanes *)&planes->y[centre - k][x];
            lanes down = *(const lanes *)&planes->y[centre + k][x];
            lanes sum = up + down;
            achromatic += sum * f->achromatic[k];
            gauss += sum * f->gauss[k];
            curve += sum * f->curve[k];
            slope += (down - up) * f->slope[k];
        }
        *(lanes *)&out->achromatic[x] = achromatic;
        *(lanes *)&out->gauss[x] = gauss;
        *(lanes *)&out->curve[x] = curve;
        *(lanes *)&out->slope[x] = slope;
        lanes cx = *(const lanes *)&planes->cx[centre][x];
        lanes cz = *(const lanes *)&planes->cz[centre][x];
        lanes red_green = cx * f->red_green[0];
        lanes by1 = cz * f->blue_yellow1[0], by2 = cz * f->blue_yellow2[0];
        for (int k = 1; k <= r; k++) {
            lanes sum = *(const lanes *)&planes->cz[centre - k][x] +
                        *(const lanes *)&planes->cz[centre + k][x];
            red_green += (*(const lanes *)&planes->cx[centre - k][x] +
                          *(const lanes *)&planes->cx[centre + k][x]) *
                         f->red_green[k];
            by1 += sum * f->blue_yellow1[k];
            by2 += sum * f->blue_yellow2[k];
        }
        *(lanes *)&out->red_green[x] = red_green;
        *(lanes *)&out->blue_yellow1[x] = by1;
        *(lanes *)&out->blue_yellow2[x] = by2;
    }
}

#define AT(row, offset) (*(const lanes *)&in->row[x + r + (offset)])
#define BOTH(row)       (AT(row, -k) + AT(row, k))

// Filters the colour channels of a row; column i + radius of `in` is the centre of column i of
// `out`.
RG_MULTIVERSION static void filter_colours(const struct vertical *in, const struct filters *f,
                                           int width, struct filtered *out)
{
    int r = f->radius;
    for (int x = 0; x < width; x += LANES) {
        lanes y = AT(achromatic, 0) * f->achromatic[0];
        lanes cx = AT(red_green, 0) * f->red_green[0];
        lanes cz1 = AT(blue_yellow1, 0) * f->blue_yellow1[0];
        lanes cz2 = AT(blue_yellow2, 0) * f->blue_yellow2[0];
        for (int k = 1; k <= r; k++) {
            y += BOTH(achromatic) * f->achromatic[k];
            cx += BOTH(red_green) * f->red_green[k];
            cz1 += BOTH(blue_yellow1) * f->blue_yellow1[k];
            cz2 += BOTH(blue_yellow2) * f->blue_yellow2[k];
        }
        *(lanes *)&out->y[x] = y;
        *(lanes *)&out->cx[x] = cx;
        *(lanes *)&out->cz[x] = cz1 + cz2;
    }
}

// Filters a row for the strength of edges and points.
RG_MULTIVERSION static void filter_features(const struct vertical *in, const struct filters *f,
                                            int width, struct filtered *out)
{
    int r = f->radius;
    for (int x = 0; x < width; x += LANES) {
        lanes middle = AT(gauss, 0);
        lanes edge_x = middle * 0.0f, edge_y = AT(slope, 0) * f->gauss[0];
        lanes point_x = middle * f->curve[0], point_y = AT(curve, 0) * f->gauss[0];
        for (int k = 1; k <= r; k++) {
            edge_x += (AT(gauss, k) - AT(gauss, -k)) * f->slope[k];
            point_x += BOTH(gauss) * f->curve[k];
            edge_y += BOTH(slope) * f->gauss[k];
            point_y += BOTH(curve) * f->gauss[k];
        }
        *(lanes *)&out->edge[x] = edge_x * edge_x + edge_y * edge_y;
        *(lanes *)&out->point[x] = point_x * point_x + point_y * point_y;
    }
    for (int x = 0; x < width; x++) {
        out->edge[x] = sqrtf(out->edge[x]);
        out->point[x] = sqrtf(out->point[x]);
    }
}

// --- from filtered colours to the difference of a pixel ---

static inline float from_bits(int32_t bits)
{
    float value;
    memcpy(&value, &bits, 4);
    return value;
}

static inline int32_t to_bits(float value)
{
    int32_t bits;
    memcpy(&bits, &value, 4);
    return bits;
}

// Starts from a third of exponent and mantissa; each of the two Halley steps triples the number of
// good digits.
static inline float cube_root(float x)
{
    float r = from_bits((int32_t)((uint32_t)to_bits(x) / 3u) + 709921077);
    float cube = r * r * r;
    r = r * (cube + 2.0f * x) / (2.0f * cube + x);
    cube = r * r * r;
    return r * (cube + 2.0f * x) / (2.0f * cube + x);
}

// The series of atanh, for a mantissa around 1.
static inline float log_2(float x)
{
    int32_t bits = to_bits(x) - 0x3f3504f3; // minus the bits of sqrt(1/2)
    float exponent = (float)(bits >> 23);
    float mantissa = from_bits((bits & 0x7fffff) + 0x3f3504f3);
    float s = (mantissa - 1.0f) / (mantissa + 1.0f), q = s * s;
    float series = 0.2f + q * (0.14285715f + q * 0.11111111f);
    return exponent + s * (2.8853901f + q * (0.33333333f + q * series) * 2.8853901f);
}

// For -126 < x < 127, without a branch, so that loops vectorise.
static inline float exp_2(float x)
{
    int32_t whole = (int32_t)(x + 1024.5f) - 1024; // truncates a positive value
    float t = (x - (float)whole) * 0.69314718f;
    float series = 1.0f / 24 + t * (1.0f / 120 + t * (1.0f / 720));
    float power = 1.0f + t * (1.0f + t * (0.5f + t * (1.0f / 6 + t * series)));
    return power * from_bits((whole + 127) << 23);
}

float rg_flip_cbrt(float x)
{
    return cube_root(x);
}

float rg_flip_pow(float x, float y)
{
    return exp_2(y * log_2(x));
}

struct lab {
    float l, a, b;
};

static inline float lab_curve(float t)
{
    return t > 0.008856452f ? cube_root(t) : t * 7.787037f + 0.13793103f;
}

static inline float clamp01(float v)
{
    return v < 0.0f ? 0.0f : v > 1.0f ? 1.0f : v;
}

// Hunt-adjusted L*a*b* of linear RGB in 0..1. The matrix's rows are those of sRGB to XYZ, divided
// by the white point (D65).
static inline struct lab hunt_lab(float r, float g, float b)
{
    float x = lab_curve(0.43389538f * r + 0.37624236f * g + 0.18986223f * b);
    float y = lab_curve(0.21263682f * r + 0.71518298f * g + 0.07218020f * b);
    float z = lab_curve(0.01775242f * r + 0.10946563f * g + 0.87278196f * b);
    float l = 116.0f * y - 16.0f;
    return (struct lab){l, 5.0f * l * (x - y), 2.0f * l * (y - z)};
}

// Converts filtered YCxCz back to RGB, clamps it to what a screen shows, and converts it to the
// uniform colour space.
static inline struct lab perceived(float y, float cx, float cz)
{
    float x = y + cx, z = y - cz;
    return hunt_lab(clamp01(3.08034203f * x - 1.53739893f * y - 0.54294300f * z),
                    clamp01(-0.92117847f * x + 1.87593007f * y + 0.04524841f * z),
                    clamp01(0.05288130f * x - 0.20401120f * y + 1.15112987f * z));
}

static inline float hyab(struct lab p, struct lab q)
{
    float a = p.a - q.a, b = p.b - q.b;
    return fabsf(p.l - q.l) + sqrtf(a * a + b * b);
}

// cmax is the largest colour difference, between green and blue, to the power of 0.7.
RG_MULTIVERSION static void difference_row(const struct filtered *restrict a,
                                           const struct filtered *restrict b, int width, float cmax,
                                           float *restrict map, bool keeps_larger)
{
    // Plain pointers, because gcc does not vectorise members of a struct that vectors were stored
    // to.
    const float *ay = a->y, *acx = a->cx, *acz = a->cz, *a_edge = a->edge, *a_point = a->point;
    const float *by = b->y, *bcx = b->cx, *bcz = b->cz, *b_edge = b->edge, *b_point = b->point;
    float knee = 0.4f * cmax, below = 0.95f / knee, above = 0.05f / (cmax - knee);
#pragma omp simd
    for (int x = 0; x < width; x++) {
        float distance = hyab(perceived(ay[x], acx[x], acz[x]), perceived(by[x], bcx[x], bcz[x]));
        float power = exp_2(0.7f * log_2(distance));
        float colour = power < knee ? below * power : 0.95f + (power - knee) * above;
        float edge = fabsf(a_edge[x] - b_edge[x]), point = fabsf(a_point[x] - b_point[x]);
        float feature = sqrtf(0.70710678f * (edge > point ? edge : point));
        float flip = exp_2((1.0f - feature) * log_2(colour));
        float value = distance > 0.0f ? clamp01(flip) : 0.0f;
        map[x] = keeps_larger && map[x] > value ? map[x] : value;
    }
}

// --- tiles ---

static inline int clamp_index(int i, int count)
{
    return i < 0 ? 0 : i >= count ? count - 1 : i;
}

struct job {
    const uint8_t *codes[2]; // NULL: pictures
    const struct rg_picture *pictures[2];
    rg_tone *tone; // for texels of `pictures`
    float scale;   // for texels of `pictures`
    int width, height;
    struct filters filters;
    float cmax;
    const float *linear;
    float *map;
    bool keeps_larger; // larger values in the map stay
};

// A row of a tile and its border, linear and shown: the picture's edge pixels go on for ever.
struct colours {
    float of[3][COLUMNS];
};

static void read_codes(const struct job *job, const uint8_t *codes, int x0, int columns,
                       struct colours *row)
{
    for (int column = 0; column < columns; column++) {
        const uint8_t *code = codes + (int64_t)clamp_index(x0 + column, job->width) * 4;
        for (int c = 0; c < 3; c++)
            row->of[c][column] = job->linear[code[c]];
    }
}

// Loops over a fixed number of channels become vectors.
RG_MULTIVERSION static void take_colour(const float *texels, int channels, int count,
                                        float *restrict values)
{
    for (int i = 0; channels == 4 && i < count; i++)
        values[i] = texels[i * 4];
    for (int i = 0; channels != 4 && i < count; i++)
        values[i] = texels[i * channels];
}

static void read_picture(const struct job *job, const struct rg_picture *picture, int64_t line,
                         int x0, int columns, struct colours *row)
{
    const int channels = picture->channels, green = rg_picture_colours(picture) > 1;
    const float *texels = picture->texels + line * channels;
    const int left = x0 < 0 ? -x0 : 0, end = job->width - x0 < columns ? job->width - x0 : columns;
    for (int c = 0; c < 3; c++) {
        float *of = row->of[c];
        take_colour(texels + (int64_t)(x0 + left) * channels + c * green, channels, end - left,
                    of + left);
        for (int column = 0; column < left; column++)
            of[column] = of[left];
        for (int column = end; column < columns; column++)
            of[column] = of[end - 1];
        job->tone(of, columns, job->scale);
    }
}

RG_MULTIVERSION static void to_planes(const struct colours *row, int columns, float *restrict ys,
                                      float *restrict cxs, float *restrict czs)
{
    for (int column = 0; column < columns; column++) {
        float red = row->of[0][column], green = row->of[1][column], blue = row->of[2][column];
        float y = 0.21263682f * red + 0.71518298f * green + 0.07218020f * blue;
        ys[column] = y;
        cxs[column] = 0.43389538f * red + 0.37624236f * green + 0.18986223f * blue - y;
        czs[column] = y - (0.01775242f * red + 0.10946563f * green + 0.87278196f * blue);
    }
}

static void load_planes(const struct job *job, int picture, int x0, int y0, int columns, int rows,
                        struct planes *planes)
{
    const int r = job->filters.radius;
    struct colours colours;
    for (int row = 0; row < rows; row++) {
        const int64_t line = (int64_t)clamp_index(y0 - r + row, job->height) * job->width;
        if (job->codes[picture])
            read_codes(job, job->codes[picture] + line * 4, x0 - r, columns, &colours);
        else
            read_picture(job, job->pictures[picture], line, x0 - r, columns, &colours);
        to_planes(&colours, columns, planes->y[row], planes->cx[row], planes->cz[row]);
    }
}

// Whether the tile and its border are equal in both pictures.
static bool same_tile(const struct job *job, int x0, int y0, int width, int height)
{
    int r = job->filters.radius;
    int left = clamp_index(x0 - r, job->width), right = clamp_index(x0 + width - 1 + r, job->width);
    int top = clamp_index(y0 - r, job->height);
    int bottom = clamp_index(y0 + height - 1 + r, job->height);
    for (int y = top; y <= bottom; y++) {
        const int64_t at = (int64_t)y * job->width + left;
        const size_t pixels = (size_t)(right - left + 1);
        const struct rg_picture *a = job->pictures[0], *b = job->pictures[1];
        if (job->codes[0] ? memcmp(job->codes[0] + at * 4, job->codes[1] + at * 4, pixels * 4)
                          : memcmp(a->texels + at * a->channels, b->texels + at * b->channels,
                                   pixels * (size_t)a->channels * sizeof(float)))
            return false;
    }
    return true;
}

static void flip_tile(const struct job *job, int x0, int y0, struct tile_memory *memory)
{
    int width = job->width - x0 < TILE_WIDTH ? job->width - x0 : TILE_WIDTH;
    int height = job->height - y0 < TILE_HEIGHT ? job->height - y0 : TILE_HEIGHT;
    float *map = job->map + (int64_t)y0 * job->width + x0;
    if (same_tile(job, x0, y0, width, height)) {
        for (int row = 0; row < height && !job->keeps_larger; row++)
            memset(map + (int64_t)row * job->width, 0, (size_t)width * sizeof(*map));
        return;
    }
    const struct filters *f = &job->filters;
    int columns = (width + LANES - 1) / LANES * LANES + 2 * f->radius;
    for (int p = 0; p < 2; p++)
        load_planes(job, p, x0, y0, columns, height + 2 * f->radius, &memory->planes[p]);
    for (int row = 0; row < height; row++) {
        for (int p = 0; p < 2; p++) {
            filter_columns(&memory->planes[p], f, row, columns, &memory->vertical);
            filter_colours(&memory->vertical, f, width, &memory->filtered[p]);
            filter_features(&memory->vertical, f, width, &memory->filtered[p]);
        }
        difference_row(&memory->filtered[0], &memory->filtered[1], width, job->cmax,
                       map + (int64_t)row * job->width, job->keeps_larger);
    }
}

// Makes the map of a job whose pictures are set.
static bool make_map(struct job job, float pixels_per_degree, float *map)
{
    if (!(pixels_per_degree >= 1.0f && pixels_per_degree <= 200.0f))
        return rg_error("FLIP: %g pixels a degree is outside 1 to 200", (double)pixels_per_degree);
    const int width = job.width, height = job.height;
    job.filters = make_filters((double)pixels_per_degree);
    job.cmax = (float)pow((double)hyab(hunt_lab(0, 1, 0), hunt_lab(0, 0, 1)), (double)0.7f);
    job.linear = rg_srgb()->linear;
    job.map = map;
    int across = (width + TILE_WIDTH - 1) / TILE_WIDTH;
    int tiles = across * ((height + TILE_HEIGHT - 1) / TILE_HEIGHT), failed = 0;
#pragma omp parallel reduction(+ : failed)
    {
        // calloc, because the columns that round a tile up to whole lanes are read, too.
        struct tile_memory *memory = calloc(1, sizeof(*memory));
        failed = !memory;
#pragma omp for schedule(dynamic)
        for (int tile = 0; tile < tiles; tile++)
            if (memory)
                flip_tile(&job, tile % across * TILE_WIDTH, tile / across * TILE_HEIGHT, memory);
        free(memory);
    }
    return !failed ||
           rg_harness_error("FLIP of %d x %d pixels: no memory for its tiles", width, height);
}

bool rg_flip_map(const uint8_t *a_codes, const uint8_t *b_codes, int width, int height,
                 float pixels_per_degree, float *map)
{
    return make_map((struct job){.codes = {a_codes, b_codes}, .width = width, .height = height},
                    pixels_per_degree, map);
}

bool rg_flip_map_shown(const struct rg_picture *a, const struct rg_picture *b, rg_tone *tone,
                       float scale, float pixels_per_degree, float *map)
{
    return make_map((struct job){.pictures = {a, b},
                                 .tone = tone,
                                 .scale = scale,
                                 .width = a->width,
                                 .height = a->height,
                                 .keeps_larger = true},
                    pixels_per_degree, map);
}
