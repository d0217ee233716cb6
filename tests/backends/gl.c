// For the gl backend alone. `gl` runs on the first gl device. `gl TEXT` expects no device, for a
// reason that contains TEXT (tests/meson.build breaks the driver); with `fails`, a driver is there.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "backends/gl/api/fixed/fixed.h"
#include "core/base/log.h"
#include "core/base/memory.h"
#include "core/device/device.h"
#include "kernels/probe/copy_params.h"
#include "tests/kernels/drawing/quads_params.h"

static const char *reason; // why there is no device; NULL: there is one
static enum rg_fault kind; // the reason's kind
static int errors;         // lines logged as errors
static FILE *noise;        // stderr of all

static void count_line(enum rg_log_level level, const char *line, void *user)
{
    (void)line, (void)user;
    errors += level == RG_LOG_ERROR;
}

static int open_device(void **state)
{
    *state = rg_device_open("gl");
    errors = 0;
    return *state ? 0 : -1;
}

static int close_device(void **state)
{
    return rg_device_close(*state) ? 0 : -1;
}

// Changes one word `steps` times, copying it from buffer to buffer and back.
static uint32_t walk(struct rg_device *device, int steps, uint32_t salt)
{
    uint32_t word = 0;
    struct rg_buf *a = rg_buf_create(device, 4, "a"), *b = rg_buf_create(device, 4, "b");
    struct rg_pass *pass = rg_pass_create(device, "probe_copy");
    assert_true(a && b && pass && rg_buf_write(a, 0, &word, 4));
    for (int i = 0; i < steps; i++) {
        struct probe_copy_params params = {1, 1, salt * (uint32_t)i};
        struct rg_run run = {.params = &params,
                             .slots = {[1].buf = i % 2 ? b : a, [2].buf = i % 2 ? a : b},
                             .extent = {1, 1, 1}};
        assert_true(rg_pass_run(pass, &run));
    }
    assert_true(rg_buf_read(steps % 2 ? b : a, 0, &word, 4));
    rg_pass_destroy(pass);
    rg_buf_destroy(a);
    rg_buf_destroy(b);
    return word;
}

static uint32_t expected_walk(int steps, uint32_t salt)
{
    uint32_t word = 0;
    for (int i = 0; i < steps; i++)
        word ^= salt * (uint32_t)i;
    return word;
}

// More runs than the memory for parameters holds at once: each sees its own.
static void queued_runs_keep_their_parameters(void **state)
{
    assert_int_equal(walk(*state, 9001, 0x9e3779b1u), expected_walk(9001, 0x9e3779b1u));
}

// A display ends with its last user. Neither listing nor closing takes it from a living device.
static void devices_and_lists_live_side_by_side(void **state)
{
    static struct rg_device_list list;
    struct rg_device *second = rg_device_open("gl");
    assert_non_null(second);
    for (uint32_t salt = 1; salt < 4; salt++) {
        assert_int_equal(walk(*state, 5, salt), expected_walk(5, salt));
        assert_int_equal(walk(second, 6, salt), expected_walk(6, salt));
        rg_device_list_all(&list);
    }
    assert_true(rg_device_close(second));
    assert_int_equal(walk(*state, 7, 3), expected_walk(7, 3));
}

struct text {
    const char *file, *code;
};

static void in_folder(char path[64], const char *folder, const struct text *text)
{
    snprintf(path, 64, "%s/%s", folder, text->file);
}

// Opens a kernel with its code replaced by `texts`, which end at the first without a file.
static struct rg_pass *open_changed(struct rg_device *device, const char *kernel,
                                    const struct text *texts)
{
    char folder[] = "/tmp/test_gl.XXXXXX", path[64];
    assert_non_null(mkdtemp(folder));
    for (const struct text *text = texts; text->file; text++) {
        in_folder(path, folder, text);
        FILE *file = fopen(path, "w");
        fputs(text->code, file);
        fclose(file);
    }
    setenv("RG_KERNEL_DIR", folder, 1);
    struct rg_pass *pass = rg_pass_create(device, kernel);
    unsetenv("RG_KERNEL_DIR");
    for (const struct text *text = texts; text->file; text++) {
        in_folder(path, folder, text);
        unlink(path);
    }
    rmdir(folder);
    return pass;
}

