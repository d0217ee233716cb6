// Simulates courses of claims, 10,000 for each kind of claim and truth: at most 0.5 % of the
// verdicts may be false. A launch's noise is either drawn in blocks from recorded launches of equal
// cells (launches.txt), or has two states 15 % apart with a lag-1 autocorrelation of 0.5.
//
// courses LAUNCHES.TXT
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "harness/tables/claims/claim.h"
#include "tests/tools/expect.h"

enum { ROWS = 6, COURSES = 10000, MOST_FALSE = COURSES / 200, BLOCK = 8, MOST_TRACES = 400 };
// The most launches that a course can take.
enum { LAUNCHES = 192 };

static double traces[MOST_TRACES][ROWS]; // logarithms, of cells with equal work
static int trace_count;

static uint32_t state = 1;

static double chance(void)
{
    state = state * 1664525u + 1013904223u;
    return ((double)(state >> 8) + 0.5) * 0x1p-24;
}

// --- noise ---

static void read_traces(const char *path)
{
    FILE *file = fopen(path, "r");
    char line[512];
    assert_non_null(file);
    while (fgets(line, sizeof(line), file) && trace_count < MOST_TRACES) {
        double ms[ROWS];
        if (*line == '#')
            continue;
        assert_int_equal(sscanf(line, "%*d %*f %*f %lf %lf %lf %lf %lf %lf", &ms[0], &ms[1], &ms[2],
                                &ms[3], &ms[4], &ms[5]),
                         ROWS);
        for (int i = 0; i < ROWS; i++)
            traces[trace_count][i] = log(ms[i]);
        trace_count++;
    }
    fclose(file);
    assert_at_least(trace_count, 100);
}

static void draw_recorded(double logs[LAUNCHES][ROWS][2], int rows, int variants)
{
    int at = 0;
    for (int l = 0; l < LAUNCHES; l++) {
        at = l % BLOCK ? (at + 1) % trace_count : (int)(chance() * trace_count);
        for (int row = 0; row < rows; row++)
            for (int v = 0; v < variants; v++) // the other variant has another row's noise
                logs[l][row][v] = traces[at][(row + 3 * v) % ROWS];
    }
}

// Each cell is slow in half of its launches, and keeps its state in three of four.
static void draw_two_states(double logs[LAUNCHES][ROWS][2], int rows, int variants)
{
    for (int row = 0; row < rows; row++) {
        for (int v = 0; v < variants; v++) {
            bool is_slow = chance() < 0.5;
            for (int l = 0; l < LAUNCHES; l++) {
                is_slow ^= chance() < 0.25;
                logs[l][row][v] = is_slow * log(1.15) + 0.02 * (chance() + chance() - 1);
            }
        }
    }
}

// --- courses ---

// A claim, and rows' true times of both variants, in arbitrary units.
struct truth {
    struct rg_claim claim;
    double ms[ROWS], other_ms;
    enum rg_claim_verdict wrong; // the verdict that is false
};

static struct rg_result result;

static void make_result(void)
{
    snprintf(result.table, sizeof(result.table), "made-up");
    snprintf(result.variants[0], RG_NAME_SIZE, "full");
    snprintf(result.variants[1], RG_NAME_SIZE, "other");
    result.variant_count = 2;
    result.device_count = 1;
    result.last_row = ROWS - 1;
    for (int row = 0; row < ROWS; row++) {
        assert_true(rg_result_add_row(&result, row));
        for (int v = 0; v < 2; v++) {
            struct rg_record *r =
                rg_result_at(&result, (struct rg_place){.row = row, .variant = v});
            r->sample_count = r->row_count = r->published_count = 1;
            snprintf(r->row[0].name, sizeof(r->row[0].name), "size");
            r->row[0].number = pow(2, row);
            snprintf(r->published[0].name, sizeof(r->published[0].name), "fps");
            r->published[0].number = 100 - 5 * row - 40 * v;
            r->samples_ms[0] = 1;
            r->launch_count = LAUNCHES;
            rg_record_settle(r);
        }
    }
}

