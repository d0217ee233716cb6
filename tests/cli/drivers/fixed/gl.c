// Faults planted into OpenGL (planted.h). This library is loaded before others (LD_PRELOAD).
#define _GNU_SOURCE // for hooks.h
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <EGL/egl.h>
#include <GL/gl.h>
#include <GL/glext.h>

#include "tests/cli/drivers/fixed/planted.h"
#include "tests/cli/drivers/hooks.h"

static any_function (*real_eglGetProcAddress)(const char *);
static PFNGLSHADERSOURCEPROC real_glShaderSource;
static PFNGLSAMPLERPARAMETERIPROC real_glSamplerParameteri;
static PFNGLSAMPLERPARAMETERFVPROC real_glSamplerParameterfv;
static PFNGLTEXTURESTORAGE2DPROC real_glTextureStorage2D;
static PFNGLTEXTURESUBIMAGE2DPROC real_glTextureSubImage2D;
static PFNGLCOMPRESSEDTEXTURESUBIMAGE2DPROC real_glCompressedTextureSubImage2D;
static PFNGLNAMEDBUFFERSTORAGEPROC real_glNamedBufferStorage;
static PFNGLBINDBUFFERBASEPROC real_glBindBufferBase;
static PFNGLCLEARNAMEDFRAMEBUFFERFVPROC real_glClearNamedFramebufferfv;
static PFNGLBLITNAMEDFRAMEBUFFERPROC real_glBlitNamedFramebuffer;
static PFNGLPROVOKINGVERTEXPROC real_glProvokingVertex;
static PFNGLBEGINQUERYPROC real_glBeginQuery;
static PFNGLENDQUERYPROC real_glEndQuery;
static void (*real_glEnable)(GLenum);
static void (*real_glColorMask)(GLboolean, GLboolean, GLboolean, GLboolean);
static void (*real_glPolygonOffset)(GLfloat, GLfloat);

// --- shaders, for units whose state is no state of the API ---

// A texture has 32 texels, and a target 64 pixels between -1 and 1: 1/256 of each is 1/8192.
static const struct edit {
    const char *fault, *from, *to;
} edits[] = {
    {"colours are not in perspective", "layout(location = 1) in vec4 colour;",
     "layout(location = 1) noperspective in vec4 colour;"},
    {"the layer is always 0", "at.z + float(state.z) / 256.0", "0.0"},
    {"early tests are late", "layout(early_fragment_tests) in;", ""},
    {"places are 1/256 texel off", "texture(image, at.xy)", "texture(image, at.xy + 1.0 / 8192.0)"},
    {"clip planes are 1/256 pixel off", "moved.x + 0.4375 * moved.y",
     "1.0 / 8192.0 + moved.x + 0.4375 * moved.y"},
    {"tessellation levels are 1/16 off", "float(state.z) * 0.25", "float(state.z) * 0.25 + 0.0625"},
    {"dFdx is one unit off in the last place", "dFdx(at.xy)",
     "dFdx(at.xy) * uintBitsToFloat(0x3f800001u)"},
    {"stores in ten bits are one code off", "imageStore(tens, place, colour)",
     "imageStore(tens, place, colour + 1.0 / 1023.0)"},
};

// A copy of a text with each `from` replaced, which the caller frees; NULL: there is none.
static char *replaced(const char *text, const char *from, const char *to)
{
    size_t count = 0;
    for (const char *at = text; (at = strstr(at, from)); at += strlen(from))
        count++;
    char *made = count ? calloc(strlen(text) + count * strlen(to) + 1, 1) : NULL;
    if (!made)
        return NULL;
    char *end = made;
    for (const char *next; (next = strstr(text, from)); text = next + strlen(from)) {
        memcpy(end, text, (size_t)(next - text));
        end += next - text;
        memcpy(end, to, strlen(to));
        end += strlen(to);
    }
    memcpy(end, text, strlen(text));
    return made;
}

