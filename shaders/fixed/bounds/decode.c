// Blocks of compressed texels, decoded.
//
// BC1 and BC3: the Khronos Data Format Specification defines real values; a decoder may leave them
// in 8 bits (S3TC Compressed Texture Image Formats), so that a code more or less is allowed. It
// gives no error for mixed colours. Direct3D's, which GPUs are built for, is 3 % of the distance
// between both colours in addition. ETC2: the same specification defines the bits (ETC2 Compressed
// Texture Image Formats).
#include <math.h>
#include <string.h>

#include "shaders/fixed/bounds/scene.h"

enum { SIDE = 4, PX = RG_FIXED_TEXTURE_PX };

// --- BC1 and BC3 ---

static const double code = 1 / 255.0;
#define MIXED_ERROR 0.03

static void unpack(int packed, double out[3])
{
    out[0] = (packed >> 11) / 31.0;
    out[1] = (packed >> 5 & 63) / 63.0;
    out[2] = (packed & 31) / 31.0;
}

// The colour of index `i` between two, or the transparent black of BC1.
static void decode_colour(const uint8_t *block, int i, bool always_four, struct rg_span out[4])
{
    const int a = block[0] | block[1] << 8, b = block[2] | block[3] << 8;
    const bool has_four = always_four || a > b;
    const double shares[] = {0, 1, has_four ? 1 / 3.0 : 0.5, 2 / 3.0};
    double first[3], second[3];
    unpack(a, first);
    unpack(b, second);
    out[3] = rg_span_at(1);
    for (int c = 0; c < 3; c++) {
        const double error = code + (i < 2 ? 0 : MIXED_ERROR * fabs(second[c] - first[c]));
        out[c] = rg_span_clamp(
            rg_span_widen(rg_span_at(first[c] + (second[c] - first[c]) * shares[i]), error), 0, 1);
    }
    if (!has_four && i == 3)
        for (int c = 0; c < 4; c++)
            out[c] = rg_span_at(0);
}

static struct rg_span decode_alpha(const uint8_t *block, int i)
{
    const int a = block[0], b = block[1], steps = a > b ? 7 : 5;
    if (i < 2)
        return rg_span_at((i ? b : a) / 255.0);
    if (i > steps)
        return rg_span_at(i - steps - 1);
    const double value = (a * (steps + 1 - i) + b * (i - 1)) / (255.0 * steps);
    return rg_span_clamp(rg_span_widen(rg_span_at(value), code), 0, 1);
}

static void decode_bc(const uint8_t *block, int x, int y, bool has_alpha, struct rg_span out[4])
{
    const uint8_t *colour = has_alpha ? block + 8 : block;
    decode_colour(colour, colour[4 + y] >> 2 * x & 3, has_alpha, out);
    uint64_t indices = 0;
    memcpy(&indices, block + 2, 6);
    if (has_alpha)
        out[3] = decode_alpha(block, (int)(indices >> 3 * (4 * y + x) & 7));
}

// --- ETC2 ---

static int extend(int value, int bits)
{
    return value << (8 - bits) | value >> (2 * bits - 8);
}

static int clamp(int value)
{
    return value < 0 ? 0 : value > 255 ? 255 : value;
}

// Two base colours, each of which a table or a distance changes.
static void decode_etc1(const uint8_t *b, const int bases[2][3], int x, int y, int index,
                        int out[3])
{
    static const int tables[8][2] = {{2, 8},   {5, 17},  {9, 29},   {13, 42},
                                     {18, 60}, {24, 80}, {33, 106}, {47, 183}};
    const int half = b[3] & 1 ? y / 2 : x / 2;
    const int change = tables[half ? b[3] >> 2 & 7 : b[3] >> 5][index & 1];
    for (int c = 0; c < 3; c++)
        out[c] = clamp(bases[half][c] + (index & 2 ? -change : change));
}

static const int distances[8] = {3, 6, 11, 16, 23, 32, 41, 64};

static void decode_t(const uint8_t *b, int index, int out[3])
{
    const int first[] = {(b[0] >> 3 & 3) << 2 | (b[0] & 3), b[1] >> 4, b[1] & 15};
    const int second[] = {b[2] >> 4, b[2] & 15, b[3] >> 4};
    const int distance = distances[(b[3] >> 2 & 3) << 1 | (b[3] & 1)];
    const int change = index == 1 ? distance : index == 3 ? -distance : 0;
    for (int c = 0; c < 3; c++)
        out[c] = clamp(17 * (index ? second[c] : first[c]) + change);
}

