// The kernel that causes a difference, alone with the items and inputs that it needs, and the
// folder of files about it: on two devices that are made up.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/base/log.h"
#include "harness/compare/shrink/folder.h"
#include "tests/harness/verifying/shrinking/made.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/folder.h"
#include "tests/tools/process/logged.h"

// --- the kernel, its items and inputs ---

enum { INPUTS = 64, NEEDED = 20 };

static const struct rg_slot_info in_and_out[] = {
    {"before", 1, RG_SLOT_IN, 4, RG_FORMAT_NONE, "u", 0},
    {"after", 2, RG_SLOT_OUT, 4, RG_FORMAT_NONE, "u", 0}};
static const struct rg_kernel right = {.name = "right", .slot_count = 2, .slots = in_and_out},
                              wrong = {.name = "wrong", .slot_count = 2, .slots = in_and_out};

// Two dispatches of a stage: one of `right`, one of `wrong`, over the same items and inputs.
static struct rg_dispatched two[2];
static uint32_t inputs[INPUTS];

static enum made_way ends; // how the device's dispatch ends that it gets wrong

static enum made_way ends_so_at_one_item(const struct rg_dispatched *d)
{
    const struct rg_extent *from = &d->origin, *by = &d->extent;
    const bool has_item = from->width <= 88 && 88 < from->width + by->width && from->height <= 3 &&
                          3 < from->height + by->height && from->depth <= 1 &&
                          1 < from->depth + by->depth;
    const bool is = d->kernel == &wrong && has_item && ((uint32_t *)d->before[1].bytes)[NEEDED];
    return is ? ends : MADE_SAME;
}

static int prepare(void **state)
{
    made_reset(state);
    for (int i = 0; i < INPUTS; i++)
        inputs[i] = (uint32_t)i + 1;
    for (int i = 0; i < 2; i++) {
        two[i] = (struct rg_dispatched){.kernel = i ? &wrong : &right,
                                        .was_kept = true,
                                        .origin = {64, 0, 0},
                                        .extent = {100, 9, 4}};
        two[i].before[1] = (struct rg_contents){.size = sizeof(inputs), .bytes = inputs};
    }
    made_dispatches = (struct rg_dispatches){.count = 2, .rows = two};
    made_dispatch = ends_so_at_one_item;
    ends = MADE_OTHER;
    return 0;
}

static const struct rg_blame blame_of_step = {
    .found = true, .first = {.frame = 1, .stages_run = 1, .stage = "rain_step", .asset = "water"}};

static bool find(const struct rg_blame *blame, const struct rg_fall *fall, double end_ms,
                 struct rg_culprit *culprit)
{
    const struct rg_digest_run run = {.subject = {.technique = &made_technique}, .frames = 2};
    const bool ok = rg_culprit_find(&run, blame, fall, &made_device, &made_truth, end_ms, culprit);
    log_forget();
    rg_log_listen(log_last, NULL);
    rg_error("later errors are told"); // though those of the search are not
    rg_log_listen(NULL, NULL);
    assert_string_equal(logged, "later errors are told");
    return ok;
}

// One item of 3600 remains, the one that differs, and of 64 inputs the part of 64 bytes with the
// one that it needs. The results are those of the truth, for these.
static void expect_one_item(const struct rg_culprit *culprit)
{
    const struct rg_dispatched *d = &culprit->due;
    assert_true(culprit->found);
    assert_string_equal(d->kernel->name, "wrong");
    assert_int_equal(culprit->of_items, 3600);
    assert_int_equal(culprit->items, 1);
    assert_int_equal(d->origin.width, 88);
    assert_int_equal(d->origin.height, 3);
    assert_int_equal(d->origin.depth, 1);
    assert_int_equal(d->extent.width * d->extent.height * d->extent.depth, 1);
    for (uint32_t i = 0; i < INPUTS; i++) {
        const uint32_t due = i >= 16 && i < 32 ? i + 1 : 0;
        assert_int_equal(((uint32_t *)d->before[1].bytes)[i], due);
        assert_int_equal(((uint32_t *)d->after[2].bytes)[i], due + 1);
    }
}

static void a_kernel_is_found_with_what_it_needs(void **state)
{
    (void)state;
    struct rg_culprit culprit;
    assert_true(find(&blame_of_step, NULL, 1, &culprit));
    expect_one_item(&culprit);
    assert_string_equal(culprit.why_not, "");
    rg_culprit_free(&culprit);
    assert_false(culprit.found);
}

