#include "core/techniques/stages/contents.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

#include "core/base/alloc.h"
#include "core/image/half.h"

static size_t level_bytes(const struct rg_image_desc *desc, int level)
{
    return (size_t)rg_level_size(desc->width, level) * (size_t)rg_level_size(desc->height, level) *
           (size_t)rg_format_size(desc->format);
}

static bool read_image(struct rg_image *image, unsigned char *bytes)
{
    const struct rg_image_desc *desc = &image->desc;
    for (int level = 0; level < desc->levels; level++) {
        for (int layer = 0; layer < desc->layers; layer++) {
            if (!rg_image_read(image, layer, level, bytes))
                return false;
            bytes += level_bytes(desc, level);
        }
    }
    return true;
}

size_t rg_contents_size(const struct rg_image_desc *desc)
{
    size_t size = 0;
    for (int level = 0; level < desc->levels; level++)
        size += level_bytes(desc, level) * (size_t)desc->layers;
    return size;
}

bool rg_contents_read(const struct rg_asset *asset, struct rg_contents *contents)
{
    *contents = (struct rg_contents){.size = asset->buf ? asset->buf->size : 0};
    if (asset->image) {
        contents->desc = asset->image->desc;
        contents->size = rg_contents_size(&contents->desc);
    }
    contents->bytes = rg_alloc(contents->size / 4 + 1, 4, asset->name); // whole words are compared
    if (!contents->bytes)
        return false;
    return asset->image ? read_image(asset->image, contents->bytes)
                        : rg_buf_read(asset->buf, 0, contents->bytes, (int64_t)contents->size);
}

bool rg_contents_write(const struct rg_contents *contents, struct rg_image *image)
{
    const unsigned char *texels = contents->bytes;
    bool ok = true;
    for (int level = 0; ok && level < contents->desc.levels; level++)
        for (int layer = 0; ok && layer < contents->desc.layers; layer++) {
            ok = rg_image_write(image, layer, level, texels);
            texels += level_bytes(&contents->desc, level);
        }
    return ok;
}

void rg_contents_free(struct rg_contents *contents)
{
    free(contents->bytes);
    *contents = (struct rg_contents){0};
}

uint64_t rg_contents_hash(const struct rg_contents *contents)
{
    return XXH3_64bits(contents->bytes, contents->size);
}

// --- differences ---

// The texel, layer and level of an image's byte.
static void texel_text(const struct rg_image_desc *desc, size_t byte, char *text, size_t size)
{
    int level = 0, layer = 0;
    while (byte >= level_bytes(desc, level)) {
        byte -= level_bytes(desc, level);
        if (++layer == desc->layers) {
            layer = 0;
            level++;
        }
    }
    const size_t texel = byte / (size_t)rg_format_size(desc->format);
    const size_t width = (size_t)rg_level_size(desc->width, level);
    snprintf(text, size, " (%zu, %zu) of layer %d, level %d, byte %zu of the texel", texel % width,
             texel / width, layer, level, byte % (size_t)rg_format_size(desc->format));
}

static void place_text(const struct rg_contents *c, const struct rg_state *state, size_t byte,
                       char *text, size_t size)
{
    const size_t word = byte / 4, words = state->words ? strlen(state->words) : 1;
    if (c->desc.levels)
        texel_text(&c->desc, byte, text, size);
    else if (state->row)
        snprintf(text, size, " (%d, %d)", (int)(word % (size_t)state->row) - state->margin,
                 (int)(word / (size_t)state->row) - state->margin);
    else if (words > 1)
        snprintf(text, size, "[%zu], word %zu of its %zu,", word / words, word % words, words);
    else
        snprintf(text, size, "[%zu]", word);
}

