#include "tests/harness/devices/measuring/fake.h"

#include <limits.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/console/clock.h"
#include "tests/tools/process/interrupt.h"

static double now_ms = 1000;
static char events[1 << 16];
static size_t event_count;

double rg_now_ms(void)
{
    return now_ms;
}

void fake_pass(double ms)
{
    now_ms += ms;
}

static void happens(char event)
{
    if (event_count + 1 < sizeof(events))
        events[event_count++] = event;
}

const char *fake_events(void)
{
    events[event_count] = 0;
    return events;
}

void fake_forget(void)
{
    event_count = 0;
}

// --- the device ---

static struct fake_device *fake_of(struct rg_device *device)
{
    return (struct fake_device *)device;
}

static bool fake_sync(struct rg_device *device)
{
    struct fake_device *fake = fake_of(device);
    happens('|');
    fake->waits++;
    now_ms += fake->pending_ms + fake->sync_ms;
    fake->pending_ms = 0;
    fake->was_lost = fake->was_lost || fake->waits_left == 0;
    if (fake->waits_left == 0)
        return rg_driver_error("device 'fake': lost");
    fake->waits_left -= fake->waits_left > 0;
    return true;
}

static bool fake_time(struct rg_device *device, int64_t *time_ns)
{
    struct fake_device *fake = fake_of(device);
    happens('t');
    fake->clock_reads++;
    now_ms += fake->pending_ms + fake->clock_ms;
    fake->pending_ms = 0;
    *time_ns = (int64_t)(now_ms * fake->clock_rate * 1e6);
    return true;
}

static bool fake_destroy(struct rg_device *device)
{
    free(device);
    return true;
}

static struct rg_buf *fake_buf_create(struct rg_device *device, size_t size, const char *name)
{
    (void)device;
    (void)name;
    struct rg_buf *buf = calloc(1, sizeof(*buf));
    buf->size = size;
    return buf;
}

static void fake_buf_destroy(struct rg_buf *buf)
{
    free(buf);
}

static bool fake_buf_write(struct rg_buf *buf, size_t offset, const void *data, size_t size)
{
    (void)buf;
    (void)offset;
    (void)data;
    (void)size;
    return true;
}

static struct rg_image *fake_image_create(struct rg_device *device,
                                          const struct rg_image_desc *desc, const char *name)
{
    (void)device;
    (void)desc;
    (void)name;
    return calloc(1, sizeof(struct rg_image));
}

static void fake_image_destroy(struct rg_image *image)
{
    free(image);
}

static bool fake_image_clear(struct rg_image *image, const void *texel)
{
    (void)image;
    (void)texel;
    return true;
}

static bool fake_image_read(struct rg_image *image, int layer, int level, void *texels)
{
    (void)layer;
    (void)level;
    uint16_t *halves = texels;
    for (int i = 0; i < image->desc.width * image->desc.height * 4; i++)
        halves[i] = fake_of(image->device)->shown;
    return true;
}

static struct rg_pass *fake_pass_create(struct rg_device *device, const struct rg_kernel *kernel)
{
    (void)device;
    (void)kernel;
    return calloc(1, sizeof(struct rg_pass));
}

static void fake_pass_destroy(struct rg_pass *pass)
{
    free(pass);
}

static bool fake_pass_run(struct rg_pass *pass, const struct rg_run *run)
{
    struct fake_device *fake = fake_of(pass->device);
    const bool copies = !strcmp(pass->kernel->name, "probe_copy");
    const double items = (double)run->extent.width * run->extent.height * run->extent.depth;
    const bool leaves_cache = fake->cache_items > 0 && items > fake->cache_items;
    const double ms =
        fake->run_ms + items * (copies ? fake->word_ms : fake->item_ms) * (leaves_cache ? 2 : 1);
    const bool is_slow =
        fake->slow_runs > 0 || (fake->slow_every && (fake->runs + 1) % fake->slow_every == 0);
    fake->pending_ms += is_slow ? 10 * ms : ms;
    fake->slow_runs -= fake->slow_runs > 0;
    fake->runs++;
    return true;
}

static const struct rg_backend fake_backend = {
    .name = "fake",
    .destroy = fake_destroy,
    .buf_create = fake_buf_create,
    .buf_destroy = fake_buf_destroy,
    .buf_write = fake_buf_write,
    .image_create = fake_image_create,
    .image_destroy = fake_image_destroy,
    .image_clear = fake_image_clear,
    .image_read = fake_image_read,
    .pass_create = fake_pass_create,
    .pass_destroy = fake_pass_destroy,
    .pass_run = fake_pass_run,
    .sync = fake_sync,
    .time = fake_time,
};

struct fake_device *fake_open(void)
{
    struct fake_device *fake = calloc(1, sizeof(*fake));
    const struct rg_slot_limits slots = {RG_MAX_SLOTS, RG_MAX_SLOTS, RG_MAX_SLOTS};
    fake->pub.backend = &fake_backend;
    fake->pub.work = calloc(1, sizeof(*fake->pub.work)); // rg_device_close frees it
    fake->pub.info = (struct rg_device_info){
        .name = "fake",
        .limits = {.max_objects = INT_MAX,
                   .max_buffer_bytes = INT_MAX,
                   .max_groups = {INT_MAX, INT_MAX, INT_MAX},
                   .group_items = 64,
                   .formats[RG_RGBA16F] = {.uses = RG_USE_DRAW,
                                           .max_px = 1 << 14,
                                           .max_layers = 1,
                                           .max_levels = 1,
                                           .max_bytes = INT_MAX},
                   .slot_count = slots,
                   .slot_end = slots,
                   .has_clock = true},
    };
    fake->waits_left = -1;
    fake->clock_rate = 1;
    return fake;
}

// --- the technique ---

struct fake_instance {
    struct rg_instance pub;
    struct fake_script script;
};

static const struct fake_script *script_of(const struct rg_instance *instance)
{
    return &((const struct fake_instance *)instance)->script;
}

static bool open_fake(struct rg_instance *instance)
{
    happens('(');
    fake_of(instance->device)->pending_ms += script_of(instance)->open_ms;
    return true;
}

static void end_stage(struct rg_instance *instance, const char *kernel)
{
    if (instance->after_stage)
        instance->after_stage(&(struct rg_opened_stage){.row.kernel = kernel}, instance->user);
}

static bool step_fake(struct rg_instance *instance)
{
    struct fake_device *fake = fake_of(instance->device);
    const struct fake_script *script = script_of(instance);
    happens(script->letter);
    fake->pending_ms += script->step_ms + (fake->last == instance ? 0 : script->cold_ms);
    fake->last = instance;
    if (++instance->frame == script->interrupt_at)
        interrupt_by(SIGTERM);
    end_stage(instance, "stir");
    return true;
}

static bool draw_fake(struct rg_instance *instance)
{
    const struct fake_script *script = script_of(instance);
    const int64_t drawn = instance->frame - 1;
    happens('.');
    fake_of(instance->device)->pending_ms +=
        drawn < script->frame_count ? script->frames_ms[drawn] : script->draw_ms;
    end_stage(instance, "show");
    return true;
}

static const struct rg_param_table no_params = {.technique = "fake",
                                                .settings_size = sizeof(struct fake_script)};

const struct rg_technique fake_technique = {
    .name = "fake",
    .params = &no_params,
    .size = sizeof(struct fake_instance),
    .settings = offsetof(struct fake_instance, script),
    .open = open_fake,
    .step = step_fake,
    .draw = draw_fake,
};
