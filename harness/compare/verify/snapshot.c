#include "harness/compare/verify/snapshot.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/techniques/stages/contents.h"

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

void rg_snapshot_describe(const struct rg_snapshot *a, const struct rg_snapshot *expected,
                          char *text, size_t size)
{
    *text = 0;
    for (int s = 0; !*text && s < a->state_count && s < expected->state_count; s++) {
        const struct rg_contents now = {.size = a->state_bytes[s], .bytes = a->state[s]};
        const struct rg_contents due = {.size = expected->state_bytes[s],
                                        .bytes = expected->state[s]};
        char where[400];
        rg_contents_describe(&now, &due, &a->layout[s], where, sizeof(where));
        if (*where)
            snprintf(text, size, "%s%s", a->layout[s].name, where);
    }
}
