#include "harness/commands/drawing/drawn.h"

#include <limits.h>
#include <stdio.h>

#include "core/base/text/plain.h"
#include "core/image/clip/clip.h"
#include "harness/record/named.h"
#include "harness/record/passport/passport.h"

// Every parameter with its value, as for --set.
static json_t *settings_json(const struct rg_technique *technique, const void *settings)
{
    json_t *json = json_object();
    for (int i = 0; i < technique->params->count; i++) {
        char value[RG_PATH_SIZE];
        rg_params_text(&technique->params->rows[i], settings, value, sizeof(value));
        json_object_set_new(json, technique->params->rows[i].name, rg_json_text(value));
    }
    return json;
}

static void add_sequence(json_t *json, const struct rg_sequence *s)
{
    json_object_set_new(json, "frames", json_pack("[ii]", s->first, s->last));
    if (rg_clip_is_named(s->path))
        json_object_set_new(json, "fps", json_integer(s->fps));
}

void rg_drawn_print_json(const struct rg_drawn *d)
{
    const struct rg_account *a = &d->account;
    struct rg_named facts[RG_MAX_FACTS];
    struct rg_count counters[RG_MAX_COUNTERS];
    rg_facts_copy(facts, a->facts, a->fact_count);
    rg_counters_copy(counters, a->counters, a->counter_count);
    json_t *json = json_pack(
        "{sisosssosisisIsosososo}", "format", 1, "file", rg_json_text(d->path), "technique",
        d->subject.technique->name, "device", rg_json_text(d->on->name), "width", d->subject.width,
        "height", d->subject.height, "frame", (json_int_t)a->frame, "settings",
        settings_json(d->subject.technique, d->subject.settings), "facts",
        rg_named_json(facts, a->fact_count), "counters", rg_counts_json(counters, a->counter_count),
        "passport", rg_passport_json(d->on, 1));
    if (d->sequence)
        add_sequence(json, d->sequence);
    json_dumpf(json, stdout, JSON_INDENT(1));
    printf("\n");
    json_decref(json);
}

// "frame 60", "frames 60-119, 60 a second"
static void frames_text(const struct rg_drawn *d, char *text, size_t size)
{
    const struct rg_sequence *s = d->sequence;
    if (!s)
        snprintf(text, size, "frame %lld", (long long)d->account.frame);
    else if (!rg_clip_is_named(s->path))
        snprintf(text, size, "frames %d-%d", s->first, s->last);
    else
        snprintf(text, size, "frames %d-%d, %d a second", s->first, s->last, s->fps);
}

void rg_drawn_print_text(const struct rg_drawn *d)
{
    struct rg_named told[RG_MAX_FACTS];
    char facts[RG_FACTS_TEXT], frames[64], line[PATH_MAX + 2 * RG_FACTS_TEXT];
    rg_facts_copy(told, d->account.facts, d->account.fact_count);
    rg_named_text(told, d->account.fact_count, NULL, facts, sizeof(facts));
    frames_text(d, frames, sizeof(frames));
    snprintf(line, sizeof(line), "%s: %s, %s, %dx%d, on %s (%s)%s%s", d->path,
             d->subject.technique->name, frames, d->subject.width, d->subject.height, d->on->name,
             d->on->device, *facts ? "; " : "", facts);
    rg_plain(line);
    printf("%s\n", line);
}
