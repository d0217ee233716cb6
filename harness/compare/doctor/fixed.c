#include "harness/compare/doctor/fixed.h"

#include <stdio.h>
#include <string.h>

#include "core/base/log.h"
#include "core/base/text/add.h"
#include "harness/console/clock.h"
#include "harness/console/exit.h"
#include "harness/devices/devices.h"
#include "harness/devices/measure/serving/fixed_pairs.h"
#include "harness/record/named.h"
#include "harness/record/passport/passport.h"

// --- drawing ---

static enum rg_outcome note_failure(struct rg_device *device, json_t *row)
{
    const struct rg_failure failure = rg_fixed_failure(device);
    rg_outcome_set(row, failure.outcome);
    json_object_set_new(row, "why", rg_json_text(failure.line));
    return failure.outcome;
}

static const char *feature_of(int row)
{
    const int draws = rg_fixed_count();
    return row < draws ? rg_fixed_draws[row].feature : rg_fixed_closed[row - draws].feature;
}

// Whether a draw's values are within their bounds, and the first that is not.
static void note_bounds(const struct rg_fixed_told *told, json_t *row)
{
    const struct rg_fixed_beyond *b = &told->beyond;
    if (*told->known)
        json_object_set_new(row, "known", rg_json_text(told->known));
    json_object_set_new(row, "bounds",
                        json_string(!told->is_bounded ? "none"
                                    : b->count        ? "beyond"
                                                      : "within"));
    if (b->count)
        json_object_set_new(row, "beyond",
                            json_pack("{sosisisisisfsfsfsi}", "part", rg_json_text(b->part),
                                      "layer", b->layer, "x", b->x, "y", b->y, "channel",
                                      b->channel, "value", b->value, "low", b->low, "high", b->high,
                                      "count", b->count));
}

// Notes how a pair is judged, and logs one line where it fails.
static enum rg_outcome note(const struct rg_device *device, int i, const struct rg_fixed_told *told,
                            json_t *row)
{
    char why[RG_FIXED_WHY];
    const enum rg_outcome outcome = rg_fixed_judge(i, told, why);
    rg_outcome_set(row, outcome);
    if (outcome != RG_UNSUPPORTED && i < rg_fixed_count()) {
        json_object_set_new(row, "digest", rg_fixed_hash(told->digest));
        json_object_set_new(row, "neighbour", rg_fixed_hash(told->other));
        note_bounds(told, row);
    }
    json_object_set_new(row, "why", rg_json_text(why));
    if (outcome == RG_FAIL)
        rg_error("device '%s': feature '%s': %s", device->info.name, feature_of(i), why);
    return outcome;
}

// `failed` counts draws that the driver failed.
static enum rg_outcome draw_one(struct rg_device *device, int i, json_t *draws, json_t *closed,
                                int *failed)
{
    struct rg_fixed_told told;
    const int count = rg_fixed_count();
    json_t *row = json_pack("{ss}", "feature", feature_of(i));
    if (i >= count)
        json_object_set_new(row, "case", json_string(rg_fixed_closed[i - count].about));
    json_array_append_new(i < count ? draws : closed, row);
    if (rg_fixed_ask(device, i, &told))
        return note(device, i, &told, row);
    ++*failed;
    return note_failure(device, row);
}

// A device's status is its worst draw's; one that draws nothing is unsupported.
static int draw_all(struct rg_device *device, json_t *row)
{
    const double start_ms = rg_now_ms();
    int counts[RG_OUTCOME_COUNT] = {0};
    json_t *draws = json_array(), *closed = json_array();
    int drawn = 0, ended = 0;
    for (; rg_fixed_goes_on(device, ended, rg_fixed_pairs() - drawn) && drawn < rg_fixed_pairs();
         drawn++)
        counts[draw_one(device, drawn, draws, closed, &ended)]++;
    json_object_set_new(row, "draws", draws);
    json_object_set_new(row, "closed", closed);
    json_object_set_new(row, "ms", json_real(rg_now_ms() - start_ms));
    const int exit = rg_exit_of_all(counts), lacking = counts[RG_LACKING];
    const int failed = drawn - counts[RG_OK] - counts[RG_UNSUPPORTED] - lacking;
    if (failed)
        json_object_set_new(row, "why",
                            json_sprintf("%d draw%s", failed, failed == 1 ? " fails" : "s fail"));
    else if (lacking)
        json_object_set_new(row, "why",
                            json_sprintf("raingauge itself lacked what %d draw%s", lacking,
                                         lacking == 1 ? " needs" : "s need"));
    rg_outcome_set(row, exit == RG_EXIT_PASS          ? RG_OK
                        : exit == RG_EXIT_UNSUPPORTED ? RG_UNSUPPORTED
                        : exit == RG_EXIT_HARNESS     ? RG_LACKING
                                                      : RG_FAIL);
    return exit;
}

