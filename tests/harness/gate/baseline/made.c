#include "tests/harness/gate/baseline/made.h"

#include <stdio.h>
#include <string.h>

#include "tests/tools/expect.h"

struct rg_launches made_launches(double ms)
{
    struct rg_launches launches = {.count = 24};
    for (int i = 0; i < launches.count; i++)
        launches.ms[i] = ms * (1 + 0.001 * (i * 7 % 24));
    return launches;
}

static void fill(struct rg_baseline_row *row, int i)
{
    static const char *const cells[] = {"rain", "flow"}, *const devices[] = {"gl", "vulkan"};
    snprintf(row->cell, sizeof(row->cell), "%s", cells[i % 2]);
    snprintf(row->technique, sizeof(row->technique), "raster%d", i);
    snprintf(row->device, sizeof(row->device), "%s", devices[i / 2]);
    snprintf(row->settings, RG_DIGEST_SIZE, "%016x", 0x100 + i);
    snprintf(row->picture, RG_DIGEST_SIZE, "%016x", 0x200 + i);
    row->state_count = 2;
    snprintf(row->states[0].name, sizeof(row->states[0].name), "wet");
    snprintf(row->states[0].digest, RG_DIGEST_SIZE, "%016x", 0x300 + i);
    snprintf(row->states[1].name, sizeof(row->states[1].name), "dry");
    snprintf(row->states[1].digest, RG_DIGEST_SIZE, "%016x", 0x400 + i);
    row->counters.count = 2;
    row->counters.counters[0] = (struct rg_count){"drops", 50 + i};
    row->counters.counters[1] = (struct rg_count){"rays", 60 + i};
    row->work = (struct rg_tally){1 + i, 2, 3, 4, 5, 6, 7, -1, 9, 10};
    row->slot = (struct rg_slot){10 + i, 5};
    row->launches = made_launches(1 + i);
    row->seconds = 0.5 + i;
}

struct rg_baseline made_baseline(void)
{
    struct rg_baseline made = {.device_count = 2};
    made.passport =
        json_pack("{s:[{s:s, s:{s:s, s:s}}, {s:s}]}", "devices", "name", "gl", "fixed_functions",
                  "linear", SHA_A, "nearest", SHA_B, "name", "vulkan");
    made.devices[0].parts = json_pack("{s:s, s:s}", "cpu", "Xeon", "driver", "Mesa 22");
    made.devices[1].parts = json_pack("{s:s, s:s}", "cpu", "Xeon", "driver", "Mesa 25");
    assert_true(made.passport && made.devices[0].parts && made.devices[1].parts);
    snprintf(made.devices[0].name, RG_DEVICE_NAME_SIZE, "gl");
    snprintf(made.devices[1].name, RG_DEVICE_NAME_SIZE, "vulkan");
    for (int i = 0; i < RG_YARDSTICKS; i++)
        made.yardsticks[i] = (struct rg_launches){2, {10 + i, 20 + i}};
    for (int i = 0; i < 4; i++) {
        struct rg_baseline_row *row = rg_baseline_add(&made);
        assert_non_null(row);
        fill(row, i);
    }
    struct rg_baseline_row *fell = &made.rows[3];
    fell->outcome = RG_CRASH;
    snprintf(fell->why, sizeof(fell->why), "it fell");
    fell->launches.count = fell->state_count = fell->counters.count = 0;
    *fell->picture = 0;
    fell->slot = (struct rg_slot){0, 0};
    made.rows[1].outcome = RG_FAIL;
    return made;
}
