// The context's current bindings, so that equal ones cost no call.
#include "backends/gl/gl.h"

void gl_bind_program(struct gl_bound *bound, GLuint id)
{
    if (bound->program != id)
        glUseProgram(id);
    bound->program = id;
}

void gl_bind_buffer(struct gl_bound *bound, int slot, GLuint id)
{
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

void gl_bind_image(struct gl_bound *bound, int slot, GLuint id, GLenum format)
{
    if (bound->images[slot] != id)
        glBindImageTexture((GLuint)slot, id, 0, GL_TRUE, 0, GL_WRITE_ONLY, format);
    bound->images[slot] = id;
}

void gl_bind_framebuffer(struct gl_bound *bound, GLuint id)
{
    if (bound->framebuffer != id)
        glBindFramebuffer(GL_DRAW_FRAMEBUFFER, id);
    bound->framebuffer = id;
}

void gl_bind_arguments(struct gl_bound *bound, GLuint id)
{
    if (bound->arguments != id)
        glBindBuffer(GL_DRAW_INDIRECT_BUFFER, id);
    bound->arguments = id;
}

void gl_forget_buffer(struct gl_bound *bound, GLuint id)
{
    for (int slot = 0; slot < RG_MAX_SLOTS; slot++)
        if (bound->buffers[slot] == id)
            bound->buffers[slot] = 0;
    if (bound->arguments == id)
        bound->arguments = 0;
}

void gl_forget_texture(struct gl_bound *bound, GLuint id)
{
    for (int slot = 0; slot < RG_MAX_SLOTS; slot++) {
        if (bound->textures[slot] == id)
            bound->textures[slot] = 0;
        if (bound->images[slot] == id)
            bound->images[slot] = 0;
    }
}

void gl_forget_framebuffer(struct gl_bound *bound, GLuint id)
{
    if (bound->framebuffer == id)
        bound->framebuffer = 0;
}
