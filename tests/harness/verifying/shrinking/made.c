#include "tests/harness/verifying/shrinking/made.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/console/clock.h"
#include "harness/devices/frames/session.h"
#include "harness/devices/workers/device.h"
#include "tests/tools/expect.h"

#define AT(field) offsetof(struct made_settings, field)

static const struct rg_param rows[] = {
    {"view", RG_PARAM_CHOICE, AT(view), 0, 0, 2, "1", "what is seen", "box pane jar"},
    {"drops", RG_PARAM_INT, AT(drops), 50, 0, 100, "1", "drops", NULL},
    {"seed", RG_PARAM_INT, AT(seed), 1, 0, 1000, "1", "seed", NULL},
    {"amount", RG_PARAM_FLOAT, AT(amount), 4, 1, 9, "1", "amount", NULL},
    {"light", RG_PARAM_FLOAT, AT(light), 1, 0, 99, "1", "light", NULL},
    {"map", RG_PARAM_FILE, AT(map), 0, 0, 0, "file", "map", ""},
};
static const struct rg_param_table table = {.technique = "made",
                                            .rows = rows,
                                            .count = sizeof(rows) / sizeof(rows[0]),
                                            .settings_size = sizeof(struct made_settings)};
const struct rg_technique made_technique = {.name = "made", .params = &table};

static const struct rg_backend nobody = {.name = "nobody"};
struct rg_device made_device = {.backend = &nobody,
                                .info = {.name = "doubtful",
                                         .full = "doubtful@A=1",
                                         .device = "a card",
                                         .driver = "a driver 1.2",
                                         .api = "an API 3"}};
struct rg_device made_truth = {.backend = &nobody,
                               .info = {.name = "trusted", .full = "trusted@B=2"}};

enum made_way (*made_way)(const struct rg_digest_run *run);
int64_t (*made_work)(const struct rg_digest_run *run);
enum made_way (*made_dispatch)(const struct rg_dispatched *dispatched);
struct rg_dispatches made_dispatches;
int made_frame, made_word, made_takes, made_open, made_renewals;
double made_run_ms;

bool made_has_worker;

static double now_ms;
static char worker; // its address stands for the device's worker

int made_reset(void **state)
{
    (void)state;
    made_way = NULL;
    made_work = NULL;
    made_dispatch = NULL;
    made_dispatches = (struct rg_dispatches){0};
    made_frame = 1;
    made_word = made_takes = made_open = made_renewals = 0;
    made_run_ms = now_ms = 0;
    made_has_worker = true;
    return 0;
}

double rg_now_ms(void)
{
    return now_ms;
}

// --- runs ---

static enum made_way way_of(const struct rg_digest_run *run, const struct rg_device *device)
{
    if (run->subject.width < 1 || run->subject.height < 1)
        return MADE_REFUSED;
    return device == &made_device && made_way && run->frames >= made_frame ? made_way(run)
                                                                           : MADE_SAME;
}

// Reports the failure of a run or a dispatch that ends in this way; true if it does not fail.
static bool succeeds(enum made_way way)
{
    switch (way) {
    case MADE_REFUSED:
        return rg_error("view and map exclude each other");
    case MADE_TIRED:
        return rg_driver_error("kernel 'rain_step': its driver is tired");
    case MADE_CRASH:
        return rg_crash_error("doubtful: its driver ended its process");
    default:
        return true;
    }
}

static int64_t work_of(const struct rg_digest_run *run)
{
    const struct made_settings *settings = run->subject.settings;
    return made_work ? made_work(run) : settings->drops;
}

bool rg_digests_take(const struct rg_digest_run *run, struct rg_device *device,
                     struct rg_digests *digests)
{
    made_takes += device == &made_device;
    now_ms += device == &made_device ? made_run_ms : 0;
    const enum made_way way = way_of(run, device);
    *digests = (struct rg_digests){0};
    if (!succeeds(way))
        return false;
    digests->rows = calloc((size_t)run->frames * 2, sizeof(*digests->rows));
    assert_non_null(digests->rows);
    for (int i = 0; i < 2 * run->frames; i++) {
        const bool is_draw = i % 2, is_late = 1 + i / 2 >= made_frame;
        struct rg_digest *row = &digests->rows[digests->count];
        if (way == MADE_FEWER && is_draw && is_late)
            continue;
        digests->count++;
        row->frame = 1 + i / 2;
        row->stages_run = i + 1;
        strcpy(row->stage, is_draw ? "rain_draw" : "rain_step");
        strcpy(row->asset, is_draw ? "target" : "water");
        row->hash = (uint64_t)(1000 * row->frame + row->stages_run);
        row->hash +=
            way != MADE_SAME && way != MADE_FEWER && is_late && is_draw == (way == MADE_TEXEL);
        row->weight = work_of(run) * row->frame;
    }
    return true;
}

