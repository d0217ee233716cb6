// The SPIR-V of every stage forbids drivers to change a kernel's floats. Each float operation is
// decorated NoContraction, and no function is called whose rounding a driver may choose.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <spirv/unified1/GLSL.std.450.h>
#include <spirv/unified1/spirv.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "tests/dialect/spirv.h"
#include "tests/tools/expect.h"

static bool is_float_operation(uint32_t op)
{
    switch (op) {
    case SpvOpFNegate:
    case SpvOpFAdd:
    case SpvOpFSub:
    case SpvOpFMul:
    case SpvOpFDiv:
    case SpvOpFRem:
    case SpvOpFMod:
    case SpvOpVectorTimesScalar:
    case SpvOpMatrixTimesScalar:
    case SpvOpVectorTimesMatrix:
    case SpvOpMatrixTimesVector:
    case SpvOpMatrixTimesMatrix:
    case SpvOpOuterProduct:
    case SpvOpDot:
        return true;
    default:
        return false;
    }
}

// Filtering and derivatives are up to drivers, so that kernels fetch texels one by one.
static bool is_refused(uint32_t op)
{
    return (op >= SpvOpImageSampleImplicitLod && op <= SpvOpImageSampleProjDrefExplicitLod) ||
           op == SpvOpImageGather || op == SpvOpImageDrefGather ||
           (op >= SpvOpDPdx && op <= SpvOpFwidthCoarse);
}

// The functions of GLSL.std.450 that are exact on every driver; the others are refused.
static bool is_exact(uint32_t function)
{
    switch (function) {
    case GLSLstd450Trunc:
    case GLSLstd450FAbs:
    case GLSLstd450SAbs:
    case GLSLstd450FSign:
    case GLSLstd450SSign:
    case GLSLstd450Floor:
    case GLSLstd450Ceil:
    case GLSLstd450Sqrt:
    case GLSLstd450UMin:
    case GLSLstd450SMin:
    case GLSLstd450UMax:
    case GLSLstd450SMax:
    case GLSLstd450UClamp:
    case GLSLstd450SClamp:
    case GLSLstd450FindILsb:
    case GLSLstd450FindSMsb:
    case GLSLstd450FindUMsb:
        return true;
    default:
        return false;
    }
}

struct findings {
    bool *exact;               // one flag an id: decorated NoContraction
    int operations, functions; // numbers inspected
    char fault[160];           // the first fault; "" if there is none
};

static void note(struct findings *found, const char *what, uint32_t number)
{
    if (!found->fault[0])
        snprintf(found->fault, sizeof(found->fault), "%s %u", what, number);
}

// Decorations precede all uses, so that one pass suffices.
static bool inspect(const struct spirv_instruction *at, void *data)
{
    struct findings *found = data;
    if (at->op == SpvOpDecorate && at->words[2] == SpvDecorationNoContraction)
        found->exact[at->words[1]] = true;
    if (is_float_operation(at->op)) {
        found->operations++;
        if (!found->exact[at->result])
            note(found, at->name, at->result);
    }
    if (is_refused(at->op))
        note(found, at->name, at->result);
    if (at->op == SpvOpExtInst && at->of_glsl) {
        found->functions++;
        if (!is_exact(at->words[4]))
            note(found, "function of GLSL.std.450, number", at->words[4]);
    }
    return true;
}

// A stage that the kernel lacks has no findings.
static struct findings inspect_module(struct spirv_module module)
{
    enum { BOUND_WORD = 3 }; // all ids are below it (SPIR-V specification, section 2.3)
    struct findings found = {0};
    if (!module.count)
        return found;
    found.exact = calloc(module.words[BOUND_WORD], sizeof(*found.exact));
    assert_non_null(found.exact);
    spirv_read(module, inspect, &found);
    free(found.exact);
    return found;
}

// Kernels that probe a driver's built-in functions call them on purpose.
static bool is_probe(const struct rg_kernel *kernel)
{
    return !strncmp(kernel->name, "probe_builtin", strlen("probe_builtin"));
}