static void a_kernel_that_does_not_compile_is_one_line(void **state)
{
    const struct text texts[] = {
        {"probe_copy.glsl", "#version 450 core\nvoid main() { missing(1);\nmissing(2); }\n"}, {0}};
    assert_null(open_changed(*state, "probe_copy", texts));
    assert_int_equal(errors, 1);
    assert_non_null(strstr(rg_last_error(), "kernel 'probe_copy': glCompileShader failed on gl: "));
    assert_non_null(strstr(rg_last_error(), "missing"));
    assert_int_equal(rg_failure_take().fault, RG_FAULT_DRIVER);
}

// The groups that were open one in another, and all that were opened, as the driver tells them.
static struct {
    int open, most_open, ended;
    char last[64];
} groups;

static void APIENTRY note_group(GLenum source, GLenum type, GLuint id, GLenum severity,
                                GLsizei length, const GLchar *message, const void *user)
{
    (void)source, (void)id, (void)severity, (void)length, (void)user;
    groups.open += type == GL_DEBUG_TYPE_PUSH_GROUP;
    groups.most_open = groups.open > groups.most_open ? groups.open : groups.most_open;
    if (type == GL_DEBUG_TYPE_PUSH_GROUP)
        snprintf(groups.last, sizeof(groups.last), "%s", message);
    groups.open -= type == GL_DEBUG_TYPE_POP_GROUP;
    groups.ended += type == GL_DEBUG_TYPE_POP_GROUP;
}

// A run of a kernel is a group of its name if RG_LABELS asks for it.
static void runs_are_named_for_debuggers(void **state)
{
    (void)state;
    for (int asked = 0; asked < 2; asked++) {
        if (asked)
            setenv("RG_LABELS", "1", 1);
        struct rg_device *device = rg_device_open("gl");
        unsetenv("RG_LABELS");
        assert_non_null(device);
        glDebugMessageCallback(note_group, NULL);
        glDebugMessageControl(GL_DEBUG_SOURCE_APPLICATION, GL_DONT_CARE, GL_DONT_CARE, 0, NULL,
                              GL_TRUE);
        memset(&groups, 0, sizeof(groups));
        walk(device, 3, 5);
        assert_int_equal(groups.ended, 3 * asked);
        assert_int_equal(groups.most_open, asked);
        assert_int_equal(groups.open, 0);
        assert_string_equal(groups.last, asked ? "probe_copy" : "");
        assert_true(rg_device_close(device));
    }
}

static bool draw_first_fixed(struct rg_device *device)
{
    static unsigned char bytes[RG_FIXED_PICTURE_BYTES];
    struct rg_fixed_picture picture = {.bytes = bytes, .room = sizeof(bytes)};
    return rg_device_fixed_draw(device, rg_fixed_draws[0].feature, &rg_fixed_draws[0].state,
                                &picture);
}

// The same of a draw of a fixed function, which has a context of its own.
static void fixed_functions_are_named_for_debuggers(void **state)
{
    (void)state;
    for (int asked = 0; asked < 2; asked++) {
        if (asked)
            setenv("RG_LABELS", "1", 1);
        struct rg_device *device = rg_device_open("gl");
        unsetenv("RG_LABELS");
        assert_non_null(device);
        assert_true(draw_first_fixed(device));
        assert_true(gl_use(&((struct gl_device *)device)->fixed->own));
        glDebugMessageCallback(note_group, NULL);
        glDebugMessageControl(GL_DEBUG_SOURCE_APPLICATION, GL_DONT_CARE, GL_DONT_CARE, 0, NULL,
                              GL_TRUE);
        memset(&groups, 0, sizeof(groups));
        assert_true(draw_first_fixed(device));
        assert_int_equal(groups.ended, asked);
        assert_int_equal(groups.open, 0);
        assert_string_equal(groups.last, asked ? rg_fixed_draws[0].feature : "");
        assert_true(rg_device_close(device));
    }
}

static void a_program_that_does_not_link_is_one_line(void **state)
{
    const struct text texts[] = {
        {"test_quads.vert", "#version 450 core\nlayout(location = 0) out vec4 a;\n"
                            "void main() { a = gl_Position = vec4(1); }\n"},
        {"test_quads.frag", "#version 450 core\nlayout(location = 0) flat in int a;\n"
                            "out vec4 c;\nvoid main() { c = vec4(a); }\n"},
        {0}};
    assert_null(open_changed(*state, "test_quads", texts));
    assert_int_equal(errors, 1);
    assert_non_null(strstr(rg_last_error(), "kernel 'test_quads': glLinkProgram failed on gl: "));
}

// --- targets ---

// A pass that fills its target, and its objects.
struct filler {
    struct rg_device *device;
    struct rg_pass *pass;
    struct rg_buf *quad, *samples;
};

