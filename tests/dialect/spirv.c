#include "tests/dialect/spirv.h"

#include <spirv-tools/libspirv.h> // defines a variable: one file of a program can include it
#include <spirv/unified1/spirv.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "tests/tools/expect.h"

const struct spirv_stage spirv_stages[SPIRV_STAGES] = {
    {RG_CODE_SPIRV, RG_CODE_GLSL, "compute", false},
    {RG_CODE_VERTEX_SPIRV, RG_CODE_VERTEX_GLSL, "vertex", false},
    {RG_CODE_FRAGMENT_SPIRV, RG_CODE_FRAGMENT_GLSL, "fragment", false},
    {RG_CODE_BLENDED_FRAGMENT_SPIRV, RG_CODE_FRAGMENT_GLSL, "blending fragment", false},
    {RG_CODE_ROUNDED_SPIRV, RG_CODE_GLSL, "rounded compute", true},
    {RG_CODE_ROUNDED_VERTEX_SPIRV, RG_CODE_VERTEX_GLSL, "rounded vertex", true},
    {RG_CODE_ROUNDED_FRAGMENT_SPIRV, RG_CODE_FRAGMENT_GLSL, "rounded fragment", true},
    {RG_CODE_ROUNDED_BLENDED_FRAGMENT_SPIRV, RG_CODE_FRAGMENT_GLSL, "rounded blending fragment",
     true}};

struct rg_kernel_code spirv_code(const struct rg_kernel *kernel, enum rg_code_kind kind)
{
    enum { MOST_KERNELS = 1000 };
    static struct rg_kernel_code all[MOST_KERNELS][RG_CODE_COUNT];
    const int index = rg_kernel_index(kernel);
    assert_between(index, 0, MOST_KERNELS - 1);
    struct rg_kernel_code *code = &all[index][kind];
    if (!code->bytes)
        assert_true(rg_embedded_code(&kernel->code[kind], kernel->name, code));
    return *code;
}

struct spirv_module spirv_module(const struct rg_kernel *kernel, enum rg_code_kind kind)
{
    const struct rg_kernel_code code = spirv_code(kernel, kind);
    return (struct spirv_module){(const uint32_t *)(const void *)code.bytes, code.size / 4};
}

struct reader {
    bool (*look)(const struct spirv_instruction *instruction, void *data);
    void *data;
};

static spv_result_t hand_on(void *user_data, const spv_parsed_instruction_t *parsed)
{
    const struct reader *reader = user_data;
    const struct spirv_instruction instruction = {
        .words = parsed->words,
        .count = parsed->num_words,
        .op = parsed->opcode,
        .name = spvOpcodeString(parsed->opcode),
        .result = parsed->result_id,
        .of_glsl = parsed->ext_inst_type == SPV_EXT_INST_TYPE_GLSL_STD_450,
        .of_float = parsed->opcode == SpvOpConstant &&
                    parsed->operands[2].number_kind == SPV_NUMBER_FLOATING,
    };
    return reader->look(&instruction, reader->data) ? SPV_SUCCESS : SPV_UNSUPPORTED;
}

void spirv_read(struct spirv_module module,
                bool (*look)(const struct spirv_instruction *instruction, void *data), void *data)
{
    spv_context context = spvContextCreate(SPV_ENV_VULKAN_1_2);
    spv_diagnostic diagnostic = NULL;
    struct reader reader = {look, data};
    const spv_result_t result =
        spvBinaryParse(context, &reader, module.words, module.count, NULL, hand_on, &diagnostic);
    if (result != SPV_SUCCESS)
        fail_msg("result %d: %s", result,
                 diagnostic ? diagnostic->error : "an instruction that no kernel may have");
    spvContextDestroy(context);
}

bool spirv_is_valid(struct spirv_module module, char *why, size_t size)
{
    spv_context context = spvContextCreate(SPV_ENV_VULKAN_1_2);
    spv_diagnostic diagnostic = NULL;
    spvValidateBinary(context, module.words, module.count, &diagnostic);
    const bool valid = diagnostic == NULL;
    if (!valid)
        snprintf(why, size, "%s", diagnostic->error);
    spvDiagnosticDestroy(diagnostic);
    spvContextDestroy(context);
    return valid;
}
