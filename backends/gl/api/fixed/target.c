// The images that draws of fixed functions go to, and what is read of them.
#include "backends/gl/api/fixed/fixed.h"

#include "core/base/log.h"
#include "shaders/fixed/bounds/bounds.h"

static const struct gl_format formats[RG_FIXED_FORMAT_COUNT] = {
    {GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE},
    {GL_RGBA16F, GL_RGBA, GL_HALF_FLOAT},
    {GL_RGBA32F, GL_RGBA, GL_FLOAT}};
static const size_t texel_bytes[RG_FIXED_FORMAT_COUNT] = {4, 8, 16};

static const GLenum depths[] = {0, GL_DEPTH_COMPONENT16, GL_DEPTH_COMPONENT32F,
                                GL_DEPTH32F_STENCIL8};

static const struct gl_format stores[RG_FIXED_STORES] = {
    {GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE},
    {GL_RGBA16F, GL_RGBA, GL_HALF_FLOAT},
    {GL_RGB10_A2, GL_RGBA, GL_UNSIGNED_INT_2_10_10_10_REV},
    {GL_R11F_G11F_B10F, GL_RGB, GL_UNSIGNED_INT_10F_11F_11F_REV}};
static const size_t store_bytes[RG_FIXED_STORES] = {4, 8, 4, 4};

// --- making ---

static GLuint make_image(const struct rg_fixed_state *state, GLenum internal)
{
    const GLsizei px = RG_FIXED_PX;
    GLuint image;
    glCreateTextures(state->samples  ? GL_TEXTURE_2D_MULTISAMPLE
                     : state->layers ? GL_TEXTURE_2D_ARRAY
                                     : GL_TEXTURE_2D,
                     1, &image);
    if (state->samples)
        glTextureStorage2DMultisample(image, RG_FIXED_SAMPLES, internal, px, px, GL_TRUE);
    else if (state->layers)
        glTextureStorage3D(image, 1, internal, px, px, state->layers);
    else
        glTextureStorage2D(image, 1, internal, px, px);
    return image;
}

static void clear(const struct gl_fixed_job *draw)
{
    glDisable(GL_SCISSOR_TEST);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    for (int i = 0; i <= draw->state->more_targets; i++)
        glClearNamedFramebufferfv(draw->framebuffer, GL_COLOR, i, rg_fixed_before);
    if (draw->state->depth == RG_FIXED_D32F_S8)
        glClearNamedFramebufferfi(draw->framebuffer, GL_DEPTH_STENCIL, 0, 1, 0);
    else if (draw->state->depth)
        glClearNamedFramebufferfv(draw->framebuffer, GL_DEPTH, 0, &(float){1});
}

static void make_copy(struct gl_fixed_job *draw)
{
    const GLsizei px = draw->state->blit ? RG_FIXED_BLIT_PX : RG_FIXED_PX;
    glCreateTextures(GL_TEXTURE_2D, 1, &draw->copied);
    glTextureStorage2D(draw->copied, 1, formats[draw->state->format].internal, px, px);
    glCreateFramebuffers(1, &draw->copy);
    glNamedFramebufferTexture(draw->copy, GL_COLOR_ATTACHMENT0, draw->copied, 0);
}

static void make_stores(struct gl_fixed_job *draw)
{
    glCreateTextures(GL_TEXTURE_2D, RG_FIXED_STORES, draw->stores);
    for (GLuint i = 0; i < RG_FIXED_STORES; i++) {
        glTextureStorage2D(draw->stores[i], 1, stores[i].internal, RG_FIXED_PX, RG_FIXED_PX);
        glClearTexImage(draw->stores[i], 0, stores[i].format, stores[i].type, NULL);
        glBindImageTexture(3 + i, draw->stores[i], 0, GL_FALSE, 0, GL_WRITE_ONLY,
                           stores[i].internal);
    }
}

void gl_fixed_targets(struct gl_fixed_job *draw)
{
    const struct rg_fixed_state *state = draw->state;
    GLenum targets[RG_FIXED_EQUATIONS];
    glCreateFramebuffers(1, &draw->framebuffer);
    for (GLuint i = 0; i <= (GLuint)state->more_targets; i++) {
        targets[i] = GL_COLOR_ATTACHMENT0 + i;
        draw->colours[i] = make_image(state, formats[state->format].internal);
        glNamedFramebufferTexture(draw->framebuffer, targets[i], draw->colours[i], 0);
    }
    glNamedFramebufferDrawBuffers(draw->framebuffer, state->more_targets + 1, targets);
    if (state->depth) {
        draw->depth = make_image(state, depths[state->depth]);
        glNamedFramebufferTexture(draw->framebuffer,
                                  state->depth == RG_FIXED_D32F_S8 ? GL_DEPTH_STENCIL_ATTACHMENT
                                                                   : GL_DEPTH_ATTACHMENT,
                                  draw->depth, 0);
    }
    if (state->samples || state->blit)
        make_copy(draw);
    if (state->stores)
        make_stores(draw);
    clear(draw);
    glBindFramebuffer(GL_FRAMEBUFFER, draw->framebuffer);
}

// --- reading ---

