#include "backends/gl/api/fixed/fixed.h"

struct texels {
    GLenum internal, format, type; // no format: compressed
};

static struct texels texels_of(int texels)
{
    static const struct texels all[] = {
        [RG_FIXED_TEXELS_RGBA8] = {GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE},
        [RG_FIXED_TEXELS_SRGB8] = {GL_SRGB8_ALPHA8, GL_RGBA, GL_UNSIGNED_BYTE},
        [RG_FIXED_TEXELS_D32F] = {GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT},
        [RG_FIXED_TEXELS_BC1] = {GL_COMPRESSED_RGBA_S3TC_DXT1_EXT, 0, 0},
        [RG_FIXED_TEXELS_BC3] = {GL_COMPRESSED_RGBA_S3TC_DXT5_EXT, 0, 0},
        [RG_FIXED_TEXELS_ETC2] = {GL_COMPRESSED_RGB8_ETC2, 0, 0},
    };
    return all[texels];
}

static void write(GLuint texture, const struct rg_fixed_state *state, int layer, int level)
{
    uint8_t bytes[RG_FIXED_LEVEL_BYTES];
    const struct texels t = texels_of(state->texels);
    const GLsizei px = RG_FIXED_TEXTURE_PX >> level;
    const GLsizei size = (GLsizei)rg_fixed_make_texels(state, layer, level, bytes);
    if (!t.format)
        glCompressedTextureSubImage2D(texture, level, 0, 0, px, px, t.internal, size, bytes);
    else if (state->texture == RG_FIXED_2D)
        glTextureSubImage2D(texture, level, 0, 0, px, px, t.format, t.type, bytes);
    else
        glTextureSubImage3D(texture, level, 0, 0, layer, px, px, 1, t.format, t.type, bytes);
}

static GLenum min_filter(const struct rg_fixed_state *state)
{
    static const GLenum filters[2][3] = {
        {GL_NEAREST, GL_NEAREST_MIPMAP_NEAREST, GL_NEAREST_MIPMAP_LINEAR},
        {GL_LINEAR, GL_LINEAR_MIPMAP_NEAREST, GL_LINEAR_MIPMAP_LINEAR}};
    return filters[state->min][state->mip];
}

static GLuint make_sampler(const struct rg_fixed_state *state)
{
    static const GLint wraps[] = {GL_REPEAT, GL_MIRRORED_REPEAT, GL_CLAMP_TO_EDGE,
                                  GL_CLAMP_TO_BORDER};
    static const float borders[][4] = {{0, 0, 0, 0}, {0, 0, 0, 1}, {1, 1, 1, 1}};
    GLuint sampler;
    glCreateSamplers(1, &sampler);
    glSamplerParameteri(sampler, GL_TEXTURE_MAG_FILTER, state->mag ? GL_LINEAR : GL_NEAREST);
    glSamplerParameteri(sampler, GL_TEXTURE_MIN_FILTER, (GLint)min_filter(state));
    glSamplerParameteri(sampler, GL_TEXTURE_WRAP_S, wraps[state->wrap_u]);
    glSamplerParameteri(sampler, GL_TEXTURE_WRAP_T, wraps[state->wrap_v]);
    glSamplerParameterfv(sampler, GL_TEXTURE_BORDER_COLOR, borders[state->border]);
    glSamplerParameterf(sampler, GL_TEXTURE_LOD_BIAS, (float)state->bias_16 / 16);
    if (state->lod_most_16) {
        glSamplerParameterf(sampler, GL_TEXTURE_MIN_LOD, (float)state->lod_least_16 / 16);
        glSamplerParameterf(sampler, GL_TEXTURE_MAX_LOD, (float)state->lod_most_16 / 16);
    }
    if (state->anisotropy)
        glSamplerParameterf(sampler, GL_TEXTURE_MAX_ANISOTROPY_EXT, (float)state->anisotropy);
    if (state->compare) {
        glSamplerParameteri(sampler, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
        glSamplerParameteri(sampler, GL_TEXTURE_COMPARE_FUNC,
                            (GLint)gl_fixed_compare(state->compare));
    }
    return sampler;
}

void gl_fixed_texture(struct gl_fixed_job *draw)
{
    static const GLenum kinds[] = {GL_TEXTURE_2D, GL_TEXTURE_2D_ARRAY, GL_TEXTURE_CUBE_MAP};
    const struct rg_fixed_state *state = draw->state;
    const int layers = rg_fixed_layers(state), levels = rg_fixed_levels(state);
    const GLenum internal = texels_of(state->texels).internal;
    glCreateTextures(kinds[state->texture], 1, &draw->texture);
    if (state->texture == RG_FIXED_ARRAY)
        glTextureStorage3D(draw->texture, levels, internal, RG_FIXED_TEXTURE_PX,
                           RG_FIXED_TEXTURE_PX, layers);
    else
        glTextureStorage2D(draw->texture, levels, internal, RG_FIXED_TEXTURE_PX,
                           RG_FIXED_TEXTURE_PX);
    for (int layer = 0; layer < layers; layer++)
        for (int level = 0; level < levels; level++)
            write(draw->texture, state, layer, level);
    draw->sampler = make_sampler(state);
    glBindTextureUnit(1, draw->texture);
    glBindSampler(1, draw->sampler);
}
