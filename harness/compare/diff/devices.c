#include "harness/compare/diff/devices.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/base/files/file.h"
#include "core/base/log.h"
#include "core/base/text/plain.h"
#include "core/device/device.h"
#include "core/image/files/io.h"
#include "harness/compare/blame/features.h"
#include "harness/compare/diff/accepts.h"
#include "harness/compare/diff/pair.h"
#include "harness/console/exit.h"
#include "harness/console/progress.h"
#include "harness/devices/devices.h"
#include "harness/devices/frames/frame.h"
#include "harness/record/named.h"
#include "harness/record/output.h"
#include "harness/record/passport/driver.h"
#include "harness/record/passport/passport.h"

enum { HEATMAP_PREFIX = 2048 };

struct shot {
    struct rg_device *device;
    const struct rg_device_info *info;
    struct rg_picture picture;
};

struct session {
    const struct rg_diff_devices_request *asked;
    struct shot shots[RG_MAX_DEVICES];
    int shot_count;
    struct rg_picture background;
    int failed;               // devices without a picture
    int compared;             // pairs
    int exit;                 // an enum rg_exit: the status of failed devices
    json_t *pairs, *failures; // with --json
    json_t *pictures;         // files of pictures, with --json and a prefix
    struct rg_accepts accepts;
};

static float exposure_of(const struct session *s)
{
    return s->asked->exposure != 0 ? (float)s->asked->exposure : 1.0f;
}

// Draws the same frame without rain; pixels of a picture that differ from it are its rain mask.
static bool take_background(struct session *s)
{
    const struct rg_diff_devices_request *r = s->asked;
    struct rg_device *device = rg_devices_open_one("cpu");
    bool ok = device && rg_frame_draw_dry(device, &r->subject, r->frames, &s->background);
    return rg_device_close(device) && ok;
}

// Notes a device without a picture. The error has been logged.
static void note_failure(struct session *s, const char *device, enum rg_outcome outcome,
                         const char *why)
{
    s->failed++;
    if (outcome != RG_UNSUPPORTED)
        s->exit = rg_exit_worse(s->exit, rg_exit_of(outcome));
    if (!s->failures)
        return;
    json_t *row = json_pack("{so}", "device", rg_json_text(device));
    rg_outcome_set(row, outcome);
    json_object_set_new(row, "detail", rg_json_text(why));
    json_array_append_new(s->failures, row);
}

// Draws on a device. False if the first device refuses the user's input, as every other would.
static bool take_picture(struct session *s, struct rg_device *device)
{
    const struct rg_diff_devices_request *r = s->asked;
    struct shot *shot = &s->shots[s->shot_count];
    shot->device = device;
    shot->info = &device->info;
    if (rg_frame_draw(device, &r->subject, r->frames, &shot->picture)) {
        s->shot_count++;
        return true;
    }
    const struct rg_failure failure = rg_failure_take();
    if (failure.fault == RG_FAULT_INPUT && !s->shot_count)
        return false;
    note_failure(s, device->info.name, failure.outcome, failure.line);
    return true;
}

static bool take_pictures(struct session *s, const struct rg_devices *devices)
{
    struct rg_progress progress;
    rg_progress_start(&progress, devices->count + 1);
    bool ok = take_background(s);
    for (int i = 0; i < devices->absent_count; i++)
        note_failure(s, devices->absent[i].name, devices->absent[i].outcome,
                     devices->absent[i].why);
    for (int d = 0; ok && d < devices->count; d++) {
        rg_progress_add(&progress, 1);
        ok = take_picture(s, devices->devices[d]);
    }
    rg_progress_end(&progress);
    return ok;
}

// "cpu:reference" and "gl" become PREFIX-cpu_reference-gl.
static void name_heatmaps(const struct session *s, const struct rg_device_info *a,
                          const struct rg_device_info *b, char prefix[HEATMAP_PREFIX])
{
    char names[2][RG_OUTPUT_PART];
    const char *asked = s->asked->heatmap_prefix;
    rg_output_part(a->name, names[0]);
    rg_output_part(b->name, names[1]);
    snprintf(prefix, HEATMAP_PREFIX, "%.1700s%s%s-%s", asked, rg_is_folder_prefix(asked) ? "" : "-",
             names[0], names[1]);
}

// PREFIX-gl.exr, or FOLDER/gl.exr.
static void name_picture(const struct session *s, const struct rg_device_info *info,
                         char path[HEATMAP_PREFIX])
{
    char name[RG_OUTPUT_PART];
    const char *asked = s->asked->heatmap_prefix;
    rg_output_part(info->name, name);
    snprintf(path, HEATMAP_PREFIX, "%.1700s%s%s.exr", asked, rg_is_folder_prefix(asked) ? "" : "-",
             name);
}

