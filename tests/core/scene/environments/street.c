// The street is computed the same everywhere, and is what drops should have behind them.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdlib.h>
#include <xxhash.h>

#include "core/base/log.h"
#include "core/scene/environment/blur.h"
#include "core/scene/environment/cube.h"
#include "core/techniques/technique.h"
#include "tests/tools/expect.h"

static uint64_t hash_of(const struct rg_environment *environment)
{
    const size_t side = (size_t)environment->size + 2;
    return XXH3_64bits(environment->light, 6 * side * side * 3 * sizeof(float));
}

static struct rg_environment *load(const char *name, int size_px)
{
    struct rg_environment *environment = rg_environment_load(name, size_px);
    assert_non_null(environment);
    return environment;
}

// --- the same bits everywhere ---

static void expect_bits(struct rg_environment *environment, const char *what, uint64_t bits)
{
    assert_non_null(environment);
    const uint64_t found = hash_of(environment);
    rg_environment_destroy(environment);
    if (found != bits)
        fail_msg("%s: %016llx, not %016llx: a change of it changes every digest that flow and "
                 "drops have in results/baseline.json",
                 what, (unsigned long long)found, (unsigned long long)bits);
}

static void every_machine_has_the_same(void **state)
{
    (void)state;
    expect_bits(load("street", 64), "the street by day", 0x22a5968000a1ca7du);
    expect_bits(load("street-night", 64), "by night", 0xd7ea9cb14317a810u);
    expect_bits(load("sky", 64), "the sky", 0x7846918a7dbaa8b6u);
}

static void blurred_it_is_the_same_too(void **state)
{
    (void)state;
    struct rg_environment *sharp = load("street-night", 128);
    expect_bits(rg_environment_blur(sharp, 0.03), "a little blurred", 0xf70db3049e35e4b7u);
    expect_bits(rg_environment_blur(sharp, 0.89), "blurred much", 0x200e9b07fe93d9ffu);
    rg_environment_destroy(sharp);
}

// --- what it is ---

static void it_is_as_fine_as_asked(void **state)
{
    (void)state;
    static const int asked[][2] = {{1, 16}, {100, 100}, {5000, 1024}};
    for (int i = 0; i < 3; i++) {
        struct rg_environment *environment = load("street", asked[i][0]);
        assert_int_equal(environment->size, asked[i][1]);
        rg_environment_destroy(environment);
    }
}

static int compare(const void *a, const void *b)
{
    const float x = *(const float *)a, y = *(const float *)b;
    return x < y ? -1 : x > y;
}

// The green light of all texels, from dark to bright; the caller frees it.
static float *sorted_greens(const struct rg_environment *environment, size_t *count)
{
    const int size = environment->size;
    float *greens = malloc(6 * (size_t)size * (size_t)size * sizeof(*greens));
    assert_non_null(greens);
    *count = 0;
    for (int face = 0; face < 6; face++)
        for (int y = 0; y < size; y++)
            for (int x = 0; x < size; x++)
                greens[(*count)++] = rg_environment_texel(environment, face, x, y)[1];
    qsort(greens, *count, sizeof(*greens), compare);
    return greens;
}

// Lamps by night outshine the rest many times over, as lights out of focus must; by day the middle
// is neither dark nor white at the exposure of 1.
static void light_has_the_range_of_its_time(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        float middle_least, middle_most, brightest_least;
    } times[] = {{"street", 0.1f, 0.6f, 5}, {"street-night", 0.005f, 0.1f, 20}};
    for (int i = 0; i < 2; i++) {
        struct rg_environment *environment = load(times[i].name, 256);
        size_t count;
        float *greens = sorted_greens(environment, &count);
        rg_environment_destroy(environment);
        assert_at_least(greens[0], 0);
        assert_above(greens[count / 2], times[i].middle_least);
        assert_below(greens[count / 2], times[i].middle_most);
        assert_above(greens[count - 1], times[i].brightest_least);
        assert_below(greens[count - 1], 1000);
        free(greens);
    }
}

// A lamp of a few texels keeps its light at any size.
static void small_lamps_keep_their_light(void **state)
{
    (void)state;
    double sums[2] = {0};
    for (int i = 0; i < 2; i++) {
        struct rg_environment *environment = load("street-night", i ? 256 : 64);
        const int size = environment->size;
        // The face ahead, its upper half: lamps, signals and windows far down the street.
        for (int y = 0; y < size / 2; y++)
            for (int x = 0; x < size; x++)
                sums[i] += (double)rg_environment_texel(environment, 5, x, y)[0] / size / size;
        rg_environment_destroy(environment);
    }
    assert_above(sums[1], 0.9 * sums[0]);
    assert_below(sums[1], 1.1 * sums[0]);
}

// --- who has it ---

static void count_line(enum rg_log_level level, const char *line, void *user)
{
    (void)level;
    print_error("%s\n", line);
    ++*(int *)user;
}

static void flow_and_drops_need_no_package(void **state)
{
    (void)state;
    static const char *const names[] = {"flow", "drops"};
    assert_int_equal(setenv("RG_ENVIRONMENT_DIR", "/nonexistent", 1), 0);
    int lines = 0;
    rg_log_listen(count_line, &lines);
    for (int i = 0; i < 2; i++) {
        const struct rg_technique *technique = rg_technique_find(names[i]);
        assert_non_null(technique);
        rg_environment_destroy(load(rg_params_find(technique->params, "environment")->text, 32));
    }
    rg_log_listen(NULL, NULL);
    assert_int_equal(lines, 0);
    unsetenv("RG_ENVIRONMENT_DIR");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_machine_has_the_same),
        cmocka_unit_test(blurred_it_is_the_same_too),
        cmocka_unit_test(it_is_as_fine_as_asked),
        cmocka_unit_test(light_has_the_range_of_its_time),
        cmocka_unit_test(small_lamps_keep_their_light),
        cmocka_unit_test(flow_and_drops_need_no_package),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
