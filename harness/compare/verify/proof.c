// Compares state, image and laws of one technique on every device with cpu:reference.
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/base/log.h"
#include "core/device/device.h"
#include "core/image/compare/compare.h"
#include "harness/compare/verify/snapshot.h"
#include "harness/compare/verify/verify.h"
#include "harness/console/exit.h"
#include "harness/devices/frames/frame.h"
#include "harness/record/named.h"

// The results of one check on one device, over all cases.
struct tally {
    int runs, failed, errors;
    int least_steps, most_steps; // of the runs
    int unlike;                  // not identical, but within the tier
    int dry;                     // without rain, so that nothing was compared
    enum rg_outcome ended;       // the outcome of errors
    bool is_bad_input;           // one of the errors is an input error
    char first[400];             // the first failure
};

enum { MAX_LAWS = 8, STATE = 0, IMAGE = 1, LAWS = 2 };

// One device's results: state, image, and each law.
struct row {
    struct rg_device *device;
    enum rg_tier tier; // the tier required of it
    struct tally tallies[LAWS + MAX_LAWS];
    struct rg_session *last; // kept open until the next one is, so that shared data is made once
};

// One case: a seed and a pose.
struct one_case {
    char name[256];
    void *settings;
    int steps;
    struct rg_snapshot expected;
    struct rg_picture expected_picture;
    bool with_dry; // draw `dry`, the background for the rain mask
    struct rg_picture dry;
};

