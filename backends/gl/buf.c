#include "backends/gl/gl.h"

#include <stdlib.h>

#include "core/base/alloc.h"

struct rg_buf *gl_buf_create(struct rg_device *device, size_t size, const char *name)
{
    struct gl_device *gl = (struct gl_device *)device;
    if (!gl_use(gl))
        return NULL;
    struct gl_buf *buf = rg_alloc(1, sizeof(*buf), name);
    if (!buf)
        return NULL;
    glCreateBuffers(1, &buf->id);
    gl_label(GL_BUFFER, buf->id, name);
    glNamedBufferStorage(buf->id, (GLsizeiptr)size, NULL, GL_DYNAMIC_STORAGE_BIT);
    if (!gl_check(gl, "glNamedBufferStorage", "buffer", name)) {
        glDeleteBuffers(1, &buf->id);
        free(buf);
        return NULL;
    }
    return &buf->pub;
}

GLuint gl_buf_words(struct rg_buf *buf)
{
    struct gl_buf *mine = (struct gl_buf *)buf;
    if (mine->words)
        return mine->words;
    glCreateTextures(GL_TEXTURE_BUFFER, 1, &mine->words);
    gl_label(GL_TEXTURE, mine->words, buf->name);
    glTextureBuffer(mine->words, GL_R32UI, mine->id);
    if (gl_check((struct gl_device *)buf->device, "glTextureBuffer", "buffer", buf->name))
        return mine->words;
    glDeleteTextures(1, &mine->words);
    return mine->words = 0;
}

void gl_buf_destroy(struct rg_buf *buf)
{
    struct gl_device *gl = (struct gl_device *)buf->device;
    struct gl_buf *mine = (struct gl_buf *)buf;
    if (gl_use(gl)) {
        glDeleteTextures(1, &mine->words);
        glDeleteBuffers(1, &mine->id);
    }
    gl_forget_texture(&gl->bound, mine->words);
    gl_forget_buffer(&gl->bound, mine->id);
    free(mine);
}

bool gl_buf_write(struct rg_buf *buf, size_t offset, const void *data, size_t size)
{
    struct gl_device *gl = (struct gl_device *)buf->device;
    if (!gl_use(gl))
        return false;
    glNamedBufferSubData(((struct gl_buf *)buf)->id, (GLintptr)offset, (GLsizeiptr)size, data);
    return gl_check(gl, "glNamedBufferSubData", "buffer", buf->name);
}

bool gl_buf_read(struct rg_buf *buf, size_t offset, void *data, size_t size)
{
    struct gl_device *gl = (struct gl_device *)buf->device;
    if (!gl_use(gl))
        return false;
    glGetNamedBufferSubData(((struct gl_buf *)buf)->id, (GLintptr)offset, (GLsizeiptr)size, data);
    return gl_check(gl, "glGetNamedBufferSubData", "buffer", buf->name);
}
