#include "backends/gl/gl.h"

bool gl_sync(struct rg_device *device)
{
    struct gl_device *gl = (struct gl_device *)device;
    if (!gl_use(gl))
        return false;
    glFinish();
    return gl_check(gl, "glFinish", "device", device->info.name);
}

bool gl_time(struct rg_device *device, int64_t *time_ns)
{
    struct gl_device *gl = (struct gl_device *)device;
    if (!gl_use(gl))
        return false;
    glQueryCounter(gl->timestamp, GL_TIMESTAMP);
    GLint64 now_ns = 0;
    glGetQueryObjecti64v(gl->timestamp, GL_QUERY_RESULT, &now_ns);
    *time_ns = now_ns;
    return gl_check(gl, "glQueryCounter", "device", device->info.name);
}