enum rg_number rg_contents_number(const struct rg_contents *c, const struct rg_state *state,
                                  int64_t word)
{
    static const enum rg_number of_formats[RG_FORMAT_COUNT] = {
        [RG_RGBA8] = RG_NUMBER_CODE, [RG_RGBA16F] = RG_NUMBER_HALF, [RG_RGBA32F] = RG_NUMBER_FLOAT,
        [RG_R32F] = RG_NUMBER_FLOAT, [RG_R16F] = RG_NUMBER_HALF,    [RG_RG11B10F] = RG_NUMBER_SMALL,
        [RG_D32F] = RG_NUMBER_FLOAT,
    };
    if (c->desc.levels)
        return of_formats[c->desc.format];
    const char *words = state->words ? state->words : "";
    const char letter = *words ? words[word % (int64_t)strlen(words)] : RG_WORD_UINT;
    return letter == RG_WORD_FLOAT ? RG_NUMBER_FLOAT
           : letter == RG_WORD_INT ? RG_NUMBER_INT
                                   : RG_NUMBER_UINT;
}

int rg_number_bits(enum rg_number number, int at)
{
    return number == RG_NUMBER_HALF    ? 16
           : number == RG_NUMBER_CODE  ? 8
           : number == RG_NUMBER_SMALL ? (at < 22 ? 11 : 10)
                                       : 32;
}

// The number at bit `at` of a word.
static double value_of(uint32_t word, enum rg_number number, int at)
{
    const int bits = rg_number_bits(number, at);
    const uint32_t value = bits == 32 ? word : word >> at & ((1u << bits) - 1);
    float real;
    memcpy(&real, &word, sizeof(real));
    switch (number) {
    case RG_NUMBER_FLOAT:
        return (double)real;
    case RG_NUMBER_HALF:
        return (double)rg_float_of_half((uint16_t)value);
    case RG_NUMBER_SMALL: // a half without its sign and last bits
        return (double)rg_float_of_half((uint16_t)(value << (15 - bits)));
    case RG_NUMBER_INT:
        return (double)(int32_t)value;
    default:
        return (double)value;
    }
}

// A word in text, as its numbers and as bits. A float gets nine digits, which tell it from all
// others.
static void word_text(uint32_t word, enum rg_number number, char *text, size_t size)
{
    const int digits = number == RG_NUMBER_FLOAT ? 9 : number == RG_NUMBER_HALF ? 5 : 10;
    const bool has_several = rg_number_bits(number, 0) < 32;
    size_t used = 0;
    for (int at = 0; at < 32 && used < size; at += rg_number_bits(number, at))
        used += (size_t)snprintf(text + used, size - used, "%s%.*g",
                                 at            ? ", "
                                 : has_several ? "("
                                               : "",
                                 digits, value_of(word, number, at));
    if (used < size)
        snprintf(text + used, size - used, "%s (0x%08x)", has_several ? ")" : "", word);
}

// The distance between two words: the largest distance between two of their numbers.
static double distance(uint32_t a, uint32_t b, enum rg_number number)
{
    double most = 0;
    for (int at = 0; at < 32; at += rg_number_bits(number, at)) {
        const double off = fabs(value_of(a, number, at) - value_of(b, number, at));
        const bool is_same = value_of(a, number, at) == value_of(b, number, at); // infinite, too
        if (!is_same && !(off <= most) && !isnan(most))
            most = off;
    }
    return most;
}

void rg_contents_describe(const struct rg_contents *c, const struct rg_contents *expected,
                          const struct rg_state *state, char *text, size_t size)
{
    const unsigned char *a = c->bytes, *b = expected->bytes;
    const size_t words = ((c->size < expected->size ? c->size : expected->size) + 3) / 4;
    size_t first = 0, differing = 0;
    *text = 0;
    for (size_t i = 0; i < words; i++) {
        if (!memcmp(a + 4 * i, b + 4 * i, 4))
            continue;
        first = differing ? first : i;
        differing++;
    }
    if (!differing)
        return;
    char place[160], is[96], due[96];
    uint32_t bits, expected_bits;
    memcpy(&bits, a + 4 * first, 4);
    memcpy(&expected_bits, b + 4 * first, 4);
    const enum rg_number number = rg_contents_number(c, state, (int64_t)first);
    const bool is_whole = number == RG_NUMBER_UINT || number == RG_NUMBER_INT;
    place_text(c, state, 4 * first, place, sizeof(place));
    word_text(bits, number, is, sizeof(is));
    word_text(expected_bits, number, due, sizeof(due));
    snprintf(text, size, "%s is %s, not %s, off by %.*g; %zu of %zu words differ", place, is, due,
             is_whole ? 10 : 3, distance(bits, expected_bits, number), differing, words);
}
