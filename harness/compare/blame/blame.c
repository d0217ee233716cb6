#include "harness/compare/blame/blame.h"

#include <stdio.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/console/interrupt.h"
#include "harness/record/named.h"

int rg_blame_first(const struct rg_digests *a, const struct rg_digests *b)
{
    const int count = a->count < b->count ? a->count : b->count;
    for (int i = 0; i < count; i++) {
        const struct rg_digest *p = &a->rows[i], *q = &b->rows[i];
        if (p->hash != q->hash || p->stages_run != q->stages_run || strcmp(p->asset, q->asset) != 0)
            return i;
    }
    return a->count == b->count ? -1 : count;
}

// The last row before `row` with the same asset; -1: none.
static int row_before(const struct rg_digests *digests, int row)
{
    int before = row - 1;
    while (before >= 0 && strcmp(digests->rows[before].asset, digests->rows[row].asset) != 0)
        before--;
    return before;
}

static void find_texel(const struct rg_image_desc *desc, int64_t byte, struct rg_blame *blame)
{
    for (;; blame->level++, blame->layer = 0) {
        const int width = rg_level_size(desc->width, blame->level);
        const int64_t texel = rg_format_size(desc->format);
        const int64_t layer = texel * width * rg_level_size(desc->height, blame->level);
        if (byte < layer * desc->layers) {
            blame->layer = (int)(byte / layer);
            blame->x = (int)(byte % layer / texel % width);
            blame->y = (int)(byte % layer / texel / width);
            return;
        }
        byte -= layer * desc->layers;
    }
}

// The contents on both devices, and `before`, those that both had earlier.
struct three {
    struct rg_contents now, due, before;
    struct rg_state state, unused;
};

static bool read_three(const struct rg_digest_run *run, struct rg_device *device,
                       struct rg_device *truth, int row, int before, struct three *c)
{
    return rg_digests_contents(run, device, row, &c->now, &c->state) &&
           rg_digests_contents(run, truth, row, &c->due, &c->state) &&
           (before < 0 || rg_digests_contents(run, truth, before, &c->before, &c->unused));
}

static void judge(const struct three *c, struct rg_blame *blame, char *where, size_t size)
{
    const struct rg_state *state = &c->state;
    struct rg_differing differing;
    blame->difference = rg_difference_of(&c->now, &c->due, &c->before, state, &differing);
    blame->differing = differing.count;
    blame->words = (int64_t)(c->due.size + 3) / 4;
    blame->is_image = c->now.desc.levels > 0;
    if (blame->is_image && differing.count)
        find_texel(&c->now.desc, 4 * differing.first, blame);
    else
        blame->item = 4 * differing.first / rg_difference_element(state);
    rg_contents_describe(&c->now, &c->due, state, where, size);
}

bool rg_blame_row(const struct rg_digest_run *run, struct rg_device *device,
                  struct rg_device *truth, const struct rg_digests *now,
                  const struct rg_digests *expected, struct rg_blame *blame)
{
    const int row = rg_blame_first(now, expected);
    *blame = (struct rg_blame){.found = row >= 0};
    if (row < 0)
        return true;
    blame->first = row < now->count ? now->rows[row] : expected->rows[row];
    const struct rg_digest *d = &blame->first;
    blame->is_alone = row >= now->count || row >= expected->count ||
                      strcmp(d->asset, expected->rows[row].asset) != 0 ||
                      d->stages_run != expected->rows[row].stages_run;
    char where[400] = " is written by one of the two alone";
    struct three c = {0};
    bool ok = true;
    if (!blame->is_alone) {
        // Frames after the row's are not needed.
        struct rg_digest_run until = *run;
        until.frames = d->frame + 1 < run->frames ? (int)d->frame + 1 : run->frames;
        blame->expected = expected->rows[row].hash;
        ok = read_three(&until, device, truth, row, row_before(expected, row), &c);
        if (ok)
            judge(&c, blame, where, sizeof(where));
        else
            snprintf(where, sizeof(where), ": %s", rg_last_error());
    }
    snprintf(blame->text, sizeof(blame->text), "frame %lld, %s %s: %s%s%s%s", (long long)d->frame,
             *d->stage ? "stage" : "opening", d->stage, d->asset, where,
             blame->difference ? "; " : "",
             blame->difference ? rg_difference_words(blame->difference) : "");
    rg_contents_free(&c.now);
    rg_contents_free(&c.due);
    rg_contents_free(&c.before);
    return ok;
}

bool rg_blame_find(const struct rg_digest_run *run, struct rg_device *device,
                   struct rg_device *truth, struct rg_blame *blame)
{
    struct rg_digest_run part = *run;
    bool ok = true;
    *blame = (struct rg_blame){0};
    for (part.frames = run->frames < 1 ? 0 : 1; ok && !blame->found; part.frames *= 2) {
        struct rg_digests now = {0}, expected = {0};
        part.frames = part.frames < run->frames ? part.frames : run->frames;
        ok = rg_digests_take(&part, device, &now) && rg_digests_take(&part, truth, &expected) &&
             !rg_interrupted() && // an interrupted run may lack frames
             rg_blame_row(&part, device, truth, &now, &expected, blame);
        rg_digests_free(&now);
        rg_digests_free(&expected);
        if (part.frames == run->frames)
            break;
    }
    return ok;
}

json_t *rg_blame_json(const struct rg_blame *b)
{
    char hash[20], expected[20];
    snprintf(hash, sizeof(hash), "%016llx", (unsigned long long)b->first.hash);
    snprintf(expected, sizeof(expected), "%016llx", (unsigned long long)b->expected);
    json_t *json = json_pack("{s:b, s:I, s:i, s:s, s:s, s:s, s:s, s:s, s:I, s:I, s:o}", "alone",
                             b->is_alone, "frame", (json_int_t)b->first.frame, "stages_run",
                             b->first.stages_run, "stage", b->first.stage, "asset", b->first.asset,
                             "class", rg_difference_name(b->difference), "digest", hash, "expected",
                             expected, "differing", (json_int_t)b->differing, "words",
                             (json_int_t)b->words, "text", rg_json_text(b->text));
    if (json && b->is_image)
        json_object_set_new(json, "texel", json_pack("[iiii]", b->x, b->y, b->layer, b->level));
    else if (json)
        json_object_set_new(json, "item", json_integer(b->item));
    return json;
}
