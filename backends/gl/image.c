#include "backends/gl/gl.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>

#include "backends/formats.h"
#include "core/base/alloc.h"

void gl_images_begin(void)
{
    const GLint smallest_texel = 2; // in bytes; EGL's default would be rows at multiples of 4
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
    glTextureStorage3D(image->id, desc->levels, gl_format(desc->format).internal, desc->width,
                       desc->height, desc->layers);
    // Drivers refuse a too large image without numbers, so this message has them.
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

void gl_image_destroy(struct rg_image *image)
{
    struct gl_device *gl = (struct gl_device *)image->device;
    struct gl_image *mine = (struct gl_image *)image;
    if (gl_use(gl)) {
        gl_framebuffers_forget(gl, mine->id);
        gl_image_views_destroy(mine);
        glDeleteTextures(1, &mine->id);
    }
    gl_forget_texture(&gl->bound, mine->id);
    free(mine);
}

bool gl_image_write(struct rg_image *image, int layer, int level, const void *texels)
{
    struct gl_device *gl = (struct gl_device *)image->device;
    const struct rg_image_desc *desc = &image->desc;
    const struct gl_format format = gl_format(desc->format);
    if (!gl_use(gl))
        return false;
    glTextureSubImage3D(((struct gl_image *)image)->id, level, 0, 0, layer,
                        rg_level_size(desc->width, level), rg_level_size(desc->height, level), 1,
                        format.format, format.type, texels);
    return gl_check(gl, "glTextureSubImage3D", "image", image->name);
}

bool gl_image_read(struct rg_image *image, int layer, int level, void *texels)
{
    struct gl_device *gl = (struct gl_device *)image->device;
    const struct rg_image_desc *desc = &image->desc;
    const struct gl_format format = gl_format(desc->format);
    if (!gl_use(gl))
        return false;
    int width = rg_level_size(desc->width, level), height = rg_level_size(desc->height, level);
    int row_bytes = width * rg_format_size(desc->format);
    // The call counts bytes in an int, so larger data is transferred in bands of rows.
    int band_rows = INT_MAX / row_bytes;
    for (int y = 0; y < height; y += band_rows) {
        int rows = height - y < band_rows ? height - y : band_rows;
        glGetTextureSubImage(((struct gl_image *)image)->id, level, 0, y, layer, width, rows, 1,
                             format.format, format.type, rows * row_bytes,
                             (char *)texels + (size_t)y * (size_t)row_bytes);
    }
    return gl_check(gl, "glGetTextureSubImage", "image", image->name);
}

bool gl_image_clear(struct rg_image *image, const void *texel)
{
    struct gl_device *gl = (struct gl_device *)image->device;
    const struct rg_image_desc *desc = &image->desc;
    const struct gl_format format = gl_format(desc->format);
    if (!gl_use(gl))
        return false;
    for (int level = 0; level < desc->levels; level++)
        glClearTexImage(((struct gl_image *)image)->id, level, format.format, format.type, texel);
    return gl_check(gl, "glClearTexImage", "image", image->name);
}

bool gl_image_make_levels(struct rg_image *image, int first)
{
    struct gl_device *gl = (struct gl_device *)image->device;
    const GLuint id = ((struct gl_image *)image)->id;
    if (!gl_use(gl))
        return false;
    glTextureParameteri(id, GL_TEXTURE_BASE_LEVEL, first - 1);
    glGenerateTextureMipmap(id);
    glTextureParameteri(id, GL_TEXTURE_BASE_LEVEL, 0);
    return gl_check(gl, "glGenerateTextureMipmap", "image", image->name);
}
