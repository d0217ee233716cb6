// The limits on this process (ulimit), in a message's words.
#ifndef RG_CORE_BASE_TEXT_LIMITS_H
#define RG_CORE_BASE_TEXT_LIMITS_H

enum { RG_LIMITS_TEXT = 120 };

// The limits that are lower than what a driver or a reader of files needs, so that what fails under
// them says nothing of it: "under ulimit -v 200000, -n 8", in the shell's units. NULL where none
// is. Returns `text`.
const char *rg_limits_low(char text[RG_LIMITS_TEXT]);

#endif
