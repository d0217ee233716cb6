#include "backends/gl/gl.h"

static bool is_image(enum rg_slot_kind kind)
{
    return kind == RG_SLOT_IMAGE || kind == RG_SLOT_OUT_IMAGE;
}

static bool bind_image(struct gl_bound *bound, bool sampled, const struct rg_slot_info *slot,
                       struct rg_image *image)
{
    const bool samples = sampled && slot->sampler != RG_TEXELS;
    const GLuint id =
        samples ? gl_image_view(image, slot->sampler) : ((const struct gl_image *)image)->id;
    if (slot->kind == RG_SLOT_IMAGE)
        gl_bind_texture(bound, slot->slot, id);
    else
        gl_bind_image(bound, slot->slot, id, gl_format(slot->format).internal);
    return id != 0;
}

void gl_slot_buffer(struct gl_bound *bound, int slot, const struct rg_buf *buf)
{
    gl_bind_buffer(bound, slot, ((const struct gl_buf *)buf)->id);
}

bool gl_slot_words(struct gl_bound *bound, int slot, struct rg_buf *buf)
{
    const GLuint words = gl_buf_words(buf);
    if (words)
        gl_bind_texture(bound, slot, words);
    return words != 0;
}

bool gl_slots_bind(struct gl_bound *bound, const struct gl_pass *pass, const struct rg_run *run)
{
    const struct rg_kernel *kernel = pass->pub.kernel;
    const bool sampled = rg_run_features(pass->pub.device, run->draw) & RG_FEATURE_SAMPLERS;
    for (int i = 0; i < kernel->slot_count; i++) {
        const struct rg_slot_info *slot = &kernel->slots[i];
        const struct rg_binding *binding = &run->slots[slot->slot];
        if (run->draw && slot->kind == RG_SLOT_OUT_IMAGE) // the target
            continue;
        if (is_image(slot->kind) && !bind_image(bound, sampled, slot, binding->image))
            return false;
        if (is_image(slot->kind))
            continue;
        if (!(pass->word_slots >> slot->slot & 1))
            gl_slot_buffer(bound, slot->slot, binding->buf);
        else if (!gl_slot_words(bound, slot->slot, binding->buf))
            return false;
    }
    return true;
}
