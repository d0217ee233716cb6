// What flow's tests share: an instance with settings as text, and its water as whole droplets.
#ifndef RG_TESTS_CORE_TECHNIQUES_FLOW_RIG_H
#define RG_TESTS_CORE_TECHNIQUES_FLOW_RIG_H

#include "core/techniques/flow/inputs/flow.h"
#include "core/techniques/technique.h"

struct rig {
    struct flow_settings settings; // as it was opened
    struct rg_device *device;
    struct rg_instance *instance;
    int panes;         // 6, or 1
    int size;          // texels along a side
    int width, height; // of the target: no whole multiple of the size, unless it was asked for
};

// Opens flow with these "key=value key=value" over a cheap environment and one pane of mirror;
// fails the test otherwise.
void rig_open(struct rig *rig, const char *device, const char *assignments);
// The same with a target of this size.
void rig_open_sized(struct rig *rig, const char *device, const char *assignments, int width,
                    int height);
void rig_close(struct rig *rig);
// For the end of a group of tests, which fails on a leak: closes the devices that rigs were on, two
// at most.
int rig_close_devices(void **state);
// Assigns on the open instance what it reads anew in every frame: turns, thresholds, lights.
void rig_set(struct rig *rig, const char *assignments);
void rig_step(struct rig *rig, int steps);

// The water in droplets, pane after pane, row by row, without margins, for the caller to free.
// Fails the test where an amount is no whole number of droplets, or more than a float counts, or a
// margin is wet.
int64_t *rig_water(const struct rig *rig);
// Replaces the water of all panes.
void rig_put(struct rig *rig, const int64_t *water);
int64_t rig_sum(const struct rig *rig);
// Where rig_water holds a texel.
int rig_texel(const struct rig *rig, int pane, int x, int y);
// FLOW_LEDGER_SOURCED or FLOW_LEDGER_DRAINED, modulo 2^32.
uint32_t rig_ledger(const struct rig *rig, int word);

// Dry panes but for one texel of the first.
void rig_put_one(struct rig *rig, int x, int y, int64_t droplets);
// Fails the test unless a texel of the first pane holds so many droplets.
void rig_expect(const struct rig *rig, int x, int y, int64_t droplets);

// Draws, and returns width x height x 4 values of linear light, for the caller to free.
float *rig_draw(struct rig *rig);

#endif
