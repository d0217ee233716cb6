#include "backends/gl/gl.h"

#include <stdlib.h>

#include "core/base/alloc.h"
#include "core/base/log.h"

static bool is_image(enum rg_slot_kind kind)
{
    return kind == RG_SLOT_IMAGE || kind == RG_SLOT_OUT_IMAGE;
}

// A slot is the binding of the same number, which the driver must have.
static bool slots_fit(const struct gl_device *device, const struct rg_kernel *kernel)
{
    if (kernel->draw && device->slots.buffers <= RG_SLOT_SAMPLES)
        return rg_error("kernel '%s': drawing needs storage buffer binding %d, and %s has %d",
                        kernel->name, RG_SLOT_SAMPLES, device->pub.info.name,
                        device->slots.buffers);
    for (int i = 0; i < kernel->slot_count; i++) {
        const struct rg_slot_info *slot = &kernel->slots[i];
        int limit = slot->kind == RG_SLOT_OUT_IMAGE ? device->slots.image_units
                    : slot->kind == RG_SLOT_IMAGE   ? device->slots.texture_units
                                                    : device->slots.buffers;
        if (slot->slot >= limit)
            return rg_error("kernel '%s': slot %d, '%s', is beyond the %d %s that %s has",
                            kernel->name, slot->slot, slot->name, limit,
                            slot->kind == RG_SLOT_OUT_IMAGE ? "image units"
                            : slot->kind == RG_SLOT_IMAGE   ? "texture units"
                                                            : "storage buffer bindings",
                            device->pub.info.name);
    }
    return true;
}

// The barriers that show a kernel's writes to whatever comes next: other passes, writes, reads.
static GLbitfield barriers_after(const struct rg_kernel *kernel)
{
    GLbitfield barriers = 0;
    for (int i = 0; i < kernel->slot_count; i++) {
        enum rg_slot_kind kind = kernel->slots[i].kind;
        if (kind == RG_SLOT_OUT_IMAGE)
            barriers |= GL_SHADER_IMAGE_ACCESS_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT |
                        GL_TEXTURE_UPDATE_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT;
        else if (kind != RG_SLOT_IN && kind != RG_SLOT_IMAGE)
            barriers |= GL_SHADER_STORAGE_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT |
                        GL_BUFFER_UPDATE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT;
    }
    return barriers;
}

struct rg_pass *gl_pass_create(struct rg_device *device, const struct rg_kernel *kernel)
{
    struct gl_device *gl = (struct gl_device *)device;
    if (!slots_fit(gl, kernel) || !gl_use(gl))
        return NULL;
    struct gl_pass *pass = rg_alloc(1, sizeof(*pass), kernel->name);
    if (!pass)
        return NULL;
    pass->program = gl_program_create(gl, kernel);
    if (!pass->program) {
        free(pass);
        return NULL;
    }
    gl_label(GL_PROGRAM, pass->program, kernel->name);
    pass->word_slots = gl_program_word_slots(pass->program, kernel);
    pass->params_size = (size_t)(kernel->draw ? kernel->draw->call_size : kernel->params_size);
    pass->block_size = 32 + (pass->params_size + 15) / 16 * 16; // std140
    pass->after_runs = barriers_after(kernel);
    return &pass->pub;
}

void gl_pass_destroy(struct rg_pass *pass)
{
    struct gl_device *gl = (struct gl_device *)pass->device;
    struct gl_pass *mine = (struct gl_pass *)pass;
    if (gl->bound.program == mine->program)
        gl->bound.program = 0;
    if (gl_use(gl)) {
        if (!gl->bound.program)
            glUseProgram(0);
        glDeleteProgram(mine->program);
    }
    free(mine);
}

static void bind_image(struct gl_bound *bound, const struct rg_slot_info *slot,
                       const struct gl_image *image)
{
    if (slot->kind == RG_SLOT_IMAGE) {
        gl_bind_texture(bound, slot->slot, image->id);
        return;
    }
    if (bound->images[slot->slot] != image->id)
        glBindImageTexture((GLuint)slot->slot, image->id, 0, GL_TRUE, 0, GL_WRITE_ONLY,
                           gl_internal_format(slot->format));
    bound->images[slot->slot] = image->id;
}

static bool bind_slots(struct gl_bound *bound, const struct gl_pass *pass, const struct rg_run *run)
{
    const struct rg_kernel *kernel = pass->pub.kernel;
    for (int i = 0; i < kernel->slot_count; i++) {
        const struct rg_slot_info *slot = &kernel->slots[i];
        const struct rg_binding *binding = &run->slots[slot->slot];
        if (is_image(slot->kind))
            bind_image(bound, slot, (const struct gl_image *)binding->image);
        else if (!(pass->word_slots >> slot->slot & 1))
            gl_bind_buffer(bound, slot->slot, binding->buf);
        else if (!gl_bind_words(bound, slot->slot, binding->buf))
            return false;
    }
    return true;
}

void gl_bind_buffer(struct gl_bound *bound, int slot, const struct rg_buf *buf)
{
    const GLuint id = ((const struct gl_buf *)buf)->id;
    if (bound->buffers[slot] != id)
        glBindBufferBase(GL_SHADER_STORAGE_BUFFER, (GLuint)slot, id);
    bound->buffers[slot] = id;
}

void gl_bind_texture(struct gl_bound *bound, int slot, GLuint id)
{
    if (bound->textures[slot] != id)
        glBindTextureUnit((GLuint)slot, id);
    bound->textures[slot] = id;
}

bool gl_bind_words(struct gl_bound *bound, int slot, struct rg_buf *buf)
{
    const GLuint words = gl_buf_words(buf);
    if (words)
        gl_bind_texture(bound, slot, words);
    return words != 0;
}

bool gl_pass_run(struct rg_pass *pass, const struct rg_run *run)
{
    struct gl_device *gl = (struct gl_device *)pass->device;
    struct gl_pass *mine = (struct gl_pass *)pass;
    if (!gl_use(gl) || !gl_params_bind(gl, mine, run))
        return false;
    if (gl->bound.program != mine->program)
        glUseProgram(mine->program);
    gl->bound.program = mine->program;
    if (!bind_slots(&gl->bound, mine, run))
        return false;
    if (pass->kernel->draw)
        return gl_draw(gl, pass->kernel, run);
    const int64_t columns = ((int64_t)run->extent.width + GL_GROUP_ITEMS - 1) / GL_GROUP_ITEMS;
    glDispatchCompute((GLuint)columns, (GLuint)run->extent.height, (GLuint)run->extent.depth);
    glMemoryBarrier(mine->after_runs);
    return gl_check_reported(gl, "glDispatchCompute", "kernel", pass->kernel->name);
}
