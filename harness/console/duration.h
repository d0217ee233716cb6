// Durations for people.
#ifndef RG_HARNESS_CONSOLE_DURATION_H
#define RG_HARNESS_CONSOLE_DURATION_H

#include <stdbool.h>

// "48 s", "2.8 min", "2.7 h": two digits.
enum { RG_DURATION_TEXT = 24 };
const char *rg_duration_text(double s, char text[RG_DURATION_TEXT]);

// Parses seconds from "90s", "4m" or "1h", below a million seconds. False, and one logged line that
// names the option, for any other text.
bool rg_duration_read(const char *text, const char *option, double *s);

// The duration in seconds from which a command estimates its time aloud: 30, or RG_LONG_S.
double rg_long_s(void);

#endif
