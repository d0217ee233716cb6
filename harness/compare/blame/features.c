#include "harness/compare/blame/features.h"

#include <stdio.h>
#include <string.h>

#include "backends/asked/features.h"
#include "core/base/log.h"
#include "core/base/text/add.h"
#include "core/base/text/plain.h"
#include "core/device/device.h"
#include "harness/devices/devices.h"
#include "harness/devices/names.h"
#include "harness/record/named.h"

// --- devices with features switched ---

// A device's name without RG_NATIVE.
static void name_without(const char *full, char name[RG_DEVICE_NAME_SIZE])
{
    static const char key[] = "RG_NATIVE=";
    snprintf(name, RG_DEVICE_NAME_SIZE, "%s", full);
    char *at = strstr(name, key);
    if (!at || (at[-1] != '@' && at[-1] != ';'))
        return;
    char *end = at + strcspn(at, ";");
    if (*end)
        memmove(at, end + 1, strlen(end + 1) + 1);
    else
        at[-1] = 0;
}

// Opens the same native device with features switched to the exact way.
static struct rg_device *open_with(const struct rg_device *device, unsigned exact)
{
    char plain[RG_DEVICE_NAME_SIZE], with[RG_DEVICE_NAME_SIZE], words[RG_FEATURES_TEXT];
    name_without(device->info.full, plain);
    rg_features_write(device->info.features & ~exact, words);
    return rg_device_name_with(plain, "RG_NATIVE", words, with) ? rg_devices_open_one(with) : NULL;
}

// --- pairs of pictures ---

// Whether the pictures of two devices are within the tier that they owe.
static bool judge_tier(const struct rg_features_request *r, struct rg_device *device,
                       const struct rg_device *truth, const struct rg_picture *now,
                       const struct rg_picture *due, enum rg_tier tier, bool *holds)
{
    struct rg_comparison c;
    if (!rg_frame_compare(device, &r->run.subject, r->frames, &truth->info, due, r->dry, now, &c))
        return false;
    *holds = c.tiers.of[tier].holds;
    rg_comparison_destroy(&c);
    return true;
}

// Compares what two devices draw. The first pair decides by what the others are compared. `due` is
// empty, or the truth's picture.
static bool compare(const struct rg_features_request *r, struct rg_device *device,
                    struct rg_device *truth, struct rg_picture *due, struct rg_features_told *told,
                    struct rg_features_pair *pair)
{
    const struct rg_subject *subject = &r->run.subject;
    struct rg_picture now = {0};
    struct rg_metrics m = {0};
    bool holds = false;
    const bool is_first = !told->count;
    bool ok = rg_frame_draw(device, subject, r->frames, &now) &&
              (due->texels || rg_frame_draw(truth, subject, r->frames, due)) &&
              rg_metrics_compute(due, &now, &m);
    if (ok && (is_first || !told->by_bits))
        ok = judge_tier(r, device, truth, &now, due, told->tier, &holds);
    if (ok) {
        told->by_bits = is_first ? holds : told->by_bits;
        told->values = m.values;
        *pair = (struct rg_features_pair){.exact = pair->exact,
                                          .is_drawn = true,
                                          .is_equal = told->by_bits ? !m.differing_values : holds,
                                          .differing = m.differing_values,
                                          .largest = m.max,
                                          .x = m.max_x,
                                          .y = m.max_y};
    }
    rg_picture_destroy(&now);
    return ok;
}

// Adds a pair with these features switched on both devices; an exact one has drawn `due`. A device
// that fails then is noted.
static const struct rg_features_pair *add_pair(const struct rg_features_request *r, unsigned exact,
                                               struct rg_picture *due,
                                               struct rg_features_told *told)
{
    struct rg_features_pair *pair = &told->pairs[told->count];
    *pair = (struct rg_features_pair){.exact = exact};
    const bool both = r->truth->info.native;
    struct rg_picture own = {0};
    rg_log_hold(true);
    struct rg_device *device = open_with(r->device, exact);
    struct rg_device *truth = !both ? r->truth : device ? open_with(r->truth, exact) : NULL;
    if (!device || !truth || !compare(r, device, truth, both ? &own : due, told, pair))
        rg_text_copy(pair->why, sizeof(pair->why), rg_last_error());
    rg_picture_destroy(&own);
    if (both)
        rg_device_close(truth);
    rg_device_close(device);
    rg_failure_take();
    rg_log_hold(false);
    told->count++;
    return pair;
}