// Writes each device's picture, as linear light to the bit, and notes its file.
static bool write_pictures(struct session *s)
{
    bool ok = true;
    for (int i = 0; ok && s->asked->heatmap_prefix && i < s->shot_count; i++) {
        const struct shot *shot = &s->shots[i];
        char path[HEATMAP_PREFIX];
        name_picture(s, shot->info, path);
        ok = rg_picture_write(path, &shot->picture, &(struct rg_write_options){.full_float = true});
        if (ok && s->pairs && !s->pictures)
            s->pictures = json_array();
        if (ok && s->pairs)
            json_array_append_new(s->pictures,
                                  json_pack("{so so}", "device", rg_json_text(shot->info->name),
                                            "file", rg_json_text(path)));
    }
    return ok;
}

static bool write_heatmaps(const struct session *s, const struct shot *a, const struct shot *b,
                           const struct rg_comparison *comparison)
{
    char prefix[HEATMAP_PREFIX];
    name_heatmaps(s, a->info, b->info, prefix);
    return rg_pair_heatmaps(prefix, &a->picture, &b->picture, comparison);
}

// Whether no pair's heat map and no picture replaces a file that settings name. False, and one
// logged line, if one does.
static bool spare_files(const struct session *s, const struct rg_devices *devices)
{
    char prefix[HEATMAP_PREFIX], value[RG_PATH_SIZE];
    bool spared = true;
    for (int at = 0;
         s->asked->heatmap_prefix && spared && rg_file_own_next(&s->asked->subject, &at, value);)
        for (int i = 0; spared && i < devices->count; i++) {
            name_picture(s, &devices->devices[i]->info, prefix);
            spared = rg_file_spares(prefix, value);
            for (int j = i + 1; spared && j < devices->count; j++) {
                name_heatmaps(s, &devices->devices[i]->info, &devices->devices[j]->info, prefix);
                spared = rg_pair_heatmaps_spare(prefix, value);
            }
        }
    return spared;
}

static void print_head(void)
{
    printf("%-30s %-5s %-5s %10s %10s %8s %9s %8s\n", "pair", "", "tier", "differing", "largest",
           "mask px", "FLIP mean", "PSNR dB");
}

static void print_pair(const struct shot *a, const struct shot *b, const struct rg_comparison *c,
                       bool holds)
{
    char pair[2 * RG_DEVICE_NAME_SIZE + 2];
    snprintf(pair, sizeof(pair), "%s, %s", a->info->name, b->info->name);
    rg_plain(pair);
    char psnr[32] = "none"; // for values that are NaN
    if (!isnan(c->metrics.psnr_db))
        snprintf(psnr, sizeof(psnr), "%.4g", c->metrics.psnr_db);
    printf("%-30s %-5s %-5s %10lld %6d/255 %8lld %9.6f %8s\n", pair, holds ? "ok" : "fail", c->tier,
           (long long)c->metrics.differing_values, c->tiers.max_codes,
           (long long)c->tiers.mask_pixels, c->flip.mean, psnr);
}

// Whether `a` counts as the truth: it is the reference, or has the stricter tier, or, of equal
// tiers, is cpu's.
static bool is_truer(const struct rg_device_info *a, const struct rg_device_info *b)
{
    if (a->tier != b->tier)
        return a->tier < b->tier;
    return !strncmp(a->full, "cpu", 3) && strcmp(b->full, "cpu:reference") != 0;
}

// Finds the first difference of a pair that fails its tier; the device nearer to cpu:reference
// counts as the truth. NULL if nothing is found, or on a failure, which has been logged: the pair's
// own failure is known already.
static json_t *blame_pair(struct session *s, const struct shot *a, const struct shot *b)
{
    const struct rg_diff_devices_request *r = s->asked;
    const struct shot *truth = is_truer(b->info, a->info) ? b : a, *other = truth == a ? b : a;
    const struct rg_digest_run run = {r->subject, r->frames < 1 ? 1 : r->frames};
    struct rg_blame blame;
    if (!rg_blame_find(&run, other->device, truth->device, &blame))
        return NULL;
    json_t *json = r->json && blame.found ? rg_blame_json(&blame) : NULL;
    if (json)
        json_object_set_new(json, "device", rg_json_text(other->info->name));
    if (r->json)
        return json;
    if (blame.found)
        printf("  %s: %s\n", other->info->name, blame.text);
    else
        printf("  no stage leaves other bits when each is read: it may not differ in every run\n");
    return NULL;
}

