// What no driver may do to a kernel's floats stands in its SPIR-V: every float operation is
// decorated NoContraction, and nothing is called whose rounding is a driver's own choice.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/kernel.h"

// Words of the SPIR-V specification, sections 2.3, 3.20 and 3.49.
enum {
    HEADER_WORDS = 5,
    BOUND_WORD = 3,
    OP_EXT_INST_IMPORT = 11,
    OP_EXT_INST = 12,
    OP_DECORATE = 71,
    DECORATION_NO_CONTRACTION = 42,
};

static const struct {
    int op;
    const char *name;
} float_ops[] = {
    {127, "OpFNegate"},
    {129, "OpFAdd"},
    {131, "OpFSub"},
    {133, "OpFMul"},
    {136, "OpFDiv"},
    {140, "OpFRem"},
    {141, "OpFMod"},
    {142, "OpVectorTimesScalar"},
    {143, "OpMatrixTimesScalar"},
    {144, "OpVectorTimesMatrix"},
    {145, "OpMatrixTimesVector"},
    {146, "OpMatrixTimesMatrix"},
    {147, "OpOuterProduct"},
    {148, "OpDot"},
};

// The instructions of GLSL.std.450 that are exact on every driver; all others are refused.
static const struct {
    uint32_t number;
    const char *name;
} exact_instructions[] = {
    {3, "Trunc"},     {4, "FAbs"},      {5, "SAbs"},    {6, "FSign"},   {7, "SSign"},
    {8, "Floor"},     {9, "Ceil"},      {31, "Sqrt"},   {38, "UMin"},   {39, "SMin"},
    {41, "UMax"},     {42, "SMax"},     {44, "UClamp"}, {45, "SClamp"}, {73, "FindILsb"},
    {74, "FindSMsb"}, {75, "FindUMsb"},
};

struct findings {
    int operations, instructions; // looked at
    char fault[160];              // the first; "" if there is none
};

static const char *float_op_name(int op)
{
    for (size_t i = 0; i < sizeof(float_ops) / sizeof(float_ops[0]); i++)
        if (float_ops[i].op == op)
            return float_ops[i].name;
    return NULL;
}

static bool is_exact(uint32_t instruction)
{
    for (size_t i = 0; i < sizeof(exact_instructions) / sizeof(exact_instructions[0]); i++)
        if (exact_instructions[i].number == instruction)
            return true;
    return false;
}

static void note(struct findings *found, const char *what, int number)
{
    if (!found->fault[0])
        snprintf(found->fault, sizeof(found->fault), "%s %d", what, number);
}

// `exact` has a flag an id: decorated NoContraction. Decorations precede all uses.
static void inspect(const uint32_t *at, bool *exact, uint32_t bound, uint32_t *imported,
                    struct findings *found)
{
    int op = at[0] & 0xffff;
    if (op == OP_EXT_INST_IMPORT && !strcmp((const char *)&at[2], "GLSL.std.450"))
        *imported = at[1];
    if (op == OP_DECORATE && at[2] == DECORATION_NO_CONTRACTION && at[1] < bound)
        exact[at[1]] = true;
    if (float_op_name(op)) {
        found->operations++;
        if (at[2] >= bound || !exact[at[2]])
            note(found, float_op_name(op), (int)at[2]);
    }
    if (op == OP_EXT_INST && at[3] == *imported) {
        found->instructions++;
        if (!is_exact(at[4]))
            note(found, "instruction of GLSL.std.450, number", (int)at[4]);
    }
}

static struct findings inspect_module(const uint32_t *words, size_t count)
{
    struct findings found = {0};
    uint32_t imported = 0, bound = words[BOUND_WORD];
    bool *exact = calloc(bound, sizeof(*exact));
    for (size_t at = HEADER_WORDS; at < count; at += words[at] >> 16) {
        if (words[at] >> 16 == 0 || at + (words[at] >> 16) > count) {
            note(&found, "broken instruction at word", (int)at);
            break;
        }
        inspect(&words[at], exact, bound, &imported, &found);
    }
    free(exact);
    return found;
}

static struct findings inspect_kernel(const struct rg_kernel *kernel)
{
    const struct rg_kernel_code *code = &kernel->code[RG_CODE_SPIRV];
    return inspect_module((const uint32_t *)(const void *)code->bytes, code->size / 4);
}

// Kernels that probe what a driver makes of its built-in functions call them on purpose.
static bool is_probe(const struct rg_kernel *kernel)
{
    return !strncmp(kernel->name, "probe_builtin", strlen("probe_builtin"));
}

static void every_kernel_is_exact(void **state)
{
    (void)state;
    const struct rg_kernel *const *all;
    int count = rg_kernel_all(&all);
    assert_true(count > 0);
    for (int i = 0; i < count; i++) {
        struct findings found = inspect_kernel(all[i]);
        if (found.fault[0] && !is_probe(all[i]))
            fail_msg("kernel '%s': %s may be rounded otherwise; see kernels/flatten.py",
                     all[i]->name, found.fault);
    }
}

static void the_inspection_sees_operations(void **state)
{
    (void)state;
    struct findings found = inspect_kernel(rg_kernel_find("test_precise"));
    assert_true(found.operations >= 25);
    assert_true(found.instructions >= 3);
}

// The module of test_precise with one decoration, then one instruction, made another.
static void the_inspection_finds_faults(void **state)
{
    (void)state;
    const struct rg_kernel_code *code = &rg_kernel_find("test_precise")->code[RG_CODE_SPIRV];
    size_t count = code->size / 4;
    const uint32_t restrict_decoration = 19, glsl_fma = 50, glsl_sqrt = 31;
    uint32_t *words = malloc(code->size);
    int faults = 0, roots = 0;
    memcpy(words, code->bytes, code->size);
    for (size_t at = HEADER_WORDS; at < count; at += words[at] >> 16) {
        uint32_t *word = &words[at];
        bool decoration = (word[0] & 0xffff) == OP_DECORATE && word[2] == DECORATION_NO_CONTRACTION;
        bool root = (word[0] & 0xffff) == OP_EXT_INST && word[4] == glsl_sqrt;
        if (!decoration && !root)
            continue;
        uint32_t *changed = decoration ? &word[2] : &word[4], was = *changed;
        *changed = decoration ? restrict_decoration : glsl_fma;
        bool fault = inspect_module(words, count).fault[0];
        *changed = was;
        faults += fault && decoration;
        roots += fault && root;
    }
    struct findings intact = inspect_module(words, count);
    assert_int_equal(faults, intact.operations); // glslang decorates some other operations too
    assert_true(roots >= 1);
    assert_string_equal(intact.fault, "");
    free(words);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_kernel_is_exact),
        cmocka_unit_test(the_inspection_sees_operations),
        cmocka_unit_test(the_inspection_finds_faults),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