static void hooked_glShaderSource(GLuint shader, GLsizei count, const GLchar *const *texts,
                                  const GLint *lengths)
{
    enum { PARTS = 8 };
    const GLchar *parts[PARTS];
    char *made = NULL;
    for (GLsizei i = 0; i < count && count <= PARTS; i++) {
        parts[i] = texts[i];
        for (size_t e = 0; !lengths && !made && e < sizeof(edits) / sizeof(edits[0]); e++)
            if (is_planted(edits[e].fault) &&
                (made = replaced(texts[i], edits[e].from, edits[e].to)))
                parts[i] = made;
    }
    real_glShaderSource(shader, count, made ? parts : texts, lengths);
    free(made);
}

// --- textures ---

static void hooked_glSamplerParameteri(GLuint sampler, GLenum name, GLint value)
{
    const bool is_magnified = name == GL_TEXTURE_MAG_FILTER;
    if (is_magnified && is_planted("magnified texels are not filtered"))
        value = GL_NEAREST;
    if (value == GL_MIRRORED_REPEAT && is_planted("mirroring repeats"))
        value = GL_REPEAT;
    if (name == GL_TEXTURE_COMPARE_FUNC && value == GL_LESS && is_planted("less is less or equal"))
        value = GL_LEQUAL;
    real_glSamplerParameteri(sampler, name, value);
}

static void hooked_glSamplerParameterfv(GLuint sampler, GLenum name, const GLfloat *values)
{
    const GLfloat off[4] = {values[0] + 1.0f / 255, values[1], values[2], values[3]};
    const bool is_off = name == GL_TEXTURE_BORDER_COLOR && values[0] == 0 && values[3] == 1 &&
                        is_planted("an opaque black border is one code off");
    real_glSamplerParameterfv(sampler, name, is_off ? off : values);
}

static void hooked_glTextureStorage2D(GLuint texture, GLsizei levels, GLenum format, GLsizei width,
                                      GLsizei height)
{
    const bool is_plain = format == GL_SRGB8_ALPHA8 && is_planted("sRGB is not decoded");
    real_glTextureStorage2D(texture, levels, is_plain ? GL_RGBA8 : format, width, height);
}

static void hooked_glTextureSubImage2D(GLuint texture, GLint level, GLint x, GLint y, GLsizei width,
                                       GLsizei height, GLenum format, GLenum type, const void *data)
{
    enum { PX = 32 };
    uint8_t texels[PX * PX * 4];
    const bool is_off = level == 0 && width == PX && height == PX && type == GL_UNSIGNED_BYTE &&
                        is_planted("one texel is one code off");
    if (is_off) {
        memcpy(texels, data, sizeof(texels));
        texels[(PX / 2 * PX + PX / 2) * 4 + 1] ^= 1; // green, in the middle
    }
    real_glTextureSubImage2D(texture, level, x, y, width, height, format, type,
                             is_off ? texels : data);
}

static void hooked_glCompressedTextureSubImage2D(GLuint texture, GLint level, GLint x, GLint y,
                                                 GLsizei width, GLsizei height, GLenum format,
                                                 GLsizei size, const void *data)
{
    uint8_t *blocks = is_planted("one bit of a block is another") ? malloc((size_t)size) : NULL;
    if (blocks) {
        memcpy(blocks, data, (size_t)size);
        blocks[size - 1] ^= 1;
    }
    real_glCompressedTextureSubImage2D(texture, level, x, y, width, height, format, size,
                                       blocks ? blocks : data);
    free(blocks);
}

// --- vertices ---

static void hooked_glNamedBufferStorage(GLuint buffer, GLsizeiptr size, const void *data,
                                        GLbitfield flags)
{
    enum { VERTICES = 96, STRIDE = 32 }; // of the attributes in other formats than floats
    uint8_t formats[VERTICES * STRIDE];
    const bool is_off =
        data && size == sizeof(formats) && is_planted("an attribute is one code off");
    if (is_off) {
        memcpy(formats, data, sizeof(formats));
        formats[(VERTICES - 1) * STRIDE] ^= 1;
    }
    real_glNamedBufferStorage(buffer, size, is_off ? formats : data, flags);
}

