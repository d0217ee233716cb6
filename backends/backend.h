// The backend contract: what an API must do to run raingauge's passes.
//
// A backend is one folder with one `const struct rg_backend`. Only core/device calls it, after
// checking every argument, so that a backend contains no checks of its callers. It states its
// device's limits as data, struct rg_limits, and core/device refuses what exceeds them. A driver's
// error is logged in one line with the call, its code and the object's name (rg_driver_error), and
// returned as false or NULL. A backend never aborts and prints nothing else.
//
// Objects: a backend's own struct begins with the public one (struct gl_buf { struct rg_buf pub; })
// and is allocated zeroed by the backend. core/device fills the public part after a create.
// Destroy functions are never called with NULL, and only when the device is idle (after a sync).
//
// Threads: a device is used by one thread at a time. Several devices live side by side. Order:
// pass_run, buf_write, calls for images and reads take effect in the order of their calls,
// as if each ended before the next began. Only sync, reads and time wait.
#ifndef RG_BACKENDS_BACKEND_H
#define RG_BACKENDS_BACKEND_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "backends/kernel.h"
#include "backends/library.h"
#include "core/base/tier.h"
#include "shaders/fixed/fixed.h"

struct rg_extent {
    int width, height, depth; // items
};

// Numbers of slots, by the kind of object bound to them.
struct rg_slot_limits {
    int buffers, images, out_images;
};

// The limits of a device, set at creation; 0 means that it lacks the feature. core/device refuses
// whatever exceeds them, so that backends need not check.
struct rg_limits {
    int max_objects; // buffers and images that may exist at once; INT_MAX: no limit
    int64_t max_buffer_bytes;
    int max_image_px; // width and height, of any format
    int max_image_layers;
    int max_groups[3]; // work groups in a dispatch, in x, y and z; INT_MAX: no limit
    int group_items;   // items in a work group, along x
    struct rg_format_limits formats[RG_FORMAT_COUNT];
    struct rg_slot_limits slot_count; // the most slots of a kernel
    struct rg_slot_limits slot_end;   // slot numbers must be below these
    char no_draws[120];               // why DRAW programs cannot run: "has no queue that draws"
    bool has_clock;                   // `time` works
    bool has_queries;                 // the API's own occlusion queries
    char no_native[120]; // why neither fixed_draw nor native devices work: "lacks geometryShader"
};

// What a native device leaves to its driver (docs/native.md): a word of RG_NATIVE for each, and
// what the driver does. PLACES is only with SETUP.
#define RG_FEATURES(X)                                                                             \
    X(SAMPLERS, "samplers", "filters textures, and compares depths")                               \
    X(LEVELS, "levels", "makes textures' smaller levels")                                          \
    X(SETUP, "setup", "makes, clips, culls and snaps items, and interpolates depth")               \
    X(PLACES, "places", "interpolates places on surfaces, and w")                                  \
    X(BLENDING, "blending", "blends, and rounds to formats")                                       \
    X(PASSES, "passes", "draws what kernels store to images, and rounds it")
#define RG_FEATURE_NUMBER(name, word, does) RG_FEATURE_NUMBER_##name,
#define RG_FEATURE_BIT(name, word, does)    RG_FEATURE_##name = 1 << RG_FEATURE_NUMBER_##name,
enum { RG_FEATURES(RG_FEATURE_NUMBER) RG_FEATURE_COUNT };
enum rg_feature { RG_FEATURES(RG_FEATURE_BIT) RG_FEATURE_ALL = (1 << RG_FEATURE_COUNT) - 1 };

// Sizes: a name with settings, which may include several paths; and the libraries of a driver's
// code. Most drivers are one file, but a layered one, such as zink, uses another's.
enum { RG_DEVICE_NAME_SIZE = 512, RG_DRIVER_LIBRARIES = 3 };

