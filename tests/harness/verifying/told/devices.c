// What `diff` tells of several devices: which pairs hold their tiers, which device is blamed, which
// gave no picture, and the exit status. The devices are made up: a value of each one's pictures is
// all that differs.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/base/log.h"
#include "harness/compare/blame/blame.h"
#include "harness/compare/diff/devices.h"
#include "harness/console/exit.h"
#include "harness/devices/frames/frame.h"
#include "harness/record/passport/driver.h"
#include "harness/record/passport/passport.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/folder.h"
#include "tests/tools/process/printed.h"

// --- stand-ins ---

enum { SIDE_PX = 16, RAIN_PX = 10 };

// A device, and the red of its rain; below 0: it gives no picture, by one of these failures.
struct made {
    struct rg_device device;
    float red;
};
enum { UNABLE = -1, TIRED = -2, REFUSED = -3 };

#define MADE(name_, tier_, ...)                                                                    \
    {                                                                                              \
        .device.info = {.name = name_, .full = name_, .tier = tier_, __VA_ARGS__ }                 \
    }
static struct made reference = MADE("cpu:reference", RG_T0), cpu = MADE("cpu", RG_T0),
                   gl = MADE("gl", RG_T1), vulkan = MADE("vulkan", RG_T1),
                   software = MADE("opencl", RG_T0),
                   native = MADE("gl:native", RG_T2, .native = true);

static struct rg_devices devices; // that are opened
static const struct rg_device *blamed, *trusted, *drawn_natively;
static bool has_blame;

int rg_devices_open_asked(const struct rg_devices_asked *asked, struct rg_devices *opened)
{
    (void)asked;
    *opened = devices;
    return RG_EXIT_PASS;
}

struct rg_device *rg_devices_open_one(const char *name)
{
    assert_string_equal(name, "cpu");
    return &cpu.device;
}

bool rg_device_close(struct rg_device *device)
{
    assert_ptr_equal(device, &cpu.device);
    return true;
}

int rg_devices_end(struct rg_devices *opened, int exit)
{
    assert_int_equal(opened->count, devices.count);
    return exit;
}

static bool draw(float red, struct rg_picture *picture)
{
    assert_true(rg_picture_create(picture, SIDE_PX, SIDE_PX, 4, "rain"));
    for (int i = 0; i < SIDE_PX * SIDE_PX; i++)
        for (int c = 0; c < 4; c++)
            picture->texels[4 * i + c] = c == 3 ? 1 : !c && i % 25 == 3 && i < 250 ? red : 0;
    return true;
}

bool rg_frame_draw(struct rg_device *device, const struct rg_subject *subject, int frames,
                   struct rg_picture *picture)
{
    const struct made *made = (const struct made *)device; // its first member
    assert_int_equal(frames, 7);
    assert_int_equal(subject->width, SIDE_PX);
    const int failure = (int)made->red;
    return failure == UNABLE    ? rg_unsupported("%s: too small", device->info.name)
           : failure == TIRED   ? rg_driver_error("%s: is tired", device->info.name)
           : failure == REFUSED ? rg_error("%s: a file is not there", device->info.name)
                                : draw(made->red, picture);
}

bool rg_frame_draw_dry(struct rg_device *device, const struct rg_subject *subject, int frames,
                       struct rg_picture *picture)
{
    (void)device;
    (void)subject;
    assert_int_equal(frames, 7);
    return draw(0, picture);
}

bool rg_frame_compare_rain(struct rg_device *device, const struct rg_subject *subject, int frames,
                           const struct rg_device_info *other, const struct rg_picture *expected,
                           const struct rg_picture *dry, const struct rg_picture *picture,
                           float exposure, struct rg_comparison *comparison)
{
    (void)subject;
    (void)frames;
    assert_false(other->native);
    drawn_natively = device;
    return rg_compare(expected, other->name, picture, device->info.name, dry,
                      &(struct rg_compare_options){.exposure = exposure}, comparison);
}

void rg_frame_tell_dry(struct rg_device *device, const struct rg_subject *subject, int frames,
                       float exposure, const char *option, char text[RG_FRAME_DRY])
{
    (void)device;
    (void)subject;
    snprintf(text, RG_FRAME_DRY, "no rain at %s %d and exposure %g", option, frames,
             (double)exposure);
}

