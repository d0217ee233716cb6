#include "harness/tables/runs/compile.h"

#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>

#include "core/base/files/nameless.h"
#include "core/base/log.h"
#include "core/base/program.h"
#include "harness/console/clock.h"
#include "harness/console/duration.h"
#include "harness/console/exit.h"
#include "harness/console/interrupt.h"
#include "harness/console/progress.h"
#include "harness/devices/kept.h"
#include "harness/devices/workers/worker.h"
#include "harness/record/passport/machine.h"
#include "harness/tables/runs/needed.h"
#include "harness/tables/table.h"

// --- in this process ---

// Draws two frames of the last needed row, which has the most in it, as small as a budget would
// draw it.
static bool draw(const struct rg_table *table, struct rg_device *device)
{
    const struct rg_devices devices = {.count = 1, .devices = {device}};
    const struct rg_table_part all = {.last_row = table->row_count - 1};
    const int divisor = rg_most_divisor(table);
    struct rg_table small = *table;
    struct rg_result result = {0};
    struct rg_place at = {0};
    bool needed[RG_TABLE_ROWS];
    double ms;
    rg_needed_rows(table, needed);
    for (int row = 0; row < table->row_count; row++)
        at.row = needed[row] ? row : at.row;
    char *quick = rg_table_quick(table, divisor);
    small.quick = quick;
    rg_table_begin(&result, &small, &all, &devices);
    void *settings = quick ? rg_table_settings(&result, &small, at) : NULL;
    const struct rg_subject subject = {rg_technique_find(table->technique), settings,
                                       table->width / divisor, table->height / divisor};
    struct rg_session *session = settings ? rg_session_run(device, &subject, 1) : NULL;
    const bool ok = session && rg_session_frames(session, 1, &ms);
    if (session)
        rg_session_close(session);
    rg_result_free(&result);
    free(settings);
    free(quick);
    return ok;
}

static int compile_here(const struct rg_table *table, struct rg_device *device)
{
    const bool ok = draw(table, device);
    return rg_interrupted() ? RG_EXIT_SIGNALLED + rg_interrupt_signal()
           : ok             ? RG_EXIT_PASS
                            : rg_exit_of_error();
}

// --- side by side ---

enum { PAUSE_MS = 5, MAX_AT_ONCE = 64, MAX_TECHNIQUES = 64 };

// A table on a device, opened in a process of its own.
struct job {
    const struct rg_table *table;
    struct rg_device *device;
    pid_t process; // 0: none
    FILE *printed;
};

struct jobs {
    const struct rg_table *tables[MAX_TECHNIQUES]; // one per technique
    int table_count;
    struct rg_device *devices[RG_MAX_DEVICES]; // those that have drivers
    int device_count;
    int begun;
    struct job running[MAX_AT_ONCE]; // entries without a process are free
    int at_once;
    bool are_told; // the processes were asked to end
    struct rg_progress progress;
    int exit;
};

// The number of processes at a time: the cores, or the share of their time that is granted.
static int places(void)
{
    struct rg_machine machine;
    rg_machine_read(&machine, "");
    const double quota = machine.quota_cpus > 0 ? ceil(machine.quota_cpus) : MAX_AT_ONCE;
    return (int)fmax(1, fmin(fmin(machine.cores_allowed, quota), MAX_AT_ONCE));
}

// Chooses the first table of each technique that draws; the technique's other tables mostly use the
// same kernels.
static void choose_tables(struct jobs *jobs, const struct rg_table *const tables[], int count)
{
    for (int i = 0; i < count; i++) {
        int k = 0;
        while (k < jobs->table_count &&
               strcmp(jobs->tables[k]->technique, tables[i]->technique) != 0)
            k++;
        if (k < jobs->table_count || tables[i]->is_of_textures || k == MAX_TECHNIQUES)
            continue;
        jobs->tables[jobs->table_count++] = tables[i];
    }
}

// Begins with the last device: OpenCL's compilers take longest, so they should start early.
static void choose_devices(struct jobs *jobs, const struct rg_devices *devices)
{
    for (int d = devices->count - 1; d >= 0; d--)
        if (devices->devices[d]->backend->package)
            jobs->devices[jobs->device_count++] = devices->devices[d];
}

static struct job job_at(const struct jobs *jobs, int number)
{
    return (struct job){.table = jobs->tables[number % jobs->table_count],
                        .device = jobs->devices[number / jobs->table_count]};
}

static int count_of(const struct jobs *jobs)
{
    return jobs->table_count * jobs->device_count;
}

static void tell_failure(struct jobs *jobs, const struct job *job, int exit, const char *why)
{
    rg_warning("%s: what %s needs is not compiled beforehand%s", job->device->info.name,
               job->table->technique, why);
    jobs->exit = rg_exit_worse(jobs->exit, exit);
}

