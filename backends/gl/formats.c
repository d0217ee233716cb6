#include "backends/gl/gl.h"

static const struct gl_format formats[RG_FORMAT_COUNT] = {
    [RG_RGBA8] = {GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE},
    [RG_RGBA16F] = {GL_RGBA16F, GL_RGBA, GL_HALF_FLOAT},
    [RG_RGBA32F] = {GL_RGBA32F, GL_RGBA, GL_FLOAT},
    [RG_R32F] = {GL_R32F, GL_RED, GL_FLOAT},
    [RG_R16F] = {GL_R16F, GL_RED, GL_HALF_FLOAT},
    [RG_RG11B10F] = {GL_R11F_G11F_B10F, GL_RGB, GL_UNSIGNED_INT_10F_11F_11F_REV},
    [RG_D32F] = {GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT},
};

struct gl_format gl_format(enum rg_format format)
{
    return formats[format];
}
