#include "harness/devices/measure/serving/fixed_pairs.h"

#include <inttypes.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

#include "core/base/alloc.h"
#include "harness/console/interrupt.h"
#include "harness/devices/measure/serving/services.h"
#include "harness/devices/workers/device.h"

// --- a draw ---

#define FARTHEST ((int64_t)RG_FIXED_BEYOND_MOST)
static const struct rg_field beyond_fields[] = {
    RG_FIELD_INTEGER(struct rg_fixed_beyond, count, 0, INT_MAX),
    RG_FIELD_TEXT(struct rg_fixed_beyond, part),
    RG_FIELD_INTEGER(struct rg_fixed_beyond, layer, 0, INT_MAX),
    RG_FIELD_INTEGER(struct rg_fixed_beyond, x, 0, INT_MAX),
    RG_FIELD_INTEGER(struct rg_fixed_beyond, y, 0, INT_MAX),
    RG_FIELD_INTEGER(struct rg_fixed_beyond, channel, 0, INT_MAX),
    RG_FIELD_NUMBER(struct rg_fixed_beyond, value, -FARTHEST, FARTHEST),
    RG_FIELD_NUMBER(struct rg_fixed_beyond, low, -FARTHEST, FARTHEST),
    RG_FIELD_NUMBER(struct rg_fixed_beyond, high, -FARTHEST, FARTHEST),
    RG_FIELDS_END,
};

const struct rg_field rg_fixed_fields[] = {
    RG_FIELD_TEXT(struct rg_fixed_told, lacks),
    RG_FIELD_BYTES(struct rg_fixed_told, digest),
    RG_FIELD_BYTES(struct rg_fixed_told, other),
    RG_FIELD_FLAG(struct rg_fixed_told, is_constant),
    RG_FIELD_FLAG(struct rg_fixed_told, is_bounded),
    RG_FIELD_STRUCT(struct rg_fixed_told, beyond, beyond_fields),
    RG_FIELD_TEXT(struct rg_fixed_told, known),
    RG_FIELDS_END,
};

static bool digest(struct rg_device *device, const char *feature,
                   const struct rg_fixed_state *state, struct rg_fixed_picture *picture,
                   uint64_t *hash)
{
    picture->size = 0;
    picture->is_constant = false;
    if (!rg_device_fixed_draw(device, feature, state, picture))
        return false;
    *hash = XXH3_64bits(picture->bytes, picture->size);
    return true;
}

struct pair {
    const char *feature;
    struct rg_fixed_state first, other;
    bool is_bounded; // the first one
};

static struct pair pair_of(int row)
{
    const int draws = rg_fixed_count();
    if (row < draws)
        return (struct pair){rg_fixed_draws[row].feature, rg_fixed_draws[row].state,
                             rg_fixed_neighbour(&rg_fixed_draws[row]),
                             rg_fixed_sections(rg_fixed_draws[row].feature)};
    const struct rg_fixed_closed *closed = &rg_fixed_closed[row - draws];
    return (struct pair){closed->feature, closed->state, closed->same, false};
}

int rg_fixed_pairs(void)
{
    return rg_fixed_count() + rg_fixed_closed_count();
}

// Where a device does not say where samples lie, nothing bounds a draw of several.
static bool hold(const struct rg_device *device, const struct pair *pair,
                 const struct rg_fixed_picture *picture, struct rg_fixed_told *told)
{
    told->is_bounded = pair->is_bounded && !picture->lacks[0] &&
                       (!pair->first.samples || picture->precision.has_places);
    if (!told->is_bounded)
        return true;
    struct rg_fixed_bounds *bounds = rg_fixed_bounds_make(&pair->first, &picture->precision);
    if (!bounds)
        return false;
    rg_fixed_bounds_hold(bounds, picture->bytes, picture->size, &told->beyond);
    rg_fixed_bounds_free(bounds);
    const char *known = rg_fixed_known_fault(pair->feature, device->info.device, &told->beyond);
    snprintf(told->known, sizeof(told->known), "%s", known ? known : "");
    return true;
}

static bool take(struct rg_device *device, const struct pair *pair,
                 struct rg_fixed_picture *picture, struct rg_fixed_told *told)
{
    if (!digest(device, pair->feature, &pair->first, picture, &told->digest))
        return false;
    told->is_constant = !picture->size || picture->is_constant;
    if (!hold(device, pair, picture, told))
        return false;
    if (!picture->lacks[0] && !digest(device, pair->feature, &pair->other, picture, &told->other))
        return false;
    snprintf(told->lacks, sizeof(told->lacks), "%s", picture->lacks);
    return true;
}

static struct rg_fixed_picture make_room(void)
{
    return (struct rg_fixed_picture){.bytes = rg_alloc(1, RG_FIXED_PICTURE_BYTES, "picture"),
                                     .room = RG_FIXED_PICTURE_BYTES};
}

bool rg_fixed_take(struct rg_device *device, int row, struct rg_fixed_told *told)
{
    struct rg_fixed_picture picture = make_room();
    const struct pair pair = pair_of(row);
    const bool ok = picture.bytes && take(device, &pair, &picture, told);
    free(picture.bytes);
    return ok;
}

bool rg_serve_fixed(struct rg_message *request, struct rg_message *reply)
{
    struct rg_fixed_told told = {0};
    struct rg_device *device = rg_served_device(rg_take_text(request));
    const int row = rg_take_index(request, rg_fixed_pairs());
    if (!device || request->failed || !rg_fixed_take(device, row, &told))
        return false;
    rg_put_fields(reply, rg_fixed_fields, &told);
    return true;
}

