#include "backends/gl/gl.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"

struct stage {
    GLenum type;
    enum rg_code_kind code;
};

enum { MAX_STAGES = 3 };

static const struct stage grid_stages[MAX_STAGES] = {{GL_COMPUTE_SHADER, RG_CODE_GLSL}};
static const struct stage draw_stages[MAX_STAGES] = {
    {GL_VERTEX_SHADER, RG_CODE_VERTEX_GLSL},
    {GL_FRAGMENT_SHADER, RG_CODE_FRAGMENT_GLSL},
};
static const struct stage native_stages[MAX_STAGES] = {
    {GL_VERTEX_SHADER, RG_CODE_VERTEX_GLSL},
    {GL_GEOMETRY_SHADER, RG_CODE_NATIVE_GEOMETRY_GLSL},
    {GL_FRAGMENT_SHADER, RG_CODE_FRAGMENT_GLSL},
};

static bool refuse(const struct gl_device *device, const char *kernel, const char *step,
                   const char *log)
{
    return rg_driver_error("kernel '%s': %s failed on %s: %.*s", kernel, step,
                           device->pub.info.name, (int)strcspn(log, "\r\n"),
                           log[0] ? log : "the driver says nothing");
}

static bool compile(const struct gl_device *device, const struct rg_kernel *kernel,
                    enum rg_code_kind kind, unsigned ways, GLuint shader)
{
    struct rg_kernel_code code;
    if (!rg_kernel_code(kernel, kind, ways, &code))
        return false;
    const GLchar *text = (const GLchar *)code.bytes;
    const GLint length = (GLint)code.size;
    glShaderSource(shader, 1, &text, &length);
    glCompileShader(shader);
    free(code.bytes);
    GLint compiled = GL_FALSE;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    char log[512] = "";
    glGetShaderInfoLog(shader, sizeof(log), NULL, log);
    return compiled || refuse(device, kernel->name, "glCompileShader", log);
}

static bool attach(const struct gl_device *device, const struct rg_kernel *kernel,
                   const struct stage *stage, unsigned ways, GLuint program)
{
    GLuint shader = glCreateShader(stage->type);
    bool compiled = compile(device, kernel, stage->code, ways, shader);
    if (compiled)
        glAttachShader(program, shader);
    glDeleteShader(shader); // deleted together with the program
    return compiled;
}

static bool link(const struct gl_device *device, const struct rg_kernel *kernel, GLuint program)
{
    glProgramParameteri(program, GL_PROGRAM_BINARY_RETRIEVABLE_HINT, GL_TRUE); // for gl_pass_code
    glLinkProgram(program);
    GLint linked = GL_FALSE;
    glGetProgramiv(program, GL_LINK_STATUS, &linked);
    char log[512] = "";
    glGetProgramInfoLog(program, sizeof(log), NULL, log);
    return linked || refuse(device, kernel->name, "glLinkProgram", log);
}

GLuint gl_program_create(struct gl_device *device, const struct rg_kernel *kernel, unsigned ways)
{
    const bool draws = kernel->draw || (ways & RG_CODE_PASSES);
    const struct stage *stages = !draws                   ? grid_stages
                                 : (ways & RG_CODE_SETUP) ? native_stages
                                                          : draw_stages;
    GLuint program = glCreateProgram();
    bool built = true;
    for (int i = 0; built && i < MAX_STAGES && stages[i].type; i++)
        built = attach(device, kernel, &stages[i], ways, program);
    built = built && link(device, kernel, program) &&
            gl_check(device, "glCreateProgram", "kernel", kernel->name);
    if (built)
        return program;
    glDeleteProgram(program);
    return 0;
}

// kernels/dialect/slots/glsl.h declares such slots as the sampler NAME_words.
unsigned gl_program_word_slots(GLuint program, const struct rg_kernel *kernel)
{
    unsigned slots = 0;
    for (int i = 0; i < kernel->slot_count; i++) {
        char sampler[128];
        snprintf(sampler, sizeof(sampler), "%s_words", kernel->slots[i].name);
        if (glGetUniformLocation(program, sampler) >= 0)
            slots |= 1u << kernel->slots[i].slot;
    }
    return slots;
}