struct rg_device_info {
    // The name in tables and messages: "cpu:reference", "gl", "vulkan:1", "gl@LP_NUM_THREADS=1", or
    // the short name from the command line, such as "new" from "new=vulkan@DRIVER=/opt/mesa".
    char name[RG_DEVICE_NAME_SIZE];
    char full[RG_DEVICE_NAME_SIZE]; // without a short name, as the device can be opened again
    char device[128];               // the driver's name for it: "llvmpipe (LLVM 15.0.6, 256 bits)"
    char driver[160];               // driver and version: "Mesa 22.3.6"
    char api[64]; // "OpenGL 4.5 core", "Vulkan 1.3.230", "OpenCL 1.2", "C11, AVX-512"
    // The files with the code that draws, for an open device; for cpu the program. The first is the
    // API's driver; an empty path ends the list.
    struct rg_library libraries[RG_DRIVER_LIBRARIES];
    bool software;     // runs on the CPU
    bool native;       // draws by the driver's own pipeline (docs/native.md)
    unsigned features; // of a native device: bits of enum rg_feature; 0: it draws as an exact one
    // How closely its pictures agree with cpu:reference's. T0: the driver computes as C does. T1:
    // it has a GPU's arithmetic. T2: the device draws in another way.
    enum rg_tier tier;
    struct rg_limits limits;
};

struct rg_device {
    const struct rg_backend *backend;
    struct rg_device_info info;
    bool rounds;                // programs round quotients and roots (backends/asked/rounding.h)
    bool blends;                // programs blend by themselves (backends/asked/blending.h)
    struct rg_work *work;       // core/device's counts; not for the backend
    struct rg_packing *packing; // owned by core/device/packing.c
    struct rg_shared *shared;   // owned by core/device/shared.c
};

// Whether the device, with these features, draws the texels of a GRID kernel over its image.
static inline bool rg_draws_texels(const struct rg_device *device, const struct rg_kernel *kernel,
                                   unsigned features)
{
    const struct rg_slot_info *target = rg_kernel_target(kernel);
    return target && (features & RG_FEATURE_PASSES) &&
           (device->info.limits.formats[target->format].uses & RG_USE_DRAW);
}

// Whether drawing stages run a kernel: of DRAW programs, and where the device draws its texels.
static inline bool rg_is_drawn(const struct rg_device *device, const struct rg_kernel *kernel)
{
    return kernel->draw || rg_draws_texels(device, kernel, device->info.features);
}

// The ways of a kernel on this device with these features, without blending.
static inline unsigned rg_ways_of(const struct rg_device *device, const struct rg_kernel *kernel,
                                  unsigned features)
{
    const bool samples = rg_kernel_samples(kernel);
    const bool by_samplers = samples && (features & RG_FEATURE_SAMPLERS);
    if (kernel->draw && (features & RG_FEATURE_SETUP))
        return RG_CODE_SETUP | (by_samplers || !samples ? RG_CODE_SAMPLERS : 0) |
               (features & RG_FEATURE_PLACES ? RG_CODE_PLACES : 0);
    if (rg_draws_texels(device, kernel, features))
        return RG_CODE_PASSES | (by_samplers ? RG_CODE_SAMPLERS : 0);
    if (by_samplers)
        return RG_CODE_SAMPLERS;
    return device->rounds ? RG_CODE_ROUNDS : 0;
}

static inline unsigned rg_device_ways(const struct rg_device *device,
                                      const struct rg_kernel *kernel)
{
    return rg_ways_of(device, kernel, device->info.features);
}

struct rg_buf {
    struct rg_device *device;
    size_t size;
    const char *name; // for messages and debug labels; the caller keeps it for the object's life
    bool is_counted;  // for core/device alone: the object takes no memory, and no backend knows it
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
    struct rg_buf *buf; // one of the two, as the kernel's slot requires
    struct rg_image *image;
};

enum { RG_MAX_QUERIES = 32768 }; // in a run; a longer draw takes several

enum rg_blend {
    RG_BLEND_OFF,
    RG_BLEND_OVER, // premultiplied: source + target (1 - alpha of the source)
    RG_BLEND_ADD,
};
// The nearer fragment wins; at equal depths the first one stays.
enum rg_depth_mode { RG_DEPTH_OFF, RG_DEPTH_TEST, RG_DEPTH_WRITE };
enum rg_cull {
    RG_CULL_NONE,
    RG_CULL_BACK, // drops primitives that turn clockwise on the screen
    RG_CULL_FRONT,
};

