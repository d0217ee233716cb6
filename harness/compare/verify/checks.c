#include "harness/compare/verify/checks.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/array.h"
#include "core/base/log.h"
#include "harness/console/exit.h"
#include "harness/record/named.h"

void rg_checks_add(struct rg_checks *checks, const char *technique, const char *check,
                   const char *device, enum rg_outcome status, const char *format, ...)
{
    if (!rg_array_fit(&checks->rows, &checks->room, checks->count + 1, sizeof(*checks->rows),
                      "results of checks")) {
        checks->exit = rg_exit_worse(checks->exit, RG_EXIT_HARNESS);
        return;
    }
    struct rg_check *row = &checks->rows[checks->count++];
    memset(row, 0, sizeof(*row));
    row->status = status;
    snprintf(row->technique, sizeof(row->technique), "%s", technique);
    snprintf(row->check, sizeof(row->check), "%s", check);
    snprintf(row->device, sizeof(row->device), "%s", device);
    va_list args;
    va_start(args, format);
    vsnprintf(row->detail, sizeof(row->detail), format, args);
    va_end(args);
}

void rg_checks_add_failure(struct rg_checks *checks, const char *technique, const char *check,
                           const char *device, const struct rg_failure *failure)
{
    if (failure->fault == RG_FAULT_INPUT)
        checks->exit = rg_exit_worse(checks->exit, RG_EXIT_USAGE);
    rg_checks_add(checks, technique, check, device, failure->outcome, "%s", failure->line);
}

void rg_checks_add_error(struct rg_checks *checks, const char *technique, const char *check,
                         const char *device)
{
    const struct rg_failure failure = rg_failure_take();
    rg_checks_add_failure(checks, technique, check, device, &failure);
}

// --- the JSON form ---

json_t *rg_checks_document(const struct rg_checks *checks, json_t *devices)
{
    json_t *rows = json_array();
    for (int i = 0; i < checks->count; i++) {
        const struct rg_check *row = &checks->rows[i];
        json_t *json = json_pack("{ssssso}", "technique", row->technique, "check", row->check,
                                 "device", rg_json_text(row->device));
        rg_outcome_set(json, row->status);
        json_object_set_new(json, "detail", rg_json_text(row->detail));
        json_array_append_new(rows, json);
    }
    return json_pack("{sisoso}", "format", 1, "devices", devices, "checks", rows);
}

bool rg_checks_read(struct rg_checks *checks, const json_t *row)
{
    const char *technique, *check, *device, *status, *detail, *fault = "";
    enum rg_outcome outcome;
    if (json_unpack((json_t *)row, "{ss ss ss ss ss s?s}", "technique", &technique, "check", &check,
                    "device", &device, "status", &status, "detail", &detail, "fault", &fault) ||
        !rg_outcome_find(status, &outcome))
        return rg_error("a record of verify has a check without a name or a status; run its shard "
                        "again");
    if (*fault)
        outcome = strcmp(fault, "set-up") ? RG_LACKING : RG_SETUP;
    struct rg_check plain; // texts from outside
    rg_text_copy(plain.technique, sizeof(plain.technique), technique);
    rg_text_copy(plain.check, sizeof(plain.check), check);
    rg_text_copy(plain.device, sizeof(plain.device), device);
    rg_text_copy(plain.detail, sizeof(plain.detail), detail);
    rg_checks_add(checks, plain.technique, plain.check, plain.device, outcome, "%s", plain.detail);
    return true;
}

// --- text ---

static int longer(int width, const char *text)
{
    return (int)strlen(text) > width ? (int)strlen(text) : width;
}

static void print_lines(const struct rg_checks *checks)
{
    int widths[4] = {0};
    for (int i = 0; i < checks->count; i++) {
        const struct rg_check *row = &checks->rows[i];
        widths[0] = longer(widths[0], rg_outcome_name(row->status));
        widths[1] = longer(widths[1], row->technique);
        widths[2] = longer(widths[2], row->check);
        widths[3] = longer(widths[3], row->device);
    }
    for (int i = 0; i < checks->count; i++) {
        const struct rg_check *row = &checks->rows[i];
        printf("%-*s  %-*s  %-*s  %-*s  %s\n", widths[0], rg_outcome_name(row->status), widths[1],
               row->technique, widths[2], row->check, widths[3], row->device, row->detail);
    }
}

static void count_outcomes(const struct rg_checks *checks, int counts[RG_OUTCOME_COUNT])
{
    memset(counts, 0, RG_OUTCOME_COUNT * sizeof(*counts));
    for (int i = 0; i < checks->count; i++)
        counts[checks->rows[i].status]++;
}

// Prints the number of checks; none is no proof.
static void print_count(const struct rg_checks *checks)
{
    int counts[RG_OUTCOME_COUNT];
    count_outcomes(checks, counts);
    printf("%d checks", checks->count);
    for (int i = 0; i < RG_OUTCOME_COUNT; i++)
        if (counts[i])
            printf(", %d %s", counts[i], rg_outcome_name((enum rg_outcome)i));
    printf("\n");
}

void rg_checks_print(const struct rg_checks *checks, const char *note, json_t *devices, bool json)
{
    json_t *document = json ? rg_checks_document(checks, devices) : NULL;
    if (json) {
        json_dumpf(document, stdout, JSON_INDENT(2));
        printf("\n");
        json_decref(document);
        return;
    }
    json_decref(devices);
    fputs(note, stdout);
    print_lines(checks);
    print_count(checks);
}

// Whether a check is of raingauge's own model, not of a device.
static bool is_own(const struct rg_check *row)
{
    return !strcmp(row->check, "mutants") || !strcmp(row->device, "cpu:reference");
}

int rg_checks_exit(const struct rg_checks *checks)
{
    int counts[RG_OUTCOME_COUNT], devices[RG_OUTCOME_COUNT] = {0};
    bool has_devices = false;
    count_outcomes(checks, counts);
    for (int i = 0; i < checks->count; i++) {
        devices[checks->rows[i].status] += !is_own(&checks->rows[i]);
        has_devices = has_devices || !is_own(&checks->rows[i]);
    }
    const int exit = rg_exit_worse(checks->exit, rg_exit_of_all(counts));
    return has_devices ? rg_exit_worse(exit, rg_exit_of_all(devices)) : exit;
}

void rg_checks_free(struct rg_checks *checks)
{
    free(checks->rows);
    memset(checks, 0, sizeof(*checks));
}
