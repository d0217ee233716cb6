#include "harness/compare/blame/difference.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"

// How far floats may be apart, in steps of their last bit, to differ in the last bits alone.
enum { LAST_STEPS = 16, LAST_STEPS_HALF = 2, LAST_CODES = 1 };

static const struct {
    const char *name, *words;
} differences[RG_DIFFERENCE_COUNT] = {
    [RG_DIFFERENCE_NONE] = {"none", "no difference"},
    [RG_DIFFERENCE_SIZE] = {"size", "of size"},
    [RG_DIFFERENCE_NAN] = {"nan", "a NaN or an infinity in one of the two alone"},
    [RG_DIFFERENCE_MISSING] = {"missing", "missing: what was there before the stage still is"},
    [RG_DIFFERENCE_SURPLUS] = {"surplus", "surplus: the stage was not to write there"},
    [RG_DIFFERENCE_ORDER] = {"order", "the same elements in another order"},
    [RG_DIFFERENCE_LAST_BITS] = {"last-bits", "in the last bits"},
    [RG_DIFFERENCE_EDGE] = {"edge", "at edges, by a texel"},
    [RG_DIFFERENCE_VALUES] = {"values", "other values"},
};

const char *rg_difference_name(enum rg_difference difference)
{
    return differences[difference].name;
}

const char *rg_difference_words(enum rg_difference difference)
{
    return differences[difference].words;
}

enum rg_difference rg_difference_find(const char *name)
{
    for (int i = 0; i < RG_DIFFERENCE_COUNT; i++)
        if (!strcmp(name, differences[i].name))
            return (enum rg_difference)i;
    return RG_DIFFERENCE_NONE;
}

// Both, word by word.
struct pair {
    const struct rg_contents *now, *due, *before;
    int64_t words;
    const struct rg_state *state;
};

static uint32_t word_of(const struct rg_contents *contents, int64_t word)
{
    uint32_t bits;
    memcpy(&bits, (const char *)contents->bytes + 4 * word, sizeof(bits));
    return bits;
}

static bool differs(const struct pair *p, int64_t word)
{
    return word_of(p->now, word) != word_of(p->due, word);
}

// --- values: the parts of a word that are numbers of their own ---

// Bits of each; 0: a word that is no such number.
static int value_bits(const struct pair *p, int64_t word)
{
    if (p->now->desc.levels)
        switch (p->now->desc.format) {
        case RG_RGBA8:
            return 8;
        case RG_RGBA16F:
        case RG_R16F:
            return 16;
        case RG_RG11B10F:
            return 0;
        default:
            return 32;
        }
    return rg_contents_has_float(p->due, p->state, word_of(p->due, word)) ? 32 : 0;
}

// Of a float of so many bits: all ones in its exponent.
static bool is_endless(uint32_t bits, int size)
{
    const uint32_t exponent = size == 32 ? 0x7f800000u : 0x7c00u;
    return size > 8 && (bits & exponent) == exponent;
}

// Floats as integers in their order, so that neighbours are one apart.
static int64_t step_of(uint32_t bits, int size)
{
    const uint32_t sign = 1u << (size - 1);
    return size == 8 ? (int64_t)bits : bits & sign ? -(int64_t)(bits & ~sign) : (int64_t)bits;
}

static bool is_near(uint32_t a, uint32_t b, int size)
{
    const int64_t apart = llabs(step_of(a, size) - step_of(b, size));
    return apart <= (size == 32 ? LAST_STEPS : size == 16 ? LAST_STEPS_HALF : LAST_CODES);
}

static uint32_t value_of(uint32_t word, int at, int size)
{
    return size == 32 ? word : word >> at & ((1u << size) - 1);
}

// What a float unit makes where there is no number, or none so large.
static bool is_made_endless(uint32_t bits)
{
    return (bits & 0x7fffffff) == 0x7fc00000 || (bits & 0x7fffffff) == 0x7f800000;
}

static bool has_nan(const struct pair *p, int64_t word)
{
    const uint32_t a = word_of(p->now, word), b = word_of(p->due, word);
    const int size = value_bits(p, word);
    // Where nothing tells floats from integers, whose bits may be those of any NaN.
    if (!p->now->desc.levels && !p->state)
        return size && is_made_endless(a) != is_made_endless(b);
    for (int at = 0; size && at < 32; at += size)
        if (is_endless(value_of(a, at, size), size) != is_endless(value_of(b, at, size), size))
            return true;
    return false;
}

static bool is_in_last_bits(const struct pair *p, int64_t word)
{
    const uint32_t a = word_of(p->now, word), b = word_of(p->due, word);
    const int size = value_bits(p, word);
    for (int at = 0; size && at < 32; at += size)
        if (!is_near(value_of(a, at, size), value_of(b, at, size), size))
            return false;
    return size != 0;
}

