// A farm of a thousand machines that only a clock of numbers moves: cells are planned, measured by
// machines that fail and straggle, and merged.
//
//     simulated CELLS [SEED]
//
// Times of cells, failures and stragglers follow from the seed. Prints what planning, failures,
// stragglers and merging cost. Fails where a cell is lost or counted twice, or where planning and
// merging take more of a processor, or more memory, than is promised here. A processor's time is
// bounded and the clock's is not, for other programs may run beside this one.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "core/base/log.h"
#include "harness/console/clock.h"
#include "harness/console/exit.h"
#include "harness/record/disk/stored.h"
#include "harness/tables/farm/cut.h"
#include "harness/tables/farm/merge.h"
#include "kernels/dialect/rng.h"
#include "tests/harness/farm/made.h"
#include "tests/tools/expect.h"
#include "tests/tools/process/folder.h"
#include "tests/tools/process/logged.h"

// A table has 50 rows of 10 variants on two devices.
enum { ROWS = 50, VARIANTS = 10, ROW_CELLS = 2 * VARIANTS, TABLE_CELLS = ROWS * ROW_CELLS };
enum { CELLS_A_NODE = 100 }; // a thousand nodes for 100,000 cells
#define CELL_S        30.0   // mean; times spread by a hundred times
#define FAILURES_HOUR 0.01   // of a node
#define REQUEUE_S     120.0  // until a failed shard begins anew
#define STRAGGLERS    0.03   // of the nodes, which take twice to four times as long
#define TWICE         0.01   // of the records, a second time in another folder
#define CUT           0.002  // of the records, cut in one folder and whole in another
// Most seconds of a processor for 100,000 cells, as promised.
#define PLAN_S      10.0
#define MERGE_S     60.0
#define MERGE_BYTES 2e9

static int64_t wanted_cells = 4000;
static uint seed = 1;

// A number from 0 to below 1.
static double chance(uint what, uint a, uint b)
{
    return rg_random(what, seed, a, b).x / 4294967296.0;
}

struct took {
    double by_clock_s, of_processor_s;
};

static struct took now(void)
{
    struct timespec time;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return (struct took){rg_now_ms() / 1000, (double)time.tv_sec + 1e-9 * (double)time.tv_nsec};
}

static struct took since(struct took begin)
{
    const struct took end = now();
    return (struct took){end.by_clock_s - begin.by_clock_s,
                         end.of_processor_s - begin.of_processor_s};
}

// --- planning ---

static void set_times(struct rg_farm_plan *plan)
{
    for (int64_t i = 0; i < plan->cell_count; i++) {
        plan->cells[i].seconds =
            CELL_S / 21.5 * exp(log(100) * chance(0, (uint)i, 0)); // mean of exp: 99 / log(100)
        plan->cells[i].is_known = true;
    }
    rg_farm_sum(plan);
}

// Makes, writes, reads and cuts the plan of the farm's tables; returns the processor's seconds.
static double plan_farm(struct farm *farm, const char *path, int shards, int *shard_of)
{
    struct rg_farm_plan made = {.shards = shards}, read = {0};
    double longest_s;
    const struct took begin = now();
    rg_text_copy(made.commit, sizeof(made.commit), farm->plan.commit);
    assert_true(rg_farm_name_devices(&made, "cpu,cpu:reference"));
    assert_true(rg_farm_make(&made, farm->all, farm->table_count));
    set_times(&made);
    assert_true(rg_farm_plan_write(&made, path));
    assert_true(rg_farm_plan_read(&read, path));
    assert_true(rg_farm_cut(&read, shards, shard_of, &longest_s));
    const struct took took = since(begin);
    const double mean_s = rg_farm_sum(&read) / shards;
    assert_int_equal(read.cell_count, made.cell_count);
    printf("plan: %lld cells in %lld groups, %d shards, %.2f s (%.2f s of a processor); the "
           "longest shard is %.3f of the mean, %.0f s\n",
           (long long)read.cell_count, (long long)read.group_count, shards, took.by_clock_s,
           took.of_processor_s, longest_s / mean_s, mean_s);
    rg_farm_plan_free(&made);
    rg_farm_plan_free(&farm->plan);
    farm->plan = read;
    return took.of_processor_s;
}

// --- measuring ---

// A shard on its way through nodes that fail.
struct course {
    double seconds; // until it is done
    double lost_s;  // of it, by failures
    int failures;
};

// How much longer a node takes.
static double slowness(int shard, int node)
{
    const double x = chance(1, (uint)shard, (uint)node);
    return x < STRAGGLERS ? 2 + 2 * x / STRAGGLERS : 1;
}

static double life_s(int shard, int node)
{
    return -log(1 - chance(2, (uint)shard, (uint)node)) * 3600 / FAILURES_HOUR;
}

// A failure loses the group under way; the groups before it have their records.
static struct course run_shard(const struct rg_farm_plan *plan, const int *shard_of, int shard)
{
    struct course c = {0};
    int node = 0;
    double left_s = life_s(shard, node), slow = slowness(shard, node);
    for (int64_t g = 0; g < plan->group_count;) {
        const double group_s = plan->groups[g].seconds * slow;
        if (shard_of[g] != shard) {
            g++;
        } else if (group_s <= left_s) {
            c.seconds += group_s;
            left_s -= group_s;
            g++;
        } else {
            c.seconds += left_s + REQUEUE_S;
            c.lost_s += left_s + REQUEUE_S;
            c.failures++;
            node++;
            left_s = life_s(shard, node);
            slow = slowness(shard, node);
        }
    }
    return c;
}

