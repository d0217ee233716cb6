// glslc folds constants in double precision and rounds once, but C rounds after each operation:
// `180.0f / 3.14159274f / 20.0f` becomes another float. So the kernel's text must hold each float
// constant of a SPIR-V module, as a literal or as the float result of an expression of literals.
// The test does not see constants that were folded further, into integers and booleans.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <ctype.h>
#include <math.h>
#include <spirv/unified1/spirv.h>
#include <stdlib.h>
#include <string.h>

#include "tests/dialect/spirv.h"
#include "tests/tools/expect.h"

// --- constants of the text ---

struct values {
    float *all;
    int count, room;
};

// Ignores signs: a minus rounds nothing.
static void record(struct values *values, double value)
{
    if (values->count == values->room) {
        values->room = values->room ? 2 * values->room : 1024;
        values->all = realloc(values->all, (size_t)values->room * sizeof(*values->all));
        assert_non_null(values->all);
    }
    values->all[values->count++] = (float)fabs(value);
}

static bool has_value(const struct values *values, float value)
{
    for (int i = 0; i < values->count; i++)
        if (values->all[i] == fabsf(value))
            return true;
    return false;
}

// Whether a value has this significand, as kernels/dialect/rounding.h derives it from a constant
// divisor.
static bool has_significand(const struct values *values, float significand)
{
    int exponent;
    for (int i = 0; significand >= 1 && significand < 4 && i < values->count; i++)
        if (values->all[i] > 0 &&
            frexpf(values->all[i], &exponent) == frexpf(significand, &exponent))
            return true;
    return false;
}

// The result of a constant expression; a float is held exactly.
struct number {
    double value;
    bool whole; // an integer in its language
};

struct reader {
    const char *at;
    struct values *values;
};

static bool is_name_char(char c)
{
    return isalnum((unsigned char)c) || c == '_';
}

// The next character that is not a space.
static char next(struct reader *reader)
{
    while (isspace((unsigned char)*reader->at))
        reader->at++;
    return *reader->at;
}

static bool take(struct reader *reader, char c)
{
    if (next(reader) != c)
        return false;
    reader->at++;
    return true;
}

static bool take_name(struct reader *reader, const char *name)
{
    const size_t length = strlen(name);
    next(reader);
    if (strncmp(reader->at, name, length) || is_name_char(reader->at[length]))
        return false;
    reader->at += length;
    return true;
}

static bool take_literal(struct reader *reader, struct number *to)
{
    const char c = next(reader);
    if (!isdigit((unsigned char)c) && !(c == '.' && isdigit((unsigned char)reader->at[1])))
        return false;
    const size_t whole = strspn(reader->at, "0123456789");
    const bool hexadecimal = c == '0' && (reader->at[1] == 'x' || reader->at[1] == 'X');
    char *end;
    to->whole = hexadecimal || !strchr(".eEfF", reader->at[whole]) || !reader->at[whole];
    to->value =
        to->whole ? (double)strtoull(reader->at, &end, 0) : (double)strtof(reader->at, &end);
    reader->at = end + (*end && strchr("fFuU", *end));
    record(reader->values, to->value);
    return true;
}

static bool take_sum(struct reader *reader, struct number *to);

static bool take_brackets(struct reader *reader, struct number *to)
{
    return take(reader, '(') && take_sum(reader, to) && take(reader, ')');
}

static bool take_operand(struct reader *reader, struct number *to)
{
    if (take(reader, '-')) {
        const bool taken = take_operand(reader, to);
        to->value = -to->value;
        return taken;
    }
    if (take_name(reader, "float")) {
        const bool taken = take_brackets(reader, to);
        *to = (struct number){(double)(float)to->value, false};
        return taken;
    }
    return next(reader) == '(' ? take_brackets(reader, to) : take_literal(reader, to);
}

// A double holds the result of two floats so well that rounding it to a float equals rounding once
// (S. Figueroa, "When is double rounding innocuous?", 1995).
static struct number reckon(struct number a, char operation, struct number b)
{
    const double value = operation == '+'   ? a.value + b.value
                         : operation == '-' ? a.value - b.value
                         : operation == '*' ? a.value * b.value
                         : b.value != 0     ? a.value / b.value
                                            : 0;
    const bool whole = a.whole && b.whole;
    return (struct number){whole ? trunc(value) : (double)(float)value, whole};
}

// Operands joined by `operations`, from the left. Text after the last operand stays unread.
static bool take_chain(struct reader *reader, const char *operations,
                       bool (*take_part)(struct reader *, struct number *), struct number *to)
{
    if (!take_part(reader, to))
        return false;
    for (;;) {
        const char operation = next(reader), *before = reader->at;
        struct number part = {0};
        if (!operation || !strchr(operations, operation))
            return true;
        reader->at++;
        if (!take_part(reader, &part)) {
            reader->at = before;
            return true;
        }
        *to = reckon(*to, operation, part);
        record(reader->values, to->value);
    }
}

static bool take_product(struct reader *reader, struct number *to)
{
    return take_chain(reader, "*/", take_operand, to);
}

static bool take_sum(struct reader *reader, struct number *to)
{
    return take_chain(reader, "+-", take_product, to);
}

static void skip_word(struct reader *reader)
{
    struct number number;
    if (take_literal(reader, &number))
        return;
    const char *start = reader->at;
    while (is_name_char(*reader->at))
        reader->at++;
    reader->at += reader->at == start;
}

