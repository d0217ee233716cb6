// The samplers of native devices: views of an image's texture, each with a sampler's state, so that
// one binding has both.
#include "backends/gl/gl.h"

#include "core/base/log.h"

static void set_state(GLuint view, enum rg_sampler sampling)
{
    const GLint wrap = sampling == RG_SAMPLED_TILED ? GL_REPEAT : GL_CLAMP_TO_EDGE;
    const bool compares = sampling == RG_SAMPLED_SHADOW;
    glTextureParameteri(view, GL_TEXTURE_MIN_FILTER,
                        compares ? GL_LINEAR : GL_LINEAR_MIPMAP_LINEAR);
    glTextureParameteri(view, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
    glTextureParameteri(view, GL_TEXTURE_WRAP_S, wrap);
    glTextureParameteri(view, GL_TEXTURE_WRAP_T, wrap);
    if (compares) {
        glTextureParameteri(view, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
        glTextureParameteri(view, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
    }
}

// A new view of all levels and layers; 0, with one logged line, on failure.
static GLuint make_view(struct rg_image *image, enum rg_sampler sampling)
{
    const struct gl_image *mine = (const struct gl_image *)image;
    const struct rg_image_desc *desc = &image->desc;
    const bool is_cube = sampling == RG_SAMPLED_CUBE;
    GLuint view = 0;
    glGenTextures(1, &view);
    glTextureView(view, is_cube ? GL_TEXTURE_CUBE_MAP : GL_TEXTURE_2D_ARRAY, mine->id,
                  gl_format(desc->format).internal, 0, (GLuint)desc->levels, 0,
                  is_cube ? 6 : (GLuint)desc->layers);
    set_state(view, sampling);
    gl_label(GL_TEXTURE, view, image->name);
    if (gl_check((struct gl_device *)image->device, "glTextureView", "image", image->name))
        return view;
    glDeleteTextures(1, &view);
    return 0;
}

GLuint gl_image_view(struct rg_image *image, enum rg_sampler sampling)
{
    GLuint *view = &((struct gl_image *)image)->views[sampling];
    if (!*view)
        *view = make_view(image, sampling);
    return *view;
}

void gl_image_views_destroy(struct gl_image *image)
{
    struct gl_device *gl = (struct gl_device *)image->pub.device;
    for (int i = 0; i < RG_SAMPLERS; i++)
        if (image->views[i])
            gl_forget_texture(&gl->bound, image->views[i]);
    glDeleteTextures(RG_SAMPLERS, image->views);
}
