#include "core/techniques/stages/stages.h"

#include <stdio.h>
#include <string.h>

#include "core/base/log.h"
#include "core/techniques/stages/assets.h"

// --- opening ---

// State of opening stages.
struct opening {
    struct rg_instance *instance;
    struct rg_opened_stage *stage;
    const char *scope;
};

// Finds an asset by name, in the scope first. NULL if there is none, with one logged line that
// names `what` asked for it.
static struct rg_asset *find(const struct opening *o, const char *name, const char *what)
{
    char scoped[RG_ASSET_NAME];
    struct rg_asset *asset = NULL;
    if (o->scope && snprintf(scoped, sizeof(scoped), "%s.%s", o->scope, name) < RG_ASSET_NAME)
        asset = rg_asset_find(o->instance, scoped);
    if (!asset)
        asset = rg_asset_find(o->instance, name);
    return asset ? asset
                 : rg_error_null("stage '%s': its %s, '%s', names no asset of the instance; add "
                                 "one of that name, or name another in the stage's row",
                                 o->stage->row.kernel, what, name);
}

// The name of the asset that a slot is bound to.
static const char *asset_name(const struct rg_stage *row, const char *slot)
{
    for (int i = 0; i < RG_STAGE_NAMES && row->named[i].slot; i++)
        if (!strcmp(row->named[i].slot, slot))
            return row->named[i].asset;
    return slot;
}

static bool bind_slot(const struct opening *o, const struct rg_slot_info *slot)
{
    const struct rg_stage *row = &o->stage->row;
    const bool wants_image = slot->kind == RG_SLOT_IMAGE || slot->kind == RG_SLOT_OUT_IMAGE;
    struct rg_asset *asset = find(o, asset_name(row, slot->name), "slot");
    o->stage->slots[slot->slot] = asset;
    if (!asset)
        return false;
    if (asset->is_image != wants_image)
        return rg_error("stage '%s': slot '%s' wants %s, and the asset '%s' is not; name another "
                        "in the stage's row",
                        row->kernel, slot->name, wants_image ? "an image" : "a buffer",
                        asset->name);
    if (asset->image && asset->image->desc.format != slot->format)
        return rg_error("stage '%s': slot '%s' wants an image of %s, and the asset '%s' is %s; "
                        "name another in the stage's row",
                        row->kernel, slot->name, rg_format_name(slot->format), asset->name,
                        rg_format_name(asset->image->desc.format));
    return true;
}

// Refuses a row that names a slot that the kernel lacks.
static bool check_names(const struct rg_stage *row, const struct rg_kernel *kernel)
{
    for (int i = 0; i < RG_STAGE_NAMES && row->named[i].slot; i++) {
        bool known = false;
        for (int k = 0; k < kernel->slot_count; k++)
            known = known || !strcmp(kernel->slots[k].name, row->named[i].slot);
        if (!known)
            return rg_error("stage '%s': its row names a slot '%s', which the kernel has not; "
                            "correct the row",
                            row->kernel, row->named[i].slot);
    }
    return true;
}

static bool find_optional(const struct opening *o, const char *name, const char *what,
                          struct rg_asset **asset)
{
    *asset = name ? find(o, name, what) : NULL;
    return *asset || !name;
}

// Stages of one kernel share its pass.
static struct rg_pass *shared_pass(const struct rg_instance *instance, const char *kernel)
{
    for (int i = 0; i < instance->stage_count; i++) {
        struct rg_pass *pass = instance->stages[i].pass;
        if (pass && !strcmp(pass->kernel->name, kernel))
            return pass;
    }
    return NULL;
}

static bool open_stage(const struct opening *o)
{
    struct rg_opened_stage *stage = o->stage;
    const struct rg_stage *row = &stage->row;
    if (!row->kernel || (row->when && !row->when(o->instance)))
        return true;
    stage->pass = shared_pass(o->instance, row->kernel);
    stage->owns_pass = !stage->pass;
    if (!stage->pass && !(stage->pass = rg_pass_create(o->instance->device, row->kernel)))
        return false;
    const struct rg_kernel *kernel = stage->pass->kernel;
    for (int i = 0; i < kernel->slot_count; i++)
        if (!bind_slot(o, &kernel->slots[i]))
            return false;
    return check_names(row, kernel) && find_optional(o, row->over, "items", &stage->over) &&
           find_optional(o, row->colour, "colour", &stage->colour) &&
           find_optional(o, row->depth, "depth", &stage->depth) &&
           find_optional(o, row->samples, "samples", &stage->samples);
}