// Finds the features of a native device by which a pair differs; the other device counts as the
// truth. False, and one logged line, on failure.
static bool blame_features(const struct session *s, const struct shot *a, const struct shot *b,
                           json_t *pair)
{
    const struct rg_diff_devices_request *r = s->asked;
    const struct shot *device = b->info->native ? b : a, *truth = device == a ? b : a;
    const struct rg_features_request request = {.run = {r->subject, r->frames < 1 ? 1 : r->frames},
                                                .device = device->device,
                                                .truth = truth->device,
                                                .dry = &s->background,
                                                .frames = r->frames};
    struct rg_features_told told;
    if (!device->info->native)
        return true;
    if (!rg_features_blame(&request, &told))
        return false;
    if (pair)
        json_object_set_new(pair, "features", rg_features_json(&told));
    else
        rg_features_print(&told);
    return true;
}

static json_t *pair_json(const struct shot *a, const struct shot *b, const struct rg_comparison *c)
{
    char names[2][RG_DEVICE_NAME_SIZE];
    rg_text_copy(names[0], RG_DEVICE_NAME_SIZE, a->info->name);
    rg_text_copy(names[1], RG_DEVICE_NAME_SIZE, b->info->name);
    json_t *pair = rg_pair_json(names[0], names[1], c);
    if (pair)
        json_object_set_new(pair, "owed",
                            json_string(rg_tier_name(rg_tier_owed(a->info, b->info))));
    return pair;
}

// Prints why a pair fails, and what a looser tier would accept.
static void tell_failure(struct session *s, const struct shot *a, const struct shot *b,
                         const struct rg_comparison *c, json_t *pair)
{
    json_t *blame = blame_pair(s, a, b);
    if (pair && blame)
        json_object_set(pair, "blame", blame);
    json_decref(blame);
    json_t *accepts = rg_accepts_tell(&s->accepts, s->asked->subject.technique, &c->tiers,
                                      s->asked->mutants, s->pairs);
    if (pair && accepts)
        json_object_set(pair, "accepts", accepts);
    json_decref(accepts);
}

// Takes from the comparison of a pair's rain what its mask decides: T1 and T2, which whole pictures
// must hold too, and figures over the mask.
static void take_rain(const struct rg_comparison *rain, struct rg_comparison *c)
{
    struct rg_tiers tiers = rain->tiers;
    tiers.max_codes = c->tiers.max_codes;
    tiers.of[RG_T0] = c->tiers.of[RG_T0];
    if (!c->tiers.of[RG_T1].holds)
        tiers.of[RG_T1] = c->tiers.of[RG_T1];
    c->tiers = tiers;
    c->flip.mask_mean = rain->flip.mask_mean;
    c->flip.mask_p99 = rain->flip.mask_p99;
    const int tier = rg_tiers_strictest(&tiers);
    c->tier = tier < RG_TIER_COUNT ? rg_tier_name((enum rg_tier)tier) : "none";
}

// Judges the rain of a pair whose whole pictures hold T2, and of which one scene is drawn natively.
static bool judge_rain(const struct session *s, const struct shot *a, const struct shot *b,
                       struct rg_comparison *c)
{
    const struct rg_diff_devices_request *r = s->asked;
    const struct shot *native = a->info->native ? a : b, *other = a->info->native ? b : a;
    struct rg_comparison rain;
    if (!rg_frame_compare_rain(native->device, &r->subject, r->frames, other->info, &other->picture,
                               &s->background, &native->picture, exposure_of(s), &rain))
        return false;
    take_rain(&rain, c);
    rg_comparison_destroy(&rain);
    return true;
}

static int compare_pair(struct session *s, const struct shot *a, const struct shot *b)
{
    const bool differ = rg_frame_scenes_differ(a->info, b->info);
    struct rg_comparison c;
    if (!rg_compare(&a->picture, a->info->name, &b->picture, b->info->name,
                    differ ? NULL : &s->background,
                    &(struct rg_compare_options){.exposure = exposure_of(s)}, &c))
        return rg_exit_of_error();
    if (differ && c.tiers.of[RG_T2].holds && !judge_rain(s, a, b, &c)) {
        rg_comparison_destroy(&c);
        return rg_exit_of_error();
    }
    const enum rg_outcome outcome = rg_comparison_outcome(&c, rg_tier_owed(a->info, b->info));
    s->compared += outcome != RG_NOTHING;
    json_t *pair = s->pairs ? pair_json(a, b, &c) : NULL;
    if (!s->pairs && s->compared == 1 && outcome != RG_NOTHING)
        print_head();
    if (!s->pairs && outcome != RG_NOTHING)
        print_pair(a, b, &c, outcome == RG_OK);
    bool ok = true;
    if (outcome == RG_FAIL)
        tell_failure(s, a, b, &c, pair);
    if (s->asked->features)
        ok = blame_features(s, a, b, pair);
    if (s->pairs)
        ok = json_array_append_new(s->pairs, pair) == 0 && ok;
    if (s->asked->heatmap_prefix)
        ok = write_heatmaps(s, a, b, &c) && ok;
    rg_comparison_destroy(&c);
    return ok ? rg_exit_of(outcome) : rg_exit_of_error();
}

