#include "backends/gl/api/fixed/fixed.h"

#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/base/log.h"

// Whether all calls since the last check succeeded; if not, logs one line with the feature.
static bool check(const struct gl_fixed_job *draw, const char *call)
{
    return gl_check(draw->device, call, "feature", draw->feature);
}

// --- the context ---

static struct gl_fixed *open_context(struct gl_device *device)
{
    struct gl_fixed *fixed = rg_alloc(1, sizeof(*fixed), "context");
    if (!fixed)
        return NULL;
    if (!gl_egl_beside(device, &fixed->own.egl)) {
        free(fixed);
        return NULL;
    }
    fixed->own.pub = device->pub;
    fixed->own.labels = device->labels;
    gl_debug_begin(&fixed->own);
    gl_images_begin();
    return device->fixed = fixed;
}

void gl_fixed_close(struct gl_device *device)
{
    if (device->fixed)
        gl_egl_close(&device->fixed->own.egl);
    free(device->fixed);
    device->fixed = NULL;
}

static const char *lacked(const struct rg_fixed_state *state)
{
    const bool is_newer = epoxy_gl_version() >= 46;
    if ((state->texels == RG_FIXED_TEXELS_BC1 || state->texels == RG_FIXED_TEXELS_BC3) &&
        !epoxy_has_gl_extension("GL_EXT_texture_compression_s3tc"))
        return "GL_EXT_texture_compression_s3tc";
    if (state->anisotropy && !is_newer &&
        !epoxy_has_gl_extension("GL_EXT_texture_filter_anisotropic"))
        return "GL_EXT_texture_filter_anisotropic";
    if (state->queries && !is_newer && !epoxy_has_gl_extension("GL_ARB_pipeline_statistics_query"))
        return "GL_ARB_pipeline_statistics_query";
    return NULL;
}

// --- buffers ---

static void fill(struct gl_fixed_job *draw, enum gl_fixed_buffer buffer, const void *data,
                 size_t size)
{
    glNamedBufferStorage(draw->buffers[buffer], (GLsizeiptr)size, data, 0);
    if (!data)
        glClearNamedBufferData(draw->buffers[buffer], GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT,
                               NULL);
}

static void make_buffers(struct gl_fixed_job *draw)
{
    const struct rg_fixed_state *state = draw->state;
    const struct rg_fixed_vertices *v = &draw->vertices;
    const struct rg_fixed_params params = {state->nudge, state->shift, state->value, 0};
    const struct rg_fixed_arguments arguments = rg_fixed_arguments(state, v);
    glCreateBuffers(GL_FIXED_BUFFERS, draw->buffers);
    fill(draw, GL_FIXED_PARAMS, &params, sizeof(params));
    fill(draw, GL_FIXED_VERTICES, v->vertices, sizeof(v->vertices));
    fill(draw, GL_FIXED_FORMATS, v->formats, sizeof(v->formats));
    fill(draw, GL_FIXED_OFFSETS, v->offsets, sizeof(v->offsets));
    fill(draw, GL_FIXED_INDICES, v->indices, sizeof(v->indices));
    fill(draw, GL_FIXED_ARGUMENTS, &arguments, sizeof(arguments));
    fill(draw, GL_FIXED_COUNTS, NULL, RG_FIXED_COUNTS * sizeof(GLuint));
    fill(draw, GL_FIXED_FEEDBACK, NULL, (size_t)3 * RG_FIXED_MAX_VERTICES * RG_FIXED_CAUGHT_BYTES);
    glBindBufferBase(GL_UNIFORM_BUFFER, 0, draw->buffers[GL_FIXED_PARAMS]);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 2, draw->buffers[GL_FIXED_COUNTS]);
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, draw->buffers[GL_FIXED_ARGUMENTS]);
}

struct attribute {
    GLint size;
    GLenum type;
    GLboolean is_normalized;
};

static void add_attribute(GLuint array, int at, int binding, const struct attribute *a,
                          size_t offset)
{
    const GLuint index = (GLuint)at;
    glEnableVertexArrayAttrib(array, index);
    glVertexArrayAttribFormat(array, index, a->size, a->type, a->is_normalized, (GLuint)offset);
    glVertexArrayAttribBinding(array, index, (GLuint)binding);
}

static void make_array(struct gl_fixed_job *draw)
{
    static const struct attribute floats = {4, GL_FLOAT, GL_FALSE};
    static const struct attribute formats[RG_FIXED_FORMATS] = {
        {4, GL_UNSIGNED_BYTE, GL_TRUE},  {4, GL_BYTE, GL_TRUE},
        {4, GL_UNSIGNED_SHORT, GL_TRUE}, {4, GL_SHORT, GL_TRUE},
        {4, GL_HALF_FLOAT, GL_FALSE},    {4, GL_UNSIGNED_INT_2_10_10_10_REV, GL_TRUE}};
    GLuint *array = &draw->vertex_array;
    glCreateVertexArrays(1, array);
    for (int i = 0; i < RG_FIXED_OFFSETS_AT; i++)
        add_attribute(*array, i, 0, &floats, (size_t)i * 4 * sizeof(float));
    add_attribute(*array, RG_FIXED_OFFSETS_AT, 1, &floats, 0);
    for (int i = 0; i < RG_FIXED_FORMATS; i++)
        add_attribute(*array, RG_FIXED_FORMATS_AT + i, 2, &formats[i],
                      (size_t)rg_fixed_format_offsets[i]);
    glVertexArrayVertexBuffer(*array, 0, draw->buffers[GL_FIXED_VERTICES], 0,
                              sizeof(struct rg_fixed_vertex));
    glVertexArrayVertexBuffer(*array, 1, draw->buffers[GL_FIXED_OFFSETS], 0, 4 * sizeof(float));
    glVertexArrayVertexBuffer(*array, 2, draw->buffers[GL_FIXED_FORMATS], 0,
                              RG_FIXED_FORMATS_STRIDE);
    glVertexArrayBindingDivisor(*array, 1, 1);
    glVertexArrayElementBuffer(*array, draw->buffers[GL_FIXED_INDICES]);
    glBindVertexArray(*array);
}

