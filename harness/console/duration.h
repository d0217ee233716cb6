// How long work takes, for people.
#ifndef RG_HARNESS_CONSOLE_DURATION_H
#define RG_HARNESS_CONSOLE_DURATION_H

#include <stdbool.h>

// "48 s", "2.8 min", "2.7 h": two digits.
enum { RG_DURATION_TEXT = 24 };
const char *rg_duration_text(double s, char text[RG_DURATION_TEXT]);

// Seconds of "90s", "4m" or "1h". False, and one logged line that names the option, where a text is
// none of these.
bool rg_duration_read(const char *text, const char *option, double *s);

// Seconds from which a command says how long it will take: 30, or what RG_LONG_S says.
double rg_long_s(void);

#endif
