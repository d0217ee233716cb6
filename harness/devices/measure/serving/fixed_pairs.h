// Draws of fixed functions in pairs, on the device of a worker: a draw and its neighbour, which
// must differ, or the two ways of a closed case, which must not.
#ifndef RG_HARNESS_DEVICES_MEASURE_SERVING_FIXED_PAIRS_H
#define RG_HARNESS_DEVICES_MEASURE_SERVING_FIXED_PAIRS_H

#include <jansson.h>

#include "core/base/log.h"
#include "core/device/device.h"
#include "harness/devices/workers/fields.h"
#include "shaders/fixed/bounds/bounds.h"

struct rg_fixed_told {
    char lacks[80];                // what the device lacks for either; "": nothing
    uint64_t digest, other;        // XXH3 of all that each left
    bool is_constant;              // a part of the first is the same everywhere
    bool is_bounded;               // specifications bound the first
    struct rg_fixed_beyond beyond; // the first's values that are not within the bounds
    char known[80];                // the known fault of the driver that explains those; "": none
};

extern const struct rg_field rg_fixed_fields[];

// A pair has a row: those of rg_fixed_draws come first, then those of rg_fixed_closed.
int rg_fixed_pairs(void);

// Draws a pair. False, and one logged line, on failure.
bool rg_fixed_take(struct rg_device *device, int row, struct rg_fixed_told *told);

// The same in the device's worker, or here if it has none.
bool rg_fixed_ask(struct rg_device *device, int row, struct rg_fixed_told *told);

// After a failure of rg_fixed_ask, which has been logged: takes it, and starts the
// device's worker again, which may have ended.
struct rg_failure rg_fixed_failure(struct rg_device *device);

// Whether a device of which `failed` draws have failed in its driver draws on, with `left` pairs to
// go. It does not after two, since each may take a whole timeout; one line is logged then.
bool rg_fixed_goes_on(const struct rg_device *device, int failed, int left);

enum { RG_FIXED_WHY = 300 };
// Judges a pair: OK; unsupported; or fail, where the first picture is the same everywhere, a draw
// leaves what its neighbour does or, by no known fault, a value beyond its bounds, or a closed case
// does not hold. `why` says so in one line; "": OK.
enum rg_outcome rg_fixed_judge(int row, const struct rg_fixed_told *told, char why[RG_FIXED_WHY]);

// A digest in 16 hexadecimal digits.
json_t *rg_fixed_hash(uint64_t hash);

// What a device leaves of rg_fixed_draws.
struct rg_fixed_left {
    json_t *digests; // of the draws that are OK, by feature; NULL: none is
    enum rg_outcome outcomes[RG_FIXED_MAX_DRAWS]; // RG_NOTHING: not tried
    bool is_within[RG_FIXED_MAX_DRAWS];           // the draw's bounds; false: it has none
    enum rg_outcome failed; // the first draw that could not be made; RG_OK: none
};
// Draws them all, with one logged line for each that could not be made.
void rg_fixed_draw_all(struct rg_device *device, struct rg_fixed_left *left);
void rg_fixed_left_free(struct rg_fixed_left *left);
// Puts such digests, or NULL, into a device of a passport (harness/record/passport/passport.h).
void rg_fixed_put(json_t *passport, const char *device, json_t *digests);
// The digests in a passport; NULL: the device is not in it, or has none.
const json_t *rg_fixed_kept(const json_t *passport, const char *device);
// The same of which draws were within their bounds.
void rg_fixed_put_within(json_t *passport, const char *device, const struct rg_fixed_left *left);
bool rg_fixed_kept_within(const json_t *passport, const char *device, int draw);

#endif
