// The backend contract: what an API must do to run raingauge's passes.
//
// A backend is one folder with one `const struct rg_backend`. It is only ever called through
// core/device, which has checked every argument: a backend contains no checks of its callers.
// What its device lacks it says in data, struct rg_limits, and core/device refuses it.
// It reports what its driver says: an error is logged in one line with the call, its code and the
// object's name (rg_driver_error), and comes back as false or NULL. Nothing aborts, nothing prints
// else.
//
// Objects: a backend's own struct begins with the public one (struct gl_buf { struct rg_buf pub; })
// and is allocated zeroed by the backend. core/device fills the public part after a create.
// Destroy functions are never called with NULL, and only when the device is idle (after a sync).
//
// Threads: a device is used by one thread at a time. Several devices live side by side.
// Order: pass_run, buf_write, image_write, image_clear and reads take effect in the order of their
// calls, as if each had ended before the next began. Only sync, reads and time wait.
#ifndef RG_BACKENDS_BACKEND_H
#define RG_BACKENDS_BACKEND_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "backends/kernel.h"
#include "backends/library.h"
#include "core/base/tier.h"

struct rg_extent {
    int width, height, depth; // items
};

// Numbers of slots, by what is bound to them.
struct rg_slot_limits {
    int buffers, images, out_images;
};

// What a device can do. Data, set at creation: 0 means that it cannot. core/device refuses what
// exceeds it, so that no backend is asked for it.
struct rg_limits {
    int max_objects; // buffers and images that live at once; INT_MAX: no limit
    int64_t max_buffer_bytes;
    int max_image_px; // width and height, of any format
    int max_image_layers;
    int max_groups[3]; // work groups a dispatch, in x, y and z; INT_MAX: no limit
    int group_items;   // items a work group, along x
    struct rg_format_limits formats[RG_FORMAT_COUNT];
    struct rg_slot_limits slot_count; // how many a kernel may have
    struct rg_slot_limits slot_end;   // and below what their numbers must be
    char no_draws[120];               // why DRAW programs cannot run: "has no queue that draws"
    bool has_clock;                   // `time` tells it
    bool has_queries;                 // the API's own occlusion queries
};

// Room for a name with settings, several paths among them. Of the libraries that a driver's code
// lies in: most drivers are one file, and a layered one, such as zink, stands on another's.
enum { RG_DEVICE_NAME_SIZE = 512, RG_DRIVER_LIBRARIES = 3 };

struct rg_device_info {
    // As tables and messages call it: "cpu:reference", "gl", "vulkan:1", "gl@LP_NUM_THREADS=1", or
    // the short name that the command line gave it, as "new" by "new=vulkan@DRIVER=/opt/mesa".
    char name[RG_DEVICE_NAME_SIZE];
    char full[RG_DEVICE_NAME_SIZE]; // by which it can be opened again, without a short name
    char device[128];               // what the driver calls it: "llvmpipe (LLVM 15.0.6, 256 bits)"
    char driver[160];               // driver and version: "Mesa 22.3.6"
    char api[64]; // "OpenGL 4.5 core", "Vulkan 1.3.230", "OpenCL 1.2", "C11, AVX-512"
    // The files whose code draws, of a device that is open; of cpu the program. The first is the
    // API's driver; without a path the rest are none.
    struct rg_library libraries[RG_DRIVER_LIBRARIES];
    bool software; // runs on the CPU
    // How closely its pictures agree with those of cpu:reference: T0 of a driver that computes as C
    // does, T1 of one whose arithmetic is a GPU's, T2 of a device that draws in another way.
    enum rg_tier tier;
    struct rg_limits limits;
};

struct rg_device {
    const struct rg_backend *backend;
    struct rg_device_info info;
    bool rounds;          // its programs round quotients and roots; backends/rounding.h says so
    struct rg_work *work; // what core/device counts; not the backend's business
    struct rg_packing *packing; // owned by core/device/packing.c; likewise
    struct rg_shared *shared;   // owned by core/device/shared.c; likewise
};

