// The gl backend: kernels as programs of OpenGL 4.5 core, on EGL without a window.
//
// A device is one context without a framebuffer. A context belongs to the thread that last used it,
// so a device stays on the thread that opened it. No other code on that thread may make a context
// current.
#ifndef RG_BACKENDS_GL_GL_H
#define RG_BACKENDS_GL_GL_H

#include <epoxy/gl.h>

#include <epoxy/egl.h>

#include "backends/backend.h"
#include "backends/manifests.h"

#define GL_PACKAGE "libegl-mesa0" // the Debian package with a driver

// Items in a work group: local_size_x of shaders/grid.glsl.
enum { GL_GROUP_ITEMS = 64 };

enum { GL_MAX_TARGETS = 32 };

// A place where EGL may find a driver: an EGL device, or the surfaceless platform.
struct gl_target {
    EGLenum platform;
    void *native;
    bool software; // EGL says so
};

// State of a walk over the targets that open, best first.
struct gl_search {
    struct gl_target targets[GL_MAX_TARGETS];
    int count, next;
    bool found;                   // at least one has opened
    bool lacks;                   // a library of EGL's or OpenGL's is missing
    bool grave;                   // the failure counts even if devices opened
    enum rg_manifest_state state; // whether `why` tells of a failure, or of something missing
    char why[512]; // the reason of the best target's driver, preferring failures; "": none
};

// An open context and the display that it came from.
struct gl_egl {
    EGLDisplay display;
    EGLContext context;
    unsigned serial; // never 0, never reused
    bool software;
};

// Parameters of queued runs, in memory that the driver reads. It has two halves: before one is
// refilled, the runs that read it are waited for.
struct gl_params {
    GLuint buffer;
    unsigned char *memory; // mapped for the buffer's life
    size_t alignment;
    size_t next; // offset of the next run's block
    int half;    // 0 or 1
    GLsync read[2];
};

// Images that are drawn to together; 0 stands for a missing one.
struct gl_framebuffer_key {
    GLuint colour, depth;
    GLuint behind; // a depth image that fragments fetch
    int layer, level;
    int width, height; // of the level
};

struct gl_framebuffer {
    struct gl_framebuffer_key key;
    GLuint id;     // 0: free
    GLuint behind; // one layer and level of key.behind
};

enum { GL_MAX_FRAMEBUFFERS = 64 };

// The framebuffers of recent targets; a new one replaces the oldest.
struct gl_framebuffers {
    struct gl_framebuffer kept[GL_MAX_FRAMEBUFFERS];
    int next;
};

// A draw's state besides its bindings.
struct gl_draw_state {
    bool packed;       // its primitives are
    int width, height; // of the target
    GLint scissor[4];
    enum rg_blend blend;
    enum rg_depth_mode depth;
    enum rg_cull cull; // of items that are not packed
};

// The current bindings, so that equal ones cost no call. 0: nothing.
struct gl_bound {
    GLuint program;
    GLuint buffers[RG_MAX_SLOTS], textures[RG_MAX_SLOTS], images[RG_MAX_SLOTS];
    GLuint framebuffer;
    GLuint arguments; // arguments of an indirect draw
    struct gl_draw_state draw;
};

// Occlusion queries, as many as the largest draw so far needed.
struct gl_queries {
    GLuint *ids;
    int count;
};

struct gl_fixed; // backends/gl/api/fixed/fixed.h

struct gl_device {
    struct rg_device pub;
    struct gl_egl egl;
    struct gl_params params;
    struct gl_bound bound;
    struct gl_framebuffers framebuffers;
    GLuint no_vertices; // vertex array
    GLuint timestamp;   // query
    struct gl_queries queries;
    struct gl_fixed *fixed; // made by the first draw of a fixed function
    char fault[256];        // the driver's first message since the last gl_check; "": none
    bool labels;            // passes are named for debuggers
    bool is_lost; // the driver reported a lost context, after which nothing more is logged
};

