#include "core/techniques/stages/contents.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

#include "core/base/alloc.h"

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

// Which texel, layer and level a byte of an image belongs to.
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
    const size_t word = byte / 4;
    if (c->desc.levels)
        texel_text(&c->desc, byte, text, size);
    else if (state && state->row)
        snprintf(text, size, " (%d, %d)", (int)(word % (size_t)state->row) - state->margin,
                 (int)(word / (size_t)state->row) - state->margin);
    else
        snprintf(text, size, "[%zu]", word);
}

// A word in text: as a float and as bits; a word that holds several smaller values as bits alone.
static void word_text(uint32_t bits, bool as_float, char *text, size_t size)
{
    float value;
    memcpy(&value, &bits, sizeof(value));
    if (as_float)
        snprintf(text, size, "%.9g (0x%08x)", (double)value, bits);
    else
        snprintf(text, size, "%u (0x%08x)", bits, bits);
}

// Where nothing says what words are, they count as floats if their exponent is neither that of a
// small integer nor all ones.
bool rg_contents_has_float(const struct rg_contents *c, const struct rg_state *state, uint32_t bits)
{
    const uint32_t exponent = bits >> 23 & 0xff;
    if (c->desc.levels)
        return c->desc.format == RG_R32F || c->desc.format == RG_RGBA32F ||
               c->desc.format == RG_D32F;
    return state ? state->is_float : exponent > 64 && exponent < 255;
}

static void difference_text(uint32_t bits, uint32_t due, bool as_float, char *text, size_t size)
{
    float value, expected;
    memcpy(&value, &bits, sizeof(value));
    memcpy(&expected, &due, sizeof(expected));
    if (as_float)
        snprintf(text, size, "%.3g", fabs((double)value - (double)expected));
    else
        snprintf(text, size, "%u", bits > due ? bits - due : due - bits);
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
    char place[160], is[48], due[48], off[32];
    uint32_t bits, expected_bits;
    memcpy(&bits, a + 4 * first, 4);
    memcpy(&expected_bits, b + 4 * first, 4);
    const bool as_float = rg_contents_has_float(c, state, expected_bits ? expected_bits : bits);
    place_text(c, state, 4 * first, place, sizeof(place));
    word_text(bits, as_float, is, sizeof(is));
    word_text(expected_bits, as_float, due, sizeof(due));
    difference_text(bits, expected_bits, as_float, off, sizeof(off));
    snprintf(text, size, "%s is %s, not %s, off by %s; %zu of %zu words differ", place, is, due,
             off, differing, words);
}