static void every_kernel_is_exact(void **state)
{
    (void)state;
    const struct rg_kernel *const *all;
    int count = rg_kernel_all(&all);
    assert_above(count, 0);
    for (int i = 0; i < count; i++) {
        for (int s = 0; s < SPIRV_STAGES; s++) {
            struct findings found = inspect_module(spirv_module(all[i], spirv_stages[s].kind));
            if (found.fault[0] && !is_probe(all[i]))
                fail_msg("kernel '%s', %s stage: %s may be rounded otherwise; see "
                         "kernels/build/flatten.py",
                         all[i]->name, spirv_stages[s].name, found.fault);
        }
    }
}

static void every_module_is_valid(void **state)
{
    (void)state;
    const struct rg_kernel *const *all;
    int count = rg_kernel_all(&all), modules = 0;
    for (int i = 0; i < count; i++) {
        for (int s = 0; s < SPIRV_STAGES; s++) {
            const struct spirv_module module = spirv_module(all[i], spirv_stages[s].kind);
            char why[400];
            if (module.count && !spirv_is_valid(module, why, sizeof(why)))
                fail_msg("kernel '%s', %s stage: %s", all[i]->name, spirv_stages[s].name, why);
            modules += module.count > 0;
        }
    }
    assert_at_least(modules, count);
}

// A GRID kernel has one stage, and a DRAW program the other two.
static void every_kernel_has_its_stages(void **state)
{
    (void)state;
    const struct rg_kernel *const *all;
    int count = rg_kernel_all(&all);
    for (int i = 0; i < count; i++)
        for (int s = 0; s < SPIRV_STAGES; s++)
            assert_int_equal(all[i]->code[spirv_stages[s].kind].size > 0,
                             !all[i]->draw == (spirv_stages[s].text == RG_CODE_GLSL));
}

static struct spirv_module find_module(const char *kernel, enum rg_code_kind kind)
{
    return spirv_module(rg_kernel_find(kernel), kind);
}

static void the_inspection_sees_operations(void **state)
{
    (void)state;
    struct findings found = inspect_module(find_module("test_precise", RG_CODE_SPIRV));
    assert_at_least(found.operations, 25);
    assert_at_least(found.functions, 3);
    assert_at_least(inspect_module(find_module("test_quads", RG_CODE_VERTEX_SPIRV)).operations, 2);
    assert_at_least(inspect_module(find_module("test_quads", RG_CODE_FRAGMENT_SPIRV)).operations,
                    5);
}

// How often the inspection found a module's fault, with one decoration, square root or fetch
// replaced.
struct faults {
    int decorations, roots, fetches;
};

struct spoiled {
    uint32_t *words;
    size_t count, at; // the number of words; the inspected instruction
    struct faults faults;
};

static bool faulty_with(struct spoiled *spoiled, size_t at, uint32_t value)
{
    const uint32_t was = spoiled->words[at];
    spoiled->words[at] = value;
    const struct spirv_module module = {spoiled->words, spoiled->count};
    const bool faulty = inspect_module(module).fault[0];
    spoiled->words[at] = was;
    return faulty;
}

static bool spoil_one(const struct spirv_instruction *instruction, void *data)
{
    struct spoiled *spoiled = data;
    const uint32_t *words = instruction->words;
    const size_t at = spoiled->at;
    struct faults *faults = &spoiled->faults;
    if (instruction->op == SpvOpDecorate && words[2] == SpvDecorationNoContraction)
        faults->decorations += faulty_with(spoiled, at + 2, SpvDecorationRestrict);
    if (instruction->op == SpvOpExtInst && words[4] == GLSLstd450Sqrt)
        faults->roots += faulty_with(spoiled, at + 4, GLSLstd450InverseSqrt);
    if (instruction->op == SpvOpImageFetch)
        faults->fetches +=
            faulty_with(spoiled, at, (words[0] & ~SpvOpCodeMask) | SpvOpImageSampleExplicitLod);
    spoiled->at += instruction->count;
    return true;
}

static struct faults spoil(const char *kernel, enum rg_code_kind kind)
{
    enum { HEADER_WORDS = 5 };
    const struct spirv_module module = find_module(kernel, kind);
    struct spoiled spoiled = {calloc(module.count, 4), module.count, HEADER_WORDS, {0}};
    assert_non_null(spoiled.words);
    memcpy(spoiled.words, module.words, module.count * 4);
    spirv_read(module, spoil_one, &spoiled);
    free(spoiled.words);
    const struct findings intact = inspect_module(module);
    assert_string_equal(intact.fault, "");
    // glslang decorates some other instructions, too.
    assert_int_equal(spoiled.faults.decorations, intact.operations);
    return spoiled.faults;
}

