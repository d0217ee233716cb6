// The limits on this process (ulimit), as words for messages.
#ifndef RG_CORE_BASE_TEXT_LIMITS_H
#define RG_CORE_BASE_TEXT_LIMITS_H

enum { RG_LIMITS_TEXT = 120 };

// Names the limits that are lower than a driver or a reader of files needs, because a failure under
// them does not mention the limit: "under ulimit -v 200000, -n 8", in the shell's units. Returns
// `text`, or NULL if none is too low.
const char *rg_limits_low(char text[RG_LIMITS_TEXT]);

#endif