static void blame(struct tally *tally, const struct one_case *c, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

// Keeps the first failure.
static void blame(struct tally *tally, const struct one_case *c, const char *format, ...)
{
    if (tally->failed++ || tally->errors)
        return;
    const int used = snprintf(tally->first, sizeof(tally->first), "%s: ", c->name);
    va_list args;
    va_start(args, format);
    vsnprintf(tally->first + used, sizeof(tally->first) - (size_t)used, format, args);
    va_end(args);
}

// Keeps the first error, except that an error replaces an "unsupported", which says less.
static void note_error(struct tally *tally)
{
    const struct rg_failure failure = rg_failure_take();
    const enum rg_outcome ended = failure.outcome;
    tally->is_bad_input = tally->is_bad_input || failure.fault == RG_FAULT_INPUT;
    if (tally->errors++ && (tally->ended != RG_UNSUPPORTED || ended == RG_UNSUPPORTED))
        return;
    tally->ended = ended;
    if (!tally->failed)
        rg_text_copy(tally->first, sizeof(tally->first), failure.line);
}

static void count_run(struct tally *tally, const struct one_case *c)
{
    if (!tally->runs || c->steps < tally->least_steps)
        tally->least_steps = c->steps;
    if (c->steps > tally->most_steps)
        tally->most_steps = c->steps;
    tally->runs++;
}

static int count_laws(const struct rg_verify *v)
{
    int count = 0;
    while (count < MAX_LAWS && v->technique->proof->laws[count].name)
        count++;
    return count;
}

int64_t rg_verify_device_work(const struct rg_verify *v)
{
    int64_t devices = 1, steps = 0;
    for (int i = 0; i < v->devices->count; i++)
        devices += v->devices->devices[i] != v->reference;
    for (const struct rg_pose *pose = v->technique->proof->poses; pose->set; pose++)
        if (rg_verify_steps(v, pose) != RG_POSE_LEFT_OUT)
            for (int seed = 0; seed < RG_VERIFY_SEEDS; seed++)
                steps += rg_verify_has_seed(v, pose, seed) ? rg_verify_steps(v, pose) : 0;
    return steps * devices;
}

static struct rg_subject subject_of(const struct rg_verify *v, const void *settings)
{
    return (struct rg_subject){v->technique, settings, v->width, v->height};
}

struct rg_session *rg_verify_run(struct rg_verify *v, struct rg_device *device,
                                 const void *settings, int steps)
{
    const struct rg_subject subject = subject_of(v, settings);
    struct rg_session *session = rg_session_open(device, &subject);
    bool ok = session != NULL;
    for (int i = 0; ok && i < steps; i++) {
        ok = rg_session_step(session);
        rg_progress_add(v->progress, 1);
    }
    if (ok)
        return session;
    rg_session_close(session);
    return NULL;
}

// --- state ---

// Runs both devices side by side and describes the first difference, with the step that caused it.
static void describe_first(struct rg_verify *v, struct rg_device *device, const struct one_case *c,
                           char *text, size_t size)
{
    const struct rg_subject subject = subject_of(v, c->settings);
    struct rg_session *a = rg_session_open(device, &subject);
    struct rg_session *b = rg_session_open(v->reference, &subject);
    char element[400] = "";
    int step = 0;
    for (bool ok = a && b; ok && !*element && step <= c->steps; step++) {
        struct rg_snapshot now = {0}, expected = {0};
        ok = (step == 0 || (rg_session_step(a) && rg_session_step(b))) &&
             rg_snapshot_take(a, false, &now) && rg_snapshot_take(b, false, &expected);
        if (ok)
            rg_snapshot_describe(&now, &expected, element, sizeof(element));
        rg_snapshot_free(&now);
        rg_snapshot_free(&expected);
    }
    if (*element)
        snprintf(text, size, "%s after step %d", element, step - 1);
    else
        snprintf(text, size, "differs, but not in a second run");
    rg_session_close(a);
    rg_session_close(b);
}

static void check_state(struct rg_verify *v, struct row *row, const struct one_case *c,
                        const struct rg_snapshot *now)
{
    struct tally *tally = &row->tallies[STATE];
    count_run(tally, c);
    if (rg_snapshot_same_state(now, &c->expected))
        return;
    if (row->tier != RG_T0) {
        tally->unlike++; // other tiers judge only the image
        return;
    }
    char text[440] = "";
    if (!tally->failed)
        describe_first(v, row->device, c, text, sizeof(text));
    blame(tally, c, "%s", text);
}

// --- image ---

static void check_tier(const struct rg_verify *v, struct row *row, const struct one_case *c,
                       const struct rg_picture *picture)
{
    const struct rg_subject subject = subject_of(v, c->settings);
    const enum rg_tier tier = row->tier;
    struct tally *tally = &row->tallies[IMAGE];
    struct rg_comparison comparison;
    if (!rg_frame_compare(row->device, &subject, 0, &v->reference->info, &c->expected_picture,
                          c->with_dry ? &c->dry : NULL, picture, &comparison)) {
        note_error(tally);
        return;
    }
    if (rg_comparison_outcome(&comparison, tier) == RG_FAIL)
        blame(tally, c, "%s (%s)", comparison.tiers.of[tier].why, rg_tier_name(tier));
    rg_comparison_destroy(&comparison);
}

static void check_t0(struct tally *tally, const struct one_case *c,
                     const struct rg_picture *picture)
{
    struct rg_metrics m;
    if (rg_metrics_compute(&c->expected_picture, picture, &m))
        blame(tally, c, "%lld pixels differ, the most by %g at x %d, y %d (T0)",
              (long long)m.differing_pixels, m.max, m.max_x, m.max_y);
    else
        note_error(tally);
}

static void check_image(const struct rg_verify *v, struct row *row, const struct one_case *c,
                        const struct rg_session *session, const struct rg_snapshot *now)
{
    struct tally *tally = &row->tallies[IMAGE];
    struct rg_picture picture = {0};
    count_run(tally, c);
    if (rg_snapshot_same_image(now, &c->expected))
        return;
    if (!rg_session_picture(session, now->texels, &picture))
        note_error(tally);
    else if (row->tier == RG_T0)
        check_t0(tally, c, &picture);
    else
        check_tier(v, row, c, &picture);
    tally->unlike++;
    rg_picture_destroy(&picture);
}

// --- a case ---

static void check_laws(const struct rg_verify *v, struct row *row, const struct one_case *c,
                       const struct rg_session *session)
{
    for (int i = 0; i < count_laws(v); i++) {
        struct tally *tally = &row->tallies[LAWS + i];
        char detail[256] = "";
        count_run(tally, c);
        if (rg_session_obeys(session, &v->technique->proof->laws[i], detail, sizeof(detail)))
            continue;
        if (*detail)
            blame(tally, c, "%s", detail);
        else
            note_error(tally);
    }
}

static void note_errors(const struct rg_verify *v, struct row *row)
{
    for (int i = 0; i < LAWS + count_laws(v); i++)
        note_error(&row->tallies[i]);
}

// Runs a case on a row's device and takes the snapshot. The row owns the session. NULL on failure.
static struct rg_session *run_case(struct rg_verify *v, struct row *row, struct one_case *c,
                                   struct rg_snapshot *now)
{
    rg_progress_label(v->progress, "%s: %s on %s", v->technique->name, c->name,
                      row->device->info.name);
    struct rg_session *session = rg_verify_run(v, row->device, c->settings, c->steps);
    rg_session_close(row->last);
    row->last = session;
    if (session && rg_session_draw(session) && rg_snapshot_take(session, true, now))
        return session;
    note_errors(v, row);
    return NULL;
}

static void check_device(struct rg_verify *v, struct row *row, struct one_case *c)
{
    struct rg_snapshot now = {0};
    struct rg_session *session = run_case(v, row, c, &now);
    if (!session)
        return;
    check_laws(v, row, c, session);
    check_state(v, row, c, &now);
    check_image(v, row, c, session, &now);
    rg_snapshot_free(&now);
}

// Takes cpu:reference's snapshots, with which the others are compared. False on failure, which the
// reference's row reports.
static bool expect(struct rg_verify *v, struct row *reference, struct one_case *c)
{
    struct rg_session *session = run_case(v, reference, c, &c->expected);
    if (!session)
        return false;
    const struct rg_subject subject = subject_of(v, c->settings);
    check_laws(v, reference, c, session);
    bool ok = rg_session_picture(session, c->expected.texels, &c->expected_picture) &&
              (!c->with_dry || rg_frame_draw_dry(v->reference, &subject, 0, &c->dry));
    if (!ok)
        note_errors(v, reference);
    return ok;
}

// Counts an image without rain, which proves nothing.
static void note_dry_image(const struct one_case *c, struct row *rows, int count)
{
    const size_t bytes = (size_t)rg_picture_values(&c->dry) * sizeof(float);
    if (!c->with_dry || memcmp(c->dry.texels, c->expected_picture.texels, bytes))
        return;
    for (int i = 0; i < count; i++) {
        struct tally *tally = &rows[i].tallies[IMAGE];
        if (!tally->dry++ && !tally->failed && !tally->errors)
            snprintf(tally->first, sizeof(tally->first),
                     "%s: no rain in the image, which therefore proves nothing; take another "
                     "--frame, size or setting",
                     c->name);
    }
}

// rows[0] is the reference.
static void run_one(struct rg_verify *v, struct row *rows, int count, struct one_case *c)
{
    if (expect(v, &rows[0], c)) {
        for (int i = 1; i < count; i++)
            check_device(v, &rows[i], c);
        note_dry_image(c, rows + 1, count - 1);
    }
    rg_snapshot_free(&c->expected);
    rg_picture_destroy(&c->expected_picture);
    rg_picture_destroy(&c->dry);
}

// Tiers T1 and T2 use the rain mask, so they always need `dry`. T0 needs it once a pose, to check
// that there is rain at all.
static bool wants_dry(const struct row *rows, int count, bool is_first)
{
    bool wanted = is_first;
    for (int i = 1; i < count; i++)
        wanted = wanted || rows[i].tier != RG_T0;
    return wanted;
}

// The user's settings in a pose, with one of the seeds after the user's.
static bool set_case(const struct rg_verify *v, int seed, const struct rg_pose *pose,
                     struct one_case *c)
{
    const struct rg_param *param = rg_params_find(v->technique->params, "seed");
    char text[RG_PATH_SIZE];
    rg_params_text(param, v->settings, text, sizeof(text));
    const double first = strtod(text, NULL);
    const double value = first + seed <= param->max ? first + seed : first - seed;
    snprintf(c->name, sizeof(c->name), "seed %.0f%s%s", value, *pose->set ? ", " : "", pose->set);
    snprintf(text, sizeof(text), "seed=%.0f %s", value, pose->set);
    c->steps = rg_verify_steps(v, pose);
    return (c->settings = rg_settings_copy(v->technique, v->settings, text)) != NULL;
}

// --- the verdict ---

static const char *check_name(const struct rg_verify *v, int check)
{
    static const char *const names[] = {"state", "image"};
    return check < LAWS ? names[check] : v->technique->proof->laws[check - LAWS].name;
}

// The least bad exit status of all: if cpu:reference failed, nothing is proven, however many checks
// are ok.
static int least_exit(const struct tally *t, bool is_reference)
{
    if (t->is_bad_input)
        return RG_EXIT_USAGE;
    return is_reference && t->errors ? rg_exit_of(t->ended) : RG_EXIT_PASS;
}

// "12 runs of 1000 steps", "30 runs of 300 to 2000 steps".
static void name_runs(const struct tally *t, char *text, size_t size)
{
    const int used = snprintf(text, size, "%d runs of %d", t->runs, t->least_steps);
    if (t->least_steps < t->most_steps)
        snprintf(text + used, size - (size_t)used, " to %d steps", t->most_steps);
    else
        snprintf(text + used, size - (size_t)used, " steps");
}

// Adds a row's check to the results; `reference` is the first row.
static void report(struct rg_verify *v, const struct row *reference, const struct row *row,
                   int check)
{
    const struct tally *t = &row->tallies[check];
    const char *technique = v->technique->name, *name = check_name(v, check);
    const char *device = row->device->info.name;
    char runs[64];
    name_runs(t, runs, sizeof(runs));
    v->checks->exit = rg_exit_worse(v->checks->exit, least_exit(t, row == reference));
    if (t->failed)
        rg_checks_add(v->checks, technique, name, device, RG_FAIL, "%d of %d runs; %s", t->failed,
                      t->runs, t->first);
    else if (t->errors)
        rg_checks_add(v->checks, technique, name, device, t->ended, "%s", t->first);
    else if (t->dry)
        rg_checks_add(v->checks, technique, name, device, RG_NOTHING, "%s", t->first);
    else if (!t->runs)
        rg_checks_add(v->checks, technique, name, device, reference->tallies[check].ended,
                      "not run: %s, which it is compared with, failed", v->reference->info.name);
    else if (check >= LAWS)
        rg_checks_add(v->checks, technique, name, device, RG_OK, "holds after %s", runs);
    else if (t->unlike)
        rg_checks_add(v->checks, technique, name, device, RG_OK,
                      "%d of %s are not identical to %s, %s %s%s", t->unlike, runs,
                      v->reference->info.name, check == STATE ? "which" : "but within",
                      rg_tier_name(row->tier), check == STATE ? " leaves to the image" : "");
    else
        rg_checks_add(v->checks, technique, name, device, RG_OK, "%s, identical to %s", runs,
                      v->reference->info.name);
}

static void add_row(const struct rg_verify *v, struct row *row, struct rg_device *device)
{
    row->device = device;
    row->tier = rg_tier_owed(&device->info, &v->reference->info);
}

static int list_rows(const struct rg_verify *v, struct row *rows)
{
    int count = 0;
    add_row(v, &rows[count++], v->reference);
    for (int i = 0; i < v->devices->count; i++)
        if (v->devices->devices[i] != v->reference)
            add_row(v, &rows[count++], v->devices->devices[i]);
    return count;
}

static void run_pose(struct rg_verify *v, struct row *rows, int count, const struct rg_pose *pose)
{
    bool is_first = true;
    for (int seed = 0; seed < RG_VERIFY_SEEDS; seed++) {
        if (!rg_verify_has_seed(v, pose, seed))
            continue;
        struct one_case c = {.with_dry = wants_dry(rows, count, is_first)};
        is_first = false;
        if (set_case(v, seed, pose, &c))
            run_one(v, rows, count, &c);
        else
            note_errors(v, &rows[0]);
        rg_verify_advance(v, (int64_t)c.steps * count);
        free(c.settings);
    }
}

void rg_verify_devices(struct rg_verify *v)
{
    struct row *rows = rg_alloc(RG_MAX_DEVICES + 1, sizeof(*rows), "verify");
    if (!rows) {
        rg_checks_add_error(v->checks, v->technique->name, "state", v->reference->info.name);
        return;
    }
    const int count = list_rows(v, rows);
    rg_verify_begin(v, rg_verify_device_work(v));
    for (const struct rg_pose *pose = v->technique->proof->poses; pose->set; pose++)
        if (rg_verify_steps(v, pose) != RG_POSE_LEFT_OUT)
            run_pose(v, rows, count, pose);
    for (int check = 0; check < LAWS + count_laws(v); check++)
        for (int i = 0; i < count; i++)
            if (i > 0 || check >= LAWS || rows[i].tallies[check].errors)
                report(v, rows, &rows[i], check);
    for (int i = 0; i < count; i++)
        rg_session_close(rows[i].last);
    free(rows);
}
