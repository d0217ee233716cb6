// The host's description of a kernel: its parameters, its slots and its code for each driver.
//
// The build generates one table row for each kernel in kernels/*.h (listed in kernels/meson.build).
// A kernel's C functions belong to the cpu backend and are not here.
#ifndef RG_BACKENDS_KERNEL_H
#define RG_BACKENDS_KERNEL_H

#include <stdbool.h>
#include <stddef.h>

#include "backends/formats.h"
#include "kernels/dialect/limits.h"

enum rg_slot_kind {
    RG_SLOT_IN = 1,
    RG_SLOT_OUT,
    RG_SLOT_INOUT,
    RG_SLOT_ATOMIC,
    RG_SLOT_IMAGE,
    RG_SLOT_OUT_IMAGE,
};

static inline bool rg_slot_is_written(enum rg_slot_kind kind)
{
    return kind != RG_SLOT_IN && kind != RG_SLOT_IMAGE;
}

// How a native device's sampler reads an image (SAMPLED of kernels/dialect/slots/slots.h).
enum rg_sampler {
    RG_TEXELS,           // it does not: kernels fetch texels
    RG_SAMPLED_FILTERED, // linear within and between levels, clamped at the edges
    RG_SAMPLED_TILED,    // the same, repeated
    RG_SAMPLED_CUBE,     // the same, of six layers as a cube
    RG_SAMPLED_SHADOW,   // compared: 1 if the reference is at most the texel; linear between four
                         // answers if the device filters depths
    RG_SAMPLERS
};

struct rg_slot_info {
    const char *name; // the kernel's own name for the slot
    int slot;         // 1 to RG_MAX_SLOTS - 1, the binding in every API
    enum rg_slot_kind kind;
    int element_size;      // of a buffer's element, in bytes; 0 for an image
    enum rg_format format; // of an image; RG_FORMAT_NONE for a buffer
    const char *words; // of a buffer's element: a letter a word, as in enum rg_word; NULL: unknown
    enum rg_sampler sampler; // of an image
};

// The type of each four bytes of a buffer; one text has an element's, "uff".
enum rg_word { RG_WORD_FLOAT = 'f', RG_WORD_INT = 'i', RG_WORD_UINT = 'u' };

// One driver's form of a kernel. Text is not terminated by a zero.
struct rg_kernel_code {
    unsigned char *bytes; // the caller frees them
    size_t size;
};

// The same as embedded by the build, compressed by zlib to a quarter of the size.
struct rg_embedded_code {
    const unsigned char *bytes;
    size_t packed_size, size; // both 0 if the kernel has no such form
};

// The kinds of code, and the endings of their files; kernels/build/embed.py reads this list. A GRID
// kernel has the first three, a DRAW program OpenCL C and the four after it; both may have others:
// - ROUNDED: for programs that round quotients and roots themselves (kernels/dialect/rounding.h).
//   Their GLSL is the normal one with RG_ROUNDED defined.
// - BLENDED: for fragments that blend by themselves. Their GLSL is the normal one with RG_BLENDS
//   defined.
// - NATIVE: for native devices (docs/native.md), of GRID kernels that sample and all DRAW programs.
//   Fragments that sample have two more: only SETUP is the driver's, or only SAMPLERS are.
// - PASS: of GRID kernels whose texels native devices draw. Where samplers are the driver's too,
// the
//   fragments are NATIVE ones.
#define RG_CODE_KINDS(X)                                                                           \
    X(GLSL, "glsl")                                                                                \
    X(SPIRV, "spv")                                                                                \
    X(OPENCL, "cl")                                                                                \
    X(VERTEX_GLSL, "vert")                                                                         \
    X(VERTEX_SPIRV, "vert.spv")                                                                    \
    X(FRAGMENT_GLSL, "frag")                                                                       \
    X(FRAGMENT_SPIRV, "frag.spv")                                                                  \
    X(ROUNDED_SPIRV, "rounded.spv")                                                                \
    X(ROUNDED_VERTEX_SPIRV, "vert.rounded.spv")                                                    \
    X(ROUNDED_FRAGMENT_SPIRV, "frag.rounded.spv")                                                  \
    X(BLENDED_FRAGMENT_SPIRV, "frag.blended.spv")                                                  \
    X(ROUNDED_BLENDED_FRAGMENT_SPIRV, "frag.rounded_blended.spv")                                  \
    X(NATIVE_GLSL, "native.glsl")                                                                  \
    X(NATIVE_SPIRV, "native.spv")                                                                  \
    X(NATIVE_VERTEX_GLSL, "native.vert")                                                           \
    X(NATIVE_VERTEX_SPIRV, "native.vert.spv")                                                      \
    X(NATIVE_GEOMETRY_GLSL, "native.geom")                                                         \
    X(NATIVE_GEOMETRY_SPIRV, "native.geom.spv")                                                    \
    X(NATIVE_FRAGMENT_GLSL, "native.frag")                                                         \
    X(NATIVE_FRAGMENT_SPIRV, "native.frag.spv")                                                    \
    X(SETUP_FRAGMENT_GLSL, "setup.frag")                                                           \
    X(SETUP_FRAGMENT_SPIRV, "setup.frag.spv")                                                      \
    X(SAMPLERS_FRAGMENT_GLSL, "samplers.frag")                                                     \
    X(SAMPLERS_FRAGMENT_SPIRV, "samplers.frag.spv")                                                \
    X(PASS_VERTEX_GLSL, "pass.vert")                                                               \
    X(PASS_VERTEX_SPIRV, "pass.vert.spv")                                                          \
    X(PASS_FRAGMENT_GLSL, "pass.frag")                                                             \
    X(PASS_FRAGMENT_SPIRV, "pass.frag.spv")

