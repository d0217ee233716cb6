// Launches of cells with a known truth: each draws a number of panes over the picture, by the
// technique raster. For selftest.py and for the traces of courses.c.
//
// launching DEVICE record N COUNT...
//     N launches of cells with COUNT panes: a line each, "number stolen others ms ms ..."
// launching DEVICE {ratio|alike} X COUNT COUNT
//     one course of a claim that the first cell is X times as fast, or that both are alike to X
// launching DEVICE falls COUNT...
//     one course of a claim that cells get slower
// Courses print "verdict launches disturbed seconds".
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/log.h"
#include "harness/console/clock.h"
#include "harness/console/threads.h"
#include "harness/devices/measure/serving/serving.h"
#include "harness/devices/workers/worker.h"
#include "harness/tables/launching/launches.h"

enum { MOST = 16 };

static struct rg_table_row rows[MOST];
static char sets[MOST][64];
static struct rg_table table = {.id = "launching",
                                .technique = "raster",
                                .about = "panes by their number",
                                .columns = {"quads"},
                                .key_count = 1,
                                .variants = {{"full", "", NULL}},
                                .width = 256,
                                .height = 144,
                                .rows = rows,
                                .note = ""};

static void make_rows(char **counts, int count)
{
    table.row_count = count < MOST ? count : MOST;
    for (int i = 0; i < table.row_count; i++) {
        snprintf(sets[i], sizeof(sets[i]), "scene=quads turn_deg=0 quads=%d", atoi(counts[i]));
        rows[i] = (struct rg_table_row){.set = sets[i], .values = {atof(counts[i])}};
    }
}

// Describes all rows as if they had been measured, since only launches matter here.
static bool begin(struct rg_result *result, const struct rg_devices *devices)
{
    const struct rg_table_part part = {.last_row = table.row_count - 1, .full = true};
    rg_table_begin(result, &table, &part, devices);
    for (int row = 0; row < table.row_count; row++) {
        if (!rg_table_add_row(result, &table, row))
            return false;
        struct rg_record *record = rg_result_at(result, (struct rg_place){.row = row});
        record->sample_count = record->wanted_samples = 1;
        record->samples_ms[0] = 1;
        rg_record_settle(record);
    }
    return true;
}

static int record(struct rg_result *result, int count)
{
    struct rg_launch_cells cells = {.count = table.row_count, .group_count = 1};
    for (int row = 0; row < table.row_count; row++)
        cells.cells[row].at.row = row;
    for (int number = 1; number <= count; number++) {
        if (!rg_launch_take(result, &table, &cells, number))
            return 1;
        for (int row = 0; row < table.row_count; row++) {
            struct rg_record *r = rg_result_at(result, (struct rg_place){.row = row});
            const struct rg_launch *l = &r->launches[0];
            if (!row)
                printf("%d %.4f %.4f", l->number, l->stolen, l->others);
            printf(" %.6g", l->ms);
            r->launch_count = 0;
        }
        printf("\n");
        fflush(stdout);
    }
    return 0;
}

static int decide(struct rg_result *result, const char *kind, double bound)
{
    const struct rg_claim claims[] = {{.table = "launching",
                                       .variant = "full",
                                       .where = "",
                                       .words = kind,
                                       .test = !strcmp(kind, "ratio")   ? RG_CLAIM_RATIO
                                               : !strcmp(kind, "alike") ? RG_CLAIM_ALIKE
                                                                        : RG_CLAIM_FALLS,
                                       .first = 1,
                                       .last = table.row_count,
                                       .least = bound,
                                       .most = bound},
                                      {.table = NULL}};
    const struct rg_launches_wanted wanted = {.claims = claims};
    struct rg_progress bar;
    const double start_ms = rg_now_ms();
    rg_progress_start(&bar, 1);
    const bool ok = rg_launches_take(result, &table, &wanted, NULL, &bar, 0);
    rg_progress_end(&bar);
    const struct rg_judgement j = rg_claim_judge(claims, result, 0);
    printf("%s, %d launches, %d disturbed, %.1f s: %s\n", rg_claim_verdict_text(j.verdict),
           j.launches, j.disturbed, (rg_now_ms() - start_ms) / 1000, j.why);
    return !ok;
}

int main(int argc, char **argv)
{
    struct rg_devices devices;
    struct rg_result result = {.first_row = 0};
    if (argc == 3 && !strcmp(argv[1], RG_WORKER_ARGUMENT)) {
        rg_threads_fit();
        return rg_serving(argv[2]);
    }
    if (argc < 5) {
        rg_error("launching DEVICE {record N|ratio X|alike X|falls} COUNT...");
        return 2;
    }
    rg_workers.program = "/proc/self/exe";
    rg_workers.timeout_s = 60;
    const bool is_falls = !strcmp(argv[2], "falls"), is_record = !strcmp(argv[2], "record");
    const int first = is_falls ? 3 : 4;
    make_rows(argv + first, argc - first);
    if (rg_devices_open(argv[1], &devices) || !begin(&result, &devices))
        return 1;
    const int exit = is_record ? record(&result, atoi(argv[3]))
                               : decide(&result, argv[2], is_falls ? 0 : atof(argv[3]));
    rg_result_free(&result);
    return rg_devices_close(&devices) ? exit : 1;
}
