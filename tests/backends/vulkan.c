// For the vulkan backend alone: validation, batches, staging, absent drivers.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "backends/vulkan/vulkan.h"
#include "core/base/log.h"
#include "core/base/outcome.h"
#include "core/device/device.h"
#include "kernels/probe/copy_params.h"
#include "shaders/fixed/fixed.h"
#include "tests/tools/expect.h"

static int errors;

static void count_errors(enum rg_log_level level, const char *line, void *user)
{
    (void)user;
    errors += level == RG_LOG_ERROR;
    print_message("%s\n", line);
}

static int open_device(void **state)
{
    errors = 0;
    *state = rg_device_open("vulkan");
    return *state ? 0 : -1;
}

// Messages of the driver or of the validation layer while objects are destroyed count as well.
static int close_silently(void **state)
{
    return rg_device_close(*state) && errors == 0 ? 0 : -1;
}

static int close_device(void **state)
{
    return rg_device_close(*state) ? 0 : -1;
}

static bool run_copy(struct rg_pass *pass, struct rg_buf *from, struct rg_buf *to, int words,
                     uint32_t salt)
{
    const struct probe_copy_params params = {words, 1, salt};
    return rg_pass_run(pass, &(struct rg_run){.params = &params,
                                              .slots = {[1].buf = from, [2].buf = to},
                                              .extent = {words, 1, 1}});
}

// More runs than several batches hold, with writes between them that must stay in order.
static void writes_keep_their_place_among_runs(void **state)
{
    enum { WORDS = 1000, RUNS = 500 };
    struct rg_buf *bufs[3];
    for (int i = 0; i < 3; i++)
        assert_non_null(bufs[i] = rg_buf_create(*state, WORDS * 4, "chain"));
    struct rg_pass *pass = rg_pass_create(*state, "probe_copy");
    assert_non_null(pass);
    uint32_t expected[WORDS] = {0}, back[WORDS];
    assert_true(rg_buf_write(bufs[0], 0, expected, sizeof(expected)));
    for (int run = 0; run < RUNS; run++) {
        assert_true(run_copy(pass, bufs[run % 3], bufs[(run + 1) % 3], WORDS, (uint32_t)run));
        for (int i = 0; i < WORDS; i++)
            expected[i] ^= (uint32_t)run;
        if (run % 7 == 0) {
            expected[run] = (uint32_t)run * 2654435761u;
            assert_true(rg_buf_write(bufs[(run + 1) % 3], run * 4, &expected[run], 4));
        }
    }
    assert_true(rg_buf_read(bufs[RUNS % 3], 0, back, sizeof(back)));
    assert_memory_equal(back, expected, sizeof(back));
    rg_pass_destroy(pass);
    for (int i = 0; i < 3; i++)
        rg_buf_destroy(bufs[i]);
}

// Images larger than a staging buffer ever grows, so that they travel in parts.
static void large_images_travel_in_parts(void **state)
{
    const struct rg_image_desc desc = {RG_RGBA32F, 1025, 1030, 1, 1};
    size_t floats = (size_t)desc.width * (size_t)desc.height * 4;
    float *data = malloc(floats * 4), *back = calloc(floats, 4);
    for (size_t i = 0; i < floats; i++)
        data[i] = (float)i;
    struct rg_image *image = rg_image_create(*state, &desc, "large");
    assert_non_null(image);
    assert_true(rg_image_write(image, 0, 0, data));
    assert_true(rg_image_read(image, 0, 0, back));
    assert_memory_equal(back, data, floats * 4);
    rg_image_destroy(image);
    free(data);
    free(back);
}