static int tell_none(json_t *row)
{
    rg_outcome_set(row, RG_UNSUPPORTED);
    json_object_set_new(row, "why", json_string("has no fixed functions"));
    return RG_EXIT_UNSUPPORTED;
}

int rg_doctor_fixed(const char *name, struct rg_device_info *info, json_t *devices)
{
    struct rg_device *device = rg_devices_open_one(name);
    json_t *row = json_pack("{sosssf s[] s[]}", "name", rg_json_text(name), "why", "", "ms", 0.0,
                            "draws", "closed");
    json_array_append_new(devices, row);
    if (!device) {
        const struct rg_failure failure = rg_failure_take();
        rg_outcome_set(row, failure.outcome);
        json_object_set_new(row, "why", rg_json_text(failure.line));
        return failure.fault == RG_FAULT_INPUT ? RG_EXIT_USAGE : rg_exit_of(failure.outcome);
    }
    *info = device->info;
    const int exit = *device->info.limits.no_native ? tell_none(row) : draw_all(device, row);
    return rg_device_close(device) ? exit : rg_exit_worse(exit, RG_EXIT_FAIL);
}

json_t *rg_doctor_fixed_passport(const json_t *devices, const struct rg_device_info *infos,
                                 int count)
{
    json_t *passport = rg_passport_json(infos, count), *device, *draw;
    size_t i, d;
    json_array_foreach(devices, i, device)
    {
        json_t *digests = json_object();
        json_array_foreach(json_object_get(device, "draws"), d, draw)
        {
            if (!strcmp(rg_json_text_of(draw, "status"), "ok"))
                json_object_set(digests, rg_json_text_of(draw, "feature"),
                                json_object_get(draw, "digest"));
        }
        rg_fixed_put(passport, rg_json_text_of(device, "name"),
                     json_object_size(digests) ? digests : NULL);
        json_decref(digests);
    }
    return passport;
}

// --- printing ---

static int count_with(const json_t *draws, const char *key, const char *text)
{
    size_t i;
    json_t *draw;
    int found = 0;
    json_array_foreach(draws, i, draw) found +=
        json_object_get(draw, key) && (!text || !strcmp(rg_json_text_of(draw, key), text));
    return found;
}

static void print_draw(const json_t *draw)
{
    const char *status = rg_json_text_of(draw, "status");
    const char *bounds = rg_json_text_of(draw, "bounds"), *known = rg_json_text_of(draw, "known");
    if (!strcmp(status, "ok"))
        printf("  %-26s %s  %s%s\n", rg_json_text_of(draw, "feature"),
               rg_json_text_of(draw, "digest"),
               *known                    ? "known fault: "
               : !strcmp(bounds, "none") ? "no bounds"
                                         : "within bounds",
               known);
    else
        printf("  %-26s %s: %s\n", rg_json_text_of(draw, "feature"), status,
               rg_json_text_of(draw, "why"));
}

void rg_doctor_fixed_print(const json_t *devices)
{
    size_t i, d;
    json_t *device, *draw;
    json_array_foreach(devices, i, device)
    {
        const json_t *draws = json_object_get(device, "draws");
        const json_t *closed = json_object_get(device, "closed");
        const int all = (int)json_array_size(draws), ok = count_with(draws, "status", "ok");
        const int unsupported = count_with(draws, "status", "unsupported");
        const int known = count_with(draws, "known", NULL);
        const int lacking = count_with(draws, "fault", "harness");
        char told[100] = "";
        if (lacking)
            rg_text_add(told, sizeof(told), "", ", %d not drawn by a lack of raingauge's own",
                        lacking);
        if (known)
            rg_text_add(told, sizeof(told), "", ", %d known fault%s", known, known == 1 ? "" : "s");
        if (all)
            printf("%s: %d draws of fixed functions, %d unsupported, %d fail%s; %d of %d closed "
                   "cases hold; in %.0f ms\n",
                   rg_json_text_of(device, "name"), all, unsupported,
                   all - ok - unsupported - lacking, told, count_with(closed, "status", "ok"),
                   (int)json_array_size(closed), json_real_value(json_object_get(device, "ms")));
        else
            printf("%s: %s: %s\n", rg_json_text_of(device, "name"),
                   rg_json_text_of(device, "status"), rg_json_text_of(device, "why"));
        json_array_foreach(draws, d, draw) print_draw(draw);
        json_array_foreach(closed, d, draw)
        {
            if (strcmp(rg_json_text_of(draw, "status"), "ok") != 0)
                print_draw(draw);
        }
    }
}
