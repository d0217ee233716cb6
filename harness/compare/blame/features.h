// Blames a native device's difference on the features of the driver (docs/native.md): switches them
// to the exact way one at a time, on both devices if both are native, and compares the pictures
// again.
#ifndef RG_HARNESS_COMPARE_BLAME_FEATURES_H
#define RG_HARNESS_COMPARE_BLAME_FEATURES_H

#include "harness/compare/blame/blame.h"
#include "harness/devices/frames/frame.h"

// Two devices, the first of which is native, and the picture without rain.
struct rg_features_request {
    struct rg_digest_run run;
    struct rg_device *device, *truth;
    const struct rg_picture *dry;
    int frames; // of the picture, which may be 0
};

// A pair of pictures, with features switched to the exact way.
struct rg_features_pair {
    unsigned exact;          // bits of enum rg_feature
    bool is_drawn, is_equal; // equal as `by_bits` says
    int64_t differing;       // values
    double largest;          // difference, linear
    int x, y;                // where it is
    char why[200];           // if it is not drawn
};

enum rg_features_verdict {
    RG_FEATURES_ALONE,    // each of `blamed` ends the difference alone
    RG_FEATURES_TOGETHER, // only all of `blamed` end it
    RG_FEATURES_SHARED,   // nothing ends it: the exact way has it too
    RG_FEATURES_UNKNOWN,  // a picture that would tell was not drawn
    RG_FEATURES_VERDICTS
};

enum { RG_FEATURES_PAIRS = 2 * RG_FEATURE_COUNT + 2 };

struct rg_features_told {
    bool by_bits;      // equal means to the bit; else within `tier`
    enum rg_tier tier; // that the devices owe
    int64_t values;    // of a picture
    int count;         // of pairs: none switched, one at a time, all, then fewer
    struct rg_features_pair pairs[RG_FEATURES_PAIRS];
    enum rg_features_verdict verdict;
    unsigned blamed;
    struct rg_blame blame; // the first stage that tells: of the two devices if `by_bits`, else of
                           // the device and itself with the blamed features switched
    char text[200];        // the verdict in a line
};

// False, and one logged line, if a device fails with nothing switched, or the user's input is
// refused.
bool rg_features_blame(const struct rg_features_request *request, struct rg_features_told *told);

void rg_features_print(const struct rg_features_told *told);
// "features" in docs/records.schema.json; the caller owns it.
json_t *rg_features_json(const struct rg_features_told *told);

#endif