// --- places ---

static bool is_left(const struct pair *p, int64_t word)
{
    return word_of(p->now, word) == word_of(p->before, word);
}

static bool was_due_so(const struct pair *p, int64_t word)
{
    return word_of(p->due, word) == word_of(p->before, word);
}

static bool any(const struct pair *p, bool (*holds)(const struct pair *p, int64_t word))
{
    for (int64_t i = 0; i < p->words; i++)
        if (differs(p, i) && holds(p, i))
            return true;
    return false;
}

static bool all(const struct pair *p, bool (*holds)(const struct pair *p, int64_t word))
{
    for (int64_t i = 0; i < p->words; i++)
        if (differs(p, i) && !holds(p, i))
            return false;
    return true;
}

// --- order ---

static int element_size; // for qsort, which takes no size

static int by_bytes(const void *a, const void *b)
{
    return memcmp(a, b, (size_t)element_size);
}

// Whether the elements that differ are the same ones, in another order.
static bool is_another_order(const struct pair *p, int element_bytes)
{
    const int64_t step = element_bytes / 4, elements = p->words / step;
    char *both = rg_alloc((size_t)elements * 2 + 1, (size_t)element_bytes, "elements");
    char *now = both, *due = both ? both + elements * element_bytes : NULL;
    int64_t count = 0;
    for (int64_t i = 0; both && i < elements; i++) {
        const char *a = (const char *)p->now->bytes + i * element_bytes;
        const char *b = (const char *)p->due->bytes + i * element_bytes;
        if (!memcmp(a, b, (size_t)element_bytes))
            continue;
        memcpy(now + count * element_bytes, a, (size_t)element_bytes);
        memcpy(due + count++ * element_bytes, b, (size_t)element_bytes);
    }
    element_size = element_bytes;
    if (count) {
        qsort(now, (size_t)count, (size_t)element_bytes, by_bytes);
        qsort(due, (size_t)count, (size_t)element_bytes, by_bytes);
    }
    const bool same = count && !memcmp(now, due, (size_t)(count * element_bytes));
    free(both);
    return same;
}

// --- edges ---

// Whether an image of one layer and level has a texel within a texel of (x, y).
static bool has_near(const struct rg_contents *c, const char *texel, int x, int y)
{
    const size_t size = (size_t)rg_format_size(c->desc.format);
    for (int v = y > 0 ? y - 1 : 0; v <= y + 1 && v < c->desc.height; v++)
        for (int u = x > 0 ? x - 1 : 0; u <= x + 1 && u < c->desc.width; u++) {
            const size_t at = (size_t)v * (size_t)c->desc.width + (size_t)u;
            if (!memcmp((const char *)c->bytes + at * size, texel, size))
                return true;
        }
    return false;
}

static bool is_at_edges(const struct pair *p)
{
    const struct rg_image_desc *desc = &p->now->desc;
    const size_t size = (size_t)rg_format_size(desc->format);
    if (desc->levels != 1 || desc->layers != 1)
        return false;
    const char *a = p->now->bytes, *b = p->due->bytes;
    for (int y = 0; y < desc->height; y++)
        for (int x = 0; x < desc->width; x++, a += size, b += size)
            if (memcmp(a, b, size) != 0 &&
                (!has_near(p->due, a, x, y) || !has_near(p->now, b, x, y)))
                return false;
    return true;
}

enum rg_difference rg_difference_of(const struct rg_contents *contents,
                                    const struct rg_contents *expected,
                                    const struct rg_contents *before, int element_bytes,
                                    const struct rg_state *state, struct rg_differing *differing)
{
    const size_t size = contents->size < expected->size ? contents->size : expected->size;
    const struct pair p = {contents, expected, before, (int64_t)(size + 3) / 4, state};
    *differing = (struct rg_differing){0};
    for (int64_t i = 0; i < p.words; i++)
        if (differs(&p, i) && !differing->count++)
            differing->first = i;
    if (contents->size != expected->size)
        return RG_DIFFERENCE_SIZE;
    if (!differing->count)
        return RG_DIFFERENCE_NONE;
    if (any(&p, has_nan))
        return RG_DIFFERENCE_NAN;
    const bool has_before = before->bytes && before->size == contents->size;
    if (has_before && all(&p, is_left))
        return RG_DIFFERENCE_MISSING;
    if (has_before && all(&p, was_due_so))
        return RG_DIFFERENCE_SURPLUS;
    if (!contents->desc.levels && is_another_order(&p, element_bytes))
        return RG_DIFFERENCE_ORDER;
    if (all(&p, is_in_last_bits))
        return RG_DIFFERENCE_LAST_BITS;
    return contents->desc.levels && is_at_edges(&p) ? RG_DIFFERENCE_EDGE : RG_DIFFERENCE_VALUES;
}
