#include "harness/compare/blame/difference.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"

// The largest distance, in units in the last place, that counts as a difference in the last bits.
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

// Compares both word by word.
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

static bool is_whole(enum rg_number number)
{
    return number == RG_NUMBER_UINT || number == RG_NUMBER_INT;
}

static uint32_t value_of(uint32_t word, enum rg_number number, int at)
{
    const int size = rg_number_bits(number, at);
    return size == 32 ? word : word >> at & ((1u << size) - 1);
}

// Whether a float is NaN or infinite: all ones in its exponent.
static bool is_endless(uint32_t bits, enum rg_number number, int at)
{
    const uint32_t exponent = number == RG_NUMBER_FLOAT ? 0x7f800000u
                              : number == RG_NUMBER_HALF
                                  ? 0x7c00u
                                  : 0x1fu << (rg_number_bits(number, at) - 5);
    return !is_whole(number) && number != RG_NUMBER_CODE && (bits & exponent) == exponent;
}

// Floats as integers in their order, so that neighbours are one apart.
static int64_t step_of(uint32_t bits, enum rg_number number)
{
    const uint32_t sign = number == RG_NUMBER_FLOAT  ? 1u << 31
                          : number == RG_NUMBER_HALF ? 1u << 15
                                                     : 0;
    return bits & sign ? -(int64_t)(bits & ~sign) : (int64_t)bits;
}

static bool is_near(uint32_t a, uint32_t b, enum rg_number number)
{
    const int64_t apart = llabs(step_of(a, number) - step_of(b, number));
    return apart <= (number == RG_NUMBER_FLOAT  ? LAST_STEPS
                     : number == RG_NUMBER_CODE ? LAST_CODES
                                                : LAST_STEPS_HALF);
}

static bool has_nan(const struct pair *p, int64_t word)
{
    const uint32_t a = word_of(p->now, word), b = word_of(p->due, word);
    const enum rg_number number = rg_contents_number(p->due, p->state, word);
    bool has = false;
    for (int at = 0; at < 32; at += rg_number_bits(number, at))
        has = has || is_endless(value_of(a, number, at), number, at) !=
                         is_endless(value_of(b, number, at), number, at);
    return has;
}

static bool is_in_last_bits(const struct pair *p, int64_t word)
{
    const uint32_t a = word_of(p->now, word), b = word_of(p->due, word);
    const enum rg_number number = rg_contents_number(p->due, p->state, word);
    bool is = !is_whole(number);
    for (int at = 0; at < 32; at += rg_number_bits(number, at))
        is = is && is_near(value_of(a, number, at), value_of(b, number, at), number);
    return is;
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

static int element_size; // for qsort's callback, which gets no size

static int by_bytes(const void *a, const void *b)
{
    return memcmp(a, b, (size_t)element_size);
}

// Whether the differing elements are the same ones in another order.
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

// Whether an image of one layer and level has this texel value within a texel of (x, y).
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

int rg_difference_element(const struct rg_state *state)
{
    return state->words ? 4 * (int)strlen(state->words) : 4;
}

enum rg_difference rg_difference_of(const struct rg_contents *contents,
                                    const struct rg_contents *expected,
                                    const struct rg_contents *before, const struct rg_state *state,
                                    struct rg_differing *differing)
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
    if (!contents->desc.levels && is_another_order(&p, rg_difference_element(state)))
        return RG_DIFFERENCE_ORDER;
    if (all(&p, is_in_last_bits))
        return RG_DIFFERENCE_LAST_BITS;
    return contents->desc.levels && is_at_edges(&p) ? RG_DIFFERENCE_EDGE : RG_DIFFERENCE_VALUES;
}