// Ordinary texels, and some that a driver's conversion from float would change.
static void clears_keep_every_bit(void **state)
{
    static const struct {
        enum rg_format format;
        uint32_t texel[4];
    } cases[] = {
        {RG_RGBA8, {0x01fe807f}},
        {RG_RGBA16F, {0x3c000000, 0x3555c000}},
        {RG_RGBA16F, {0x00018000, 0x7e017c00}}, // subnormal, -0, NaN, infinity
        {RG_RGBA32F, {0x3f800000, 0x00000001, 0x7fc12345, 0x80000000}},
        {RG_R32F, {0x7f812345}},
        {RG_R16F, {0x3555}},
        {RG_R16F, {0x8001}}, // subnormal
        {RG_RG11B10F, {0x781e03c0}},
        {RG_RG11B10F, {0x00400801}}, // subnormals
        {RG_D32F, {0x3f2aaaab}},
        {RG_D32F, {0x3f800000}},
        {RG_D32F, {0x00000001}}, // subnormal
    };
    for (size_t c = 0; c < sizeof(cases) / sizeof(cases[0]); c++) {
        const struct rg_image_desc desc = {cases[c].format, 7, 5, 2, 3};
        size_t size = (size_t)rg_format_size(desc.format);
        struct rg_image *image = rg_image_create(*state, &desc, "cleared");
        assert_non_null(image);
        assert_true(rg_image_clear(image, cases[c].texel));
        char back[7 * 5 * 16];
        for (int layer = 0; layer < desc.layers; layer++) {
            for (int level = 0; level < desc.levels; level++) {
                assert_true(rg_image_read(image, layer, level, back));
                int texels = rg_level_size(desc.width, level) * rg_level_size(desc.height, level);
                for (int i = 0; i < texels; i++)
                    assert_memory_equal(back + (size_t)i * size, cases[c].texel, size);
            }
        }
        rg_image_destroy(image);
    }
}

static void time_never_goes_back(void **state)
{
    int64_t before_ns, after_ns;
    assert_true(rg_device_time(*state, &before_ns));
    assert_true(rg_device_time(*state, &after_ns));
    assert_at_least(after_ns, before_ns);
}

// --- wrong kernels in a folder ---

// Loads `size` bytes as probe_copy's SPIR-V; returns whether the device accepted them.
static bool takes_kernel(struct rg_device *device, const void *bytes, size_t size)
{
    char folder[] = "/tmp/raingauge-test-XXXXXX", path[64];
    assert_non_null(mkdtemp(folder));
    snprintf(path, sizeof(path), "%s/probe_copy.spv", folder);
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    fclose(file);
    setenv("RG_KERNEL_DIR", folder, 1);
    struct rg_pass *pass = rg_pass_create(device, "probe_copy");
    unsetenv("RG_KERNEL_DIR");
    unlink(path);
    rmdir(folder);
    rg_pass_destroy(pass);
    return pass != NULL;
}

static void files_that_are_no_spirv_are_refused(void **state)
{
    assert_false(takes_kernel(*state, "#version 450 core\n", 18));
    assert_non_null(strstr(rg_last_error(), "are no SPIR-V"));
    assert_int_equal(rg_failure_take().fault, RG_FAULT_INPUT); // RG_KERNEL_DIR names the files
    assert_int_equal(errors, 1);
}

// Changes slot 2's binding to 9, which the pipeline's layout lacks. A complaint fails one call, not
// the next.
static void complaints_of_validation_fail_calls(void **state)
{
    struct rg_kernel_code code;
    assert_true(rg_kernel_code(rg_kernel_find("probe_copy"), RG_CODE_SPIRV, false, &code));
    const uint32_t op_decorate = 4u << 16 | 71, binding = 33;
    uint32_t *words = malloc(code.size);
    memcpy(words, code.bytes, code.size);
    for (size_t i = 5; i + 3 < code.size / 4; i++)
        if (words[i] == op_decorate && words[i + 2] == binding && words[i + 3] == 2)
            words[i + 3] = 9;
    assert_false(takes_kernel(*state, words, code.size));
    assert_non_null(strstr(rg_last_error(), "Vulkan validation: "));
    assert_int_equal(rg_failure_take().fault, RG_FAULT_DRIVER);
    free(words);
    assert_true(takes_kernel(*state, code.bytes, code.size));
    free(code.bytes);
}

// The groups that were begun, in the place of the layer's functions.
static int open_groups, begun_groups;
static char last_group[64];

static void VKAPI_CALL begin_group(VkCommandBuffer commands, const VkDebugUtilsLabelEXT *label)
{
    (void)commands;
    open_groups++;
    begun_groups++;
    snprintf(last_group, sizeof(last_group), "%s", label->pLabelName);
}

static void VKAPI_CALL end_group(VkCommandBuffer commands)
{
    (void)commands;
    open_groups--;
}

static bool draw_first_fixed(struct rg_device *device)
{
    static unsigned char bytes[RG_FIXED_PICTURE_BYTES];
    struct rg_fixed_picture picture = {.bytes = bytes, .room = sizeof(bytes)};
    return rg_device_fixed_draw(device, rg_fixed_draws[0].feature, &rg_fixed_draws[0].state,
                                &picture);
}