static void decode_h(const uint8_t *b, int index, int out[3])
{
    const int all[2][3] = {{b[0] >> 3 & 15, (b[0] & 7) << 1 | (b[1] >> 4 & 1),
                            (b[1] >> 3 & 1) << 3 | (b[1] & 3) << 1 | b[2] >> 7},
                           {b[2] >> 3 & 15, (b[2] & 7) << 1 | b[3] >> 7, b[3] >> 3 & 15}};
    int order[2];
    for (int i = 0; i < 2; i++)
        order[i] = all[i][0] << 8 | all[i][1] << 4 | all[i][2];
    const int distance =
        distances[(b[3] >> 2 & 1) << 2 | (b[3] & 1) << 1 | (order[0] >= order[1] ? 1 : 0)];
    for (int c = 0; c < 3; c++)
        out[c] = clamp(17 * all[index >> 1][c] + (index & 1 ? -distance : distance));
}

static void decode_planar(const uint8_t *b, int x, int y, int out[3])
{
    const int bits[] = {6, 7, 6};
    const int origin[] = {b[0] >> 1 & 63, (b[0] & 1) << 6 | (b[1] >> 1 & 63),
                          (b[1] & 1) << 5 | (b[2] >> 3 & 3) << 3 | (b[2] & 3) << 1 | b[3] >> 7};
    const int across[] = {(b[3] >> 2 & 31) << 1 | (b[3] & 1), b[4] >> 1,
                          (b[4] & 1) << 5 | b[5] >> 3};
    const int down[] = {(b[5] & 7) << 3 | b[6] >> 5, (b[6] & 31) << 2 | b[7] >> 6, b[7] & 63};
    for (int c = 0; c < 3; c++) {
        const int o = extend(origin[c], bits[c]);
        const int sum = x * (extend(across[c], bits[c]) - o) + y * (extend(down[c], bits[c]) - o);
        out[c] = clamp((sum + 4 * o + 2) >> 2); // NOLINT: arithmetic, as in the specification
    }
}

static void decode_etc2(const uint8_t *b, int x, int y, int out[3])
{
    const int place = SIDE * x + y;
    const int index = ((b[4] << 8 | b[5]) >> place & 1) << 1 | ((b[6] << 8 | b[7]) >> place & 1);
    int bases[2][3], beyond = -1;
    for (int c = 0; c < 3; c++) {
        const int first = b[c] >> 3, second = first + ((b[c] & 7) ^ 4) - 4;
        if (beyond < 0 && (second < 0 || second > 31))
            beyond = c;
        bases[0][c] = b[3] & 2 ? extend(first, 5) : 17 * (b[c] >> 4);
        bases[1][c] = b[3] & 2 ? extend(second & 31, 5) : 17 * (b[c] & 15);
    }
    if (!(b[3] & 2) || beyond < 0)
        decode_etc1(b, (const int(*)[3])bases, x, y, index, out);
    else if (beyond == 0)
        decode_t(b, index, out);
    else if (beyond == 1)
        decode_h(b, index, out);
    else
        decode_planar(b, x, y, out);
}

// --- all blocks ---

static void decode(enum rg_fixed_texels texels, const uint8_t *block, int x, int y,
                   struct rg_span out[4])
{
    int codes[3];
    if (texels != RG_FIXED_TEXELS_ETC2) {
        decode_bc(block, x, y, texels == RG_FIXED_TEXELS_BC3, out);
        return;
    }
    decode_etc2(block, x, y, codes);
    out[3] = rg_span_at(1);
    for (int c = 0; c < 3; c++)
        out[c] = rg_span_at(codes[c] / 255.0);
}

void rg_decode_blocks(enum rg_fixed_texels texels, const uint8_t *blocks, struct rg_span (*out)[4])
{
    const int size = texels == RG_FIXED_TEXELS_BC3 ? 16 : 8;
    for (int y = 0; y < PX; y++)
        for (int x = 0; x < PX; x++)
            decode(texels, blocks + (ptrdiff_t)size * (y / SIDE * (PX / SIDE) + x / SIDE), x % SIDE,
                   y % SIDE, out[y * PX + x]);
}
