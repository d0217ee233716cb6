// What flow's tests share: an instance with settings as text, and its water as whole droplets.
#ifndef FLOW_RIG_H
#define FLOW_RIG_H

#include "core/techniques/flow.h"
#include "core/techniques/technique.h"

struct rig {
    struct flow_settings settings;
    struct rg_device *device;
    struct rg_instance *instance;
    int size;          // texels along a side
    int width, height; // of the target: no whole multiple of the size
};

// Opens flow with these "key=value key=value" over a cheap environment; fails the test otherwise.
void rig_open(struct rig *rig, const char *device, const char *assignments);
// Fails the test on a leak.
void rig_close(struct rig *rig);
void rig_step(struct rig *rig, int steps);

// The water in droplets, row by row, without margins, for the caller to free. Fails the test where
// an amount is no whole number of droplets, or the margin is wet.
int64_t *rig_water(const struct rig *rig);
// Replaces all the water.
void rig_put(struct rig *rig, const int64_t *water);
int64_t rig_sum(const struct rig *rig);
// FLOW_LEDGER_SOURCED or FLOW_LEDGER_DRAINED, modulo 2^32.
uint32_t rig_ledger(const struct rig *rig, int word);

// A dry pane but for one texel.
void rig_put_one(struct rig *rig, int x, int y, int64_t droplets);
// Fails the test unless a texel holds so many droplets.
void rig_expect(const struct rig *rig, int x, int y, int64_t droplets);

#endif