// A run of a kernel, or a draw of a fixed function, is a group of its name where RG_LABELS or
// validation asks for it.
static void runs_are_named_for_debuggers(void **state)
{
    (void)state;
    unsetenv("RG_VK_VALIDATION");
    for (int asked = 0; asked < 2; asked++) {
        if (asked)
            setenv("RG_LABELS", "1", 1);
        struct rg_device *device = rg_device_open("vulkan");
        struct vk_device *vk = (struct vk_device *)device;
        unsetenv("RG_LABELS");
        assert_non_null(device);
        assert_int_equal(asked, vk->set_name && vk->begin_group && vk->end_group);
        if (asked) {
            vk->begin_group = begin_group;
            vk->end_group = end_group;
        }
        struct rg_buf *a = rg_buf_create(device, 4, "a"), *b = rg_buf_create(device, 4, "b");
        struct rg_pass *pass = rg_pass_create(device, "probe_copy");
        assert_true(a && b && pass && rg_buf_write(a, 0, &asked, 4) && run_copy(pass, a, b, 1, 3) &&
                    run_copy(pass, b, a, 1, 3) && rg_device_sync(device));
        assert_int_equal(begun_groups, 2 * asked);
        assert_int_equal(open_groups, 0);
        assert_string_equal(last_group, asked ? "probe_copy" : "");
        assert_true(draw_first_fixed(device));
        assert_int_equal(begun_groups, 3 * asked);
        assert_int_equal(open_groups, 0);
        assert_string_equal(last_group, asked ? rg_fixed_draws[0].feature : "");
        rg_pass_destroy(pass);
        rg_buf_destroy(a);
        rg_buf_destroy(b);
        assert_true(rg_device_close(device));
    }
    setenv("RG_VK_VALIDATION", "1", 1);
}

// A complaint about commands of a run names its kernel: nothing is bound that could be dispatched.
static void complaints_name_the_kernel(void **state)
{
    struct vk_device *vk = *state;
    struct vk_batch *batch = vk_record(vk);
    assert_non_null(batch);
    vk_group_begin(vk, batch->commands, "our kernel");
    vkCmdDispatch(batch->commands, 1, 1, 1);
    vk_group_end(vk, batch->commands);
    assert_false(vk_healthy(vk));
    assert_non_null(strstr(rg_last_error(), "Vulkan validation: kernel 'our kernel': "));
    rg_failure_take();
    batch->recording = false; // it is never submitted
}

static void drivers_that_are_named_and_are_not_there_fail(void **state)
{
    (void)state;
    char *kept = getenv("VK_DRIVER_FILES") ? strdup(getenv("VK_DRIVER_FILES")) : NULL;
    setenv("VK_DRIVER_FILES", "/nonexistent.json", 1);
    errors = 0;
    struct rg_device *device = rg_device_open("vulkan");
    if (kept)
        setenv("VK_DRIVER_FILES", kept, 1);
    else
        unsetenv("VK_DRIVER_FILES");
    free(kept);
    assert_null(device);
    assert_int_equal(rg_failure_take().fault, RG_FAULT_SETUP);
    assert_int_equal(errors, 1);
    assert_non_null(strstr(rg_last_error(), "VK_ERROR_INCOMPATIBLE_DRIVER"));
    assert_non_null(
        strstr(rg_last_error(),
               "VK_DRIVER_FILES names '/nonexistent.json', which cannot be read: No such file"));
}

int main(void)
{
    setenv("RG_VK_VALIDATION", "1", 1);
    rg_log_listen(count_errors, NULL);
    const int skipped = 77;
    struct rg_device *device = rg_device_open("vulkan");
    if (!device && rg_failure_take().outcome == RG_UNSUPPORTED)
        return skipped;
    rg_device_close(device);
#define SILENT(test) cmocka_unit_test_setup_teardown(test, open_device, close_silently)
#define LOUD(test)   cmocka_unit_test_setup_teardown(test, open_device, close_device)
    const struct CMUnitTest tests[] = {
        SILENT(writes_keep_their_place_among_runs),
        SILENT(large_images_travel_in_parts),
        SILENT(clears_keep_every_bit),
        SILENT(time_never_goes_back),
        LOUD(files_that_are_no_spirv_are_refused),
        LOUD(complaints_of_validation_fail_calls),
        LOUD(complaints_name_the_kernel),
        cmocka_unit_test(runs_are_named_for_debuggers),
        cmocka_unit_test(drivers_that_are_named_and_are_not_there_fail),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