// --- the verdict ---

// What is switched with a feature: places are interpolated only if the driver sets items up.
static unsigned with_it(int feature)
{
    return 1u << feature | (1u << feature == RG_FEATURE_SETUP ? (unsigned)RG_FEATURE_PLACES : 0u);
}

// Leaves out features whose switch includes another one's that ends the difference alone: setup
// includes places. Draws that blend leave out all, if the driver shall not blend.
static unsigned narrowest(unsigned enders)
{
    if (enders & RG_FEATURE_PLACES)
        enders &= ~(unsigned)RG_FEATURE_SETUP;
    if (enders & ~(unsigned)RG_FEATURE_BLENDING)
        enders &= ~(unsigned)RG_FEATURE_BLENDING;
    return enders;
}

// Takes features back from all, one after the other, as long as the difference stays ended.
static unsigned fewest(const struct rg_features_request *r, unsigned all, struct rg_picture *due,
                       struct rg_features_told *told)
{
    unsigned exact = all;
    for (int i = 0; i < RG_FEATURE_COUNT; i++) {
        const unsigned fewer = exact & ~(1u << i);
        const bool is_whole = !(exact & RG_FEATURE_SETUP) || i != RG_FEATURE_NUMBER_PLACES;
        if (fewer != exact && fewer && is_whole && add_pair(r, fewer, due, told)->is_equal)
            exact = fewer;
    }
    return exact;
}

static void judge(const struct rg_features_request *r, struct rg_picture *due,
                  struct rg_features_told *told)
{
    const unsigned all =
        r->device->info.features | (r->truth->info.native ? r->truth->info.features : 0u);
    unsigned enders = 0;
    bool is_whole = true;
    for (int i = 0; i < RG_FEATURE_COUNT; i++)
        if (all >> i & 1) {
            const struct rg_features_pair *pair = add_pair(r, all & with_it(i), due, told);
            enders |= pair->is_equal ? 1u << i : 0;
            is_whole = is_whole && pair->is_drawn;
        }
    told->blamed = narrowest(enders);
    told->verdict = RG_FEATURES_ALONE;
    if (enders)
        return;
    const struct rg_features_pair *none = add_pair(r, all, due, told);
    told->verdict = !none->is_drawn || !is_whole ? RG_FEATURES_UNKNOWN
                    : none->is_equal             ? RG_FEATURES_TOGETHER
                                                 : RG_FEATURES_SHARED;
    if (told->verdict == RG_FEATURES_TOGETHER)
        told->blamed = fewest(r, all, due, told);
}

// Finds the first stage that tells.
static bool find_stage(const struct rg_features_request *r, struct rg_features_told *told)
{
    unsigned switched = 0;
    for (int i = 0; i < RG_FEATURE_COUNT; i++)
        switched |= told->blamed >> i & 1 ? with_it(i) : 0;
    if (told->by_bits || !told->blamed)
        return rg_blame_find(&r->run, r->device, r->truth, &told->blame);
    struct rg_device *exact = open_with(r->device, switched);
    const bool ok = exact && rg_blame_find(&r->run, r->device, exact, &told->blame);
    rg_device_close(exact);
    return ok;
}

static void write_text(struct rg_features_told *told)
{
    const bool is_alone = told->verdict == RG_FEATURES_ALONE;
    char words[100] = "";
    int count = 0, last = 0;
    for (int i = 0; i < RG_FEATURE_COUNT; i++)
        if (told->blamed >> i & 1) {
            rg_text_add(words, sizeof(words), is_alone ? " or " : ", ", "%s", rg_feature_word(i));
            last = i;
            count++;
        }
    if (is_alone && count == 1)
        snprintf(told->text, sizeof(told->text), "%s: it ends the difference alone (the driver %s)",
                 words, rg_feature_does(last));
    else if (is_alone)
        snprintf(told->text, sizeof(told->text), "%s: each ends the difference alone", words);
    else if (told->verdict == RG_FEATURES_TOGETHER)
        snprintf(told->text, sizeof(told->text), "%s: only together they end the difference",
                 words);
    else
        snprintf(told->text, sizeof(told->text), "%s",
                 told->verdict == RG_FEATURES_SHARED
                     ? "none: all together do not end the difference, which the exact way has too"
                     : "unknown: a picture was not drawn, and no other ends the difference");
}

