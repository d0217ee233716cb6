// For flow's tests: an instance with settings as text, and its water in whole droplets.
#ifndef RG_TESTS_CORE_TECHNIQUES_FLOW_RIG_H
#define RG_TESTS_CORE_TECHNIQUES_FLOW_RIG_H

#include "core/techniques/flow/inputs/flow.h"
#include "core/techniques/technique.h"

struct rig {
    struct flow_settings settings; // as opened
    struct rg_device *device;
    struct rg_instance *instance;
    int panes;         // 6, or 1
    int size;          // texels along a side
    int width, height; // of the target; not whole multiples of the size unless asked for
};

// Opens flow with these "key=value key=value" over a cheap environment and one mirror pane. Fails
// the test otherwise.
void rig_open(struct rig *rig, const char *device, const char *assignments);
// The same with a target of this size.
void rig_open_sized(struct rig *rig, const char *device, const char *assignments, int width,
                    int height);
void rig_close(struct rig *rig);
// Ends a group of tests: closes the devices that rigs used, two at most. Fails on a leak.
int rig_close_devices(void **state);
// Assigns settings that the open instance reads in every frame: turns, thresholds, lights.
void rig_set(struct rig *rig, const char *assignments);
void rig_step(struct rig *rig, int steps);

// The water in droplets, pane after pane, row by row, without margins; the caller frees it. Fails
// the test if an amount is not whole, if it exceeds what a float counts, or if a margin is wet.
int64_t *rig_water(const struct rig *rig);
// Replaces the water of all panes.
void rig_put(struct rig *rig, const int64_t *water);
int64_t rig_sum(const struct rig *rig);
// The index of a texel in rig_water.
int rig_texel(const struct rig *rig, int pane, int x, int y);
// FLOW_LEDGER_SOURCED or FLOW_LEDGER_DRAINED, modulo 2^32.
uint32_t rig_ledger(const struct rig *rig, int word);
// What the ledger counts in so many frames from here on, and had counted before.
double rig_sourced_mm3(struct rig *rig, int frames);
double rig_droplet_mm3(const struct rig *rig);

// Dries all panes except for one texel of the first.
void rig_put_one(struct rig *rig, int x, int y, int64_t droplets);
// The same except for a round drop on the first pane, with the profile of a half ellipse.
void rig_put_drop(struct rig *rig, double x_mm, double y_mm, double radius_mm, double height_mm);
// Heights of water on a texel: a droplet is 2^-16 of a unit, and a unit is `relief` millimetres.
double rig_mm(const struct rig *rig, int64_t droplets);
int64_t rig_droplets(const struct rig *rig, double mm);
// Fails the test unless a texel of the first pane holds this many droplets.
void rig_expect(const struct rig *rig, int x, int y, int64_t droplets);

// Draws, and returns width x height x 4 values of linear light; the caller frees them.
float *rig_draw(struct rig *rig);

#endif