struct rg_buf {
    struct rg_device *device;
    size_t size;
    const char *name; // for messages and debug labels; the caller's, for the object's life
    bool is_counted;  // core/device's alone: it takes no memory, and no backend knows it
};

struct rg_image {
    struct rg_device *device;
    struct rg_image_desc desc;
    const char *name; // as a buffer's
    bool is_counted;  // likewise
};

struct rg_pass {
    struct rg_device *device;
    const struct rg_kernel *kernel;
    struct rg_packer *packer; // of a DRAW pass: core/device/packing.c owns it; NULL for others
    bool is_counted;          // as a buffer's
};

struct rg_binding {
    struct rg_buf *buf; // one of the two, as the kernel's slot wants it
    struct rg_image *image;
};

enum { RG_MAX_QUERIES = 32768 }; // of a run; a longer draw takes several

enum rg_blend {
    RG_BLEND_OFF,
    RG_BLEND_OVER, // premultiplied: source + target (1 - alpha of the source)
    RG_BLEND_ADD,
};
// Nearer wins; of equal depths the first stays.
enum rg_depth_mode { RG_DEPTH_OFF, RG_DEPTH_TEST, RG_DEPTH_WRITE };
enum rg_cull {
    RG_CULL_NONE,
    RG_CULL_BACK, // leaves out what turns clockwise on the screen
    RG_CULL_FRONT,
};

// Where and how a DRAW pass draws. Items blend in the order of their index on every backend.
struct rg_draw {
    struct rg_image *colour; // RGBA8, RGBA16F or RGBA32F; NULL: depth alone
    struct rg_image *depth;  // D32F, of the same size at `level`; NULL: without
    int layer, level;        // of both
    enum rg_blend blend;
    enum rg_depth_mode depth_mode;
    enum rg_cull cull;
    int x0, y0, x1, y1;     // scissor: x0 <= x < x1, y0 <= y < y1; all 0: the whole target
    struct rg_buf *samples; // uints, by item: grow by its visible samples. NULL: not counted
    // 0: fragments count. Else the API's own occlusion queries do, each of so many items from a
    // multiple of that on, itself a multiple of 32; `samples` is then by query, and is set.
    int items_a_query;
};

// Whether fragments count, each of which then tests the depth itself.
static inline bool rg_draw_counts(const struct rg_draw *draw)
{
    return draw->samples && !draw->items_a_query;
}

// A DRAW pass's primitives, packed by core/device/packing.c, for backends with `packed` true.
struct rg_packed {
    struct rg_buf *prims; // rg_prim of kernels/dialect/draw/draw.h, drawn in this order
    struct rg_buf *args;  // 5 uints: vertices, 1, 0, 0 (an indirect draw), then the number of prims
    int capacity;         // the most that `prims` holds
    // Of a draw with queries: an indirect draw of 4 uints for each, that is, of `queries` ones, the
    // first of which counts into `first_query`.
    struct rg_buf *query_args;
    int queries, first_query;
};

// What a run comes to, for those who count it; core/device/work.h says of what. -1: not counted,
// for this device cannot have it exactly, or core/device finds it itself.
struct rg_counts {
    int64_t records, fragments, fragments_kept, texels_fetched;
};

// One run of a pass over the items origin <= (x, y, z) < origin + extent, in any order.
struct rg_run {
    const void *params;                    // kernel->params_size bytes, copied during the call
    struct rg_binding slots[RG_MAX_SLOTS]; // indexed by slot
    struct rg_extent extent;               // at least 1 each
    struct rg_extent origin;               // of the first item; 0 for most
    const struct rg_draw *draw;            // of a DRAW pass, whose items lie along x; else NULL
    const struct rg_packed *packed;        // set by core/device/packing.c, NULL for its callers
    struct rg_counts *counts;              // set by core/device/work.c; NULL: nobody counts
};