static void hooked_glBindBufferBase(GLenum target, GLuint index, GLuint buffer)
{
    enum { CAUGHT = 94 * 3, STRIDE = 32 }; // what a strip of 96 vertices leaves
    if (target != GL_TRANSFORM_FEEDBACK_BUFFER || !is_planted("the last triangle is not caught")) {
        real_glBindBufferBase(target, index, buffer);
        return;
    }
    const PFNGLBINDBUFFERRANGEPROC bind =
        (PFNGLBINDBUFFERRANGEPROC)real_eglGetProcAddress("glBindBufferRange");
    bind(target, index, buffer, 0, (CAUGHT - 1) * STRIDE);
}

static void hooked_glProvokingVertex(GLenum mode)
{
    real_glProvokingVertex(is_planted("the last vertex provokes") ? GL_LAST_VERTEX_CONVENTION
                                                                  : mode);
}

// --- primitives and pixels ---

static void hooked_glEnable(GLenum what)
{
    const bool has_seams = what == GL_TEXTURE_CUBE_MAP_SEAMLESS && is_planted("cubes have seams");
    const bool goes_on =
        what == GL_PRIMITIVE_RESTART_FIXED_INDEX && is_planted("strips do not restart");
    if (!has_seams && !goes_on)
        real_glEnable(what);
}

static void hooked_glPolygonOffset(GLfloat factor, GLfloat units)
{
    real_glPolygonOffset(factor, units + (is_planted("the offset is one unit more") ? 1 : 0));
}

static void hooked_glColorMask(GLboolean r, GLboolean g, GLboolean b, GLboolean a)
{
    const bool all = is_planted("every channel is written");
    real_glColorMask(r || all, g || all, b || all, a || all);
}

static void hooked_glClearNamedFramebufferfv(GLuint framebuffer, GLenum buffer, GLint i,
                                             const GLfloat *values)
{
    const bool is_off =
        buffer == GL_COLOR && i == 4 && is_planted("the fifth target is cleared one code off");
    GLfloat off[4];
    if (is_off) {
        memcpy(off, values, sizeof(off));
        off[0] += 1.0f / 255;
    }
    real_glClearNamedFramebufferfv(framebuffer, buffer, i, is_off ? off : values);
}

static void hooked_glBlitNamedFramebuffer(GLuint from, GLuint to, GLint x0, GLint y0, GLint x1,
                                          GLint y1, GLint to_x0, GLint to_y0, GLint to_x1,
                                          GLint to_y1, GLbitfield mask, GLenum filter)
{
    const bool is_scaled = y1 - y0 != to_y1 - to_y0;
    const GLint less = is_scaled && is_planted("a scaled blit leaves out a row") ? 1 : 0;
    real_glBlitNamedFramebuffer(from, to, x0, y0, x1, y1 - less, to_x0, to_y0, to_x1, to_y1, mask,
                                filter);
}

// --- queries ---

static GLenum counted_by(GLenum target)
{
    return target == GL_SAMPLES_PASSED && is_planted("samples are not counted")
               ? GL_ANY_SAMPLES_PASSED
               : target;
}

static void hooked_glBeginQuery(GLenum target, GLuint query)
{
    real_glBeginQuery(counted_by(target), query);
}

static void hooked_glEndQuery(GLenum target)
{
    real_glEndQuery(counted_by(target));
}

// --- looking functions up ---

static any_function hooked_eglGetProcAddress(const char *name)
{
    return hook_of(name, real_eglGetProcAddress(name));
}

static any_function hook_of(const char *name, any_function real)
{
    static const struct hook hooks[] = {
        HOOK(eglGetProcAddress),
        HOOK(glShaderSource),
        HOOK(glSamplerParameteri),
        HOOK(glSamplerParameterfv),
        HOOK(glTextureStorage2D),
        HOOK(glTextureSubImage2D),
        HOOK(glCompressedTextureSubImage2D),
        HOOK(glNamedBufferStorage),
        HOOK(glBindBufferBase),
        HOOK(glProvokingVertex),
        HOOK(glEnable),
        HOOK(glPolygonOffset),
        HOOK(glColorMask),
        HOOK(glClearNamedFramebufferfv),
        HOOK(glBlitNamedFramebuffer),
        HOOK(glBeginQuery),
        HOOK(glEndQuery),
    };
    return hook_among(hooks, sizeof(hooks) / sizeof(hooks[0]), name, real);
}
