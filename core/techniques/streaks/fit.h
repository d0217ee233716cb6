// Searches for the smallest culling radius and local height without visible error, which Creus
// leaves to future work (section 5.5). docs/streaks.md explains what counts as visible.
#ifndef RG_CORE_TECHNIQUES_STREAKS_FIT_H
#define RG_CORE_TECHNIQUES_STREAKS_FIT_H

#include "core/techniques/streaks/instance.h"

// Sets the sizes to the largest possible, where the search begins. False, and one logged line,
// where the settings leave nothing to search for.
bool streaks_fit_begin(struct streaks_settings *settings);

// Finds the sizes by drawing the first frame repeatedly, sets them, makes particles for them, and
// tells the error as a fact. Everything except the particles must be open. False, and one logged
// line, if even the largest sizes exceed fit_error, if no rain is visible, or on any other failure.
bool streaks_fit(struct streaks *streaks);

#endif
