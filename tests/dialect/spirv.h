// For tests of SPIR-V: a kernel's modules, read by spirv-tools.
#ifndef RG_TESTS_DIALECT_SPIRV_H
#define RG_TESTS_DIALECT_SPIRV_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "backends/kernel.h"

// A module's words; NULL and 0 if the kernel lacks the stage.
struct spirv_module {
    const uint32_t *words;
    size_t count;
};

struct spirv_stage {
    enum rg_code_kind kind, text;
    const char *name;
    bool rounds; // rounds quotients and roots by itself
};

// Three stages, and fragments that blend by themselves; the same again for programs that round.
enum { SPIRV_STAGES = 8 };

extern const struct spirv_stage spirv_stages[SPIRV_STAGES];

struct spirv_instruction {
    const uint32_t *words; // the first holds the number of words and the operation
    size_t count;
    uint32_t op;      // SpvOp
    const char *name; // the operation's, as "FAdd"
    uint32_t result;  // the result's id; 0: none
    bool of_glsl;     // OpExtInst calls a function of GLSL.std.450
    bool of_float;    // OpConstant holds a float
};

// One of a kernel's forms; it lives as long as the test.
struct rg_kernel_code spirv_code(const struct rg_kernel *kernel, enum rg_code_kind kind);
struct spirv_module spirv_module(const struct rg_kernel *kernel, enum rg_code_kind kind);

// Calls `look` for every instruction in order. Fails the test if the words are not SPIR-V, or if
// `look` returns false.
void spirv_read(struct spirv_module module,
                bool (*look)(const struct spirv_instruction *instruction, void *data), void *data);

// Whether Vulkan 1.2 allows the module. If not, `why` says in one line what it forbids.
bool spirv_is_valid(struct spirv_module module, char *why, size_t size);

#endif
