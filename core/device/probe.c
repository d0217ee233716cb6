#include "core/device/probe.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/device/device.h"
#include "kernels/probe/ops_params.h"

enum inputs { WIDE, POSITIVE, SMALL, ANGLE, EXPONENT, POWER, MODULO, WORDS };
enum result { FLOAT, UINT };

#define ENUM_ROW(number, name, inputs, result, expression) OP_##name = number,
enum { RG_PROBE_OPS(ENUM_ROW) };

struct op {
    const char *name;
    enum inputs inputs;
    enum result result;
};

#define OP_ROW(number, name, inputs, result, expression) [number] = {#name, inputs, result},
static const struct op ops[] = {RG_PROBE_OPS(OP_ROW)};
static const struct op builtins[] = {RG_PROBE_BUILTINS(OP_ROW)};

// --- plain operations as the host computes them ---

static uint32_t bits_of(float f)
{
    uint32_t u;
    memcpy(&u, &f, sizeof(u));
    return u;
}

static float float_of(uint32_t u)
{
    float f;
    memcpy(&f, &u, sizeof(f));
    return f;
}

struct input {
    uint32_t a, b, c;
};

#define HOST_FLOAT(name, expression)                                                               \
    static uint32_t host_##name(struct input in)                                                   \
    {                                                                                              \
        const float a = float_of(in.a), b = float_of(in.b), c = float_of(in.c);                    \
        (void)a, (void)b, (void)c;                                                                 \
        return bits_of(expression);                                                                \
    }
#define HOST_UINT(name, expression)                                                                \
    static uint32_t host_##name(struct input in)                                                   \
    {                                                                                              \
        return (uint32_t)(expression);                                                             \
    }

HOST_FLOAT(add, a + b)
HOST_FLOAT(subtract, a - b)
HOST_FLOAT(multiply, a *b)
HOST_FLOAT(divide, a / b)
HOST_FLOAT(negate, -a)
HOST_FLOAT(abs, fabsf(a))
HOST_FLOAT(sqrt, sqrtf(a))
HOST_FLOAT(one_over_sqrt, 1.0f / sqrtf(a))
HOST_FLOAT(floor, floorf(a))
HOST_FLOAT(multiply_add, a *b + c)
HOST_FLOAT(minus_product, c - a * b)
HOST_FLOAT(member_multiply_add, a *b + c)
HOST_FLOAT(modulo, a - b * floorf(a / b))
HOST_FLOAT(lerp, a *(1.0f - c) + b * c)
HOST_FLOAT(sum_of_squares, (a * a + b * b) + c * c)
HOST_UINT(less, float_of(in.a) < float_of(in.b))
HOST_FLOAT(int_to_float, (float)((int32_t)(in.a >> 1) - 1073741824))
HOST_FLOAT(uint_to_float, (float)in.a)
HOST_UINT(float_to_int, (int32_t)truncf(float_of(in.a) * 1000.0f))
HOST_UINT(bits_of_float, in.a)
HOST_UINT(float_of_bits, in.a ^ 0x80000001u)
HOST_UINT(shift_left, in.a << (in.b % 32))
HOST_UINT(shift_right, in.a >> (in.b % 32))
HOST_UINT(multiply_low, (uint64_t)in.a *in.b)
HOST_UINT(multiply_high, ((uint64_t)in.a * in.b) >> 32)
HOST_UINT(divide_uint, in.a / (in.b / 512 + 1))
HOST_UINT(modulo_uint, in.a % (in.b / 512 + 1))
HOST_FLOAT(min, fminf(a, b))
HOST_FLOAT(max, fmaxf(a, b))
HOST_FLOAT(clamp, a < -1.0f ? -1.0f : (a > 1.0f ? 1.0f : a))

