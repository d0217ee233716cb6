#include "backends/gl/gl.h"

#include <string.h>

#include "backends/formats.h"
#include "core/base/log.h"

static GLuint id_of(const struct rg_image *image)
{
    return image ? ((const struct gl_image *)image)->id : 0;
}

// A depth image is attached if the driver tests it. If samples are counted, fragments test the
// depth, and may not fetch an attached image.
static struct gl_framebuffer_key key_of(const struct rg_draw *draw)
{
    const struct rg_image *image = draw->colour ? draw->colour : draw->depth;
    const GLuint depth = draw->depth_mode == RG_DEPTH_OFF ? 0 : id_of(draw->depth);
    return (struct gl_framebuffer_key){
        .colour = id_of(draw->colour),
        .depth = rg_draw_counts(draw) ? 0 : depth,
        .behind = rg_draw_counts(draw) ? depth : 0,
        .layer = draw->layer,
        .level = draw->level,
        .width = rg_level_size(image->desc.width, draw->level),
        .height = rg_level_size(image->desc.height, draw->level),
    };
}

static const char *name_of(const struct rg_draw *draw)
{
    return draw->colour ? draw->colour->name : draw->depth->name;
}

static void release(struct gl_device *gl, struct gl_framebuffer *framebuffer)
{
    if (!framebuffer->id)
        return;
    glDeleteFramebuffers(1, &framebuffer->id);
    gl_forget_framebuffer(&gl->bound, framebuffer->id);
    glDeleteTextures(1, &framebuffer->behind);
    gl_forget_texture(&gl->bound, framebuffer->behind);
    *framebuffer = (struct gl_framebuffer){0};
}

void gl_framebuffers_forget(struct gl_device *device, GLuint image)
{
    for (int i = 0; i < GL_MAX_FRAMEBUFFERS; i++) {
        struct gl_framebuffer *framebuffer = &device->framebuffers.kept[i];
        const struct gl_framebuffer_key *key = &framebuffer->key;
        if (!image || key->colour == image || key->depth == image || key->behind == image)
            release(device, framebuffer);
    }
}

static GLuint layer_view(const struct gl_framebuffer_key *key)
{
    GLuint view = 0;
    glGenTextures(1, &view);
    glTextureView(view, GL_TEXTURE_2D_ARRAY, key->behind, gl_format(RG_D32F).internal,
                  (GLuint)key->level, 1, (GLuint)key->layer, 1);
    glTextureParameteri(view, GL_TEXTURE_MIN_FILTER, GL_NEAREST_MIPMAP_NEAREST);
    glTextureParameteri(view, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    return view;
}

static void fill(struct gl_framebuffer *framebuffer)
{
    const struct gl_framebuffer_key *key = &framebuffer->key;
    glCreateFramebuffers(1, &framebuffer->id);
    if (key->colour)
        glNamedFramebufferTextureLayer(framebuffer->id, GL_COLOR_ATTACHMENT0, key->colour,
                                       key->level, key->layer);
    else
        glNamedFramebufferDrawBuffer(framebuffer->id, GL_NONE);
    if (key->depth)
        glNamedFramebufferTextureLayer(framebuffer->id, GL_DEPTH_ATTACHMENT, key->depth, key->level,
                                       key->layer);
    if (!key->colour && !key->depth) { // only counts samples, writes nothing
        glNamedFramebufferParameteri(framebuffer->id, GL_FRAMEBUFFER_DEFAULT_WIDTH, key->width);
        glNamedFramebufferParameteri(framebuffer->id, GL_FRAMEBUFFER_DEFAULT_HEIGHT, key->height);
    }
    if (key->behind)
        framebuffer->behind = layer_view(key);
}

static bool is_complete(struct gl_device *gl, const struct gl_framebuffer *framebuffer,
                        const char *name)
{
    const GLenum status = glCheckNamedFramebufferStatus(framebuffer->id, GL_DRAW_FRAMEBUFFER);
    if (!gl_check(gl, "glCreateFramebuffers", "target", name))
        return false;
    return status == GL_FRAMEBUFFER_COMPLETE ||
           rg_driver_error("target '%s': %s cannot draw to it, framebuffer status %04x", name,
                           gl->pub.info.name, (unsigned)status);
}

static struct gl_framebuffer *make(struct gl_device *gl, const struct gl_framebuffer_key *key,
                                   const char *name)
{
    struct gl_framebuffers *all = &gl->framebuffers;
    struct gl_framebuffer *framebuffer = &all->kept[all->next];
    all->next = (all->next + 1) % GL_MAX_FRAMEBUFFERS;
    release(gl, framebuffer);
    framebuffer->key = *key;
    fill(framebuffer);
    if (is_complete(gl, framebuffer, name)) {
        gl_label(GL_FRAMEBUFFER, framebuffer->id, name);
        return framebuffer;
    }
    release(gl, framebuffer);
    return NULL;
}

const struct gl_framebuffer *gl_framebuffer_of(struct gl_device *device, const struct rg_draw *draw)
{
    const struct gl_framebuffer_key key = key_of(draw);
    for (int i = 0; i < GL_MAX_FRAMEBUFFERS; i++) {
        const struct gl_framebuffer *framebuffer = &device->framebuffers.kept[i];
        if (framebuffer->id && !memcmp(&framebuffer->key, &key, sizeof(key)))
            return framebuffer;
    }
    return make(device, &key, name_of(draw));
}