static void a_kernel_that_fails_is_found_too(void **state)
{
    (void)state;
    rg_log_listen(log_last, NULL);
    struct rg_culprit culprit;
    const struct rg_fall fall = {.outcome = RG_CRASH};
    ends = MADE_CRASH;
    assert_true(find(&blame_of_step, &fall, 1, &culprit));
    expect_one_item(&culprit);
    rg_culprit_free(&culprit);
    // A failure that is not sought, and one that is no failure of the driver.
    assert_false(find(&blame_of_step, NULL, 1, &culprit));
    rg_culprit_free(&culprit);
    ends = MADE_REFUSED;
    assert_false(find(&blame_of_step, &fall, 1, &culprit));
    rg_culprit_free(&culprit);
    rg_log_listen(NULL, NULL);
}

// Without time nothing is reduced; the kernel is found all the same.
static void without_time_a_kernel_stays_whole(void **state)
{
    (void)state;
    struct rg_culprit culprit;
    assert_true(find(&blame_of_step, NULL, 0, &culprit));
    assert_true(culprit.found);
    assert_int_equal(culprit.items, 3600);
    assert_int_equal(culprit.due.extent.width, 100);
    assert_memory_equal(culprit.due.before[1].bytes, inputs, sizeof(inputs));
    rg_culprit_free(&culprit);
}

static void why_there_is_none_is_told(void **state)
{
    (void)state;
    const struct rg_fall fall = {.outcome = RG_CRASH};
    const struct rg_blame opening = {.first = {.asset = "water"}};
    static const struct {
        bool is_opening, falls, is_drawn, has_packer;
        const char *says;
    } cases[] = {
        {.is_opening = true,
         .says = "water differs before the first stage runs; what opening does is not kept"},
        {.says = "no kernel of stage rain_step leaves other bits alone: what differs is between "
                 "kernels, such as their order, barriers or memory"},
        {.falls = true,
         .says = "no kernel of stage rain_step fails alone: what it needs is between kernels, such "
                 "as their order, barriers or memory"},
        {.is_drawn = true,
         .says = "rain_step draws: no kernel packs it; what differs is the drawing itself, which "
                 "needs raingauge"},
        {.is_drawn = true,
         .has_packer = true,
         .says = "rain_step draws, and trusted has none of the kernels that pack it for doubtful; "
                 "to try these, hold gl, vulkan or opencl for the truth"},
    };
    made_dispatch = NULL; // nothing is wrong
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); i++) {
        struct rg_culprit culprit;
        two[0].was_kept = !cases[i].is_drawn;
        made_dispatches.count = cases[i].is_drawn && !cases[i].has_packer ? 1 : 2;
        assert_true(find(cases[i].is_opening ? &opening : &blame_of_step,
                         cases[i].falls ? &fall : NULL, 1, &culprit));
        assert_false(culprit.found);
        assert_string_equal(culprit.why_not, cases[i].says);
        rg_culprit_free(&culprit);
    }
}

// --- the folder of its files ---

static const struct rg_slot_info slots[] = {
    {"blurred", 1, RG_SLOT_IN, 4, RG_FORMAT_NONE, "f", 0},
    {"shown", 2, RG_SLOT_OUT_IMAGE, 0, RG_RGBA16F, NULL, 0},
    {"depth", 3, RG_SLOT_IMAGE, 0, RG_D32F, NULL, RG_SAMPLED_SHADOW},
    {"water", 4, RG_SLOT_INOUT, 8, RG_FORMAT_NONE, "ff", 0},
    {"count", 5, RG_SLOT_ATOMIC, 4, RG_FORMAT_NONE, "u", 0}};
static const struct rg_kernel kernel = {
    .name = "rain_step", .params_size = 12, .slot_count = 5, .slots = slots};

static char path[64], kernel_folder[80];
// Contents of slots before and after: patterns with gaps.
static unsigned char before[6][80], after[6][80];

static void make_slot(struct rg_dispatched *d, int slot, size_t size, struct rg_image_desc desc)
{
    for (size_t i = 0; i < size; i++) {
        before[slot][i] = i % 24 < 12 ? 0 : (unsigned char)(i + (size_t)slot);
        after[slot][i] = i % 32 < 12 ? 0 : i > 60 ? (unsigned char)(i + 100) : before[slot][i];
    }
    d->before[slot] = (struct rg_contents){desc, size, before[slot]};
    d->after[slot] = (struct rg_contents){desc, size, after[slot]};
}

