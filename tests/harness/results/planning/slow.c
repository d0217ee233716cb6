#include "tests/harness/results/planning/slow.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <signal.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "core/base/log.h"
#include "core/techniques/proof.h"
#include "harness/record/record.h"
#include "tests/tools/process/interrupt.h"

// --- a technique whose frames take the time of its settings ---

struct slow_settings {
    double open_ms, step_ms, fixed_ms, late_ms, late_frame, late_on_cpu, pixel_us;
};
struct slow_instance {
    struct rg_instance pub;
    struct slow_settings settings;
};

#define AT(field) offsetof(struct slow_settings, field)
static const struct rg_param params[] = {
    {"open_ms", RG_PARAM_FLOAT, AT(open_ms), 40, 0, 1e6, "ms", "of opening", NULL},
    {"step_ms", RG_PARAM_FLOAT, AT(step_ms), 1, 0, 1e6, "ms", "of simulating a frame", NULL},
    {"fixed_ms", RG_PARAM_FLOAT, AT(fixed_ms), 10, 0, 1e6, "ms", "of drawing it", NULL},
    {"late_ms", RG_PARAM_FLOAT, AT(late_ms), 0, 0, 1e6, "ms", "more of it once rain fell", NULL},
    {"late_frame", RG_PARAM_FLOAT, AT(late_frame), 3, 0, 100, "", "from which on it did", NULL},
    {"late_on_cpu", RG_PARAM_FLOAT, AT(late_on_cpu), 1, 0, 1, "", "share of it on cpu", NULL},
    {"pixel_us", RG_PARAM_FLOAT, AT(pixel_us), 0.125, 0, 1e6, "us", "more of each pixel", NULL},
};
static const struct rg_param_table param_table = {
    .technique = "slow", .rows = params, .count = 7, .settings_size = sizeof(struct slow_settings)};

// A device's item_ms is its slowness, relative to cpu. A cpu that a command opens in addition is a
// real one: its frames take as long, and show nothing.
static struct fake_device *fake_of(const struct rg_instance *instance)
{
    static struct fake_device real;
    real.item_ms = 1;
    const bool is_real = strcmp(instance->device->backend->name, "fake") != 0;
    return is_real ? &real : (struct fake_device *)instance->device;
}

// A frame takes longer if it waits after every stage.
static double slowness(const struct rg_instance *instance)
{
    return fake_of(instance)->item_ms * (instance->after_stage ? 1.5 : 1);
}

// The time of full rain, which the first frames do not show.
static double late_ms(const struct rg_instance *instance)
{
    const struct slow_settings *s = &((const struct slow_instance *)instance)->settings;
    const bool is_cpu = !strcmp(instance->device->info.name, "cpu");
    return instance->frame >= s->late_frame ? s->late_ms * (is_cpu ? s->late_on_cpu : 1) : 0;
}

int slow_opened, slow_interrupted;
// The time that gl's driver compiles, and how many more times: first in an opening, then in frames.
enum { COMPILES = 3 };
static double compile_ms;
static int compiles_left;

static double compiled_ms(const struct rg_instance *instance, bool is_opening)
{
    const bool is_due = compiles_left > 0 && (compiles_left == COMPILES) == is_opening;
    const bool compiles = is_due && !strcmp(instance->device->info.name, "gl");
    compiles_left -= compiles;
    return compiles ? compile_ms : 0;
}

// The time in which cpu still has to make what its instances share.
static double unshared_ms;

static double shared_ms(const struct rg_instance *instance)
{
    const double ms = strcmp(instance->device->info.name, "cpu") ? 0 : unshared_ms;
    unshared_ms -= ms;
    return ms;
}

void slow_shares(double ms)
{
    unshared_ms = ms;
}

void slow_compiles(double ms)
{
    compile_ms = ms;
    compiles_left = COMPILES;
}

static bool open_slow(struct rg_instance *instance)
{
    const struct slow_instance *slow = (const struct slow_instance *)instance;
    if (++slow_opened == slow_interrupted)
        interrupt_by(SIGINT);
    fake_pass(slow->settings.open_ms * fake_of(instance)->item_ms + compiled_ms(instance, true) +
              shared_ms(instance));
    return true;
}

static bool step_slow(struct rg_instance *instance)
{
    const struct slow_instance *slow = (const struct slow_instance *)instance;
    instance->frame++;
    fake_pass((slow->settings.step_ms + late_ms(instance)) * slowness(instance));
    return true;
}

static bool draw_slow(struct rg_instance *instance)
{
    const struct slow_settings *s = &((const struct slow_instance *)instance)->settings;
    const double pixels = (double)instance->target->desc.width * instance->target->desc.height;
    fake_of(instance)->shown = s->fixed_ms > 0 ? 0x3c00 : 0; // 1, or nothing without rain
    fake_pass((s->fixed_ms + late_ms(instance) + 1e-3 * s->pixel_us * pixels) * slowness(instance) +
              compiled_ms(instance, false));
    return true;
}

static const struct rg_proof proof = {.dry = "fixed_ms=0"};
#define SLOW(its_name)                                                                             \
    {                                                                                              \
        .name = its_name, .params = &param_table, .proof = &proof,                                 \
        .size = sizeof(struct slow_instance),                                                      \
        .settings = offsetof(struct slow_instance, settings), .open = open_slow,                   \
        .step = step_slow, .draw = draw_slow                                                       \
    }
static const struct rg_technique slow_technique = SLOW("slow"), other_technique = SLOW("other");

// Replaces the build's own list.
const struct rg_technique *const rg_techniques[] = {&slow_technique, &other_technique, NULL};
const struct rg_technique *rg_technique_find(const char *name)
{
    return strcmp(name, "other") ? &slow_technique : &other_technique;
}

// --- devices ---

void slow_begin(struct slow_rig *rig)
{
    static const char *const names[] = {"cpu", "cpu:reference", "gl"};
    static const double slowness[] = {1, 10, 3};
    *rig = (struct slow_rig){.devices = {.count = 3}};
    for (int d = 0; d < 3; d++) {
        rig->fakes[d] = fake_open();
        rig->fakes[d]->item_ms = slowness[d];
        rg_text_copy(rig->fakes[d]->pub.info.name, RG_NAME_SIZE, names[d]);
        rig->devices.devices[d] = &rig->fakes[d]->pub;
    }
    rig->kept.devices = &rig->devices;
    slow_opened = slow_interrupted = 0;
    compiles_left = 0;
    unshared_ms = 0;
}

void slow_end(struct slow_rig *rig)
{
    assert_true(rg_kept_free(&rig->kept));
    for (int d = 0; d < 3; d++) {
        const bool was_lost = rig->fakes[d]->was_lost; // it then closes badly, leak or no leak
        const struct rg_work *work = rg_device_work(&rig->fakes[d]->pub);
        assert_int_equal(work->live_buffers + work->live_images + work->live_passes, 0);
        assert_true(rg_device_close(&rig->fakes[d]->pub) || was_lost);
    }
}