bool rg_blame_find(const struct rg_digest_run *run, struct rg_device *device,
                   struct rg_device *truth, struct rg_blame *blame)
{
    assert_int_equal(run->frames, 7);
    blamed = device;
    trusted = truth;
    *blame = (struct rg_blame){.found = has_blame, .text = "frame 7, stage rain"};
    return true;
}

void rg_drivers_print(const struct rg_device_info *const infos[], int count, FILE *out)
{
    for (int i = 0; i < count; i++)
        fprintf(out, "%s;", infos[i]->name);
    fprintf(out, "\n");
}

json_t *rg_passport_devices(const struct rg_device_info *const infos[], int count)
{
    json_t *all = json_array();
    for (int i = 0; i < count; i++)
        json_array_append_new(all, json_string(infos[i]->name));
    return all;
}

// --- the tests' own ---

static void open_devices(int count, struct made *const *all)
{
    devices = (struct rg_devices){.count = count};
    for (int i = 0; i < count; i++)
        devices.devices[i] = &all[i]->device;
    blamed = trusted = drawn_natively = NULL;
    has_blame = true;
}

#define OPEN(...)                                                                                  \
    open_devices(sizeof((struct made *[]){__VA_ARGS__}) / sizeof(struct made *),                   \
                 (struct made *[]){__VA_ARGS__})

static char last[512]; // line of the log

static void listen(enum rg_log_level level, const char *line, void *user)
{
    (void)user;
    if (level == RG_LOG_ERROR)
        snprintf(last, sizeof(last), "%s", line);
}

// Runs `diff` on these devices, and returns what it prints; the caller frees it.
static const char *run(bool json, const char *prefix, int *exit)
{
    static const struct rg_param_table none = {.technique = "made"};
    static const struct rg_technique made = {.name = "made", .params = &none};
    char names[] = "these";
    const struct rg_devices_asked asked = {.names = names};
    const struct rg_diff_devices_request request = {.subject = {&made, NULL, SIDE_PX, SIDE_PX},
                                                    .devices = &asked,
                                                    .frames = 7,
                                                    .heatmap_prefix = prefix,
                                                    .json = json};
    *last = 0;
    rg_log_listen(listen, NULL);
    printed_begin();
    *exit = rg_diff_devices(&request);
    rg_log_listen(NULL, NULL);
    return printed_end();
}

static json_t *run_json(const char *prefix, int *exit)
{
    const char *text = run(true, prefix, exit);
    json_t *json = json_loads(text, 0, NULL);
    assert_non_null(json);
    return json;
}

static void expect_json(const json_t *found, const char *due)
{
    json_t *json = json_loads(due, JSON_DECODE_ANY, NULL);
    assert_non_null(json);
    if (!json_equal(found, json))
        fail_msg("%s is not %s", json_dumps(found, JSON_ENCODE_ANY), due);
    json_decref(json);
}

// --- pairs ---

// Each pair owes the looser of its devices' tiers. A value off by less than a code breaks T0 alone.
static void each_pair_has_a_line(void **state)
{
    (void)state;
    static const char *const due[] = {
        "cpu:reference;cpu;gl;\n",
        "pair                                 tier   differing    largest  mask px FLIP mean  PSNR "
        "dB\n",
        "\ncpu:reference, cpu             fail  T1            10      0/255       10  0.0",
        "\n  cpu: frame 7, stage rain\n  T1 would hold\n"
        "cpu:reference, gl              ok    T1            10      0/255       10  0.0",
        "\ncpu, gl                        ok    T0             0      0/255       10  0.000000     "
        " "
        "inf\n"
        "3 pairs of 3 devices compared\n"};
    int exit;
    reference.red = 0.5f;
    cpu.red = gl.red = 0.5001f;
    OPEN(&reference, &cpu, &gl);
    const char *text = run(false, NULL, &exit);
    assert_int_equal(exit, RG_EXIT_FAIL);
    const char *at = text;
    for (int i = 0; i < 5; i++) {
        const char *found = strstr(at, due[i]);
        if (!found)
            fail_msg("no %s in %s", due[i], at);
        at = found + strlen(due[i]) - 1;
    }
    assert_string_equal(at, "\n");
    has_blame = false;
    text = run(false, NULL, &exit);
    assert_non_null(strstr(text, "\n  no stage leaves other bits when each is read: it may not "
                                 "differ in every run\n"));
}