static struct filler make_filler(struct rg_device *device)
{
    const float quad[TEST_QUAD_WORDS] = {-1,   -1, 0.5f, 1, 1,    -1, 0.5f,  1,    1,     1,
                                         0.5f, 1,  -1,   1, 0.5f, 1,  0.25f, 0.5f, 0.75f, 1};
    struct filler f = {device, rg_pass_create(device, "test_quads"),
                       rg_buf_create_with(device, quad, sizeof(quad), "one quad"),
                       rg_buf_create(device, 4, "samples")};
    assert_true(f.pass && f.quad && f.samples);
    return f;
}

static void destroy_filler(struct filler *f)
{
    rg_pass_destroy(f->pass);
    rg_buf_destroy(f->quad);
    rg_buf_destroy(f->samples);
}

// test_quads skips pixels of the first item for which px ^ py ends in 15.
static int kept_of(int size)
{
    int kept = 0;
    for (int i = 0; i < size * size; i++)
        kept += ((i % size) ^ (i / size)) % 16 != 15;
    return kept;
}

// Fills a layer, and returns how many of its pixels changed from `before`.
static int fill_layer(const struct filler *f, struct rg_draw to, const float before[4])
{
    const test_quads_params p = {0};
    assert_true(rg_pass_run(f->pass, &(struct rg_run){.params = &p,
                                                      .slots = {[1].buf = f->quad},
                                                      .extent = {1, 1, 1},
                                                      .draw = &to}));
    const int count = to.colour->desc.width * to.colour->desc.height;
    float *texels = malloc((size_t)count * 16);
    assert_true(rg_image_read(to.colour, to.layer, 0, texels));
    int changed = 0;
    for (int i = 0; i < count; i++)
        changed += memcmp(texels + 4 * i, before, 16) != 0;
    free(texels);
    return changed;
}

static struct rg_image *cleared(struct rg_device *device, enum rg_format format, int size,
                                int layers, const float *texel)
{
    struct rg_image *image =
        rg_image_create(device, &(struct rg_image_desc){format, size, size, layers, 1}, "target");
    assert_true(image && rg_image_clear(image, texel));
    return image;
}

static int kept_framebuffers(const struct rg_device *device)
{
    int kept = 0;
    for (int i = 0; i < GL_MAX_FRAMEBUFFERS; i++)
        kept += ((const struct gl_device *)device)->framebuffers.kept[i].id != 0;
    return kept;
}

// A driver may give numbers of dead images to new ones: a framebuffer must not outlive its images.
static void framebuffers_go_with_their_images(void **state)
{
    const float black[4] = {0};
    struct filler f = make_filler(*state);
    enum { SIZE = 20 };
    for (int round = 0; round < 8; round++) {
        const float depth = round % 2 ? 0.75f : 0.25f; // the quad is at 0.5
        const bool visible = depth > 0.5f;
        struct rg_image *colour = cleared(*state, RG_RGBA32F, SIZE, 1, black);
        struct rg_image *behind = cleared(*state, RG_D32F, SIZE, 1, &depth);
        struct rg_draw to = {.colour = colour, .depth = behind, .depth_mode = RG_DEPTH_TEST};
        assert_int_equal(fill_layer(&f, to, black), visible ? kept_of(SIZE) : 0);
        uint32_t samples = 0;
        assert_true(rg_buf_write(f.samples, 0, &samples, 4));
        to.samples = f.samples;
        fill_layer(&f, to, black);
        assert_true(rg_buf_read(f.samples, 0, &samples, 4));
        assert_int_equal(samples, visible ? kept_of(SIZE) : 0);
        assert_int_equal(kept_framebuffers(*state), 2);
        rg_image_destroy(behind);
        assert_int_equal(kept_framebuffers(*state), 0);
        rg_image_destroy(colour);
    }
    destroy_filler(&f);
    assert_int_equal(errors, 0);
}

// More targets than are cached, each twice.
static void more_targets_than_are_kept(void **state)
{
    enum { LAYERS = 150, SIZE = 4 };
    const float black[4] = {0};
    struct filler f = make_filler(*state);
    struct rg_image *colour = cleared(*state, RG_RGBA32F, SIZE, LAYERS, black);
    for (int i = 0; i < 2 * LAYERS; i++) {
        const struct rg_draw to = {.colour = colour, .layer = i % LAYERS, .blend = RG_BLEND_ADD};
        assert_int_equal(fill_layer(&f, to, black), kept_of(SIZE));
    }
    assert_int_equal(kept_framebuffers(*state), GL_MAX_FRAMEBUFFERS);
    rg_image_destroy(colour);
    destroy_filler(&f);
    assert_int_equal(errors, 0);
}