static struct rg_culprit culprit_of_all_slots(void)
{
    struct rg_culprit culprit = {.found = true, .items = 140, .of_items = 3600};
    struct rg_dispatched *d = &culprit.due;
    d->kernel = &kernel;
    d->origin = (struct rg_extent){64, 3, 1};
    d->extent = (struct rg_extent){70, 2, 1};
    memcpy(d->params, (int[]){7, 0, 9}, 12);
    make_slot(d, 1, 64, (struct rg_image_desc){0});
    make_slot(d, 2, 64, (struct rg_image_desc){RG_RGBA16F, 4, 2, 1, 1});
    make_slot(d, 3, 80, (struct rg_image_desc){RG_D32F, 4, 4, 1, 2});
    make_slot(d, 4, 32, (struct rg_image_desc){0});
    make_slot(d, 5, 8, (struct rg_image_desc){0});
    return culprit;
}

// A file of the folder, with a zero behind it; the caller frees it.
static char *load(const char *name, size_t *size)
{
    char file_path[160];
    snprintf(file_path, sizeof(file_path), "%s/%s", kernel_folder, name);
    FILE *file = fopen(file_path, "rb");
    if (!file)
        fail_msg("%s is not there", file_path);
    char *bytes = calloc(1, 1 << 15);
    assert_non_null(bytes);
    *size = fread(bytes, 1, (1 << 15) - 1, file);
    fclose(file);
    return bytes;
}

// Puts the parts of a file over what was there: each part's start, size and bytes.
static void put_parts(const char *name, unsigned char *to, size_t room)
{
    size_t size;
    char *parts = load(name, &size);
    uint32_t head[2];
    for (size_t at = 0; at < size; at += sizeof(head) + head[1]) {
        assert_at_most(at + sizeof(head), size);
        memcpy(head, parts + at, sizeof(head));
        assert_at_most((size_t)head[0] + head[1], room);
        assert_at_most(at + sizeof(head) + head[1], size);
        memcpy(to + head[0], parts + at + sizeof(head), head[1]);
    }
    free(parts);
}

static void write_folder(void)
{
    const struct rg_culprit culprit = culprit_of_all_slots();
    assert_true(rg_kernel_folder_write(path, &culprit, "a note", &made_device, &made_truth));
}

// Vulkan's numbers of types, formats and aspects, and work groups of 64 items along x.
static void the_manifest_says_what_is_bound(void **state)
{
    (void)state;
    static const char *const due[] = {
        "# One run of the compute shader rain_step, of 140 items of 3600: from (64, 3, 1) on,\n"
        "# 70 x 2 x 1. README says how to run it.\n",
        "\ngroups 2 2 1\n",
        "\nconstants 0 0\n",
        "\nslot 0 type 6 format 0 aspect 0 texel 0 size 0 x 0 layers 0 levels 0 "
        "view 0 filter 0 wrap 0 compare 0 bytes 48 "
        "00-block.before - # the first item and the end, 4 ints each, then the parameters\n",
        "\nslot 1 type 7 format 0 aspect 0 texel 0 size 0 x 0 layers 0 levels 0 "
        "view 0 filter 0 wrap 0 compare 0 bytes 64 "
        "01-blurred.before - # blurred, 16 elements of 4 bytes, read\n",
        "\nslot 2 type 3 format 97 aspect 1 texel 8 size 4 x 2 layers 1 levels 1 "
        "view 5 filter 0 wrap 2 compare 0 bytes 64 "
        "02-shown.before 02-shown.expected # shown, an image of RGBA16F, written\n",
        "\nslot 3 type 1 format 126 aspect 2 texel 4 size 4 x 4 layers 1 levels 2 "
        "view 5 filter 0 wrap 2 compare 0 bytes 80 "
        "03-depth.before - # depth, an image of D32F, read\n",
        "\nslot 4 type 7 format 0 aspect 0 texel 0 size 0 x 0 layers 0 levels 0 "
        "view 0 filter 0 wrap 0 compare 0 bytes 32 "
        "04-water.before 04-water.expected # water, 4 elements of 8 bytes, read and written\n",
        "\nslot 5 type 7 format 0 aspect 0 texel 0 size 0 x 0 layers 0 levels 0 "
        "view 0 filter 0 wrap 0 compare 0 bytes 8 "
        "05-count.before 05-count.expected # count, 2 elements of 4 bytes, read and written\n",
    };
    size_t size;
    write_folder();
    char *manifest = load("kernel.txt", &size);
    for (size_t i = 0; i < sizeof(due) / sizeof(due[0]); i++)
        if (!strstr(manifest, due[i]))
            fail_msg("no %s in\n%s", due[i], manifest);
    free(manifest);
}