enum { RG_MAX_DEVICES = 32, RG_LIST_WHY_SIZE = 640 }; // that a list takes; of its reason

struct rg_backend {
    const char *name;    // "vulkan"
    const char *package; // the Debian package that brings a driver; NULL: none is needed
    bool rough;          // its language lets quotients and roots be inexact (rounding.h)
    bool packed;         // draws what core/device/packing.c has packed, rather than items

    // Fills `infos` with up to `max` devices, best first, and returns their number; 0: no driver is
    // there; -1: one is there, and fails. `why` (of `why_size` bytes, RG_LIST_WHY_SIZE are enough)
    // then says so in one line, with the mend. Beside devices it is "", or tells of another driver
    // that fails. Quiet: it logs nothing and leaves nothing open.
    int (*list)(struct rg_device_info *infos, int max, char *why, size_t why_size);

    // Opens the device at `index` of the list. NULL and one logged line on failure.
    struct rg_device *(*create)(int index);
    // Addresses in the driver's code, of functions that serve this device: up to `max`, of each
    // file one or more, the API's driver first. Returns how many. NULL: the program itself draws.
    int (*functions)(struct rg_device *device, const void **functions, int max);
    // False, and one logged line, where the driver did not come to its end well.
    bool (*destroy)(struct rg_device *device);

    // Contents are undefined until written. `size` is at most limits.max_buffer_bytes.
    struct rg_buf *(*buf_create)(struct rg_device *device, size_t size, const char *name);
    void (*buf_destroy)(struct rg_buf *buf);
    bool (*buf_write)(struct rg_buf *buf, size_t offset, const void *data, size_t size);
    bool (*buf_read)(struct rg_buf *buf, size_t offset, void *data, size_t size);

    // Texels travel tightly packed, rows from y = 0, one layer of one level at a time, in the
    // image's own format (kernels/dialect/image/format.h): rg_format_size(format) bytes each.
    struct rg_image *(*image_create)(struct rg_device *device, const struct rg_image_desc *desc,
                                     const char *name);
    void (*image_destroy)(struct rg_image *image);
    bool (*image_write)(struct rg_image *image, int layer, int level, const void *texels);
    bool (*image_read)(struct rg_image *image, int layer, int level, void *texels);
    // Sets every texel of every layer and level. `texel` is one packed texel.
    bool (*image_clear)(struct rg_image *image, const void *texel);

    // Compiles a kernel. The driver may go on compiling at the first run.
    struct rg_pass *(*pass_create)(struct rg_device *device, const struct rg_kernel *kernel);
    void (*pass_destroy)(struct rg_pass *pass);
    // Runs a pass, or queues it. extent fits limits.max_groups. Of a DRAW pass, `params` is the
    // program's rg_draw_call (kernels/dialect/draw/draw.h): the draw's state, then the parameters.
    bool (*pass_run)(struct rg_pass *pass, const struct rg_run *run);
    // What the driver's compiler has made of it, as the API hands it out, which may be less than
    // native code: `*bytes`, which the caller frees, or NULL where there are none. False, and one
    // logged line, on failure. Drivers compile late: to be asked for once the pass has run. NULL:
    // the API has no such thing.
    bool (*pass_code)(struct rg_pass *pass, void **bytes, size_t *size);

    // Returns when all that was queued has ended. False: some of it failed.
    bool (*sync)(struct rg_device *device);
    // The API's own clock, in nanoseconds from an arbitrary start, once all that was queued before
    // has ended. Two readings make an interval. Drivers lie: callers compare with wall clock.
    bool (*time)(struct rg_device *device, int64_t *time_ns);
};

// All backends, NULL-terminated, made by the build from the one list in backends/meson.build.
extern const struct rg_backend *const rg_backends[];
enum { RG_MAX_BACKENDS = 16 }; // the build checks it

#endif