static void run_shards(struct rg_farm_plan *plan, const int *shard_of, int shards)
{
    double longest_s = 0, sum_s = 0, lost_s = 0;
    int failures = 0, slow = 0;
    for (int shard = 1; shard <= shards; shard++) {
        const struct course c = run_shard(plan, shard_of, shard);
        longest_s = fmax(longest_s, c.seconds);
        sum_s += c.seconds;
        lost_s += c.lost_s;
        failures += c.failures;
        slow += slowness(shard, 0) > 1;
    }
    const double mean_s = rg_farm_sum(plan) / shards;
    printf("measuring: %d failures lose %.2f %% of the time, %d stragglers; the last shard ends "
           "after %.2f times the mean\n",
           failures, 100 * lost_s / sum_s, slow, longest_s / mean_s);
}

// Writes a record as a shard does, but without the sync, which saves it if the machine falls.
static void write_record(const struct farm *farm, int64_t group, const char *to, bool is_cut)
{
    struct rg_result result = measure_group(farm, group, 0);
    const struct rg_farm_group *g = &farm->plan.groups[group];
    json_t *json = rg_farm_record_json(&farm->plan, g, &result, g->seconds);
    char *text = json_dumps(json, JSON_COMPACT | RG_JSON_FLAGS);
    FILE *file = fopen(record_path(farm, group, to), "wb");
    assert_true(text && file);
    const size_t size = strlen(text) / (is_cut ? 2 : 1);
    assert_int_equal(fwrite(text, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
    free(text);
    json_decref(json);
    rg_result_free(&result);
}

struct left {
    int64_t twice, cut;
};

// Leaves all records in one folder, and some in another as well.
static struct left leave_records(const struct farm *farm, const char *all, const char *other)
{
    struct left left = {0};
    for (int64_t g = 0; g < farm->plan.group_count; g++) {
        const double x = chance(3, (uint)g, 0);
        const bool is_cut = x < CUT, is_twice = !is_cut && x < CUT + TWICE;
        write_record(farm, g, all, is_cut);
        if (is_cut || is_twice)
            write_record(farm, g, other, false);
        left.cut += is_cut;
        left.twice += is_twice;
    }
    return left;
}

// --- merging ---

static double merge_farm(const struct farm *farm, const char *const folders[2], const char *out,
                         struct left left)
{
    struct rg_farm_records found = {0};
    const struct took begin = now();
    rg_log_listen(log_last, NULL);
    assert_true(rg_farm_records_find(&found, &farm->plan, folders, 2));
    rg_log_listen(NULL, NULL);
    const struct took finding = since(begin);
    assert_int_equal(found.damaged, left.cut);
    assert_int_equal(found.twice, left.twice);
    assert_int_equal(rg_farm_missing(&found, &farm->plan), 0);
    assert_int_equal(rg_farm_merge(&farm->plan, &found, out), RG_EXIT_PASS);
    const struct took took = since(begin);
    printf("merge: %.1f s (%.1f s of a processor), of which checking the records takes %.1f s "
           "(%.1f s)\n",
           took.by_clock_s, took.of_processor_s, finding.by_clock_s, finding.of_processor_s);
    rg_farm_found_free(&found);
    return took.of_processor_s;
}

// Counts the cells of the merged tables, one table at a time.
static int64_t count_cells(const struct farm *farm, const char *out)
{
    int64_t cells = 0;
    for (int t = 0; t < farm->table_count; t++) {
        char path[512];
        struct rg_stored stored = {0};
        snprintf(path, sizeof(path), "%s/farm-%d.json", out, t);
        assert_true(rg_stored_read(&stored, path));
        struct rg_place at = rg_result_start(&stored.results[0]);
        while (rg_result_next(&stored.results[0], &at))
            cells++;
        rg_stored_free(&stored);
    }
    return cells;
}

static double peak_bytes(void)
{
    struct rusage usage;
    getrusage(RUSAGE_SELF, &usage);
    return 1024.0 * (double)usage.ru_maxrss;
}

static void test_simulated(void **state)
{
    (void)state;
    struct farm farm;
    char paths[4][64];
    assert_int_equal(make_folder(state), 0);
    for (int i = 0; i < 4; i++)
        snprintf(paths[i], sizeof(paths[i]), "%s/%s", folder,
                 ((const char *[]){"plan.json", "all", "other", "out"})[i]);
    mkdir(paths[1], 0777);
    mkdir(paths[2], 0777);
    make_farm(&farm, (int)(wanted_cells / TABLE_CELLS), ROWS, VARIANTS);
    const int shards = (int)(wanted_cells / CELLS_A_NODE);
    int *shard_of = calloc((size_t)farm.plan.group_count, sizeof(*shard_of));
    assert_non_null(shard_of);
    const double plan_s = plan_farm(&farm, paths[0], shards, shard_of);
    run_shards(&farm.plan, shard_of, shards);
    const struct left left = leave_records(&farm, paths[1], paths[2]);
    const char *const folders[] = {paths[1], paths[2]};
    const double merge_s = merge_farm(&farm, folders, paths[3], left);
    printf("memory: %.0f MB at most, with what made the records\n", peak_bytes() / 1e6);
    assert_int_equal(count_cells(&farm, paths[3]), wanted_cells);
    remove_whole_folder(state);
    free(shard_of);
    unmake_farm(&farm);
    assert_at_most(plan_s, PLAN_S);
    assert_at_most(merge_s, MERGE_S);
    assert_at_most(peak_bytes(), MERGE_BYTES);
}

int main(int argc, char **argv)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_simulated)};
    if (argc > 1)
        wanted_cells = atoll(argv[1]) / TABLE_CELLS * TABLE_CELLS;
    if (argc > 2)
        seed = (uint)atoi(argv[2]);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
