// What the tables of one command share: devices, instances that stay open, and truths.
//
// Instances on a device share what is large and the same for all (an atlas, a scene), for as long
// as one of them lives. So the bench keeps one open on each device from one row to the next.
#ifndef RG_HARNESS_DEVICES_BENCH_H
#define RG_HARNESS_DEVICES_BENCH_H

#include "core/image/picture.h"
#include "core/techniques/technique.h"
#include "harness/devices/devices.h"

// The cells of a table: what is opened, and for how large an image.
struct rg_bench_subject {
    const struct rg_technique *technique;
    const void *settings; // not owned
    int width, height;
};

enum { RG_BENCH_OWN_DEVICES = 2, RG_BENCH_TRUTHS = 8 };

// Zeroed but for `devices`, which outlive it. The owner calls rg_bench_free.
struct rg_bench {
    const struct rg_devices *devices;
    struct rg_device *own[RG_BENCH_OWN_DEVICES]; // opened beside them
    struct rg_kept {
        struct rg_instance *instance; // owned
        struct rg_bench_subject of;   // of textures: what it was opened with; settings owned
    } kept[RG_MAX_DEVICES + RG_BENCH_OWN_DEVICES];
    struct rg_truth {
        struct rg_picture picture;  // owned; no texels: nothing
        struct rg_bench_subject of; // settings owned
        int frames;
    } truths[RG_BENCH_TRUTHS];
    int truth_count; // made so far; the oldest gives way
};

// The device of this name, among the bench's devices or opened beside them for as long as the bench
// lives. NULL, and one logged line, on failure.
struct rg_device *rg_bench_device(struct rg_bench *bench, const char *name);

// Takes over an instance, which lives until another takes its place on its device.
void rg_bench_keep(struct rg_bench *bench, struct rg_instance *instance);

// An instance that may have been opened before, at no frame in particular; the bench keeps it.
// NULL, and one logged line, on failure.
struct rg_instance *rg_bench_open(struct rg_bench *bench, struct rg_device *device,
                                  const struct rg_bench_subject *subject);

// The picture after so many frames on the device `cpu`; the bench keeps it for those who ask for
// the same. NULL, and one logged line, on failure.
const struct rg_picture *rg_bench_truth(struct rg_bench *bench,
                                        const struct rg_bench_subject *subject, int frames);

// Closes everything. False on a leak.
bool rg_bench_free(struct rg_bench *bench);

#endif
