#include "harness/compare/gate/run/gate.h"

#include <math.h>
#include <stdlib.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "harness/console/exit.h"
#include "harness/devices/names.h"
#include "shaders/fixed/fixed.h"

// The result of a cell that did not run on a device.
static struct rg_known_result unknown(const char *cell, const char *device)
{
    return (struct rg_known_result){.cell = cell,
                                    .device = device,
                                    .outcome = RG_UNSUPPORTED,
                                    .pixels = NAN,
                                    .difference = NAN};
}

static bool make_results(const struct rg_gate_request *asked, struct rg_gate *gate)
{
    const int64_t left = asked->left.count * asked->cells->count;
    const int64_t fixed = asked->pairs->count * RG_FIXED_MAX_DRAWS;
    const size_t count = (size_t)(gate->case_count + left + fixed);
    gate->results = rg_alloc(count ? count : 1, sizeof(*gate->results), "gate");
    for (int64_t i = 0; gate->results && i < left; i++)
        gate->results[gate->result_count++] =
            unknown(asked->cells->cells[i / asked->left.count].name,
                    asked->left.names[i % asked->left.count]);
    return gate->results;
}

// Adds a failing case, as for a missing device, if a required device has cells but none was
// compared, failed or ran out of time. Unsupported cells do not count: they do not pass anyway.
static void hold_required(struct rg_report *report, const char *name)
{
    bool any = false, is_told = false;
    for (int i = 0; i < report->case_count; i++) {
        const struct rg_report_case *c = &report->cases[i];
        for (int d = 0; d < c->device_count; d++) {
            const bool is_of =
                rg_device_is_of(c->devices[d], name) && c->ending != RG_ENDING_UNSUPPORTED;
            any = any || is_of;
            is_told =
                is_told || (is_of && (c->is_compared || c->is_over || rg_ending_fails(c->ending)));
        }
    }
    if (!any || is_told)
        return;
    rg_driver_error("--require %s: none of its cells was compared", name);
    rg_side_is_missing(name, NULL, report);
}

bool rg_gate_hold_required(const char *require, struct rg_report *report)
{
    struct rg_device_name name;
    bool ok = true;
    for (const char *rest = require; ok && rest && *rest;)
        if ((ok = rg_device_name_read(&rest, &name)))
            hold_required(report, name.name);
    return ok;
}

bool rg_gate_report(const struct rg_gate_request *asked, struct rg_gate *gate)
{
    bool ok = make_results(asked, gate);
    for (int i = 0; ok && i < gate->case_count; i++) {
        const struct rg_gate_case *c = &gate->cases[i];
        struct rg_known_result *result = &gate->results[gate->result_count++];
        ok = rg_gate_case_tell(c, asked, &gate->report, result);
        if (!c->is_compared && !c->is_skipped &&
            (result->outcome == RG_UNSUPPORTED || result->is_foreign))
            *result = unknown(c->cell->name, rg_gate_case_device(c));
    }
    const bool is_part = asked->shard.count > 1 && !asked->is_apart; // others may have compared it
    ok = ok && (is_part || rg_gate_hold_required(asked->require, &gate->report));
    gate->told_count = ok ? gate->case_count : 0;
    gate->is_told = ok;
    return ok;
}

// Logs why a gate without a failure proves nothing.
static void tell_nothing(const struct rg_gate_request *asked, const struct rg_gate *gate)
{
    const struct rg_shard *shard = &asked->shard;
    if (gate->report.case_count)
        rg_error("gate: none of %d cases was compared to its end; mend what their lines name",
                 gate->report.case_count);
    else if (gate->chosen)
        rg_error("gate: shard %d of %d has none of %d cases; make it %d shards at most",
                 shard->number, shard->count, gate->chosen, gate->chosen);
    else
        rg_error("gate: no case has a name of --gtest_filter; --gtest_list_tests prints names");
}

int rg_gate_exit(const struct rg_gate_request *asked, const struct rg_gate *gate)
{
    const struct rg_report *report = &gate->report;
    int worst = RG_EXIT_PASS, compared = -report->idle_count;
    for (int i = 0; i < report->case_count; i++) {
        const enum rg_ending ending = report->cases[i].ending;
        const int exit = rg_ending_exit(ending);
        compared += exit == RG_EXIT_PASS && ending != RG_ENDING_SKIPPED;
        worst = rg_exit_worse(worst, exit);
    }
    if (worst != RG_EXIT_PASS && (worst != RG_EXIT_UNSUPPORTED || !compared))
        return worst;
    if (!compared)
        tell_nothing(asked, gate);
    return rg_exit_with(RG_EXIT_PASS, compared);
}

void rg_gate_free(struct rg_gate *gate)
{
    rg_report_free(&gate->report);
    for (int i = 0; i < gate->case_count; i++)
        free(gate->cases[i].name);
    free(gate->cases);
    free(gate->results);
    free(gate->note);
    json_decref(gate->names);
    *gate = (struct rg_gate){.results = NULL};
}