static bool read_image(struct gl_fixed_job *draw, GLuint image, const struct gl_format *format,
                       int texels, size_t texel)
{
    const size_t size = (size_t)texels * texel;
    void *part = rg_fixed_part(draw->picture, size);
    if (!part)
        return rg_harness_error("feature '%s': no room for its picture", draw->feature);
    glGetTextureImage(image, 0, format->format, format->type, (GLsizei)size, part);
    rg_fixed_look(draw->picture, size, texel);
    return true;
}

static bool read_pixels(struct gl_fixed_job *draw, GLenum format, GLenum type, size_t texel)
{
    const size_t size = RG_FIXED_PX * RG_FIXED_PX * texel;
    void *part = rg_fixed_part(draw->picture, size);
    if (!part)
        return rg_harness_error("feature '%s': no room for its picture", draw->feature);
    glReadPixels(0, 0, RG_FIXED_PX, RG_FIXED_PX, format, type, part);
    rg_fixed_look(draw->picture, size, texel);
    return true;
}

static bool read_depth(struct gl_fixed_job *draw)
{
    const int depth = draw->state->depth;
    const bool is_short = depth == RG_FIXED_D16;
    return read_pixels(draw, GL_DEPTH_COMPONENT, is_short ? GL_UNSIGNED_SHORT : GL_FLOAT,
                       is_short ? 2 : 4) &&
           (depth != RG_FIXED_D32F_S8 || read_pixels(draw, GL_STENCIL_INDEX, GL_UNSIGNED_BYTE, 1));
}

static bool read_colours(struct gl_fixed_job *draw)
{
    const struct rg_fixed_state *state = draw->state;
    const struct gl_format *format = &formats[state->format];
    const int px = state->blit ? RG_FIXED_BLIT_PX : RG_FIXED_PX;
    bool ok = true;
    if (draw->copy) {
        glBlitNamedFramebuffer(draw->framebuffer, draw->copy, 0, 0, RG_FIXED_PX, RG_FIXED_PX, 0, 0,
                               px, px, GL_COLOR_BUFFER_BIT,
                               state->blit == 1 + RG_FIXED_LINEAR ? GL_LINEAR : GL_NEAREST);
        return read_image(draw, draw->copied, format, px * px, texel_bytes[state->format]);
    }
    for (int i = 0; ok && i <= state->more_targets; i++)
        ok = read_image(draw, draw->colours[i], format,
                        px * px * (state->layers ? state->layers : 1), texel_bytes[state->format]);
    return ok;
}

static bool read_buffer(struct gl_fixed_job *draw, enum gl_fixed_buffer buffer, size_t size,
                        size_t texel)
{
    void *part = rg_fixed_part(draw->picture, size);
    if (!part)
        return rg_harness_error("feature '%s': no room for its picture", draw->feature);
    glGetNamedBufferSubData(draw->buffers[buffer], 0, (GLsizeiptr)size, part);
    rg_fixed_look(draw->picture, size, texel);
    return true;
}

static bool read_queries(struct gl_fixed_job *draw)
{
    for (int i = 0; i < GL_FIXED_QUERIES; i++) {
        GLuint64 *part = rg_fixed_part(draw->picture, sizeof(*part));
        if (!part)
            return rg_harness_error("feature '%s': no room for its picture", draw->feature);
        glGetQueryObjectui64v(draw->queries[i], GL_QUERY_RESULT, part);
        draw->picture->is_constant = draw->picture->is_constant || !*part;
    }
    return true;
}

// OpenGL says nothing about texels and levels, so that the least holds which Vulkan demands.
static void note_precision(const struct gl_fixed_job *draw)
{
    struct rg_fixed_precision *precision = &draw->picture->precision;
    *precision = rg_fixed_precision_least;
    precision->is_opengl = true;
    glGetIntegerv(GL_SUBPIXEL_BITS, &precision->subpixel_bits);
    GLint samples = 0; // which may be more than asked for
    glGetIntegerv(GL_SAMPLES, &samples);
    precision->has_places = !draw->state->samples || samples == RG_FIXED_SAMPLES;
    for (GLuint i = 0; i < RG_FIXED_SAMPLES && draw->state->samples; i++) {
        GLfloat place[2];
        glGetMultisamplefv(GL_SAMPLE_POSITION, i, place);
        for (int c = 0; c < 2; c++)
            precision->places[i][c] = (double)place[c];
    }
}

bool gl_fixed_read(struct gl_fixed_job *draw)
{
    note_precision(draw);
    const struct rg_fixed_state *state = draw->state;
    bool ok = read_colours(draw) && (!state->depth || read_depth(draw));
    for (int i = 0; ok && i < RG_FIXED_STORES && state->stores; i++)
        ok = read_image(draw, draw->stores[i], &stores[i], RG_FIXED_PX * RG_FIXED_PX,
                        store_bytes[i]);
    return ok &&
           (!state->counts ||
            read_buffer(draw, GL_FIXED_COUNTS, RG_FIXED_COUNTS * sizeof(GLuint), sizeof(GLuint))) &&
           (!state->feedback ||
            read_buffer(draw, GL_FIXED_FEEDBACK, 3 * RG_FIXED_MAX_VERTICES * RG_FIXED_CAUGHT_BYTES,
                        RG_FIXED_CAUGHT_BYTES)) &&
           (!state->queries || read_queries(draw));
}
