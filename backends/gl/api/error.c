#include "backends/gl/gl.h"

#include <stdio.h>
#include <string.h>

#include "core/base/log.h"

static const char *error_name(GLenum code)
{
    switch (code) {
    case GL_INVALID_ENUM:
        return "GL_INVALID_ENUM";
    case GL_INVALID_VALUE:
        return "GL_INVALID_VALUE";
    case GL_INVALID_OPERATION:
        return "GL_INVALID_OPERATION";
    case GL_INVALID_FRAMEBUFFER_OPERATION:
        return "GL_INVALID_FRAMEBUFFER_OPERATION";
    case GL_OUT_OF_MEMORY:
        return "GL_OUT_OF_MEMORY";
    case GL_CONTEXT_LOST:
        return "GL_CONTEXT_LOST";
    default:
        return "an unknown error";
    }
}

static void APIENTRY note_fault(GLenum source, GLenum type, GLuint id, GLenum severity,
                                GLsizei length, const GLchar *message, const void *user)
{
    (void)source, (void)type, (void)id, (void)severity, (void)length;
    struct gl_device *device = (struct gl_device *)user;
    if (!device->fault[0])
        snprintf(device->fault, sizeof(device->fault), "%s", message);
}

void gl_debug_begin(struct gl_device *device)
{
    glEnable(GL_DEBUG_OUTPUT);
    glEnable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    glDebugMessageControl(GL_DONT_CARE, GL_DONT_CARE, GL_DONT_CARE, 0, NULL, GL_FALSE);
    glDebugMessageControl(GL_DEBUG_SOURCE_API, GL_DEBUG_TYPE_ERROR, GL_DONT_CARE, 0, NULL, GL_TRUE);
    glDebugMessageCallback(note_fault, device);
}

static bool report(struct gl_device *device, GLenum code, const char *call, const char *kind,
                   const char *name)
{
    // Every call on a lost context fails, so only the first is logged.
    if (!device->is_lost)
        rg_driver_error("%s '%s': %s failed on %s with %s%s%s", kind, name, call,
                        device->pub.info.name, error_name(code), device->fault[0] ? ": " : "",
                        device->fault);
    device->is_lost = device->is_lost || code == GL_CONTEXT_LOST;
    device->fault[0] = 0;
    return false;
}

bool gl_check(struct gl_device *device, const char *call, const char *kind, const char *name)
{
    GLenum code = glGetError();
    if (code == GL_NO_ERROR && !device->fault[0])
        return true;
    // A driver may hold several errors, and a lost context reports them endlessly, so the loop is
    // bounded.
    for (int i = 0; i < 8 && glGetError() != GL_NO_ERROR; i++)
        ;
    return report(device, code, call, kind, name);
}

bool gl_check_reported(struct gl_device *device, const char *call, const char *kind,
                       const char *name)
{
    return !device->fault[0] || gl_check(device, call, kind, name);
}

// The length of a label, as far as every driver takes one.
static GLsizei length_of(const char *name)
{
    const size_t longest = 255, length = strlen(name);
    return (GLsizei)(length < longest ? length : longest);
}

void gl_label(GLenum type, GLuint id, const char *name)
{
    glObjectLabel(type, id, length_of(name), name);
}

void gl_group_begin(const struct gl_device *device, const char *name)
{
    if (device->labels)
        glPushDebugGroup(GL_DEBUG_SOURCE_APPLICATION, 0, length_of(name), name);
}

void gl_group_end(const struct gl_device *device)
{
    if (device->labels)
        glPopDebugGroup();
}