// --- drawing ---

static const GLenum query_targets[GL_FIXED_QUERIES] = {
    GL_SAMPLES_PASSED, GL_VERTICES_SUBMITTED_ARB, GL_PRIMITIVES_SUBMITTED_ARB,
    GL_CLIPPING_INPUT_PRIMITIVES_ARB, GL_CLIPPING_OUTPUT_PRIMITIVES_ARB};

static void call(const struct gl_fixed_job *draw)
{
    static const GLenum modes[] = {GL_TRIANGLES, GL_TRIANGLE_STRIP, GL_LINES, GL_POINTS,
                                   GL_PATCHES};
    const struct rg_fixed_state *state = draw->state;
    const struct rg_fixed_arguments a = rg_fixed_arguments(state, &draw->vertices);
    const GLenum mode = modes[state->topology];
    if (state->indexed && state->indirect)
        glDrawElementsIndirect(mode, GL_UNSIGNED_SHORT, NULL);
    else if (state->indexed)
        glDrawElementsInstancedBaseVertexBaseInstance(mode, (GLsizei)a.count, GL_UNSIGNED_SHORT,
                                                      NULL, (GLsizei)a.instances, a.base_vertex,
                                                      a.first_instance);
    else
        glDrawArraysInstancedBaseInstance(mode, 0, (GLsizei)a.count, (GLsizei)a.instances,
                                          a.first_instance);
}

static void render(struct gl_fixed_job *draw)
{
    const struct rg_fixed_state *state = draw->state;
    for (int i = 0; state->queries && i < GL_FIXED_QUERIES; i++) {
        glGenQueries(1, &draw->queries[i]); // Mesa's glCreateQueries knows no statistics
        glBeginQuery(query_targets[i], draw->queries[i]);
    }
    if (state->feedback) {
        glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, draw->buffers[GL_FIXED_FEEDBACK]);
        glBeginTransformFeedback(GL_TRIANGLES);
    }
    call(draw);
    if (state->feedback)
        glEndTransformFeedback();
    for (int i = 0; state->queries && i < GL_FIXED_QUERIES; i++)
        glEndQuery(query_targets[i]);
    glMemoryBarrier(GL_ALL_BARRIER_BITS);
}

static void release(struct gl_fixed_job *draw)
{
    glUseProgram(0);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glDeleteProgram(draw->program);
    glDeleteVertexArrays(1, &draw->vertex_array);
    glDeleteBuffers(GL_FIXED_BUFFERS, draw->buffers);
    glDeleteTextures(1, &draw->texture);
    glDeleteSamplers(1, &draw->sampler);
    glDeleteTextures(RG_FIXED_STORES, draw->stores);
    glDeleteTextures(RG_FIXED_EQUATIONS, draw->colours);
    glDeleteTextures(1, &draw->depth);
    glDeleteTextures(1, &draw->copied);
    glDeleteFramebuffers(1, &draw->framebuffer);
    glDeleteFramebuffers(1, &draw->copy);
    glDeleteQueries(GL_FIXED_QUERIES, draw->queries);
}

static bool execute(struct gl_fixed_job *draw)
{
    rg_fixed_make_vertices(draw->state, &draw->vertices);
    if (!gl_fixed_program(draw))
        return false;
    gl_label(GL_PROGRAM, draw->program, draw->feature);
    make_buffers(draw);
    make_array(draw);
    if (draw->state->texels) {
        gl_fixed_texture(draw);
        gl_label(GL_TEXTURE, draw->texture, draw->feature);
    }
    gl_fixed_targets(draw);
    gl_fixed_state(draw->state);
    glUseProgram(draw->program);
    render(draw);
    return check(draw, "a draw") && gl_fixed_read(draw) && check(draw, "glGetTextureImage");
}

bool gl_fixed_draw(struct rg_device *device, const char *feature,
                   const struct rg_fixed_state *state, struct rg_fixed_picture *picture)
{
    struct gl_device *gl = (struct gl_device *)device;
    struct gl_fixed *fixed = gl->fixed ? gl->fixed : open_context(gl);
    if (!fixed || !gl_use(&fixed->own))
        return false;
    const char *lack = lacked(state);
    if (lack)
        return rg_fixed_lacks(picture, lack);
    struct gl_fixed_job *draw = rg_alloc(1, sizeof(*draw), feature);
    if (!draw)
        return false;
    *draw = (struct gl_fixed_job){
        .device = &fixed->own, .state = state, .feature = feature, .picture = picture};
    gl_group_begin(&fixed->own, feature);
    const bool ok = execute(draw);
    gl_group_end(&fixed->own);
    release(draw);
    free(draw);
    return ok;
}