// The results of all constant expressions in a text, and of all their parts.
static struct values read_values(const char *text)
{
    struct values values = {0};
    struct reader reader = {text, &values};
    while (next(&reader)) {
        const char *start = reader.at;
        struct number number = {0};
        take_sum(&reader, &number);
        reader.at = start;
        skip_word(&reader);
    }
    return values;
}

static struct values values_of(struct rg_kernel_code text)
{
    char *copy = calloc(1, text.size + 1);
    assert_non_null(copy);
    memcpy(copy, text.bytes, text.size);
    const struct values values = read_values(copy);
    free(copy);
    return values;
}

// --- constants of the module ---

enum { MOST_CONSTANTS = 1000 };

struct constants {
    float all[MOST_CONSTANTS];
    int count;
};

// All floats must have 32 bits, and none may be a specialisation constant.
static bool read_constant(const struct spirv_instruction *at, void *data)
{
    struct constants *constants = data;
    if (at->op == SpvOpSpecConstant || (at->op == SpvOpTypeFloat && at->words[2] != 32))
        return false;
    if (!at->of_float)
        return true;
    if (constants->count == MOST_CONSTANTS)
        return false;
    memcpy(&constants->all[constants->count++], &at->words[3], sizeof(*constants->all));
    return true;
}

// The float constants of a stage's module, in order, and the values in its text. Both stay empty if
// the kernel lacks the stage.
struct stage {
    struct constants constants;
    struct values values; // the caller frees them
};

static struct stage read_stage(const struct rg_kernel *kernel, const struct spirv_stage *stage)
{
    struct stage read = {0};
    const struct spirv_module module = spirv_module(kernel, stage->kind);
    if (module.count) {
        read.values = values_of(spirv_code(kernel, stage->text));
        spirv_read(module, read_constant, &read.constants);
    }
    return read;
}

static void every_constant_is_written(void **state)
{
    (void)state;
    const struct rg_kernel *const *all;
    const int count = rg_kernel_all(&all);
    int faults = 0;
    for (int i = 0; i < count * SPIRV_STAGES; i++) {
        const struct rg_kernel *kernel = all[i / SPIRV_STAGES];
        const struct spirv_stage *stage = &spirv_stages[i % SPIRV_STAGES];
        struct stage read = read_stage(kernel, stage);
        for (int c = 0; c < read.constants.count; c++) {
            const float constant = read.constants.all[c];
            if (has_value(&read.values, constant) ||
                (stage->rounds && has_significand(&read.values, constant)))
                continue;
            print_error("kernel '%s', %s stage: no expression comes to %.9g in floats\n",
                        kernel->name, stage->name, (double)constant);
            faults++;
        }
        free(read.values.all);
    }
    if (faults)
        fail_msg("glslc folded them in double precision: write such constants out");
}

// --- the test finds planted constants ---

static bool comes_to(const char *text, double value)
{
    const struct values values = read_values(text);
    const bool has = has_value(&values, (float)value);
    free(values.all);
    return has;
}

static void expressions_come_to_what_c_makes_of_them(void **state)
{
    (void)state;
    const float pi = 3.14159274f, tenth = 0.1f;
    const char *const degrees =
        "float steps(float x) { return x * (180.0f / 3.14159274f / 20.0f); }";
    assert_true(comes_to(degrees, (double)(180.0f / pi / 20.0f)));
    assert_false(comes_to(degrees, 180 / (double)pi / 20));
    assert_true(comes_to("least(x, rg_exact_7 = (0.1f * 0.1f))", (double)(tenth * tenth)));
    assert_false(comes_to("least(x, rg_exact_7 = (0.1f * 0.1f))", 0.01));
    assert_true(comes_to("x - (float(7 / 2 * 5) - -.5e1f)", 20));
    assert_true(comes_to("x * 2.0f + 0x10u", 16) && comes_to("3.0f * 4.0f * x", 12));
    assert_false(comes_to("3.0f * x * 4.0f", 12));
    assert_false(comes_to("x7 + v1_25.x / 2.0f", 7) || comes_to("x7 + v1_25.x / 2.0f", 25));
    assert_false(comes_to("(3.0f + x) + 4.0f", 7));
}

// Counts the float constants of a stage of a kernel. `missed` counts those that could be one step
// of a float larger unnoticed, since the text has that float, too.
static void count_steps(const struct rg_kernel *kernel, const struct spirv_stage *stage,
                        int *constants, int *missed)
{
    struct stage read = read_stage(kernel, stage);
    for (int i = 0; i < read.constants.count; i++)
        *missed += has_value(&read.values, nextafterf(read.constants.all[i], INFINITY));
    *constants += read.constants.count;
    free(read.values.all);
}

static void a_last_bit_is_seen(void **state)
{
    (void)state;
    const struct rg_kernel *const *all;
    const int count = rg_kernel_all(&all);
    int constants = 0, missed = 0;
    for (int i = 0; i < count; i++)
        for (int s = 0; s < SPIRV_STAGES; s++)
            count_steps(all[i], &spirv_stages[s], &constants, &missed);
    assert_above(constants, 500);
    assert_below(200 * missed, constants);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_constant_is_written),
        cmocka_unit_test(expressions_come_to_what_c_makes_of_them),
        cmocka_unit_test(a_last_bit_is_seen),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