static void fill_water(float *water, int64_t frame, enum made_way way)
{
    for (int i = 0; i < MADE_WORDS; i++)
        water[i] = (float)((i + 1) * frame);
    if (way == MADE_LEFT)
        water[MADE_WRONG] = (float)((MADE_WRONG + 1) * (frame - 1));
    uint32_t word;
    memcpy(&word, &water[MADE_WRONG], 4);
    word += way == MADE_OFF ? 1 : way == MADE_OTHER ? 1 << 20 : 0;
    memcpy(&water[MADE_WRONG], &word, 4);
}

// An image of 4 x 2 texels, 2 layers and 2 levels.
static void fill_target(struct rg_contents *contents, int64_t frame, enum made_way way)
{
    uint32_t *texels = contents->bytes;
    contents->desc = (struct rg_image_desc){RG_RGBA8, 4, 2, 2, 2};
    for (int i = 0; i < MADE_TEXELS; i++)
        texels[i] = (uint32_t)(0x01010101 * frame);
    if (way == MADE_TEXEL)
        texels[made_word] = 0xa0b0c0d0;
}

bool rg_digests_contents(const struct rg_digest_run *run, struct rg_device *device, int row,
                         struct rg_contents *contents, struct rg_state *state)
{
    const int64_t frame = 1 + row / 2;
    const enum made_way way = frame >= made_frame ? way_of(run, device) : MADE_SAME;
    assert_at_most(frame, run->frames);
    *state = (struct rg_state){.name = row % 2 ? NULL : "water", .words = row % 2 ? NULL : "f"};
    *contents = (struct rg_contents){.size = 4 * (row % 2 ? MADE_TEXELS : MADE_WORDS)};
    contents->bytes = calloc(1, contents->size);
    assert_non_null(contents->bytes);
    if (row % 2)
        fill_target(contents, frame, way);
    else
        fill_water(contents->bytes, frame, way);
    return true;
}

// --- dispatches ---

static void copy_contents(struct rg_contents *to, const struct rg_contents *from)
{
    *to = *from;
    to->bytes = from->bytes ? malloc(from->size) : NULL;
    if (to->bytes)
        memcpy(to->bytes, from->bytes, from->size);
}

bool rg_digests_dispatches(const struct rg_digest_run *run, struct rg_device *device,
                           int stages_run, struct rg_dispatches *dispatches)
{
    (void)run;
    (void)device;
    (void)stages_run;
    *dispatches = (struct rg_dispatches){.count = made_dispatches.count};
    dispatches->rows = calloc((size_t)made_dispatches.count + 1, sizeof(*dispatches->rows));
    assert_non_null(dispatches->rows);
    for (int i = 0; i < made_dispatches.count; i++) {
        dispatches->rows[i] = made_dispatches.rows[i];
        for (int slot = 0; slot < RG_MAX_SLOTS; slot++)
            copy_contents(&dispatches->rows[i].before[slot], &made_dispatches.rows[i].before[slot]);
    }
    return true;
}

bool rg_digests_dispatch(struct rg_dispatched *dispatched, struct rg_device *device)
{
    const enum made_way way =
        device == &made_device && made_dispatch ? made_dispatch(dispatched) : MADE_SAME;
    const struct rg_contents *in = &dispatched->before[1];
    struct rg_contents *out = &dispatched->after[2];
    rg_contents_free(out);
    if (!succeeds(way))
        return false;
    copy_contents(out, in);
    for (size_t i = 0; i < in->size / 4; i++)
        ((uint32_t *)out->bytes)[i] += 1 + (way == MADE_OTHER && i == in->size / 4 - 1);
    return true;
}

void *rg_digests_code(struct rg_device *device, const struct rg_kernel *kernel,
                      enum rg_code_kind kind, size_t *size)
{
    char *code = malloc(128);
    assert_non_null(code);
    *size = (size_t)snprintf(code, 128, "%s of %s for %s",
                             kind == RG_CODE_SPIRV  ? "SPIR-V"
                             : kind == RG_CODE_GLSL ? "GLSL"
                                                    : "OpenCL C",
                             kernel->name, device->info.name);
    return code;
}

// --- sessions and workers, of which nothing but their number is asked ---

struct rg_session *rg_session_open(struct rg_device *device, const struct rg_subject *subject)
{
    (void)device;
    (void)subject;
    made_open++;
    return malloc(1);
}

void rg_session_close(struct rg_session *session)
{
    made_open -= session != NULL;
    free(session);
}

struct rg_worker *rg_remote_worker(const struct rg_device *device)
{
    return device == &made_device && made_has_worker ? (struct rg_worker *)&worker : NULL;
}

void rg_worker_renew(struct rg_worker *renewed)
{
    assert_ptr_equal(renewed, &worker);
    made_renewals++;
}

const char *rg_worker_end_doing(const struct rg_worker *ended)
{
    assert_ptr_equal(ended, &worker);
    return " while running kernel 'rain_step'";
}