bool rg_features_blame(const struct rg_features_request *r, struct rg_features_told *told)
{
    struct rg_picture due = {0};
    *told = (struct rg_features_told){.tier = rg_tier_owed(&r->device->info, &r->truth->info)};
    bool ok = compare(r, r->device, r->truth, &due, told, &told->pairs[0]);
    told->count = 1;
    if (ok && !told->pairs[0].is_equal) {
        judge(r, &due, told);
        write_text(told);
        ok = find_stage(r, told);
    }
    rg_picture_destroy(&due);
    return ok;
}

// --- telling ---

static void print_pair(const struct rg_features_told *told, const struct rg_features_pair *pair)
{
    char words[RG_FEATURES_TEXT], why[sizeof(pair->why)];
    rg_features_write(pair->exact, words);
    rg_text_copy(why, sizeof(why), pair->why);
    rg_plain(why);
    if (!pair->is_drawn)
        printf("  %-44s not drawn: %s\n", words, why);
    else
        printf("  %-44s %10lld %10.3g  %4d %4d  %s\n", words, (long long)pair->differing,
               pair->largest, pair->x, pair->y,
               told->by_bits    ? (pair->is_equal ? "equal" : "differs")
               : pair->is_equal ? "holds"
                                : "fails");
}

void rg_features_print(const struct rg_features_told *told)
{
    const struct rg_blame *blame = &told->blame;
    if (told->count < 2) {
        printf("  no feature is switched: the pictures are equal\n");
        return;
    }
    printf("  %-44s %10s %10s  %4s %4s  %s\n", "drawn the exact way", "differing", "largest", "x",
           "y", told->by_bits ? "bits" : rg_tier_name(told->tier));
    for (int i = 0; i < told->count; i++)
        print_pair(told, &told->pairs[i]);
    printf("  %d pairs of pictures of %lld values compared\n", told->count,
           (long long)told->values);
    printf("  %s\n", told->text);
    if (blame->found)
        printf("  first %s %s\n", told->by_bits || !told->blamed ? "differs" : "changes",
               blame->text);
}

static json_t *words_json(unsigned features)
{
    json_t *words = json_array();
    for (int i = 0; i < RG_FEATURE_COUNT; i++)
        if (features >> i & 1)
            json_array_append_new(words, json_string(rg_feature_word(i)));
    return words;
}

json_t *rg_features_json(const struct rg_features_told *told)
{
    static const char *const verdicts[] = {"alone", "together", "shared", "unknown"};
    json_t *rows = json_array();
    for (int i = 0; i < told->count; i++) {
        const struct rg_features_pair *pair = &told->pairs[i];
        json_t *row =
            json_pack("{s:o, s:b}", "exact", words_json(pair->exact), "equal", pair->is_equal);
        if (pair->is_drawn) {
            json_object_set_new(row, "differing", json_integer(pair->differing));
            json_object_set_new(row, "largest", rg_number_json(pair->largest));
            json_object_set_new(row, "pixel", json_pack("[ii]", pair->x, pair->y));
        } else {
            json_object_set_new(row, "why", rg_json_text(pair->why));
        }
        json_array_append_new(rows, row);
    }
    json_t *json = json_pack("{s:s, s:o}", "by", told->by_bits ? "bits" : rg_tier_name(told->tier),
                             "compared", rows);
    if (json && told->count > 1) {
        json_object_set_new(json, "verdict", json_string(verdicts[told->verdict]));
        json_object_set_new(json, "blamed", words_json(told->blamed));
        json_object_set_new(json, "text", json_string(told->text));
    }
    if (json && told->blame.found)
        json_object_set_new(json, "blame", rg_blame_json(&told->blame));
    return json;
}
