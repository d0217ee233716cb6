#define GL_GLEXT_PROTOTYPES
#define EGL_EGLEXT_PROTOTYPES
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <GL/glcorearb.h>

enum { SAMPLED_IMAGE = 1, UNIFORM_BLOCK = 6, TARGET = 10 }; // types of slots
static GLuint objects[16], program; // textures, or buffers
#define OF(s) objects[(s) - slots]

static void check(const char *step) {
    const GLenum error = glGetError();
    if (error) FAIL(2, "failed: %s, 0x%04x\n", step, error);
}

static void open_device(unsigned index) {
    static const EGLint wanted[] = {EGL_CONTEXT_MAJOR_VERSION, 4, EGL_CONTEXT_MINOR_VERSION, 5, EGL_CONTEXT_OPENGL_PROFILE_MASK,
        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
    PFNEGLQUERYDEVICESEXTPROC query = (PFNEGLQUERYDEVICESEXTPROC)eglGetProcAddress("eglQueryDevicesEXT");
    PFNEGLGETPLATFORMDISPLAYEXTPROC get = (PFNEGLGETPLATFORMDISPLAYEXTPROC)eglGetProcAddress("eglGetPlatformDisplayEXT");
    EGLDeviceEXT all[16];
    EGLint found = 0;
    if (!query || !get || !query(16, all, &found) || (int)index >= found) FAIL(77, "there is no EGL device %u\n", index);
    EGLDisplay display = get(EGL_PLATFORM_DEVICE_EXT, all[index], NULL);
    if (!eglInitialize(display, NULL, NULL) || !eglBindAPI(EGL_OPENGL_API)) FAIL(77, "EGL device %u has no OpenGL\n", index);
    EGLContext context = eglCreateContext(display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, wanted);
    if (!context || !eglMakeCurrent(display, EGL_NO_SURFACE, EGL_NO_SURFACE, context)) FAIL(77, "EGL device %u has no OpenGL 4.5\n", index);
}

static void attach(GLenum type, const char *path) {
    size_t size;
    const GLchar *text = read_code(path, &size);
    const GLint length = (GLint)size;
    const GLuint shader = glCreateShader(type);
    char log[1024] = "";
    GLint compiled;
    glShaderSource(shader, 1, &text, &length);
    glCompileShader(shader);
    glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    glGetShaderInfoLog(shader, sizeof(log), NULL, log);
    if (!compiled) FAIL(2, "%s: %s\n", path, log);
    glAttachShader(program, shader);
}

static void make_program(void) {
    GLint linked;
    program = glCreateProgram();
    attach(GL_VERTEX_SHADER, "kernel.vert");
    if (draw.points) attach(GL_GEOMETRY_SHADER, "kernel.geom");
    attach(GL_FRAGMENT_SHADER, "kernel.frag");
    glLinkProgram(program);
    glGetProgramiv(program, GL_LINK_STATUS, &linked);
    if (!linked) FAIL(2, "failed: glLinkProgram\n");
    glUseProgram(program);
}

static void make_buffer(struct slot *s) { // shaders read it as a block, or as a texture of words
    GLuint words;
    glCreateBuffers(1, &OF(s));
    glNamedBufferStorage(OF(s), s->size, s->bytes, 0);
    glBindBufferBase(s->type == UNIFORM_BLOCK ? GL_UNIFORM_BUFFER : GL_SHADER_STORAGE_BUFFER, s->at, OF(s));
    if (s->type == UNIFORM_BLOCK) return;
    glCreateTextures(GL_TEXTURE_BUFFER, 1, &words);
    glTextureBuffer(words, GL_R32UI, OF(s));
    glBindTextureUnit(s->at, words);
}

static const struct format { unsigned vulkan; GLenum internal, format, type; } formats[] = {
    {37, GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE}, {97, GL_RGBA16F, GL_RGBA, GL_HALF_FLOAT}, {109, GL_RGBA32F, GL_RGBA, GL_FLOAT},
    {100, GL_R32F, GL_RED, GL_FLOAT}, {76, GL_R16F, GL_RED, GL_HALF_FLOAT},
    {122, GL_R11F_G11F_B10F, GL_RGB, GL_UNSIGNED_INT_10F_11F_11F_REV}, {126, GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT}};

static const struct format *format_of(const struct slot *s) {
    for (unsigned i = 0; i < sizeof(formats) / sizeof(formats[0]); i++)
        if (formats[i].vulkan == s->format) return &formats[i];
    FAIL(2, "slot %u: format %u is unknown\n", s->at, s->format);
}

static void copy(const struct slot *s, int back) { // between an image and its bytes, level by level
    const struct format *f = format_of(s);
    unsigned char *at = s->bytes;
    for (unsigned level = 0, w = s->width, h = s->height; level < s->levels; level++, w = w / 2 + (w < 2), h = h / 2 + (h < 2)) {
        const unsigned size = w * h * s->layers * s->texel;
        if (back) glGetTextureImage(OF(s), (int)level, f->format, f->type, (int)size, at);
        else glTextureSubImage3D(OF(s), (int)level, 0, 0, 0, (int)w, (int)h, (int)s->layers, f->format, f->type, at);
        at += size;
    }
}

static void make_image(struct slot *s) {
    const int cube = s->view_type == 3, wrap = s->wrap ? GL_CLAMP_TO_EDGE : GL_REPEAT;
    glCreateTextures(cube ? GL_TEXTURE_CUBE_MAP : GL_TEXTURE_2D_ARRAY, 1, &OF(s));
    if (cube) glTextureStorage2D(OF(s), (int)s->levels, format_of(s)->internal, (int)s->width, (int)s->height);
    else glTextureStorage3D(OF(s), (int)s->levels, format_of(s)->internal, (int)s->width, (int)s->height, (int)s->layers);
    glTextureParameteri(OF(s), GL_TEXTURE_MIN_FILTER,
        !s->filter ? GL_NEAREST_MIPMAP_NEAREST : s->compare ? GL_LINEAR : GL_LINEAR_MIPMAP_LINEAR);
    glTextureParameteri(OF(s), GL_TEXTURE_MAG_FILTER, s->filter ? GL_LINEAR : GL_NEAREST);
    glTextureParameteri(OF(s), GL_TEXTURE_WRAP_S, wrap);
    glTextureParameteri(OF(s), GL_TEXTURE_WRAP_T, wrap);
    if (s->compare) glTextureParameteri(OF(s), GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    copy(s, 0);
    if (s->type == SAMPLED_IMAGE) glBindTextureUnit(s->at, OF(s));
}

static void set_state(void) {
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    glDisable(GL_DITHER);
    glViewport(0, 0, (int)draw.width, (int)draw.height);
    glEnable(GL_SCISSOR_TEST);
    glScissor((int)draw.x, (int)draw.y, (int)draw.across, (int)draw.down);
    if (draw.blend) glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, draw.blend == 1 ? GL_ONE : GL_ONE_MINUS_SRC_ALPHA);
    if (draw.depth) glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glDepthMask(draw.depth > 1);
    if (draw.cull) glEnable(GL_CULL_FACE);
    glFrontFace(GL_CW); // for the viewer, to whom row 0 is the top
    glCullFace(draw.cull == 1 ? GL_FRONT : GL_BACK);
}

static void run(void) {
    GLuint framebuffer, vertices;
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glCreateFramebuffers(1, &framebuffer);
    EACH_SLOT {
        s->bytes = calloc(1, s->size);
        if (!s->bytes) FAIL(2, "there is no memory\n");
        read_parts(s->before, s->bytes, s->size);
        if (s->format) make_image(s);
        else make_buffer(s);
        if (s->type == TARGET)
            glNamedFramebufferTextureLayer(framebuffer, s->format == 126 ? GL_DEPTH_ATTACHMENT : GL_COLOR_ATTACHMENT0, OF(s), (int)draw.level,
                (int)draw.layer);
    }
    check("the slots");
    make_program();
    set_state();
    glCreateVertexArrays(1, &vertices);
    glBindVertexArray(vertices);
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
    glDrawArrays(draw.points ? GL_POINTS : GL_TRIANGLES, (int)draw.first, (int)items);
    check("glDrawArrays");
    glFinish();
    EACH_SLOT if (s->format && *s->expected != '-') copy(s, 1);
    check("glGetTextureImage");
}