// cpu:reference counts as the truth, then the device of the stricter tier, then cpu, then the
// first.
static void the_device_nearer_to_the_reference_is_trusted(void **state)
{
    (void)state;
    struct made *const pairs[][2] = {// the trusted one first
                                     {&reference, &cpu}, {&reference, &gl}, {&cpu, &software},
                                     {&cpu, &vulkan},    {&software, &gl},  {&gl, &native}};
    for (int i = 0; i < 6; i++)
        for (int turned = 0; turned < 2; turned++) {
            int exit;
            pairs[i][0]->red = 0.5f;
            pairs[i][1]->red = 0.9f;
            OPEN(pairs[i][turned], pairs[i][!turned]);
            run(false, NULL, &exit);
            assert_int_equal(exit, RG_EXIT_FAIL);
            assert_ptr_equal(trusted, &pairs[i][0]->device);
            assert_ptr_equal(blamed, &pairs[i][1]->device);
        }
    int exit;
    OPEN(&vulkan, &gl); // alike
    vulkan.red = 0.5f;
    gl.red = 0.9f;
    run(false, NULL, &exit);
    assert_ptr_equal(trusted, &vulkan.device);
}

// Of a native device the rain alone counts, once whole pictures hold T2.
static void a_native_scene_is_compared_by_its_rain(void **state)
{
    (void)state;
    for (int turned = 0; turned < 2; turned++) {
        int exit;
        gl.red = 0.5f;
        native.red = 0.5001f;
        OPEN(turned ? &native : &gl, turned ? &gl : &native);
        json_t *json = run_json(NULL, &exit);
        const json_t *pair = json_array_get(json_object_get(json, "pairs"), 0);
        assert_int_equal(exit, RG_EXIT_PASS);
        assert_ptr_equal(drawn_natively, &native.device);
        expect_json(json_object_get(pair, "mask"), "10");
        expect_json(json_object_get(pair, "owed"), "\"T2\"");
        expect_json(json_object_get(pair, "tier"), "\"T1\"");
        json_decref(json);
    }
}

static void a_pair_has_a_machine_form(void **state)
{
    (void)state;
    int exit;
    reference.red = 0.5f;
    gl.red = 0.9f;
    OPEN(&reference, &gl);
    json_t *json = run_json(NULL, &exit);
    const json_t *pair = json_array_get(json_object_get(json, "pairs"), 0);
    assert_int_equal(exit, RG_EXIT_FAIL);
    expect_json(json_object_get(json, "devices"), "[\"cpu:reference\", \"gl\"]");
    expect_json(json_object_get(json, "failures"), "[]");
    assert_null(json_object_get(json, "pictures"));
    expect_json(json_object_get(pair, "a"), "\"cpu:reference\"");
    expect_json(json_object_get(pair, "b"), "\"gl\"");
    expect_json(json_object_get(pair, "owed"), "\"T1\"");
    expect_json(json_object_get(pair, "accepts"), "{\"tier\": \"none\"}");
    const json_t *blame = json_object_get(pair, "blame");
    expect_json(json_object_get(blame, "device"), "\"gl\"");
    expect_json(json_object_get(blame, "text"), "\"frame 7, stage rain\"");
    json_decref(json);
}