static void files_hold_inputs_and_results(void **state)
{
    (void)state;
    static const char *const names[] = {NULL,       "01-blurred", "02-shown",
                                        "03-depth", "04-water",   "05-count"};
    static const size_t sizes[] = {0, 64, 64, 80, 32, 8};
    write_folder();
    for (int slot = 1; slot <= 5; slot++) {
        unsigned char held[80] = {0};
        char name[64];
        snprintf(name, sizeof(name), "%s.before", names[slot]);
        put_parts(name, held, sizes[slot]);
        assert_memory_equal(held, before[slot], sizes[slot]);
        if (slot == 1 || slot == 3) // only read
            continue;
        snprintf(name, sizeof(name), "%s.expected", names[slot]);
        put_parts(name, held, sizes[slot]);
        assert_memory_equal(held, after[slot], sizes[slot]);
    }
    const int block[12] = {64, 3, 1, 0, 134, 5, 2, 0, 7, 0, 9, 0};
    unsigned char held[48] = {0};
    put_parts("00-block.before", held, sizeof(held));
    assert_memory_equal(held, block, sizeof(block));
}

static void files_hold_code_and_what_it_is(void **state)
{
    (void)state;
    static const char *const due[][2] = {
        {"kernel.spv", "SPIR-V of rain_step for doubtful"},
        {"kernel.comp", "GLSL of rain_step for doubtful"},
        {"kernel.cl", "OpenCL C of rain_step for doubtful"},
        {"README", "The compute shader rain_step leaves other bits on doubtful\n"
                   "(a card, a driver 1.2, an API 3)\n"
                   "than on trusted, which is held for the truth. raingauge found it as\n\n"
                   "    a note\n\n"},
        {"run.c", "// Runs the shaders here as kernel.txt describes"}};
    write_folder();
    for (int i = 0; i < 5; i++) {
        size_t size;
        char *text = load(due[i][0], &size);
        assert_memory_equal(text, due[i][1], strlen(due[i][1]));
        if (i < 3)
            assert_int_equal(size, strlen(due[i][1]));
        free(text);
    }
}

static void touch(const char *name)
{
    char file_path[160];
    snprintf(file_path, sizeof(file_path), "%s/%s", kernel_folder, name);
    FILE *file = fopen(file_path, "w");
    assert_non_null(file);
    fclose(file);
}

static int count_files(void)
{
    int count = 0;
    DIR *all = opendir(kernel_folder);
    assert_non_null(all);
    for (struct dirent *entry; (entry = readdir(all));)
        count += *entry->d_name != '.';
    closedir(all);
    return count;
}

// A new case removes files of an earlier one, and none that raingauge did not write.
static void files_of_an_earlier_case_go(void **state)
{
    (void)state;
    static const char *const strange[] = {"notes.txt", "7-old.before", "07_old.before",
                                          "07-old.after", "kernel.txt.bak"};
    char file_path[160];
    write_folder();
    const int written = count_files();
    assert_int_equal(written, 6 + 6 + 3); // texts, contents before, contents after
    touch("07-old.before");
    touch("07-old.expected");
    for (int i = 0; i < 5; i++)
        touch(strange[i]);
    write_folder();
    assert_int_equal(count_files(), written + 5);
    rg_kernel_folder_remove(path);
    assert_int_equal(count_files(), 5);
    for (int i = 0; i < 5; i++) {
        snprintf(file_path, sizeof(file_path), "%s/%s", kernel_folder, strange[i]);
        assert_int_equal(unlink(file_path), 0);
    }
    rg_kernel_folder_remove(path);
    assert_int_equal(access(kernel_folder, F_OK), -1);
    rg_kernel_folder_remove(path); // nothing is there
}

static int make_parent(void **state)
{
    if (make_folder(state))
        return -1;
    snprintf(path, sizeof(path), "%s/case", folder);
    snprintf(kernel_folder, sizeof(kernel_folder), "%s.kernel", path);
    return 0;
}

static int remove_parent(void **state)
{
    rg_kernel_folder_remove(path);
    return remove_folder(state);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(a_kernel_is_found_with_what_it_needs, prepare),
        cmocka_unit_test_setup(a_kernel_that_fails_is_found_too, prepare),
        cmocka_unit_test_setup(without_time_a_kernel_stays_whole, prepare),
        cmocka_unit_test_setup(why_there_is_none_is_told, prepare),
        cmocka_unit_test(the_manifest_says_what_is_bound),
        cmocka_unit_test(files_hold_inputs_and_results),
        cmocka_unit_test(files_hold_code_and_what_it_is),
        cmocka_unit_test(files_of_an_earlier_case_go),
    };
    return cmocka_run_group_tests_name("culprits", tests, make_parent, remove_parent);
}
