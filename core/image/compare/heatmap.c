#include "core/image/compare/heatmap.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "core/image/srgb.h"

// The colour map magma at 33 even steps, sRGB codes.
static const uint8_t magma[33][3] = {
    {0, 0, 4},       {5, 4, 23},      {10, 8, 34},     {21, 13, 56},    {29, 17, 71},
    {43, 16, 91},    {54, 16, 107},   {69, 17, 116},   {81, 18, 124},   {94, 24, 126},
    {106, 28, 129},  {119, 33, 129},  {131, 38, 129},  {144, 42, 128},  {156, 46, 127},
    {170, 51, 124},  {183, 55, 121},  {196, 60, 116},  {208, 65, 111},  {220, 74, 105},
    {231, 82, 99},   {238, 95, 95},   {245, 107, 92},  {248, 123, 95},  {252, 137, 97},
    {253, 153, 106}, {254, 167, 114}, {254, 182, 126}, {254, 196, 136}, {254, 212, 151},
    {253, 226, 163}, {252, 240, 178}, {252, 253, 191},
};

// A font of the characters that "%.3g" can print: 5 x 7 pixels, a row a byte, the leftmost pixel in
// bit 4.
static const struct {
    char character;
    uint8_t rows[7];
} glyphs[] = {
    {'0', {14, 17, 19, 21, 25, 17, 14}}, {'1', {4, 12, 4, 4, 4, 4, 14}},
    {'2', {14, 17, 1, 2, 4, 8, 31}},     {'3', {31, 2, 4, 2, 1, 17, 14}},
    {'4', {2, 6, 10, 18, 31, 2, 2}},     {'5', {31, 16, 30, 1, 1, 17, 14}},
    {'6', {6, 8, 16, 30, 17, 17, 14}},   {'7', {31, 1, 2, 4, 8, 8, 8}},
    {'8', {14, 17, 17, 14, 17, 17, 14}}, {'9', {14, 17, 17, 15, 1, 2, 12}},
    {'.', {0, 0, 0, 0, 0, 12, 12}},      {'-', {0, 0, 0, 31, 0, 0, 0}},
    {'+', {0, 4, 4, 31, 4, 4, 0}},       {'e', {0, 0, 14, 17, 31, 16, 14}},
};

enum {
    GAP = 6, // pixels
    BAR_WIDTH = 16,
    GLYPH_WIDTH = 6,
    GLYPH_HEIGHT = 7,
    LABEL_CHARACTERS = 9,
    LOWEST = 48,    // a shorter picture is padded, so that the labels do not meet
    BIG = 360,      // from this height on the labels are drawn twice as large
    TINY = 128,     // a picture whose sides are shorter is enlarged,
    ENLARGED = 256, // to no more than this
};

static void set_texel(struct rg_picture *heat, int x, int y, const float colour[3])
{
    memcpy(heat->texels + ((int64_t)y * heat->width + x) * 3, colour, 3 * sizeof(float));
}

static void colour_of(const float *linear, float share, float colour[3])
{
    float at = share > 0.0f ? fminf(share, 1.0f) * 32.0f : share <= 0.0f ? 0.0f : 32.0f;
    int i = at < 31.0f ? (int)at : 31;
    for (int c = 0; c < 3; c++)
        colour[c] = linear[(int)((float)magma[i][c] +
                                 (at - (float)i) * (float)(magma[i + 1][c] - magma[i][c]) + 0.5f)];
}

static void draw_text(struct rg_picture *heat, int x, int y, int scale, const char *text)
{
    static const float white[3] = {1, 1, 1};
    for (; *text; text++, x += GLYPH_WIDTH * scale)
        for (size_t g = 0; g < sizeof(glyphs) / sizeof(glyphs[0]); g++)
            for (int i = 0; *text == glyphs[g].character && i < 35 * scale * scale; i++) {
                int column = i % (5 * scale), row = i / (5 * scale);
                if (glyphs[g].rows[row / scale] >> (4 - column / scale) & 1)
                    set_texel(heat, x + column, y + row, white);
            }
}

static void draw_scale(struct rg_picture *heat, int left, float top)
{
    const float *linear = rg_srgb()->linear;
    int scale = heat->height >= BIG ? 2 : 1;
    for (int y = 0; y < heat->height; y++) {
        float colour[3];
        colour_of(linear, 1.0f - (float)y / (float)(heat->height - 1), colour);
        for (int x = 0; x < BAR_WIDTH; x++)
            set_texel(heat, left + x, y, colour);
    }
    char label[24];
    snprintf(label, sizeof(label), "%.3g", (double)top);
    int text = left + BAR_WIDTH + GAP;
    draw_text(heat, text, 1, scale, label);
    draw_text(heat, text, heat->height - 1 - GLYPH_HEIGHT * scale, scale, "0");
}

bool rg_heatmap_draw(const float *values, int width, int height, float top, struct rg_picture *heat)
{
    int longer = width > height ? width : height;
    int zoom = longer < TINY ? ENLARGED / longer : 1;
    int drawn_height = height * zoom < LOWEST ? LOWEST : height * zoom;
    int scale = drawn_height >= BIG ? 2 : 1;
    int left = width * zoom + GAP;
    int drawn_width = left + BAR_WIDTH + GAP + LABEL_CHARACTERS * GLYPH_WIDTH * scale;
    if (!rg_picture_create(heat, drawn_width, drawn_height, 3, "heat map"))
        return false;
    memset(heat->texels, 0, (size_t)rg_picture_values(heat) * sizeof(float));
    const float *linear = rg_srgb()->linear;
    float per_top = top > 0.0f ? 1.0f / top : 0.0f;
#pragma omp parallel for schedule(static)
    for (int y = 0; y < height * zoom; y++)
        for (int x = 0; x < width * zoom; x++) {
            float colour[3];
            colour_of(linear, values[(int64_t)(y / zoom) * width + x / zoom] * per_top, colour);
            set_texel(heat, x, y, colour);
        }
    draw_scale(heat, left, top);
    return true;
}

void rg_heatmap_difference(const struct rg_picture *a, const struct rg_picture *b, float *values,
                           float *max)
{
    int64_t pixels = (int64_t)a->width * a->height;
    int channels = a->channels;
    float largest = 0.0f;
#pragma omp parallel for schedule(static) reduction(max : largest)
    for (int64_t i = 0; i < pixels; i++) {
        float worst = 0.0f;
        for (int c = 0; c < channels; c++) {
            float va = a->texels[i * channels + c], vb = b->texels[i * channels + c];
            float d = fabsf(va - vb);
            if (!isfinite(d))
                d = va == vb || (isnan(va) && isnan(vb)) ? 0.0f : INFINITY;
            worst = fmaxf(worst, d);
        }
        values[i] = worst;
        if (isfinite(worst))
            largest = fmaxf(largest, worst);
    }
    *max = largest;
}