// The dialect composes the operations without a row here from others; they are compared with
// cpu:reference.
#define HOST_ROW(name) [OP_##name] = host_##name
static uint32_t (*const host[RG_PROBE_OP_COUNT])(struct input) = {
    HOST_ROW(add),           HOST_ROW(subtract),      HOST_ROW(multiply),
    HOST_ROW(divide),        HOST_ROW(negate),        HOST_ROW(abs),
    HOST_ROW(sqrt),          HOST_ROW(one_over_sqrt), HOST_ROW(floor),
    HOST_ROW(multiply_add),  HOST_ROW(minus_product), HOST_ROW(member_multiply_add),
    HOST_ROW(modulo),        HOST_ROW(lerp),          HOST_ROW(sum_of_squares),
    HOST_ROW(less),          HOST_ROW(int_to_float),  HOST_ROW(uint_to_float),
    HOST_ROW(float_to_int),  HOST_ROW(bits_of_float), HOST_ROW(float_of_bits),
    HOST_ROW(shift_left),    HOST_ROW(shift_right),   HOST_ROW(multiply_low),
    HOST_ROW(multiply_high), HOST_ROW(divide_uint),   HOST_ROW(modulo_uint),
    HOST_ROW(min),           HOST_ROW(max),           HOST_ROW(clamp),
};

// --- inputs ---

static uint32_t random_bits(uint64_t *seed)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return (uint32_t)(*seed >> 32);
}

static float random_within(uint64_t *seed, float low, float high)
{
    return low + (high - low) * ((float)(random_bits(seed) >> 8) * 0x1p-24f);
}

// Exponents that keep squares, quotients and sums of a few normal: 2^-30 to 2^30.
static uint32_t random_wide(uint64_t *seed)
{
    uint32_t bits = random_bits(seed);
    return (bits & 0x807fffffu) | ((97 + random_bits(seed) % 60) << 23);
}

static struct input draw(enum inputs inputs, uint64_t *seed)
{
    struct input in = {random_bits(seed), random_bits(seed), random_bits(seed)};
    switch (inputs) {
    case WORDS:
        break;
    case WIDE:
        in = (struct input){random_wide(seed), random_wide(seed), random_wide(seed)};
        // Every fourth pair is of close magnitude, where sums cancel.
        if (in.c % 4 == 0)
            in.b = (in.a ^ (in.c & 0x80000000u)) + in.c % 1024;
        break;
    case POSITIVE:
        in.a = random_wide(seed) & 0x7fffffffu;
        if (in.b % 4 == 0)
            in.a = 0x3f7ff000u + in.b % 8192; // around 1
        break;
    case SMALL:
        in = (struct input){bits_of(random_within(seed, -2.0f, 2.0f)),
                            bits_of(random_within(seed, -2.0f, 2.0f)),
                            bits_of(random_within(seed, 0.125f, 1.0f))};
        break;
    case ANGLE:
        in.a = bits_of(random_within(seed, -1000.0f, 1000.0f));
        break;
    case EXPONENT:
        in.a = bits_of(random_within(seed, -87.0f, 87.0f));
        break;
    case POWER:
        in.a = bits_of(random_within(seed, 0.001f, 10.0f));
        in.b = bits_of(random_within(seed, -8.0f, 8.0f));
        break;
    case MODULO:
        in.a = bits_of(random_within(seed, -1000.0f, 1000.0f));
        in.b = bits_of(random_within(seed, 0.1f, 10.0f));
        break;
    }
    return in;
}

struct inputs_of_op {
    uint32_t words[3][RG_PROBE_INPUTS];
};

static void draw_all(const struct op *op, struct inputs_of_op *drawn)
{
    uint64_t seed = 0x7a1d + (uint64_t)op->inputs;
    for (int i = 0; i < RG_PROBE_INPUTS; i++) {
        struct input in = draw(op->inputs, &seed);
        drawn->words[0][i] = in.a;
        drawn->words[1][i] = in.b;
        drawn->words[2][i] = in.c;
    }
}

// --- devices ---

// A device's buffers (three inputs, one result) and its pass for one list.
struct bench {
    struct rg_buf *bufs[4];
    struct rg_pass *pass;
};

static bool bench_init(struct bench *bench, struct rg_device *device, const char *kernel)
{
    static const char *const names[] = {"probe first", "probe second", "probe third",
                                        "probe result"};
    *bench = (struct bench){0};
    for (int i = 0; i < 4; i++)
        if (!(bench->bufs[i] = rg_buf_create(device, RG_PROBE_INPUTS * 4, names[i])))
            return false;
    return (bench->pass = rg_pass_create(device, kernel)) != NULL;
}

