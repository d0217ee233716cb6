// What no driver may do to a kernel's floats stands in its SPIR-V, in every stage: each float
// operation is decorated NoContraction, and nothing is called whose rounding is a driver's own
// choice.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/dialect/spirv.h"

// Words of the SPIR-V specification, sections 2.3, 3.20 and 3.49.
enum {
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

// Drivers filter and derive as they see fit. Texels are fetched, one by one.
static const struct {
    int first, last;
    const char *name;
} refused_ops[] = {{87, 94, "OpImageSample"}, {96, 97, "OpImageGather"}, {207, 215, "OpDPdx"}};

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

static const char *refused_op_name(int op)
{
    for (size_t i = 0; i < sizeof(refused_ops) / sizeof(refused_ops[0]); i++)
        if (op >= refused_ops[i].first && op <= refused_ops[i].last)
            return refused_ops[i].name;
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
    int op = spirv_op(at[0]);
    if (op == OP_EXT_INST_IMPORT && !strcmp((const char *)&at[2], "GLSL.std.450"))
        *imported = at[1];
    if (op == OP_DECORATE && at[2] == DECORATION_NO_CONTRACTION && at[1] < bound)
        exact[at[1]] = true;
    if (float_op_name(op)) {
        found->operations++;
        if (at[2] >= bound || !exact[at[2]])
            note(found, float_op_name(op), (int)at[2]);
    }
    if (refused_op_name(op))
        note(found, refused_op_name(op), op);
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
    for (size_t at = SPIRV_HEADER_WORDS; at < count; at += spirv_length(words[at])) {
        if (spirv_length(words[at]) == 0 || at + spirv_length(words[at]) > count) {
            note(&found, "broken instruction at word", (int)at);
            break;
        }
        inspect(&words[at], exact, bound, &imported, &found);
    }
    free(exact);
    return found;
}

// Nothing is found in a stage that the kernel does not have.
static struct findings inspect_stage(const struct rg_kernel *kernel, enum rg_code_kind kind)
{
    const struct rg_kernel_code *code = &kernel->code[kind];
    return code->bytes ? inspect_module(spirv_words(code), code->size / 4) : (struct findings){0};
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
        for (int s = 0; s < SPIRV_STAGES; s++) {
            struct findings found = inspect_stage(all[i], spirv_stages[s].kind);
            if (found.fault[0] && !is_probe(all[i]))
                fail_msg("kernel '%s', %s stage: %s may be rounded otherwise; see "
                         "kernels/build/flatten.py",
                         all[i]->name, spirv_stages[s].name, found.fault);
        }
    }
}

// A GRID kernel has one stage, a DRAW program the two others.
static void every_kernel_has_its_stages(void **state)
{
    (void)state;
    const struct rg_kernel *const *all;
    int count = rg_kernel_all(&all);
    for (int i = 0; i < count; i++)
        for (int s = 0; s < SPIRV_STAGES; s++)
            assert_int_equal(all[i]->code[spirv_stages[s].kind].size > 0,
                             !all[i]->draw == (spirv_stages[s].kind == RG_CODE_SPIRV));
}

static void the_inspection_sees_operations(void **state)
{
    (void)state;
    struct findings found = inspect_stage(rg_kernel_find("test_precise"), RG_CODE_SPIRV);
    assert_true(found.operations >= 25);
    assert_true(found.instructions >= 3);
    const struct rg_kernel *program = rg_kernel_find("test_quads");
    assert_true(inspect_stage(program, RG_CODE_VERTEX_SPIRV).operations >= 2);
    assert_true(inspect_stage(program, RG_CODE_FRAGMENT_SPIRV).operations >= 5);
}

// How often a fault was found in a module with one decoration, one square root or one fetch made
// another.
struct faults {
    int decorations, roots, fetches;
};

static bool faulty_with(uint32_t *words, size_t count, uint32_t *changed, uint32_t value)
{
    const uint32_t was = *changed;
    *changed = value;
    const bool faulty = inspect_module(words, count).fault[0];
    *changed = was;
    return faulty;
}

static struct faults spoil(const struct rg_kernel *kernel, enum rg_code_kind kind)
{
    const uint32_t restrict_decoration = 19, glsl_fma = 50, glsl_sqrt = 31, image_sample = 88;
    const int image_fetch = 95;
    const struct rg_kernel_code *code = &kernel->code[kind];
    const size_t count = code->size / 4;
    struct faults faults = {0};
    uint32_t *words = malloc(code->size);
    memcpy(words, code->bytes, code->size);
    for (size_t at = SPIRV_HEADER_WORDS; at < count; at += spirv_length(words[at])) {
        uint32_t *word = &words[at];
        const int op = spirv_op(word[0]);
        if (op == OP_DECORATE && word[2] == DECORATION_NO_CONTRACTION)
            faults.decorations += faulty_with(words, count, &word[2], restrict_decoration);
        if (op == OP_EXT_INST && word[4] == glsl_sqrt)
            faults.roots += faulty_with(words, count, &word[4], glsl_fma);
        if (op == image_fetch)
            faults.fetches +=
                faulty_with(words, count, &word[0], (word[0] & 0xffff0000u) | image_sample);
    }
    const struct findings intact = inspect_module(words, count);
    assert_string_equal(intact.fault, "");
    assert_int_equal(faults.decorations, intact.operations); // glslang decorates some others too
    free(words);
    return faults;
}

static void the_inspection_finds_faults(void **state)
{
    (void)state;
    assert_true(spoil(rg_kernel_find("test_precise"), RG_CODE_SPIRV).roots >= 1);
    assert_true(spoil(rg_kernel_find("test_quads"), RG_CODE_VERTEX_SPIRV).decorations >= 2);
    assert_true(spoil(rg_kernel_find("test_quads"), RG_CODE_FRAGMENT_SPIRV).fetches >= 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_kernel_is_exact),
        cmocka_unit_test(every_kernel_has_its_stages),
        cmocka_unit_test(the_inspection_sees_operations),
        cmocka_unit_test(the_inspection_finds_faults),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