#define RG_CODE_KIND(kind, ending) RG_CODE_##kind,
enum rg_code_kind { RG_CODE_KINDS(RG_CODE_KIND) RG_CODE_COUNT };

// The slots of a DRAW program's packing and drawing stages (kernels/dialect/draw/draw.h); the
// program's other slots have lower numbers.
enum {
    RG_SLOT_PRIMS = 12,   // packed primitives
    RG_SLOT_COUNTS = 13,  // primitives in each chunk of items, or before it
    RG_SLOT_ARGS = 14,    // in emit: arguments of the draw
    RG_SLOT_SAMPLES = 14, // in fragments: visible samples of each item
    RG_SLOT_FATES = 15,   // in count and emit: which items of a chunk are whole, which clipped
    RG_SLOT_BEHIND = 15,  // in fragments: the depth against which counted samples are tested
};

// Ways of programs, as bits: they round quotients and roots themselves (backends/asked/rounding.h),
// and blend by themselves (backends/asked/blending.h). Those of native devices leave the setup of
// items to the driver, or samplers, and do neither of the first two; with PLACES beside SETUP the
// driver interpolates places too. A program without SAMPLED slots has SAMPLERS beside SETUP.
enum {
    RG_CODE_ROUNDS = 1,
    RG_CODE_BLENDS = 2,
    RG_CODE_SETUP = 4,
    RG_CODE_SAMPLERS = 8,
    RG_CODE_PLACES = 16,
    RG_CODE_PASSES = 32
};

// Slots of fragments besides the program's own, on backends that draw packed primitives.
enum { RG_DRAWN_SLOTS = 3 };
extern const struct rg_slot_info rg_drawn_slots[RG_DRAWN_SLOTS];

// Additional properties of a DRAW program.
struct rg_draw_info {
    int corners;              // of an item: 3 or 4
    int prim_size;            // of a packed primitive, in bytes
    int call_size;            // of rg_draw_call: the draw's state and the parameters, in bytes
    int lights_at;            // offset of the number of lights in its parameters; -1: not lit
    const char *count, *emit; // the GRID kernels that pack it
};

struct rg_kernel {
    const char *name;
    int params_size; // in bytes, a multiple of 4
    int slot_count;
    const struct rg_slot_info *slots;    // ascending by slot
    const struct rg_embedded_code *code; // RG_CODE_COUNT of them
    const struct rg_draw_info *draw;     // NULL: a GRID kernel
    // The layer to which items at z store, if each item (x, y, z) stores texel (x, y) alone
    // (RG_OWN_TEXELS of kernels/dialect/slots/slots.h); NULL: any other kernel.
    int (*layer)(const void *params, int z);
};

// The kernel of this name, or NULL, without a message.
const struct rg_kernel *rg_kernel_find(const char *name);

// All kernels, in the order of the list; returns their number.
int rg_kernel_all(const struct rg_kernel *const **kernels);

// Whether native devices' samplers read one of its images. Such a kernel, and every DRAW program,
// has a form of its own for native devices.
bool rg_kernel_samples(const struct rg_kernel *kernel);

// The slot of the image in which each item stores its own texel; NULL: any other kernel.
const struct rg_slot_info *rg_kernel_target(const struct rg_kernel *kernel);

// A kernel's index in rg_kernel_all, for tables by kernel.
int rg_kernel_index(const struct rg_kernel *kernel);

// The code for a driver: embedded at build time, or, if RG_KERNEL_DIR names a folder, read from
// NAME.glsl, NAME.spv, NAME.cl and so on there. `ways` has bits of RG_CODE_ROUNDS and
// the like; only fragments blend. False, and one logged line, on failure; then there is nothing to
// free.
bool rg_kernel_code(const struct rg_kernel *kernel, enum rg_code_kind kind, unsigned ways,
                    struct rg_kernel_code *code);

// Decompresses embedded code; `name` is for messages. True, without bytes, if there is no such
// form.
bool rg_embedded_code(const struct rg_embedded_code *embedded, const char *name,
                      struct rg_kernel_code *code);

// The folder named by RG_KERNEL_DIR, or NULL; records note it.
const char *rg_kernel_override(void);

#endif