static int finishes; // waits for the driver
static void (*wait_for_driver)(void);

static void count_finish(void)
{
    finishes++;
    wait_for_driver();
}

// A clock read after a sync means nothing unless the driver has finished: glFlush returns earlier.
static void a_sync_waits_for_the_driver(void **state)
{
    assert_true(rg_device_sync(*state)); // libepoxy finds the function on its first call
    wait_for_driver = epoxy_glFinish;
    epoxy_glFinish = count_finish;
    finishes = 0;
    const bool ok = rg_device_sync(*state);
    epoxy_glFinish = wait_for_driver;
    assert_true(ok);
    assert_int_equal(finishes, 1);
}

static void what_the_driver_refuses_is_one_line(void **state)
{
    struct rg_device *device = *state;
    const struct rg_limits *limits = &device->info.limits;
    struct rg_image_desc desc = {RG_RGBA32F, limits->max_image_px, limits->max_image_px,
                                 limits->max_image_layers, 1};
    rg_memory_allow(INT64_MAX); // so that the driver is asked
    assert_null(rg_image_create(device, &desc, "all there is"));
    assert_int_equal(errors, 1);
    assert_non_null(strstr(rg_last_error(), "image 'all there is': glTextureStorage3D of "));
    assert_non_null(strstr(rg_last_error(), " texels of RGBA32F, "));
    assert_non_null(strstr(rg_last_error(), " levels, failed on gl with GL_"));
    assert_int_equal(rg_failure_take().fault, RG_FAULT_DRIVER);
    assert_int_equal(walk(device, 3, 5), expected_walk(3, 5));
}

static void a_missing_driver_has_a_reason(void **state)
{
    (void)state;
    static struct rg_device_list list;
    errors = 0;
    rg_device_list_all(&list);
    assert_int_equal(errors, 0);
    const char *line = "";
    for (int i = 0; i < list.missing_count; i++)
        if (!strncmp(list.missing[i].why, "gl: ", 4))
            line = list.missing[i].why;
    if (!strstr(line, reason))
        fail_msg("'%s' does not say '%s'", line, reason);
    assert_null(rg_device_open("gl"));
    assert_int_equal(rg_failure_take().fault, kind);
    assert_int_equal(errors, 1);
    assert_non_null(strstr(rg_last_error(), reason));
}

// Runs last: nothing before it may write to stderr.
static void drivers_are_silent(void **state)
{
    (void)state;
    fflush(stderr);
    rewind(noise);
    char line[256];
    if (fgets(line, sizeof(line), noise))
        fail_msg("on stderr: %s", line);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(queued_runs_keep_their_parameters, open_device,
                                        close_device),
        cmocka_unit_test_setup_teardown(devices_and_lists_live_side_by_side, open_device,
                                        close_device),
        cmocka_unit_test_setup_teardown(a_kernel_that_does_not_compile_is_one_line, open_device,
                                        close_device),
        cmocka_unit_test_setup_teardown(a_program_that_does_not_link_is_one_line, open_device,
                                        close_device),
        cmocka_unit_test_setup_teardown(framebuffers_go_with_their_images, open_device,
                                        close_device),
        cmocka_unit_test_setup_teardown(more_targets_than_are_kept, open_device, close_device),
        cmocka_unit_test_setup_teardown(a_sync_waits_for_the_driver, open_device, close_device),
        cmocka_unit_test_setup_teardown(what_the_driver_refuses_is_one_line, open_device,
                                        close_device),
        cmocka_unit_test(runs_are_named_for_debuggers),
        cmocka_unit_test(fixed_functions_are_named_for_debuggers),
        cmocka_unit_test(drivers_are_silent),
    };
    const struct CMUnitTest without_driver[] = {
        cmocka_unit_test(a_missing_driver_has_a_reason),
        cmocka_unit_test(drivers_are_silent),
    };
    reason = argc > 1 ? argv[1] : NULL;
    kind = argc > 2 && !strcmp(argv[2], "broken") ? RG_FAULT_SETUP : RG_FAULT_NONE;
    cmocka_set_message_output(CM_OUTPUT_TAP);
    rg_log_listen(count_line, NULL);
    noise = tmpfile();
    dup2(fileno(noise), STDERR_FILENO);
    return reason ? cmocka_run_group_tests(without_driver, NULL, NULL)
                  : cmocka_run_group_tests(tests, NULL, NULL);
}
