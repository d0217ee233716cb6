// What the tests of SPIR-V share: the stages of a kernel, and how a module's words are walked.
#ifndef RG_TESTS_DIALECT_SPIRV_H
#define RG_TESTS_DIALECT_SPIRV_H

#include <stdint.h>

#include "core/device/kernel.h"

// Words of the SPIR-V specification, section 2.3: a header, then instructions, the first word of
// each of which is how many words it has (above) and what it does (below).
enum { SPIRV_HEADER_WORDS = 5 };

static inline int spirv_op(uint32_t first_word)
{
    return (int)(first_word & 0xffff);
}

static inline uint32_t spirv_length(uint32_t first_word)
{
    return first_word >> 16;
}

static inline const uint32_t *spirv_words(const struct rg_kernel_code *code)
{
    return (const uint32_t *)(const void *)code->bytes;
}

struct spirv_stage {
    enum rg_code_kind kind, text;
    const char *name;
};

enum { SPIRV_STAGES = 3 };

static const struct spirv_stage spirv_stages[SPIRV_STAGES] = {
    {RG_CODE_SPIRV, RG_CODE_GLSL, "compute"},
    {RG_CODE_VERTEX_SPIRV, RG_CODE_VERTEX_GLSL, "vertex"},
    {RG_CODE_FRAGMENT_SPIRV, RG_CODE_FRAGMENT_GLSL, "fragment"}};

#endif
