// What the host knows of a kernel: its parameters, its slots and its text for each driver.
//
// One table row a kernel, made by the build from kernels/*.h (kernels/meson.build lists them). A
// kernel's C functions belong to the cpu backend and are not here.
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

struct rg_slot_info {
    const char *name; // as the kernel calls it
    int slot;         // 1 to RG_MAX_SLOTS - 1, the binding in every API
    enum rg_slot_kind kind;
    int element_size;      // of a buffer's element, in bytes; 0 for an image
    enum rg_format format; // of an image; RG_FORMAT_NONE for a buffer
    const char *words; // of a buffer's element: a letter a word, as enum rg_word has them; NULL:
                       // not told
};

// What four bytes of a buffer are; an element's are told in one text, "uff".
enum rg_word { RG_WORD_FLOAT = 'f', RG_WORD_INT = 'i', RG_WORD_UINT = 'u' };

// One driver's form of a kernel. Text is not terminated by a zero.
struct rg_kernel_code {
    unsigned char *bytes; // the caller frees them
    size_t size;
};

// The same as the build embeds it, compressed by zlib: a quarter of the bytes.
struct rg_embedded_code {
    const unsigned char *bytes;
    size_t packed_size, size; // 0 where the kernel has no such form
};

// A GRID kernel has the first three; a DRAW program has OpenCL C and the last four.
enum rg_code_kind {
    RG_CODE_GLSL,
    RG_CODE_SPIRV,
    RG_CODE_OPENCL,
    RG_CODE_VERTEX_GLSL,
    RG_CODE_VERTEX_SPIRV,
    RG_CODE_FRAGMENT_GLSL,
    RG_CODE_FRAGMENT_SPIRV,
    // Of programs that round quotients and roots themselves (kernels/dialect/rounding.h); their
    // GLSL is that of others, and defines RG_ROUNDED.
    RG_CODE_ROUNDED_SPIRV,
    RG_CODE_ROUNDED_VERTEX_SPIRV,
    RG_CODE_ROUNDED_FRAGMENT_SPIRV,
    RG_CODE_COUNT
};

// The slots of a DRAW program's own stages (kernels/dialect/draw/draw.h); its other slots are below
// them.
enum {
    RG_SLOT_PRIMS = 12,   // packed primitives
    RG_SLOT_COUNTS = 13,  // primitives a chunk of items, or before it
    RG_SLOT_ARGS = 14,    // of emit: arguments of the draw
    RG_SLOT_SAMPLES = 14, // of fragments: visible samples an item
    RG_SLOT_FATES = 15,   // of count and emit: which items of a chunk are whole, which clipped
    RG_SLOT_BEHIND = 15,  // of fragments: the depth that counted samples are held against
};

// The slots that fragments have beside the program's own, on backends that draw packed primitives.
enum { RG_DRAWN_SLOTS = 3 };
extern const struct rg_slot_info rg_drawn_slots[RG_DRAWN_SLOTS];

// What a DRAW program has that a GRID kernel has not.
struct rg_draw_info {
    int corners;              // of an item: 3 or 4
    int prim_size;            // of a packed primitive, in bytes
    int call_size;            // of rg_draw_call: the draw's state and the parameters, in bytes
    int lights_at;            // where its parameters say how many lights there are; -1: not lit
    const char *count, *emit; // the GRID kernels that pack it
};

struct rg_kernel {
    const char *name;
    int params_size; // in bytes, a multiple of 4
    int slot_count;
    const struct rg_slot_info *slots;    // ascending by slot
    const struct rg_embedded_code *code; // RG_CODE_COUNT of them
    const struct rg_draw_info *draw;     // NULL: a GRID kernel
};

// The kernel of this name, or NULL (no message).
const struct rg_kernel *rg_kernel_find(const char *name);

// All kernels, in the order of the list; returns their number.
int rg_kernel_all(const struct rg_kernel *const **kernels);

// A kernel's place among rg_kernel_all: what a device may keep a table by.
int rg_kernel_index(const struct rg_kernel *kernel);

// The code for a driver, as embedded at build time or, where RG_KERNEL_DIR names a folder, read
// from NAME.glsl, NAME.spv, NAME.cl and so on there; `rounded`, of a program that rounds quotients
// and roots itself. False, and one logged line, on failure; then there is nothing to free.
bool rg_kernel_code(const struct rg_kernel *kernel, enum rg_code_kind kind, bool rounded,
                    struct rg_kernel_code *code);

// What was embedded; `name` is for messages. No bytes, and true, where there is no such form.
bool rg_embedded_code(const struct rg_embedded_code *embedded, const char *name,
                      struct rg_kernel_code *code);

// The folder that RG_KERNEL_DIR names, or NULL. Records say so.
const char *rg_kernel_override(void);

#endif