static void bench_finish(struct bench *bench)
{
    for (int i = 0; i < 4; i++)
        rg_buf_destroy(bench->bufs[i]);
    rg_pass_destroy(bench->pass);
}

static bool bench_run(struct bench *bench, int op, const struct inputs_of_op *drawn,
                      uint32_t *results)
{
    const struct probe_params params = {op};
    struct rg_run run = {.params = &params, .extent = {RG_PROBE_INPUTS, 1, 1}};
    for (int i = 0; i < 4; i++)
        run.slots[i + 1].buf = bench->bufs[i];
    for (int i = 0; i < 3; i++)
        if (!rg_buf_write(bench->bufs[i], 0, drawn->words[i], RG_PROBE_INPUTS * 4))
            return false;
    return rg_pass_run(bench->pass, &run) &&
           rg_buf_read(bench->bufs[3], 0, results, RG_PROBE_INPUTS * 4);
}

// --- comparing ---

// Maps floats to integers in their order, so that neighbours differ by 1 and -0 equals 0.
static int64_t rank(uint32_t bits)
{
    int64_t magnitude = bits & 0x7fffffffu;
    return bits >> 31 ? -magnitude : magnitude;
}

static void compare(const struct op *op, const uint32_t *got, const uint32_t *expected,
                    struct rg_probe_result *result)
{
    result->compared = RG_PROBE_INPUTS;
    for (int i = 0; i < RG_PROBE_INPUTS; i++) {
        int64_t distance = op->result == FLOAT ? rank(got[i]) - rank(expected[i])
                                               : (int64_t)got[i] - (int64_t)expected[i];
        distance = distance < 0 ? -distance : distance;
        result->different += got[i] != expected[i];
        if (distance > result->largest_ulps)
            result->largest_ulps = (uint32_t)distance;
    }
}

struct workspace {
    struct inputs_of_op drawn;
    uint32_t got[RG_PROBE_INPUTS], expected[RG_PROBE_INPUTS];
};

static bool expect(struct bench *reference, int op, bool builtin, struct workspace *work)
{
    if (builtin || !host[op])
        return bench_run(reference, op, &work->drawn, work->expected);
    for (int i = 0; i < RG_PROBE_INPUTS; i++)
        work->expected[i] = host[op]((struct input){
            work->drawn.words[0][i], work->drawn.words[1][i], work->drawn.words[2][i]});
    return true;
}

static bool probe_list(struct rg_device *device, struct rg_device *reference, bool builtin,
                       struct workspace *work, struct rg_probe_result *results)
{
    const struct op *list = builtin ? builtins : ops;
    const char *kernel = builtin ? "probe_builtin" : "probe_ops";
    struct bench tried, trusted = {0};
    bool ok = bench_init(&tried, device, kernel) && bench_init(&trusted, reference, kernel);
    for (int i = 0; ok && i < (builtin ? RG_PROBE_BUILTIN_COUNT : RG_PROBE_OP_COUNT); i++) {
        draw_all(&list[i], &work->drawn);
        ok = bench_run(&tried, i, &work->drawn, work->got) && expect(&trusted, i, builtin, work);
        if (ok)
            compare(&list[i], work->got, work->expected, &results[i]);
    }
    bench_finish(&tried);
    bench_finish(&trusted);
    return ok;
}

void rg_probe_name(struct rg_probe_result results[RG_PROBE_COUNT])
{
    for (int i = 0; i < RG_PROBE_OP_COUNT; i++)
        results[i] = (struct rg_probe_result){.name = ops[i].name};
    for (int i = 0; i < RG_PROBE_BUILTIN_COUNT; i++)
        results[RG_PROBE_OP_COUNT + i] =
            (struct rg_probe_result){.name = builtins[i].name, .builtin = true};
}

bool rg_probe_run(struct rg_device *device, struct rg_probe_result results[RG_PROBE_COUNT])
{
    struct rg_device *reference = rg_device_open("cpu:reference");
    struct workspace *work = rg_alloc(1, sizeof(*work), "probe");
    rg_probe_name(results);
    bool ok = reference && work && probe_list(device, reference, false, work, results) &&
              probe_list(device, reference, true, work, results + RG_PROBE_OP_COUNT);
    free(work);
    return rg_device_close(reference) && ok;
}
