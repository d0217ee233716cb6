#include "harness/compare/verify/snapshot.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

bool rg_snapshot_take(struct rg_session *session, bool with_image, struct rg_snapshot *s)
{
    memset(s, 0, sizeof(*s));
    bool ok = true;
    for (int i = 0; ok && i < rg_session_state_count(session); i++) {
        s->state[i] = rg_session_read_state(session, i, &s->layout[i], &s->state_bytes[i]);
        ok = s->state[i] != NULL;
        s->state_count += ok;
    }
    if (ok && with_image)
        ok = (s->texels = rg_session_read(session, &s->texels_bytes)) != NULL;
    if (!ok)
        rg_snapshot_free(s);
    return ok;
}

void rg_snapshot_free(struct rg_snapshot *s)
{
    for (int i = 0; i < s->state_count; i++)
        free(s->state[i]);
    free(s->texels);
    memset(s, 0, sizeof(*s));
}

static bool same(const void *a, size_t a_bytes, const void *b, size_t b_bytes)
{
    return a_bytes == b_bytes && !memcmp(a, b, a_bytes);
}

bool rg_snapshot_same_state(const struct rg_snapshot *a, const struct rg_snapshot *b)
{
    bool equal = a->state_count == b->state_count;
    for (int i = 0; equal && i < a->state_count; i++)
        equal = same(a->state[i], a->state_bytes[i], b->state[i], b->state_bytes[i]);
    return equal;
}

bool rg_snapshot_same_image(const struct rg_snapshot *a, const struct rg_snapshot *b)
{
    return same(a->texels, a->texels_bytes, b->texels, b->texels_bytes);
}

static void value_text(const struct rg_state *layout, const void *state, size_t i, char *text,
                       size_t size)
{
    uint32_t bits;
    float value;
    memcpy(&bits, (const char *)state + 4 * i, sizeof(bits));
    memcpy(&value, &bits, sizeof(value));
    if (layout->is_float)
        snprintf(text, size, "%.9g (0x%08x)", (double)value, bits);
    else
        snprintf(text, size, "%u", bits);
}

static void describe_element(const struct rg_state *layout, const void *a, const void *expected,
                             size_t i, char *text, size_t size)
{
    char value[40], due[40], place[40];
    value_text(layout, a, i, value, sizeof(value));
    value_text(layout, expected, i, due, sizeof(due));
    if (layout->row)
        snprintf(place, sizeof(place), " (%d, %d)", (int)(i % (size_t)layout->row) - layout->margin,
                 (int)(i / (size_t)layout->row) - layout->margin);
    else
        snprintf(place, sizeof(place), "[%zu]", i);
    snprintf(text, size, "%s%s is %s, not %s", layout->name, place, value, due);
}

void rg_snapshot_describe(const struct rg_snapshot *a, const struct rg_snapshot *expected,
                          char *text, size_t size)
{
    *text = 0;
    for (int s = 0; s < a->state_count && s < expected->state_count; s++) {
        const char *p = a->state[s], *q = expected->state[s];
        for (size_t i = 0; 4 * i < a->state_bytes[s] && 4 * i < expected->state_bytes[s]; i++) {
            if (!memcmp(p + 4 * i, q + 4 * i, 4))
                continue;
            describe_element(&a->layout[s], p, q, i, text, size);
            return;
        }
    }
}