struct gl_buf {
    struct rg_buf pub;
    GLuint id;
    GLuint words; // a texture of the buffer's words; 0 until a kernel needs it
};

struct gl_image {
    struct rg_image pub;
    GLuint id;
    GLuint views[RG_SAMPLERS]; // of native devices, by sampling, with the sampler's state; 0 until
                               // a kernel needs it
};

struct gl_pass {
    struct rg_pass pub;
    GLuint program;
    GLuint blending;       // the program for draws that blend, if it is another; 0: none yet
    unsigned word_slots;   // bits of the slots that are read as textures of words
    size_t params_size;    // parameters of a run, in bytes
    size_t block_size;     // of the uniform block, in bytes
    GLbitfield after_runs; // barriers that make the pass's writes visible
};

// api/egl.c
void gl_search_begin(struct gl_search *search);
// Opens the next target that works and makes its context current; false: none is left.
bool gl_search_next(struct gl_search *search, struct gl_egl *egl);
// api/drivers.c: the places where EGL finds drivers, and the result of backend->list for `count`
// devices found.
extern const struct rg_manifest_rules gl_manifests;
int gl_judge(const struct gl_search *search, int count, char *why, size_t why_size);
// Whether the current context is of the driver that a Mesa variable asks for, or no variable does;
// if not, `why` says so.
bool gl_is_driver_asked(const struct gl_egl *egl, char *why, size_t why_size);
// Makes the search fail if the last opened device did not answer its queries.
void gl_search_check(struct gl_search *search);
// Opens another context on a device's display and makes it current. False, and one logged line, on
// failure.
bool gl_egl_beside(const struct gl_device *device, struct gl_egl *beside);
void gl_egl_close(struct gl_egl *egl);

// backend->functions
int gl_functions(struct rg_device *device, const void **functions, int max);
// Makes the device's context current on this thread, if it is not.
bool gl_use(struct gl_device *device);

// api/error.c

// Turns the driver's messages about errors into the text that gl_check logs.
void gl_debug_begin(struct gl_device *device);
// Whether all calls since the last check succeeded. If not, logs one line that names `call`, the
// error's code and the object ("buffer 'heights'": `kind` is "buffer", `name` is "heights").
bool gl_check(struct gl_device *device, const char *call, const char *kind, const char *name);
// As gl_check, but sees only errors that the driver reported itself, which costs no call.
bool gl_check_reported(struct gl_device *device, const char *call, const char *kind,
                       const char *name);
// Names an object for debuggers.
void gl_label(GLenum type, GLuint id, const char *name);
// Names the calls between the two, if the device has labels.
void gl_group_begin(const struct gl_device *device, const char *name);
void gl_group_end(const struct gl_device *device);

// formats.c

// A format in the driver's memory, and in ours, where rows are packed tightly (gl_images_begin).
struct gl_format {
    GLenum internal, format, type;
};
struct gl_format gl_format(enum rg_format format);

// api/bound.c
void gl_bind_program(struct gl_bound *bound, GLuint id);
void gl_bind_buffer(struct gl_bound *bound, int slot, GLuint id);
void gl_bind_texture(struct gl_bound *bound, int slot, GLuint id);
void gl_bind_image(struct gl_bound *bound, int slot, GLuint id, GLenum format);
void gl_bind_framebuffer(struct gl_bound *bound, GLuint id);
void gl_bind_arguments(struct gl_bound *bound, GLuint id);
// To be called when an object is deleted, which unbinds it, because its number may be reused.
void gl_forget_buffer(struct gl_bound *bound, GLuint id);
void gl_forget_texture(struct gl_bound *bound, GLuint id);
void gl_forget_framebuffer(struct gl_bound *bound, GLuint id);

// api/params.c
bool gl_params_create(struct gl_device *device);
void gl_params_destroy(struct gl_device *device);
// Writes a run's uniform block and binds it to binding 0.
bool gl_params_bind(struct gl_device *device, const struct gl_pass *pass, const struct rg_run *run);

