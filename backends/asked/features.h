// What a native device leaves to its driver, as RG_NATIVE says: everything, or the named features.
#ifndef RG_BACKENDS_ASKED_FEATURES_H
#define RG_BACKENDS_ASKED_FEATURES_H

#include "backends/backend.h"

// "samplers", of an index below RG_FEATURE_COUNT; and what the driver does: "filters textures, and
// compares depths".
const char *rg_feature_word(int feature);
const char *rg_feature_does(int feature);

enum { RG_FEATURES_TEXT = 64 };
// The words of features as RG_NATIVE has them: "samplers+setup"; "none".
void rg_features_write(unsigned features, char text[RG_FEATURES_TEXT]);

// Reads RG_NATIVE. False, and one logged line, if it names no features, or places without setup.
bool rg_features_read(unsigned *features);

// Has programs blend where they can, if the driver shall not.
void rg_features_settle(struct rg_device *device);

#endif
