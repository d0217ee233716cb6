#include "backends/gl/gl.h"

#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "backends/labels.h"
#include "core/base/alloc.h"
#include "core/base/log.h"

static int integer(GLenum what)
{
    GLint value = 0;
    glGetIntegerv(what, &value);
    return value;
}

static struct rg_limits read_limits(void)
{
    GLint64 storage_bytes = 0, words = 0; // kernels read buffers as either
    glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &storage_bytes);
    glGetInteger64v(GL_MAX_TEXTURE_BUFFER_SIZE, &words);
    struct rg_limits limits = {
        .max_objects = INT_MAX,
        .max_buffer_bytes = words * 4 < storage_bytes ? words * 4 : storage_bytes,
        .max_image_px = integer(GL_MAX_TEXTURE_SIZE),
        .max_image_layers = integer(GL_MAX_ARRAY_TEXTURE_LAYERS),
        .group_items = GL_GROUP_ITEMS,
        .slot_count = {RG_MAX_SLOTS, RG_MAX_SLOTS, RG_MAX_SLOTS},
        // A slot is the binding of the same number, so the driver must have that many.
        .slot_end = {.buffers = integer(GL_MAX_SHADER_STORAGE_BUFFER_BINDINGS),
                     .images = integer(GL_MAX_COMBINED_TEXTURE_IMAGE_UNITS),
                     .out_images = integer(GL_MAX_IMAGE_UNITS)},
        .has_clock = true,
        .has_queries = true,
    };
    // OpenGL 4.5 requires all formats for all uses.
    for (int f = RG_FORMAT_NONE + 1; f < RG_FORMAT_COUNT; f++)
        limits.formats[f] =
            (struct rg_format_limits){RG_USE_ALL | RG_USE_FILTER, limits.max_image_px,
                                      limits.max_image_layers, RG_MAX_LEVELS, INT64_MAX};
    for (GLuint axis = 0; axis < 3; axis++) {
        GLint64 groups = 0;
        glGetInteger64i_v(GL_MAX_COMPUTE_WORK_GROUP_COUNT, axis, &groups);
        limits.max_groups[axis] = groups < INT_MAX ? (int)groups : INT_MAX;
    }
    return limits;
}

static const char *text(GLenum what)
{
    const GLubyte *value = glGetString(what);
    return value ? (const char *)value : "unnamed";
}

// The driver's version: "Mesa 22.3.6" from "4.5 (Core Profile) Mesa 22.3.6", "NVIDIA 550.54" from
// "4.5.0 NVIDIA 550.54".
static const char *driver_version(void)
{
    const char *version = text(GL_VERSION);
    const char *driver = strchr(version, ' ');
    if (driver && driver[1] == '(')
        driver = strstr(driver, ") ") ? strstr(driver, ") ") + 1 : driver;
    return driver ? driver + 1 : version;
}

// Fills `info` from the current context; `index` is the device's.
static void describe(int index, const struct gl_egl *egl, struct rg_device_info *info)
{
    const char *renderer = text(GL_RENDERER);
    *info = (struct rg_device_info){
        .software = egl->software || strstr(renderer, "llvmpipe"),
        .limits = read_limits(),
    };
    info->tier = info->software ? RG_T0 : RG_T1;
    snprintf(info->name, sizeof(info->name), index ? "gl:%d" : "gl", index);
    snprintf(info->device, sizeof(info->device), "%s", renderer);
    snprintf(info->driver, sizeof(info->driver), "%s", driver_version());
    snprintf(info->api, sizeof(info->api), "OpenGL %d.%d core", integer(GL_MAJOR_VERSION),
             integer(GL_MINOR_VERSION));
}

static int gl_list(struct rg_device_info *infos, int max, char *why, size_t why_size)
{
    struct gl_search search;
    struct gl_egl egl;
    int count = 0;
    gl_search_begin(&search);
    while (count < max && gl_search_next(&search, &egl)) {
        describe(count, &egl, &infos[count]);
        gl_search_check(&search);
        count++;
        gl_egl_close(&egl);
    }
    return gl_judge(&search, count, why, why_size);
}

// Opens the device at `index` of the list and makes its context current.
static bool open_at(int index, struct gl_egl *egl)
{
    struct gl_search search;
    gl_search_begin(&search);
    for (int at = 0; gl_search_next(&search, egl); at++) {
        if (at == index)
            return true;
        gl_egl_close(egl);
    }
    return rg_driver_error("device 'gl:%d': %s", index,
                           search.why[0] ? search.why : "its driver opens no more");
}

static bool gl_destroy(struct rg_device *device)
{
    struct gl_device *gl = (struct gl_device *)device;
    gl_fixed_close(gl);
    if (gl_use(gl)) {
        gl_params_destroy(gl);
        gl_draw_end(gl);
        glDeleteQueries(1, &gl->timestamp);
    }
    gl_egl_close(&gl->egl);
    free(gl);
    return true;
}

static struct rg_device *gl_create(int index)
{
    struct gl_device *gl = rg_alloc(1, sizeof(*gl), "device 'gl'");
    if (!gl)
        return NULL;
    if (!open_at(index, &gl->egl)) {
        free(gl);
        return NULL;
    }
    describe(index, &gl->egl, &gl->pub.info);
    gl->labels = rg_labels_are_asked();
    gl_debug_begin(gl);
    gl_images_begin();
    glCreateQueries(GL_TIMESTAMP, 1, &gl->timestamp);
    if (!gl_params_create(gl) || !gl_draw_begin(gl)) {
        gl_destroy(&gl->pub);
        return NULL;
    }
    return &gl->pub;
}

const struct rg_backend rg_backend_gl = {
    .name = "gl",
    .package = GL_PACKAGE,
    .rough = true,
    .takes_glsl = true,
    .packed = true,
    .list = gl_list,
    .create = gl_create,
    .can_blend = gl_can_blend,
    .functions = gl_functions,
    .destroy = gl_destroy,
    .buf_create = gl_buf_create,
    .buf_destroy = gl_buf_destroy,
    .buf_write = gl_buf_write,
    .buf_read = gl_buf_read,
    .image_create = gl_image_create,
    .image_destroy = gl_image_destroy,
    .image_write = gl_image_write,
    .image_read = gl_image_read,
    .image_clear = gl_image_clear,
    .image_make_levels = gl_image_make_levels,
    .pass_create = gl_pass_create,
    .pass_destroy = gl_pass_destroy,
    .pass_code = gl_pass_code,
    .pass_run = gl_pass_run,
    .fixed_draw = gl_fixed_draw,
    .sync = gl_sync,
    .time = gl_time,
};