// Prints the number of pairs; none is no proof.
static void tell_count(const struct session *s)
{
    printf("%d pair%s of %d devices compared", s->compared, s->compared == 1 ? "" : "s",
           s->shot_count);
    if (s->failed)
        printf("; %d more device%s gave no picture", s->failed, s->failed == 1 ? "" : "s");
    printf("\n");
}

// Explains why pairs of pictures may show nothing to compare.
static void tell_dry(const struct session *s)
{
    const struct rg_diff_devices_request *r = s->asked;
    char why[RG_FRAME_DRY];
    rg_frame_tell_dry(s->shots[0].device, &r->subject, r->frames, exposure_of(s), "--frame", why);
    rg_error("diff %s: %s", r->subject.technique->name, why);
}

// Lists the devices with pictures.
static void list_infos(const struct session *s, const struct rg_device_info *infos[RG_MAX_DEVICES])
{
    for (int i = 0; i < s->shot_count; i++)
        infos[i] = s->shots[i].info;
}

static int compare_all(struct session *s)
{
    const struct rg_device_info *infos[RG_MAX_DEVICES];
    int exit = s->exit;
    list_infos(s, infos);
    if (!write_pictures(s))
        return rg_exit_of_error();
    if (!s->asked->json)
        rg_drivers_print(infos, s->shot_count, stdout);
    for (int i = 0; i < s->shot_count; i++) {
        for (int j = i + 1; j < s->shot_count && exit != RG_EXIT_USAGE; j++)
            exit = rg_exit_worse(exit, compare_pair(s, &s->shots[i], &s->shots[j]));
    }
    if (exit == RG_EXIT_NOTHING)
        tell_dry(s);
    if (!s->asked->json)
        tell_count(s);
    else if (!rg_pairs_print_json(rg_passport_devices(infos, s->shot_count), s->pictures, s->pairs,
                                  s->failures))
        exit = rg_exit_worse(exit, rg_exit_of_error());
    return exit;
}

// Memory for each device's picture, the one without rain, and three that blame features; on the
// disk, two heat maps a pair and a picture a device.
static bool has_room(const struct session *s, const struct rg_devices *devices)
{
    const struct rg_diff_devices_request *r = s->asked;
    const int64_t pixels = (int64_t)r->subject.width * r->subject.height;
    const int count = devices->count, of_features = r->features ? 3 : 0;
    char path[HEATMAP_PREFIX];
    if (!rg_pictures_fit(r->subject.width, r->subject.height, count + 1 + of_features))
        return false;
    if (!r->heatmap_prefix)
        return true;
    name_picture(s, &devices->devices[0]->info, path);
    return rg_pair_heatmaps_can_be_written(r->heatmap_prefix, (count - 1) * count * pixels) &&
           rg_picture_can_be_written(path, count * pixels);
}

// Whether the opened devices can be compared as asked. False, and one logged line, if not.
static bool suffice(const struct rg_diff_devices_request *r, const struct rg_devices *devices)
{
    bool any_native = false;
    for (int i = 0; i < devices->count; i++)
        any_native = any_native || devices->devices[i]->info.native;
    if (devices->count < 2)
        return rg_error("--device %s: a comparison takes two devices", r->devices->names);
    return !r->features || any_native ||
           rg_error("--device %s: --features takes a native device, such as gl:native",
                    r->devices->names);
}

int rg_diff_devices(const struct rg_diff_devices_request *request)
{
    struct session *s = rg_alloc(1, sizeof(*s), "diff");
    if (!s)
        return rg_exit_of_error();
    s->asked = request;
    if (request->json) {
        s->pairs = json_array();
        s->failures = json_array();
    }
    struct rg_devices devices;
    int exit = rg_devices_open_asked(request->devices, &devices);
    if (exit == RG_EXIT_PASS && rg_devices_exit(&devices) == RG_EXIT_PASS &&
        !suffice(request, &devices)) {
        exit = RG_EXIT_USAGE;
    } else if (exit == RG_EXIT_PASS && !(spare_files(s, &devices) && has_room(s, &devices))) {
        exit = rg_exit_of_error();
    } else if (exit == RG_EXIT_PASS) {
        exit = take_pictures(s, &devices) ? compare_all(s) : rg_exit_of_error();
        exit = rg_exit_with(exit, s->compared);
    }
    for (int i = 0; i < s->shot_count; i++)
        rg_picture_destroy(&s->shots[i].picture);
    json_decref(s->pictures);
    json_decref(s->pairs);
    json_decref(s->failures);
    rg_picture_destroy(&s->background);
    exit = rg_devices_end(&devices, exit);
    free(s);
    return exit;
}
