// A case: a difference between two devices, as a short text that one device replays.
#ifndef RG_HARNESS_COMPARE_SHRINK_CASE_H
#define RG_HARNESS_COMPARE_SHRINK_CASE_H

#include "harness/compare/blame/blame.h"
#include "harness/compare/blame/fall.h"

enum { RG_CASE_NAME = RG_DEVICE_NAME_SIZE };

struct rg_case {
    struct rg_digest_run run; // its settings are owned
    int stages_run;           // the asset differs after this many stages
    char stage[RG_ASSET_NAME], asset[RG_ASSET_NAME];
    enum rg_difference difference; // NONE if the device fails
    struct rg_fall fall;           // how the device fails, if it does
    uint64_t expected, found;      // digests of the asset; found: 0 if the device fails
    char device[RG_CASE_NAME], truth[RG_CASE_NAME]; // the devices with which it was found
};

// Writes a case with every parameter that is not at its default, and `note`, one line. Copies the
// user's own files that settings name into a folder next to it (files.h). False, and one logged
// line, on failure; no partial file remains.
bool rg_case_write(const struct rg_case *found, const char *note, const char *path);

// Reads a case. False, and one logged line with the file and the line, if it is not valid;
// rg_case_free in either case.
bool rg_case_read(const char *path, struct rg_case *found);
void rg_case_free(struct rg_case *found);

// Replays a case on a device, and prints the digest of the asset or how the device failed. Returns
// an enum rg_exit: pass if the digest is the expected one. `path` is where the case was read, for
// errors.
int rg_case_replay(const struct rg_case *found, const char *path, struct rg_device *device);

#endif