int rg_open_stages(struct rg_instance *instance, const struct rg_stage *rows, int count,
                   const void *owner, const char *scope)
{
    const int first = instance->stage_count;
    bool ok = !instance->has_failed;
    if (ok && first + count > RG_MAX_STAGES)
        ok = rg_error("stages: %d are more than an instance has room for; raise RG_MAX_STAGES",
                      first + count);
    for (int i = 0; ok && i < count; i++) {
        struct rg_opened_stage *stage = &instance->stages[first + i];
        *stage = (struct rg_opened_stage){.row = rows[i], .owner = owner};
        ok = open_stage(&(struct opening){instance, stage, scope});
        instance->stage_count++;
    }
    instance->has_failed = !ok;
    return ok ? first : -1;
}

void rg_stages_free(struct rg_instance *instance)
{
    for (int i = 0; i < instance->stage_count; i++)
        if (instance->stages[i].owns_pass)
            rg_pass_destroy(instance->stages[i].pass);
    instance->stage_count = 0;
}

// --- running ---

static void note_written(struct rg_opened_stage *stage)
{
    const struct rg_kernel *kernel = stage->pass->kernel;
    for (int i = 0; i < kernel->slot_count; i++)
        if (rg_slot_is_written(kernel->slots[i].kind))
            stage->slots[kernel->slots[i].slot]->is_defined = true;
}

static bool run(struct rg_instance *instance, int at, struct rg_run *run)
{
    struct rg_opened_stage *stage = &instance->stages[at];
    stage->drawn = run->draw ? *run->draw : (struct rg_draw){0};
    stage->ran = run->extent;
    run->params = (const char *)stage->owner + stage->row.params;
    for (int i = 0; i < RG_MAX_SLOTS; i++)
        if (stage->slots[i])
            run->slots[i] = (struct rg_binding){stage->slots[i]->buf, stage->slots[i]->image};
    if (!rg_pass_run(stage->pass, run))
        return false;
    note_written(stage);
    if (instance->after_stage)
        instance->after_stage(stage, instance->user);
    return true;
}

struct rg_draw rg_stage_draw(const struct rg_instance *instance, int stage)
{
    const struct rg_opened_stage *s = &instance->stages[stage];
    return (struct rg_draw){.colour = s->colour ? s->colour->image : NULL,
                            .depth = s->depth ? s->depth->image : NULL,
                            .samples = s->samples ? s->samples->buf : NULL,
                            .blend = s->row.blend,
                            .depth_mode = s->row.depth_mode,
                            .cull = s->row.cull,
                            .items_a_query = s->row.items_a_query};
}

bool rg_stage_over(struct rg_instance *instance, int stage, struct rg_extent origin,
                   struct rg_extent extent)
{
    if (!rg_stage_runs(instance, stage))
        return true;
    const struct rg_draw draw = rg_stage_draw(instance, stage);
    const bool draws = instance->stages[stage].pass->kernel->draw;
    return run(instance, stage,
               &(struct rg_run){.origin = origin, .extent = extent, .draw = draws ? &draw : NULL});
}

bool rg_stage(struct rg_instance *instance, int stage)
{
    const struct rg_asset *over = instance->stages[stage].over;
    const struct rg_extent one = {1, 1, 1}, none = {0, 0, 0};
    return rg_stage_over(instance, stage, none, over ? over->items : one);
}

bool rg_stage_onto(struct rg_instance *instance, int stage, int items, const struct rg_draw *draw)
{
    return !rg_stage_runs(instance, stage) ||
           run(instance, stage, &(struct rg_run){.extent = {items, 1, 1}, .draw = draw});
}

bool rg_stage_runs(const struct rg_instance *instance, int stage)
{
    return instance->stages[stage].pass;
}

bool rg_stage_wrote(const struct rg_opened_stage *s, const struct rg_asset *asset)
{
    const struct rg_kernel *kernel = s->pass->kernel;
    for (int i = 0; i < kernel->slot_count; i++) {
        const struct rg_slot_info *slot = &kernel->slots[i];
        const struct rg_asset *bound = s->slots[slot->slot];
        if (rg_slot_is_written(slot->kind) && bound->buf == asset->buf &&
            bound->image == asset->image)
            return true;
    }
    if (asset->buf)
        return s->drawn.samples == asset->buf;
    return asset->image &&
           (s->drawn.colour == asset->image ||
            (s->drawn.depth == asset->image && s->drawn.depth_mode == RG_DEPTH_WRITE));
}

static const char *words_of(const struct rg_opened_stage *s, const struct rg_buf *buf)
{
    for (int i = 0; s->pass && i < s->pass->kernel->slot_count; i++) {
        const struct rg_slot_info *slot = &s->pass->kernel->slots[i];
        if (s->slots[slot->slot]->buf == buf && slot->words)
            return slot->words;
    }
    return NULL;
}

const char *rg_asset_words(const struct rg_instance *instance, const struct rg_opened_stage *by,
                           const struct rg_asset *asset)
{
    const char *words = by && asset->buf ? words_of(by, asset->buf) : NULL;
    for (int i = 0; !words && asset->buf && i < instance->stage_count; i++)
        words = words_of(&instance->stages[i], asset->buf);
    return words;
}