static void the_inspection_finds_faults(void **state)
{
    (void)state;
    assert_at_least(spoil("test_precise", RG_CODE_SPIRV).roots, 1);
    assert_at_least(spoil("test_quads", RG_CODE_VERTEX_SPIRV).decorations, 2);
    assert_at_least(spoil("test_quads", RG_CODE_FRAGMENT_SPIRV).fetches, 1);
}

// --- rounding ---

// The uses of values in a module with quotients and roots.
enum { IS_BITS = 1, IS_ROUGH = 2, IS_CHOSEN = 4 };

struct roundings {
    unsigned char *ids; // flags of each id
    int rough;          // quotients and roots
};

// Whether all operands are significands, which kernels/dialect/rounding.h assembles from bits.
static bool is_guess(const struct roundings *r, const struct spirv_instruction *at, size_t operands)
{
    for (size_t i = operands; i < at->count; i++)
        if (!(r->ids[at->words[i]] & IS_BITS))
            return false;
    return true;
}

static bool note_rounding(const struct spirv_instruction *at, void *data)
{
    struct roundings *r = data;
    const bool is_root = at->op == SpvOpExtInst && at->of_glsl && at->words[4] == GLSLstd450Sqrt;
    if (at->op == SpvOpBitcast || at->op == SpvOpConstant)
        r->ids[at->result] |= IS_BITS;
    if (at->op == SpvOpFDiv || is_root) {
        r->rough++;
        if (!is_guess(r, at, is_root ? 5 : 3))
            r->ids[at->result] |= IS_ROUGH;
    }
    // One of two values: of a select, of two branches, or of a variable that both store to.
    if (at->op == SpvOpSelect)
        r->ids[at->words[4]] |= IS_CHOSEN, r->ids[at->words[5]] |= IS_CHOSEN;
    for (size_t i = 3; at->op == SpvOpPhi && i < at->count; i += 2)
        r->ids[at->words[i]] |= IS_CHOSEN;
    if (at->op == SpvOpStore)
        r->ids[at->words[2]] |= IS_CHOSEN;
    return true;
}

// How many quotients and roots of a module are used unrounded: no choice could replace them.
static int left_to_the_driver(struct spirv_module module, int *rough)
{
    enum { BOUND_WORD = 3 };
    struct roundings r = {calloc(module.words[BOUND_WORD], sizeof(*r.ids)), 0};
    assert_non_null(r.ids);
    spirv_read(module, note_rounding, &r);
    int left = 0;
    for (uint32_t id = 0; id < module.words[BOUND_WORD]; id++)
        left += (r.ids[id] & IS_ROUGH) && !(r.ids[id] & IS_CHOSEN);
    free(r.ids);
    *rough += r.rough;
    return left;
}

// Running cannot show this on software drivers, since theirs are exact.
static void no_quotient_is_left_to_the_driver(void **state)
{
    (void)state;
    const struct rg_kernel *const *all;
    const int count = rg_kernel_all(&all);
    int rough = 0, plain = 0, plain_left = 0;
    for (int i = 0; i < count; i++)
        for (int s = 0; s < SPIRV_STAGES; s++) {
            const struct spirv_module module = spirv_module(all[i], spirv_stages[s].kind);
            const bool rounds = spirv_stages[s].rounds;
            if (!module.count)
                continue;
            const int left = left_to_the_driver(module, rounds ? &rough : &plain);
            if (rounds && left)
                fail_msg("kernel '%s', %s stage: %d quotients or roots are the driver's; see "
                         "kernels/build/quotients.py",
                         all[i]->name, spirv_stages[s].name, left);
            plain_left += rounds ? 0 : left;
        }
    assert_above(rough, 1000);
    assert_above(plain, 500);
    assert_above(plain_left, plain / 2); // so that one that is left would be seen
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_kernel_is_exact),
        cmocka_unit_test(every_module_is_valid),
        cmocka_unit_test(every_kernel_has_its_stages),
        cmocka_unit_test(the_inspection_sees_operations),
        cmocka_unit_test(the_inspection_finds_faults),
        cmocka_unit_test(no_quotient_is_left_to_the_driver),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