// The targets and state of a DRAW pass. Items blend in the order of their index on every backend.
struct rg_draw {
    struct rg_image *colour; // RGBA8, RGBA16F or RGBA32F; NULL: depth only
    struct rg_image *depth;  // D32F, of the same size at `level`; NULL: none
    int layer, level;        // of both
    enum rg_blend blend;
    enum rg_depth_mode depth_mode;
    enum rg_cull cull;
    int x0, y0, x1, y1;     // scissor: x0 <= x < x1, y0 <= y < y1; all 0: the whole target
    struct rg_buf *samples; // uints, by item, to which visible samples are added. NULL: not counted
    // 0: fragments count samples. Otherwise the API's occlusion queries do, and `samples` is by
    // query, and is overwritten. Each query counts this many items, beginning at a multiple of this
    // number, which must be a multiple of 32.
    int items_a_query;
};

// Whether fragments count samples; each fragment then tests the depth itself.
static inline bool rg_draw_counts(const struct rg_draw *draw)
{
    return draw->samples && !draw->items_a_query;
}

// The features of a native device that a run takes; `draw`: NULL for a GRID kernel. A draw whose
// driver shall not blend is drawn as on exact devices, because only their programs can blend.
static inline unsigned rg_run_features(const struct rg_device *device, const struct rg_draw *draw)
{
    const unsigned features = device->info.features;
    return draw && draw->blend != RG_BLEND_OFF && !(features & RG_FEATURE_BLENDING) ? 0 : features;
}

// The primitives of a DRAW pass, packed by core/device/packing.c, for backends with `packed` true.
struct rg_packed {
    struct rg_buf *prims; // rg_prim of kernels/dialect/draw/draw.h, drawn in this order
    struct rg_buf *args;  // 5 uints: vertices, 1, 0, 0 (an indirect draw), then the number of prims
    int capacity;         // capacity of `prims`
    struct rg_buf *query_args; // for draws with queries: an indirect draw of 4 uints for each
};

// Counts of a run's work (core/device/work.h). -1: not counted, because the device cannot count it
// exactly, or because core/device computes it.
struct rg_counts {
    int64_t records, fragments, fragments_kept, texels_fetched;
};

// One run of a pass over the items origin <= (x, y, z) < origin + extent, in any order.
struct rg_run {
    const void *params;                    // kernel->params_size bytes, copied during the call
    struct rg_binding slots[RG_MAX_SLOTS]; // indexed by slot
    struct rg_extent extent;               // at least 1 each
    struct rg_extent origin;               // first item; mostly 0
    // For DRAW passes, whose items lie along x; else NULL. core/device/grid.c sets it where texels
    // of a GRID kernel are drawn: their image and layer, and the items' extent as the scissor.
    const struct rg_draw *draw;
    const struct rg_packed *packed; // set by core/device/packing.c; NULL for its callers
    int queries, first_query;       // of draws with queries; set by core/device/draw.c
    struct rg_counts *counts;       // set by core/device/work.c; NULL: not counted
};

// The items of a run's query, for native devices, which draw items.
struct rg_items {
    int first, count;
};
static inline struct rg_items rg_query_items(const struct rg_run *run, int query)
{
    const int whole = run->draw->items_a_query, first = (run->first_query + query) * whole;
    const int end = run->origin.width + run->extent.width;
    return (struct rg_items){first, end - first < whole ? end - first : whole};
}

enum { RG_MAX_DEVICES = 32, RG_LIST_WHY_SIZE = 640 }; // length of a list; size of its reason
// Returned in place of a number of devices.
enum rg_list_end {
    RG_LIST_FAILED = -1, // a driver is installed, and fails when it is called
    RG_LIST_BROKEN = -2, // a driver is installed, and its files or settings are broken
};

struct rg_backend {
    const char *name;    // "vulkan"
    const char *package; // the Debian package with a driver; NULL: none is needed
    bool rough;          // the API's language allows inexact quotients and roots (rounding.h)
    bool packed;         // draws primitives packed by core/device/packing.c, rather than items;
                         // native devices draw items
    bool takes_glsl;     // its drivers compile GLSL; those of other APIs take other code

    // Fills `infos` with up to `max` devices, best first, and returns their number; 0: no driver is
    // installed; else an enum rg_list_end. Without devices `why` (of `why_size` bytes,
    // RG_LIST_WHY_SIZE are enough) says so in one line, with the mend. With devices `why` is "" or
    // tells of another driver that fails. Logs nothing and closes everything again.
    int (*list)(struct rg_device_info *infos, int max, char *why, size_t why_size);

