// streaks: the search for the smallest culling radius and local height without visible error, which
// Creus leaves to future work (section 5.5). docs/streaks.md explains what counts as visible.
#ifndef RG_CORE_TECHNIQUES_STREAKS_FIT_H
#define RG_CORE_TECHNIQUES_STREAKS_FIT_H

#include "core/techniques/streaks/instance.h"

// The search begins with the largest sizes there are, whatever was set. False, and one logged line,
// where the settings leave nothing to search for.
bool streaks_fit_begin(struct streaks_settings *settings);

// Finds the sizes, by drawing the first frame again and again, and leaves them in the settings,
// with particles made for them and the error told as a fact. All but the particles must be open.
// False, and one logged line, if even the largest sizes exceed fit_error, if no rain is seen, or on
// any other failure.
bool streaks_fit(struct streaks *streaks);

#endif
