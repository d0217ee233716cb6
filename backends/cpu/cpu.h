// The cpu backend: kernels as C functions, run by cpu:reference in order and by cpu on all cores.
#ifndef RG_BACKENDS_CPU_CPU_H
#define RG_BACKENDS_CPU_CPU_H

#include "backends/backend.h"
#include "backends/cpu/kernels/call.h"

// The instruction sets for which kernels were built: "reference", then from the slowest to the
// fastest.
struct cpu_level {
    const char *name;
    const struct cpu_kernel *const *kernels; // in rg_kernel_all's order; NULL: packing
    const struct cpu_raster *raster;         // shared by all DRAW programs of the level; NULL: none
};
extern const struct cpu_level cpu_levels[];
extern const int cpu_level_count;

struct cpu_device {
    struct rg_device pub;
    const struct cpu_level *level;
    bool reference;
    struct cpu_bins *bins; // buffers of drawing, reused between runs; NULL before the first
};

struct cpu_buf {
    struct rg_buf pub;
    void *data;
};

struct cpu_image {
    struct rg_image pub;
    rg_image_shape shape;
    int words; // of the whole image
    uint *texels;
};

struct cpu_pass {
    struct rg_pass pub;
    const struct cpu_kernel *code;
};

// buf.c
struct rg_buf *cpu_buf_create(struct rg_device *device, size_t size, const char *name);
void cpu_buf_destroy(struct rg_buf *buf);
bool cpu_buf_write(struct rg_buf *buf, size_t offset, const void *data, size_t size);
bool cpu_buf_read(struct rg_buf *buf, size_t offset, void *data, size_t size);

// image.c
struct rg_image *cpu_image_create(struct rg_device *device, const struct rg_image_desc *desc,
                                  const char *name);
void cpu_image_destroy(struct rg_image *image);
bool cpu_image_write(struct rg_image *image, int layer, int level, const void *texels);
bool cpu_image_read(struct rg_image *image, int layer, int level, void *texels);
bool cpu_image_clear(struct rg_image *image, const void *texel);

// target.c: the addresses of a draw's target texels.
struct cpu_target cpu_target_of(const struct rg_draw *draw);

// slots.c: a call with all bindings of a run. `notes` may be NULL.
struct cpu_call cpu_bind(const struct rg_kernel *kernel, const struct rg_run *run,
                         struct rg_notes *notes);

// pass.c
struct rg_pass *cpu_pass_create(struct rg_device *device, const struct rg_kernel *kernel);
void cpu_pass_destroy(struct rg_pass *pass);
bool cpu_pass_run(struct rg_pass *pass, const struct rg_run *run);

// time.c
bool cpu_sync(struct rg_device *device);
bool cpu_time(struct rg_device *device, int64_t *time_ns);

#endif