    // Opens the device at `index` of the list. NULL and one logged line on failure.
    struct rg_device *(*create)(int index);
    // Whether programs can blend by themselves: the driver runs a pixel's fragments in the order of
    // items, and lets them read what the pixel holds. `word` gets the API's word for it. NULL: the
    // device blends by kernels/dialect/draw/blend.h as it is.
    bool (*can_blend)(const struct rg_device *device, const char **word);
    // Finds addresses of functions in the driver's code that serve this device: up to `max`, at
    // least one in each file, the API's driver first. Returns their number, or -1, with an error
    // logged, if the driver lacks one that every driver has. NULL: the program itself draws.
    int (*functions)(struct rg_device *device, const void **functions, int max);
    // False, and one logged line, if the driver failed while closing.
    bool (*destroy)(struct rg_device *device);

    // Contents are undefined until written. `size` is at most limits.max_buffer_bytes.
    struct rg_buf *(*buf_create)(struct rg_device *device, size_t size, const char *name);
    void (*buf_destroy)(struct rg_buf *buf);
    bool (*buf_write)(struct rg_buf *buf, size_t offset, const void *data, size_t size);
    bool (*buf_read)(struct rg_buf *buf, size_t offset, void *data, size_t size);

    // Texels are transferred in the image's format (kernels/dialect/image/format.h), tightly
    // packed, with rg_format_size(format) bytes each. A call transfers one layer of one level, rows
    // from y = 0.
    struct rg_image *(*image_create)(struct rg_device *device, const struct rg_image_desc *desc,
                                     const char *name);
    void (*image_destroy)(struct rg_image *image);
    bool (*image_write)(struct rg_image *image, int layer, int level, const void *texels);
    bool (*image_read)(struct rg_image *image, int layer, int level, void *texels);
    // Sets every texel of every layer and level. `texel` is one packed texel.
    bool (*image_clear)(struct rg_image *image, const void *texel);
    // Has the driver make every level from `first` on, each from the one above. Only native devices
    // are asked, for formats with RG_USE_FILTER. NULL: the API has no native devices.
    bool (*image_make_levels)(struct rg_image *image, int first);

    // Compiles a kernel. The driver may finish compiling at the first run.
    struct rg_pass *(*pass_create)(struct rg_device *device, const struct rg_kernel *kernel);
    void (*pass_destroy)(struct rg_pass *pass);
    // Runs a pass, or queues it. extent is within limits.max_groups. For a DRAW pass, `params` is
    // the program's rg_draw_call (kernels/dialect/draw/draw.h): the draw's state, then the
    // parameters.
    bool (*pass_run)(struct rg_pass *pass, const struct rg_run *run);
    // Returns the driver's compiled code for a pass, in the API's form, which may be less than
    // native code. The caller frees `*bytes`, which is NULL if there is none. False, and one logged
    // line, on failure. Drivers compile late, so ask after the pass has run. NULL: the API cannot.
    bool (*pass_code)(struct rg_pass *pass, void **bytes, size_t *size);

    // Draws once through the driver's own pipeline, and waits. `picture` is empty, and has room for
    // RG_FIXED_PICTURE_BYTES. NULL: the API has no fixed functions.
    bool (*fixed_draw)(struct rg_device *device, const char *feature,
                       const struct rg_fixed_state *state, struct rg_fixed_picture *picture);

    // Waits for all queued work. False if a part of it failed.
    bool (*sync)(struct rg_device *device);
    // Reads the API's clock, in nanoseconds from an arbitrary start, after all queued work has
    // ended. The difference of two readings is an interval. Drivers may be wrong, so callers
    // compare it with the wall clock.
    bool (*time)(struct rg_device *device, int64_t *time_ns);
};

// Whether the device draws packed primitives: in this draw, or in any.
static inline bool rg_draw_packs(const struct rg_device *device, const struct rg_draw *draw)
{
    return device->backend->packed && !(rg_run_features(device, draw) & RG_FEATURE_SETUP);
}
static inline bool rg_device_packs(const struct rg_device *device)
{
    const unsigned never = RG_FEATURE_SETUP | RG_FEATURE_BLENDING;
    return device->backend->packed && (device->info.features & never) != never;
}

// All backends, NULL-terminated; the build generates the list from backends/meson.build.
extern const struct rg_backend *const rg_backends[];
enum { RG_MAX_BACKENDS = 16 }; // the build checks it

#endif
