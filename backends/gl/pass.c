#include "backends/gl/gl.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/base/log.h"

// The barriers that make a kernel's writes visible to later passes, writes and reads.
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
    if (!gl_use(gl))
        return NULL;
    struct gl_pass *pass = rg_alloc(1, sizeof(*pass), kernel->name);
    if (!pass)
        return NULL;
    pass->program = gl_program_create(gl, kernel, rg_device_ways(device, kernel));
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
    if (gl_use(gl)) {
        if (gl->bound.program == mine->program || gl->bound.program == mine->blending)
            gl_bind_program(&gl->bound, 0);
        glDeleteProgram(mine->program);
        glDeleteProgram(mine->blending);
    }
    free(mine);
}

// Drops the parts of Mesa's code that differ between processes, so that the same code has the same
// bytes. Mesa names a shader by the number of its program object ("GLSL168"), which a cache may
// have from another process, and pads the name with zeros. Its head has the size and a checksum of
// all of it. Returns how many bytes are left.
static size_t drop_numbers(unsigned char *bytes, size_t size)
{
    enum { HEAD = 24, COUNTED = 32, NAME = 4 }; // count and checksum lie between the first two
    size_t kept = 0;
    for (size_t i = 0; i < size; i++) {
        const bool is_name = i + NAME < size && !memcmp(bytes + i, "GLSL", NAME);
        for (size_t d = i + NAME; d < size && is_name && isdigit(bytes[d]); d++)
            bytes[d] = 0;
        if ((i < HEAD || i >= COUNTED) && bytes[i])
            bytes[kept++] = bytes[i];
    }
    return kept;
}

bool gl_pass_code(struct rg_pass *pass, void **bytes, size_t *size)
{
    const struct gl_pass *mine = (const struct gl_pass *)pass;
    struct gl_device *gl = (struct gl_device *)pass->device;
    GLint length = 0;
    GLenum format;
    *bytes = NULL;
    if (!gl_use(gl))
        return false;
    glGetProgramiv(mine->program, GL_PROGRAM_BINARY_LENGTH, &length);
    if (length > 0)
        *bytes = malloc((size_t)length);
    if (length > 0 && !*bytes)
        return rg_harness_error("kernel '%s': no memory for its program", pass->kernel->name);
    if (*bytes)
        glGetProgramBinary(mine->program, length, &length, &format, *bytes);
    *size = *bytes ? drop_numbers(*bytes, (size_t)length) : 0;
    return gl_check(gl, "glGetProgramBinary", "kernel", pass->kernel->name);
}

// The program that a run takes: one that blends by itself is made for the first draw that blends,
// as is one for such draws of a native device whose driver shall not blend. 0, and one logged line,
// on failure.
static GLuint program_of(struct gl_device *gl, struct gl_pass *mine, const struct rg_run *run)
{
    const struct rg_kernel *kernel = mine->pub.kernel;
    const unsigned own = rg_device_ways(&gl->pub, kernel);
    unsigned ways = rg_ways_of(&gl->pub, kernel, rg_run_features(&gl->pub, run->draw));
    if (gl->pub.blends && run->draw && run->draw->blend != RG_BLEND_OFF)
        ways |= RG_CODE_BLENDS;
    if (ways == own)
        return mine->program;
    if (!mine->blending)
        mine->blending = gl_program_create(gl, kernel, ways);
    return mine->blending;
}

static bool run_pass(struct gl_device *gl, struct gl_pass *mine, const struct rg_run *run)
{
    const struct rg_kernel *kernel = mine->pub.kernel;
    if (!gl_params_bind(gl, mine, run))
        return false;
    const GLuint program = program_of(gl, mine, run);
    if (!program)
        return false;
    gl_bind_program(&gl->bound, program);
    if (!gl_slots_bind(&gl->bound, mine, run))
        return false;
    if (run->draw)
        return gl_draw(gl, kernel, run);
    const int64_t columns = ((int64_t)run->extent.width + GL_GROUP_ITEMS - 1) / GL_GROUP_ITEMS;
    glDispatchCompute((GLuint)columns, (GLuint)run->extent.height, (GLuint)run->extent.depth);
    glMemoryBarrier(mine->after_runs);
    return gl_check_reported(gl, "glDispatchCompute", "kernel", kernel->name);
}

bool gl_pass_run(struct rg_pass *pass, const struct rg_run *run)
{
    struct gl_device *gl = (struct gl_device *)pass->device;
    if (!gl_use(gl))
        return false;
    gl_group_begin(gl, pass->kernel->name);
    const bool ok = run_pass(gl, (struct gl_pass *)pass, run);
    gl_group_end(gl);
    return ok;
}