// buf.c
struct rg_buf *gl_buf_create(struct rg_device *device, size_t size, const char *name);
void gl_buf_destroy(struct rg_buf *buf);
bool gl_buf_write(struct rg_buf *buf, size_t offset, const void *data, size_t size);
bool gl_buf_read(struct rg_buf *buf, size_t offset, void *data, size_t size);
// A texture of the buffer's words; 0 and one logged line on failure.
GLuint gl_buf_words(struct rg_buf *buf);

// image.c

// Sets a new context to transfer rows tightly packed.
void gl_images_begin(void);
struct rg_image *gl_image_create(struct rg_device *device, const struct rg_image_desc *desc,
                                 const char *name);
void gl_image_destroy(struct rg_image *image);
bool gl_image_write(struct rg_image *image, int layer, int level, const void *texels);
bool gl_image_read(struct rg_image *image, int layer, int level, void *texels);
bool gl_image_clear(struct rg_image *image, const void *texel);
bool gl_image_make_levels(struct rg_image *image, int first);

// api/sampler.c

// The texture by which a native device's programs sample an image; the image owns it. 0 and one
// logged line on failure.
GLuint gl_image_view(struct rg_image *image, enum rg_sampler sampling);
void gl_image_views_destroy(struct gl_image *image);

// slots.c

// Binds the objects in a run's slots; false and one logged line on failure.
bool gl_slots_bind(struct gl_bound *bound, const struct gl_pass *pass, const struct rg_run *run);
void gl_slot_buffer(struct gl_bound *bound, int slot, const struct rg_buf *buf);
// Binds a buffer as a texture of words; false and one logged line on failure.
bool gl_slot_words(struct gl_bound *bound, int slot, struct rg_buf *buf);

// program.c

// Compiles and links a kernel's stages, in `ways` as of rg_kernel_code; 0 and one logged line on
// failure.
GLuint gl_program_create(struct gl_device *device, const struct rg_kernel *kernel, unsigned ways);
// The slots whose buffers the program reads as textures of words, as bits.
unsigned gl_program_word_slots(GLuint program, const struct rg_kernel *kernel);

// target.c

// The framebuffer of a draw's images, and the depth for counting; NULL and one logged line on
// failure. Valid until the next call.
const struct gl_framebuffer *gl_framebuffer_of(struct gl_device *device,
                                               const struct rg_draw *draw);
// Drops the framebuffers of an image before it is deleted; 0 drops all.
void gl_framebuffers_forget(struct gl_device *device, GLuint image);

// draw.c
bool gl_draw_begin(struct gl_device *device);
void gl_draw_end(struct gl_device *device);
// Draws packed primitives, items or texels. The caller has bound the pass's program, parameters and
// slots.
bool gl_draw(struct gl_device *device, const struct rg_kernel *kernel, const struct rg_run *run);
// backend->can_blend, for the current context
bool gl_can_blend(const struct rg_device *device, const char **word);

// api/query.c

// Draws query by query, and has the driver write the results to the draw's samples. The caller has
// bound everything. False, and one logged line, on failure.
bool gl_draw_queries(struct gl_device *device, const struct rg_kernel *kernel,
                     const struct rg_run *run);
void gl_queries_end(struct gl_device *device);

// pass.c
struct rg_pass *gl_pass_create(struct rg_device *device, const struct rg_kernel *kernel);
void gl_pass_destroy(struct rg_pass *pass);
bool gl_pass_code(struct rg_pass *pass, void **bytes, size_t *size);
bool gl_pass_run(struct rg_pass *pass, const struct rg_run *run);

// api/fixed/fixed.c: backend->fixed_draw, and the end of what it made.
bool gl_fixed_draw(struct rg_device *device, const char *feature,
                   const struct rg_fixed_state *state, struct rg_fixed_picture *picture);
void gl_fixed_close(struct gl_device *device);

// time.c
bool gl_sync(struct rg_device *device);
bool gl_time(struct rg_device *device, int64_t *time_ns);

#endif
