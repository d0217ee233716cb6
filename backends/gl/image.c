#include "backends/gl/gl.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>

#include "core/base/alloc.h"
#include "core/device/formats.h"

// How a format lies in the driver's memory and in ours, where rows are packed tightly
// (gl_images_begin).
static const struct {
    GLenum internal, format, type;
} formats[RG_FORMAT_COUNT] = {
    [RG_RGBA8] = {GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE},
    [RG_RGBA16F] = {GL_RGBA16F, GL_RGBA, GL_HALF_FLOAT},
    [RG_RGBA32F] = {GL_RGBA32F, GL_RGBA, GL_FLOAT},
    [RG_R32F] = {GL_R32F, GL_RED, GL_FLOAT},
    [RG_R16F] = {GL_R16F, GL_RED, GL_HALF_FLOAT},
    [RG_RG11B10F] = {GL_R11F_G11F_B10F, GL_RGB, GL_UNSIGNED_INT_10F_11F_11F_REV},
    [RG_D32F] = {GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT},
};

GLenum gl_internal_format(enum rg_format format)
{
    return formats[format].internal;
}

void gl_images_begin(void)
{
    const GLint smallest_texel = 2; // in bytes; by itself GL expects rows at multiples of 4
    glPixelStorei(GL_UNPACK_ALIGNMENT, smallest_texel);
    glPixelStorei(GL_PACK_ALIGNMENT, smallest_texel);
}

struct rg_image *gl_image_create(struct rg_device *device, const struct rg_image_desc *desc,
                                 const char *name)
{
    struct gl_device *gl = (struct gl_device *)device;
    if (!gl_use(gl))
        return NULL;
    struct gl_image *image = rg_alloc(1, sizeof(*image), name);
    if (!image)
        return NULL;
    glCreateTextures(GL_TEXTURE_2D_ARRAY, 1, &image->id);
    gl_label(GL_TEXTURE, image->id, name);
    glTextureParameteri(image->id, GL_TEXTURE_MIN_FILTER, GL_NEAREST_MIPMAP_NEAREST);
    glTextureParameteri(image->id, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTextureStorage3D(image->id, desc->levels, gl_internal_format(desc->format), desc->width,
                       desc->height, desc->layers);
    // What drivers say of an image that is too large has no numbers.
    char call[128];
    snprintf(call, sizeof(call), "glTextureStorage3D of %dx%d texels of %s, %d layers, %d levels,",
             desc->width, desc->height, rg_format_name(desc->format), desc->layers, desc->levels);
    if (!gl_check(gl, call, "image", name)) {
        glDeleteTextures(1, &image->id);
        free(image);
        return NULL;
    }
    return &image->pub;
}

void gl_texture_forget(struct gl_bound *bound, GLuint id)
{
    for (int slot = 0; slot < RG_MAX_SLOTS; slot++) {
        if (bound->textures[slot] == id)
            bound->textures[slot] = 0;
        if (bound->images[slot] == id)
            bound->images[slot] = 0;
    }
}

void gl_image_destroy(struct rg_image *image)
{
    struct gl_device *gl = (struct gl_device *)image->device;
    struct gl_image *mine = (struct gl_image *)image;
    if (gl_use(gl)) {
        gl_framebuffers_forget(gl, mine->id);
        glDeleteTextures(1, &mine->id);
    }
    gl_texture_forget(&gl->bound, mine->id);
    free(mine);
}

bool gl_image_write(struct rg_image *image, int layer, int level, const void *texels)
{
    struct gl_device *gl = (struct gl_device *)image->device;
    const struct rg_image_desc *desc = &image->desc;
    if (!gl_use(gl))
        return false;
    glTextureSubImage3D(((struct gl_image *)image)->id, level, 0, 0, layer,
                        rg_level_size(desc->width, level), rg_level_size(desc->height, level), 1,
                        formats[desc->format].format, formats[desc->format].type, texels);
    return gl_check(gl, "glTextureSubImage3D", "image", image->name);
}

bool gl_image_read(struct rg_image *image, int layer, int level, void *texels)
{
    struct gl_device *gl = (struct gl_device *)image->device;
    const struct rg_image_desc *desc = &image->desc;
    if (!gl_use(gl))
        return false;
    int width = rg_level_size(desc->width, level), height = rg_level_size(desc->height, level);
    int row_bytes = width * rg_format_size(desc->format);
    // The call counts bytes in an int: what is larger comes in bands of rows.
    int band_rows = INT_MAX / row_bytes;
    for (int y = 0; y < height; y += band_rows) {
        int rows = height - y < band_rows ? height - y : band_rows;
        glGetTextureSubImage(((struct gl_image *)image)->id, level, 0, y, layer, width, rows, 1,
                             formats[desc->format].format, formats[desc->format].type,
                             rows * row_bytes, (char *)texels + (size_t)y * (size_t)row_bytes);
    }
    return gl_check(gl, "glGetTextureSubImage", "image", image->name);
}

bool gl_image_clear(struct rg_image *image, const void *texel)
{
    struct gl_device *gl = (struct gl_device *)image->device;
    const struct rg_image_desc *desc = &image->desc;
    if (!gl_use(gl))
        return false;
    for (int level = 0; level < desc->levels; level++)
        glClearTexImage(((struct gl_image *)image)->id, level, formats[desc->format].format,
                        formats[desc->format].type, texel);
    return gl_check(gl, "glClearTexImage", "image", image->name);
}
