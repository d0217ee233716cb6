#include "backends/gl/api/fixed/fixed.h"

#include <string.h>

#include "core/base/log.h"

static const GLenum types[RG_FIXED_STAGES] = {GL_VERTEX_SHADER, GL_TESS_CONTROL_SHADER,
                                              GL_TESS_EVALUATION_SHADER, GL_GEOMETRY_SHADER,
                                              GL_FRAGMENT_SHADER};

static bool refuse(const struct gl_fixed_job *draw, const char *call, const char *log)
{
    return rg_driver_error("feature '%s': %s failed on %s: %.*s", draw->feature, call,
                           draw->device->pub.info.name, (int)strcspn(log, "\r\n"),
                           log[0] ? log : "the driver says nothing");
}

static bool attach(const struct gl_fixed_job *draw, enum rg_fixed_stage stage)
{
    const struct rg_fixed_code *code = rg_fixed_code_of(draw->state, stage);
    if (!code)
        return true;
    const GLchar *texts[] = {"#version 450\n#define ", code->name, "\n", code->text};
    const GLuint shader = glCreateShader(types[stage]);
    GLint compiled = GL_FALSE;
    char log[512] = "";
    glShaderSource(shader, 4, texts, NULL);
    glCompileShader(shader);
    glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    glGetShaderInfoLog(shader, sizeof(log), NULL, log);
    glAttachShader(draw->program, shader);
    glDeleteShader(shader); // deleted together with the program
    return compiled || refuse(draw, "glCompileShader", log);
}

bool gl_fixed_program(struct gl_fixed_job *draw)
{
    GLint linked = GL_FALSE;
    char log[512] = "";
    draw->program = glCreateProgram();
    for (enum rg_fixed_stage stage = 0; stage < RG_FIXED_STAGES; stage++)
        if (!attach(draw, stage))
            return false;
    glLinkProgram(draw->program);
    glGetProgramiv(draw->program, GL_LINK_STATUS, &linked);
    glGetProgramInfoLog(draw->program, sizeof(log), NULL, log);
    return linked || refuse(draw, "glLinkProgram", log);
}