// Starts a job. Its output is reported only if it fails.
static void begin(struct jobs *jobs, struct job *job)
{
    char timeout_s[16], why[240], lack[RG_NAMELESS_WHY];
    snprintf(timeout_s, sizeof(timeout_s), "%d", rg_workers.timeout_s);
    const char *const args[] = {rg_workers.program, "table",    job->table->id,
                                "--compile",        "--device", job->device->info.name,
                                "--timeout",        timeout_s,  NULL};
    const int file = rg_file_nameless(lack); // without a file its output is lost
    job->printed = file < 0 ? NULL : fdopen(file, "w+");
    const int error = rg_program_start(args, (const int[]){-1, file, file}, 3, &job->process);
    if (!error)
        return;
    snprintf(why, sizeof(why), ": no process could be started for it: %s; %s", strerror(error),
             rg_program_mend(error));
    tell_failure(jobs, job, RG_EXIT_HARNESS, why);
    if (job->printed)
        fclose(job->printed);
    job->process = 0;
}

static void end(struct jobs *jobs, struct job *job, int status)
{
    static const char prefix[] = ": raingauge"; // of its own messages; logging adds it again
    char last[200] = "";
    if (job->printed)
        rg_program_last_line(job->printed, last, sizeof(last));
    const bool is_ours = !strncmp(last, prefix, sizeof(prefix) - 1);
    const int exit = WIFEXITED(status) ? WEXITSTATUS(status) : RG_EXIT_FAIL;
    if (status && exit != RG_EXIT_UNSUPPORTED && !rg_interrupted())
        tell_failure(jobs, job, exit == RG_EXIT_HARNESS ? exit : RG_EXIT_FAIL,
                     last + (is_ours ? sizeof(prefix) - 1 : 0));
    if (job->printed)
        fclose(job->printed);
    job->process = 0;
    rg_progress_add(&jobs->progress, 1);
}

// Ctrl-C does not reach the processes' groups, so they are interrupted once from here.
static void pass_on_interruption(struct jobs *jobs)
{
    if (!rg_interrupted() || jobs->are_told)
        return;
    for (int i = 0; i < jobs->at_once; i++)
        if (jobs->running[i].process)
            kill(-jobs->running[i].process, SIGINT);
    jobs->are_told = true;
}

// Begins or ends a job in this place; whether the place is still in use.
static bool look_at(struct jobs *jobs, struct job *job)
{
    int status = 0;
    if (job->process && rg_program_has_ended(job->process, &status))
        end(jobs, job, status);
    if (!job->process && jobs->begun < count_of(jobs) && !rg_interrupted()) {
        *job = job_at(jobs, jobs->begun++);
        rg_progress_label(&jobs->progress, "%s on %s", job->table->technique,
                          job->device->info.name);
        begin(jobs, job);
    }
    return job->process || (jobs->begun < count_of(jobs) && !rg_interrupted());
}

static void run(struct jobs *jobs)
{
    bool goes_on = true;
    while (goes_on) {
        goes_on = false;
        for (int i = 0; i < jobs->at_once; i++)
            goes_on = look_at(jobs, &jobs->running[i]) || goes_on;
        pass_on_interruption(jobs);
        nanosleep(&(struct timespec){.tv_nsec = PAUSE_MS * 1000000}, NULL);
    }
}

// The bar shows no time left, since one opening takes no time and another half a minute.
static int compile_apart(struct jobs *jobs)
{
    rg_info("%d openings for drivers to compile, %d at a time", count_of(jobs),
            jobs->at_once < count_of(jobs) ? jobs->at_once : count_of(jobs));
    rg_progress_told();
    rg_progress_start(&jobs->progress, count_of(jobs));
    run(jobs);
    rg_progress_end(&jobs->progress);
    return rg_interrupted() ? RG_EXIT_SIGNALLED + rg_interrupt_signal() : jobs->exit;
}

static void tell(const struct jobs *jobs, double ms)
{
    char took[RG_DURATION_TEXT];
    rg_info("what %d technique%s draw%s with is compiled on %d device%s, in %s", jobs->table_count,
            jobs->table_count == 1 ? "" : "s", jobs->table_count == 1 ? "s" : "",
            jobs->device_count, jobs->device_count == 1 ? "" : "s",
            rg_duration_text(ms / 1000, took));
}

int rg_tables_compile(const struct rg_table *const tables[], int count,
                      const struct rg_devices *devices)
{
    struct jobs jobs = {.at_once = places()};
    const double start_ms = rg_now_ms();
    rg_interrupt_watch();
    choose_tables(&jobs, tables, count);
    choose_devices(&jobs, devices);
    if (!count_of(&jobs)) {
        rg_error("table --compile: none of these tables draws on one of these devices that has a "
                 "driver, so that nothing is compiled; name others");
        return RG_EXIT_NOTHING;
    }
    const bool is_one = count == 1 && count_of(&jobs) == 1;
    const int exit = is_one ? compile_here(jobs.tables[0], jobs.devices[0]) : compile_apart(&jobs);
    if (exit == RG_EXIT_PASS)
        tell(&jobs, rg_now_ms() - start_ms);
    return exit;
}
