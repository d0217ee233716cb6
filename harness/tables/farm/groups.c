#include "harness/tables/farm/groups.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "harness/console/clock.h"
#include "harness/console/duration.h"
#include "harness/console/exit.h"
#include "harness/console/interrupt.h"
#include "harness/devices/measure/others.h"
#include "harness/tables/farm/record.h"
#include "harness/tables/measuring/measure.h"
#include "harness/tables/print.h"
#include "harness/tables/runs/closing.h"

struct measuring {
    const struct rg_farm_plan *plan;
    const char *folder;
    rg_farm_find *find;
    struct rg_kept kept;
    struct rg_closing closing; // of what was measured now
    int groups, there;         // of the shard; among them those whose record was there
    bool is_lost;              // a record could not be written, and nor could others
};

// Begins the result of a group: of its table's rows only its own are wanted.
static void begin(const struct measuring *m, const struct rg_farm_group *group,
                  const struct rg_table *table, struct rg_result *result)
{
    const struct rg_farm_cell *cells = &m->plan->cells[group->first_cell];
    const int64_t g = group - m->plan->groups;
    const struct rg_table_part part = {.first_row = cells[0].row - 1,
                                       .last_row = cells[group->cell_count - 1].row - 1,
                                       .full = m->plan->full,
                                       .is_everywhere = true};
    rg_table_begin(result, table, &part, m->kept.devices);
    for (int row = part.first_row; row <= part.last_row; row++)
        result->left_out[row - part.first_row] = !rg_farm_has_row(m->plan, g, g + 1, row);
}

static void tell(const struct rg_farm_group *group, double seconds)
{
    char took[RG_DURATION_TEXT], expected[RG_DURATION_TEXT];
    printf("%s: %d cells, %s, expected %s\n", group->id, group->cell_count,
           rg_duration_text(seconds, took), rg_duration_text(group->seconds, expected));
    fflush(stdout);
}

static int measure(struct measuring *m, const struct rg_farm_group *group)
{
    const struct rg_table *table = m->find(group->table);
    struct rg_result result = {0};
    const double begin_ms = rg_now_ms();
    if (!table) {
        rg_error("%s: this raingauge has no such table; plan with it", group->id);
        return rg_exit_of_error();
    }
    begin(m, group, table, &result);
    const bool ok = rg_table_measure(&result, table, &m->kept, NULL, NULL, NULL);
    const double seconds = (rg_now_ms() - begin_ms) / 1000;
    int exit = ok ? rg_result_exit(&result) : rg_exit_of_error();
    if (ok && !rg_interrupted()) {
        rg_closing_add(&m->closing, &result);
        m->is_lost = !rg_farm_record_write(m->plan, group, &result, seconds, m->folder);
        if (m->is_lost)
            exit = rg_exit_worse(exit, rg_exit_of_error());
        else
            tell(group, seconds);
    }
    rg_result_free(&result);
    return exit;
}

// Measures a group, unless its record is there.
static int do_group(struct measuring *m, const struct rg_farm_group *group)
{
    struct rg_result there = {0};
    char why[RG_WHY_SIZE], name[RG_FARM_FILE], path[2048];
    rg_farm_file(group, name);
    m->groups++;
    if (snprintf(path, sizeof(path), "%s/%s", m->folder, name) >= (int)sizeof(path)) {
        rg_error("%.80s...: its name is too long", m->folder);
        return rg_exit_of_error();
    }
    const enum rg_farm_found found = rg_farm_record_read(m->plan, group, path, false, &there, why);
    if (found == RG_FARM_FOREIGN) {
        rg_error("%s", why);
        return rg_exit_of_error();
    }
    if (found == RG_FARM_DAMAGED)
        rg_warning("%s: that is done now", why);
    if (found != RG_FARM_WHOLE)
        return measure(m, group);
    const int exit = rg_result_exit(&there);
    m->there++;
    rg_result_free(&there);
    return exit;
}

static int measure_all(struct measuring *m, const struct rg_shard *shard, const int *shard_of)
{
    int exit = RG_EXIT_PASS;
    for (int64_t g = 0; g < m->plan->group_count && !rg_interrupted() && !m->is_lost; g++)
        if (shard_of[g] == shard->number)
            exit = rg_exit_worse(exit, do_group(m, &m->plan->groups[g]));
    if (rg_interrupted())
        return rg_exit_worse(exit, RG_EXIT_SIGNALLED + rg_interrupt_signal());
    if (m->is_lost)
        rg_info("shard %d of %d: ends here, for its next records would be lost as well; once they "
                "can be written, the same command goes on",
                shard->number, shard->count);
    if (!m->groups) {
        rg_error("shard %d of %d: has none of %lld groups; cut the plan into %lld shards at most",
                 shard->number, shard->count, (long long)m->plan->group_count,
                 (long long)m->plan->group_count);
        return RG_EXIT_NOTHING;
    }
    rg_info("shard %d of %d: %d of %d groups were there", shard->number, shard->count, m->there,
            m->groups);
    if (m->closing.cells)
        rg_closing_tell(&m->closing, m->kept.devices->count);
    return exit;
}

int rg_farm_measure(const struct rg_farm_plan *plan, const struct rg_shard *shard,
                    const struct rg_devices *devices, rg_farm_find *find, const char *folder)
{
    struct measuring m = {
        .plan = plan, .folder = folder, .find = find, .kept = {.devices = devices}};
    int *shard_of = rg_alloc((size_t)plan->group_count, sizeof(*shard_of), "shards");
    int exit = RG_EXIT_PASS;
    rg_interrupt_watch();
    rg_machine_probe(rg_processors_now);
    if (shard_of && rg_farm_cut(plan, shard->count, shard_of, NULL))
        exit = measure_all(&m, shard, shard_of);
    else
        exit = rg_exit_of_error();
    free(shard_of);
    if (ferror(stdout)) {
        rg_stdout_error();
        exit = rg_exit_worse(exit, rg_exit_of_error());
    }
    return rg_kept_free(&m.kept) ? exit : rg_exit_worse(exit, RG_EXIT_FAIL);
}