static void set_launches(const struct truth *truth, double logs[LAUNCHES][ROWS][2], int variants)
{
    for (int row = 0; row < truth->claim.last; row++)
        for (int v = 0; v < variants; v++) {
            struct rg_record *r =
                rg_result_at(&result, (struct rg_place){.row = row, .variant = v});
            const double ms = v ? truth->other_ms : truth->ms[row];
            for (int l = 0; l < LAUNCHES; l++)
                r->launches[l] =
                    (struct rg_launch){.number = l + 1, .ms = ms * exp(logs[l][row][v])};
        }
}

static void run(const struct truth *truth, void (*draw)(double[LAUNCHES][ROWS][2], int, int),
                const char *noise, int counts[RG_CLAIM_VERDICTS])
{
    static double logs[LAUNCHES][ROWS][2];
    const int variants = truth->claim.other ? 2 : 1;
    memset(counts, 0, RG_CLAIM_VERDICTS * sizeof(*counts));
    for (int i = 0; i < COURSES; i++) {
        draw(logs, truth->claim.last, variants);
        set_launches(truth, logs, variants);
        counts[rg_claim_judge(&truth->claim, &result, 0).verdict]++;
    }
    printf("%s, %s: %d yes, %d no, %d at the bound, %d open\n", truth->claim.words, noise,
           counts[RG_CLAIM_REPRODUCED], counts[RG_CLAIM_NOT_REPRODUCED], counts[RG_CLAIM_AT_BOUND],
           counts[RG_CLAIM_UNDECIDED]);
    if (counts[truth->wrong] > MOST_FALSE)
        fail_msg("%s, %s: %d of %d are false", truth->claim.words, noise, counts[truth->wrong],
                 COURSES);
}

// clang-format off
#define CLAIM(words_, test_, last_, ...)                                                           \
    {.table = "made-up", .variant = "full", .words = words_, .test = test_, .first = 1,            \
      .last = last_, __VA_ARGS__}
#define LEVEL {1, 1, 1, 1, 1, 1}
#define YES RG_CLAIM_REPRODUCED
#define NO  RG_CLAIM_NOT_REPRODUCED
// Truths are 0.5 % from the bound, where a wrong verdict is most probable, or equal.
static const struct truth truths[] = {
    {CLAIM("ratio, just less", RG_CLAIM_RATIO, 2, .least = 1.205), {1, 1.2}, 1, YES},
    {CLAIM("ratio, just more", RG_CLAIM_RATIO, 2, .least = 1.195), {1, 1.2}, 1, NO},
    {CLAIM("from to, just less", RG_CLAIM_TIMES, 2, .least = 1.205, .most = 1.3), {1, 1.2}, 1, YES},
    {CLAIM("alike, just apart", RG_CLAIM_ALIKE, 4, .most = 1.1), {1, 1.105, 1, 1}, 1, YES},
    {CLAIM("alike, just alike", RG_CLAIM_ALIKE, 4, .most = 1.1), {1, 1.095, 1, 1}, 1, NO},
    {CLAIM("apart, just alike", RG_CLAIM_APART, 4, .least = 1.1), {1, 1.095, 1, 1}, 1, YES},
    {CLAIM("falls, not at all", RG_CLAIM_FALLS, 6, .least = 0), {1, 1.01, 1.02, 1.03, 1.04, 1.045}, 1, YES},
    {CLAIM("falls, with a dip", RG_CLAIM_FALLS, 6, .least = 0), {1, 1.2, 1.2, 1.085, 1.4, 1.5}, 1, YES},
    {CLAIM("falls, just so", RG_CLAIM_FALLS, 6, .least = 0), {1, 1.2, 1.2, 1.095, 1.4, 1.5}, 1, NO},
    {CLAIM("order, turned", RG_CLAIM_ORDER, 4, .least = 0), {1, 1.2, 1.195, 1.4}, 1, YES},
    {CLAIM("order, just so", RG_CLAIM_ORDER, 4, .least = 0), {1, 1.2, 1.205, 1.4}, 1, NO},
    {CLAIM("power, just more", RG_CLAIM_EXPONENT, 6, .least = -0.03, .most = 0.03), {1, 1.0246, 1.0497, 1.0755, 1.1019, 1.129}, 1, YES},
    {CLAIM("faster, just not", RG_CLAIM_FASTER, 3, .other = "other", .least = 1.2), {1, 1, 1.005}, 1.2, YES},
    {CLAIM("faster, just so", RG_CLAIM_FASTER, 3, .other = "other", .least = 1.2), {0.995, 0.995, 0.995}, 1.2, NO},
    {CLAIM("fastest, just not", RG_CLAIM_OPTIMUM, 4, .knee = 2), {1, 0.905, 0.9, 1}, 1, YES},
    {CLAIM("fastest, just so", RG_CLAIM_OPTIMUM, 4, .knee = 2), {1, 0.9, 0.905, 1}, 1, NO},
    {CLAIM("slowest, just not", RG_CLAIM_SLOWEST, 4, .knee = 2), {1, 1.1, 1.105, 1}, 1, YES},
    {CLAIM("crosses, just not", RG_CLAIM_CROSSES, 4, .other = "other", .knee = 3), {1.2, 1.1, 1.005, 0.9}, 1, YES},
    {CLAIM("crosses, just so", RG_CLAIM_CROSSES, 4, .other = "other", .knee = 3), {1.2, 1.1, 0.995, 0.9}, 1, NO},
};
// clang-format on