bool rg_fixed_ask(struct rg_device *device, int row, struct rg_fixed_told *told)
{
    struct rg_worker *worker = rg_remote_worker(device);
    struct rg_message request = {0};
    *told = (struct rg_fixed_told){0};
    if (!worker)
        return rg_fixed_take(device, row, told);
    rg_put_text(&request, device->info.full);
    rg_put_int(&request, row);
    const bool ok = rg_worker_fetch(worker, RG_CALL_FIXED, &request, rg_fixed_fields, told);
    rg_message_free(&request);
    return ok;
}

struct rg_failure rg_fixed_failure(struct rg_device *device)
{
    const struct rg_failure failure = rg_failure_take();
    rg_worker_renew(rg_remote_worker(device));
    return failure;
}

bool rg_fixed_goes_on(const struct rg_device *device, int failed, int left)
{
    enum { MOST_FAILED = 2 };
    return failed < MOST_FAILED || !left ||
           rg_error("device '%s': %d draws of fixed functions failed, and %d more are not tried",
                    device->info.name, failed, left);
}

static void judge_draw(const struct rg_fixed_draw *draw, const struct rg_fixed_told *told,
                       char why[RG_FIXED_WHY])
{
    if (told->digest == told->other)
        snprintf(why, RG_FIXED_WHY, "leaves what its neighbour does, whose %s is %d", draw->field,
                 draw->to);
    else if (told->beyond.count && !*told->known)
        rg_fixed_beyond_tell(&told->beyond, why);
}

static void judge_closed(const struct rg_fixed_closed *closed, const struct rg_fixed_told *told,
                         char why[RG_FIXED_WHY])
{
    if (told->digest != told->other)
        snprintf(why, RG_FIXED_WHY, "does not hold: %s", closed->about);
}

enum rg_outcome rg_fixed_judge(int row, const struct rg_fixed_told *told, char why[RG_FIXED_WHY])
{
    const int draws = rg_fixed_count();
    *why = 0;
    if (*told->lacks)
        snprintf(why, RG_FIXED_WHY, "lacks %s", told->lacks);
    else if (told->is_constant)
        snprintf(why, RG_FIXED_WHY, "leaves a picture that is the same everywhere");
    else if (row < draws)
        judge_draw(&rg_fixed_draws[row], told, why);
    else
        judge_closed(&rg_fixed_closed[row - draws], told, why);
    return *told->lacks ? RG_UNSUPPORTED : *why ? RG_FAIL : RG_OK;
}

// --- digests of a device ---

json_t *rg_fixed_hash(uint64_t hash)
{
    return json_sprintf("%016" PRIx64, hash);
}

static void take_left(struct rg_device *device, int i, struct rg_fixed_left *left)
{
    struct rg_fixed_told told;
    char why[RG_FIXED_WHY];
    if (!rg_fixed_ask(device, i, &told)) {
        left->outcomes[i] = rg_fixed_failure(device).outcome;
        left->failed = left->failed == RG_OK ? left->outcomes[i] : left->failed;
        return;
    }
    left->outcomes[i] = rg_fixed_judge(i, &told, why);
    if (left->outcomes[i] != RG_OK)
        return;
    left->is_within[i] = told.is_bounded && !told.beyond.count;
    left->digests = left->digests ? left->digests : json_object();
    json_object_set_new(left->digests, rg_fixed_draws[i].feature, rg_fixed_hash(told.digest));
}

void rg_fixed_draw_all(struct rg_device *device, struct rg_fixed_left *left)
{
    const int count = *device->info.limits.no_native ? 0 : rg_fixed_count();
    int failed = 0;
    *left = (struct rg_fixed_left){0};
    for (int i = 0; i < RG_FIXED_MAX_DRAWS; i++)
        left->outcomes[i] = RG_NOTHING;
    for (int i = 0; rg_fixed_goes_on(device, failed, count - i) && i < count && !rg_interrupted();
         i++) {
        take_left(device, i, left);
        failed += rg_outcome_is_broken(left->outcomes[i]);
    }
}

void rg_fixed_left_free(struct rg_fixed_left *left)
{
    json_decref(left->digests);
}

static json_t *find(const json_t *passport, const char *name)
{
    size_t i;
    json_t *device;
    json_array_foreach(json_object_get(passport, "devices"), i, device)
    {
        const char *its = json_string_value(json_object_get(device, "name"));
        if (its && !strcmp(its, name))
            return device;
    }
    return NULL;
}

static const char key[] = "fixed_functions", within_key[] = "within_bounds";

void rg_fixed_put(json_t *passport, const char *device, json_t *digests)
{
    if (digests)
        json_object_set(find(passport, device), key, digests);
}

const json_t *rg_fixed_kept(const json_t *passport, const char *device)
{
    const json_t *digests = json_object_get(find(passport, device), key);
    return json_is_object(digests) ? digests : NULL;
}

void rg_fixed_put_within(json_t *passport, const char *device, const struct rg_fixed_left *left)
{
    json_t *within = json_array();
    for (int i = 0; i < rg_fixed_count(); i++)
        if (left->is_within[i])
            json_array_append_new(within, json_string(rg_fixed_draws[i].feature));
    if (json_array_size(within))
        json_object_set(find(passport, device), within_key, within);
    json_decref(within);
}

bool rg_fixed_kept_within(const json_t *passport, const char *device, int draw)
{
    size_t i;
    json_t *feature;
    json_array_foreach(json_object_get(find(passport, device), within_key), i, feature)
    {
        const char *its = json_string_value(feature);
        if (its && !strcmp(its, rg_fixed_draws[draw].feature))
            return true;
    }
    return false;
}