static void pictures_are_written_beside_heat_maps(void **state)
{
    static const char *const names[] = {"cpu_reference.exr", "gl.exr", "cpu_reference-gl-flip.png",
                                        "cpu_reference-gl-difference.png"};
    char prefix[64], path[128], due[256];
    int exit;
    assert_int_equal(make_folder(state), 0);
    reference.red = gl.red = 0.5f;
    for (int is_folder = 0; is_folder < 2; is_folder++) {
        OPEN(&reference, &gl);
        snprintf(prefix, sizeof(prefix), "%s/%s", folder, is_folder ? "" : "heat");
        const char *dash = is_folder ? "" : "-";
        json_t *json = run_json(prefix, &exit);
        assert_int_equal(exit, RG_EXIT_PASS);
        snprintf(due, sizeof(due),
                 "[{\"device\": \"cpu:reference\", \"file\": \"%s%scpu_reference.exr\"}, "
                 "{\"device\": \"gl\", \"file\": \"%s%sgl.exr\"}]",
                 prefix, dash, prefix, dash);
        expect_json(json_object_get(json, "pictures"), due);
        json_decref(json);
        for (int i = 0; i < 4; i++) {
            snprintf(path, sizeof(path), "%s%s%s", prefix, dash, names[i]);
            assert_int_equal(unlink(path), 0);
        }
    }
    assert_int_equal(remove_folder(state), 0); // nothing else was written
}

// --- devices without a picture ---

static void devices_without_a_picture_are_told(void **state)
{
    (void)state;
    static const struct {
        float vulkan;
        bool has_absent;
        int exit;
        const char *ends;
    } cases[] = {
        {0.5f, false, RG_EXIT_PASS, "3 pairs of 3 devices compared\n"},
        {UNABLE, false, RG_EXIT_PASS,
         "1 pair of 2 devices compared; 1 more device gave no picture\n"},
        {TIRED, false, RG_EXIT_FAIL,
         "1 pair of 2 devices compared; 1 more device gave no picture\n"},
        {UNABLE, true, RG_EXIT_PASS,
         "1 pair of 2 devices compared; 2 more devices gave no picture\n"},
    };
    reference.red = cpu.red = 0.5f;
    for (int i = 0; i < 4; i++) {
        int exit;
        vulkan.red = cases[i].vulkan;
        OPEN(&reference, &cpu, &vulkan);
        devices.absent_count = cases[i].has_absent;
        devices.absent[0] =
            (struct rg_absent_device){"opencl", RG_UNSUPPORTED, "opencl: is absent"};
        const char *text = run(false, NULL, &exit);
        assert_int_equal(exit, cases[i].exit);
        assert_non_null(strstr(text, cases[i].ends));
    }
    int exit;
    json_t *json = run_json(NULL, &exit);
    expect_json(json_object_get(json, "failures"),
                "[{\"device\": \"opencl\", \"status\": \"unsupported\", \"detail\": \"opencl: is "
                "absent\"}, {\"device\": \"vulkan\", \"status\": \"unsupported\", \"detail\": "
                "\"vulkan: too small\"}]");
    json_decref(json);
}

// The first device's refusal of input is that of all; without rain, or a second device, nothing is
// compared.
static void what_cannot_be_compared_is_told(void **state)
{
    (void)state;
    int exit;
    reference.red = REFUSED;
    cpu.red = 0.5f;
    OPEN(&reference, &cpu);
    run(false, NULL, &exit);
    assert_int_equal(exit, RG_EXIT_USAGE);
    assert_string_equal(last, "cpu:reference: a file is not there");
    reference.red = cpu.red = 0;
    const char *text = run(false, NULL, &exit);
    assert_int_equal(exit, RG_EXIT_NOTHING);
    assert_string_equal(last, "diff made: no rain at --frame 7 and exposure 1");
    assert_string_equal(text, "cpu:reference;cpu;\n0 pairs of 2 devices compared\n");
    OPEN(&cpu);
    run(false, NULL, &exit);
    assert_int_equal(exit, RG_EXIT_USAGE);
    assert_string_equal(last, "--device these: a comparison takes two devices");
    cpu.red = 0.5f;
    reference.red = UNABLE;
    OPEN(&reference, &cpu);
    run(false, NULL, &exit);
    assert_int_equal(exit, RG_EXIT_NOTHING); // no pair is left
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(each_pair_has_a_line),
        cmocka_unit_test(the_device_nearer_to_the_reference_is_trusted),
        cmocka_unit_test(a_native_scene_is_compared_by_its_rain),
        cmocka_unit_test(a_pair_has_a_machine_form),
        cmocka_unit_test(pictures_are_written_beside_heat_maps),
        cmocka_unit_test(devices_without_a_picture_are_told),
        cmocka_unit_test(what_cannot_be_compared_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