static void false_verdicts_are_rare(void **user)
{
    (void)user;
    for (size_t i = 0; i < sizeof(truths) / sizeof(truths[0]); i++) {
        int counts[RG_CLAIM_VERDICTS];
        run(&truths[i], draw_recorded, "recorded noise", counts);
        run(&truths[i], draw_two_states, "two states", counts);
    }
}

// A rate has no second cell that shares its launch's noise, so its truth is the recorded median.
static void rates(void **user)
{
    (void)user;
    double sorted[MOST_TRACES];
    for (int i = 0; i < trace_count; i++)
        sorted[i] = traces[i][0];
    const double fps = 1000 / exp(rg_median(sorted, trace_count).median);
    int counts[RG_CLAIM_VERDICTS];
    const struct truth truth = {CLAIM("rate, just less", RG_CLAIM_RATE, 1, .least = fps * 1.005),
                                LEVEL, 1, YES};
    run(&truth, draw_recorded, "recorded noise", counts);
}

// 95 % of cells 10 and 30 % apart are decided, and 90 % of equal cells against a margin of 10 %.
static void most_are_decided(void **user)
{
    (void)user;
    static const struct truth decided[] = {
        {CLAIM("10 % apart", RG_CLAIM_RATIO, 2, .least = 1), {1, 1.1}, 1, NO},
        {CLAIM("30 % apart", RG_CLAIM_RATIO, 2, .least = 1), {1, 1.3}, 1, NO},
        {CLAIM("equal, within 10 %", RG_CLAIM_ALIKE, 2, .most = 1.1), LEVEL, 1, NO}};
    for (size_t i = 0; i < sizeof(decided) / sizeof(decided[0]); i++) {
        int counts[RG_CLAIM_VERDICTS];
        run(&decided[i], draw_recorded, "recorded noise", counts);
        assert_at_least(counts[YES], COURSES * (i < 2 ? 95 : 90) / 100);
    }
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(false_verdicts_are_rare),
                                       cmocka_unit_test(rates), cmocka_unit_test(most_are_decided)};
    if (argc < 2)
        return 2;
    read_traces(argv[1]);
    make_result();
    return cmocka_run_group_tests(tests, NULL, NULL);
}
