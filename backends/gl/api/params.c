#include "backends/gl/gl.h"

#include <string.h>

enum { HALF_BYTES = 64 * 1024 };

// The head of the uniform block in shaders/grid.glsl and draw.*; the kernel's parameters follow.
struct block_head {
    int32_t origin[4], end[4];
};

bool gl_params_create(struct gl_device *device)
{
    const GLbitfield access = GL_MAP_WRITE_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
    struct gl_params *params = &device->params;
    GLint alignment = 256;
    glGetIntegerv(GL_UNIFORM_BUFFER_OFFSET_ALIGNMENT, &alignment);
    params->alignment = (size_t)alignment;
    glCreateBuffers(1, &params->buffer);
    gl_label(GL_BUFFER, params->buffer, "parameters");
    glNamedBufferStorage(params->buffer, 2 * HALF_BYTES, NULL, access);
    params->memory = glMapNamedBufferRange(params->buffer, 0, 2 * HALF_BYTES, access);
    return gl_check(device, "glMapNamedBufferRange", "buffer", "parameters");
}

void gl_params_destroy(struct gl_device *device)
{
    for (int half = 0; half < 2; half++)
        glDeleteSync(device->params.read[half]);
    glDeleteBuffers(1, &device->params.buffer);
}

// Switches to the other half, after the runs that read it have ended.
static bool turn(struct gl_device *device)
{
    struct gl_params *params = &device->params;
    params->read[params->half] = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    params->half = !params->half;
    params->next = (size_t)params->half * HALF_BYTES;
    GLsync *read = &params->read[params->half];
    if (!*read)
        return true;
    glClientWaitSync(*read, GL_SYNC_FLUSH_COMMANDS_BIT, GL_TIMEOUT_IGNORED);
    glDeleteSync(*read);
    *read = NULL;
    return gl_check(device, "glClientWaitSync", "buffer", "parameters");
}

bool gl_params_bind(struct gl_device *device, const struct gl_pass *pass, const struct rg_run *run)
{
    struct gl_params *params = &device->params;
    const size_t half_end = ((size_t)params->half + 1) * HALF_BYTES;
    if (params->next + pass->block_size > half_end && !turn(device))
        return false;
    const struct block_head head = {
        {run->origin.width, run->origin.height, run->origin.depth, 0},
        {run->origin.width + run->extent.width, run->origin.height + run->extent.height,
         run->origin.depth + run->extent.depth, 0},
    };
    unsigned char *block = params->memory + params->next;
    memcpy(block, &head, sizeof(head));
    memcpy(block + sizeof(head), run->params, pass->params_size);
    glBindBufferRange(GL_UNIFORM_BUFFER, 0, params->buffer, (GLintptr)params->next,
                      (GLsizeiptr)pass->block_size);
    const size_t aligned = (pass->block_size + params->alignment - 1) / params->alignment;
    params->next += aligned * params->alignment;
    return true;
}
