// Numbers in two or three significant digits, for readers.
#ifndef RG_HARNESS_TABLES_SHEET_DIGITS_H
#define RG_HARNESS_TABLES_SHEET_DIGITS_H

#include <stddef.h>

// Three digits; whole numbers in full: "0.034", "1.27", "27.4", "314".
void rg_digits_rate(double number, char *text, size_t size);
// Two digits: "0.03", "0.96", "1.3", "14".
void rg_digits_ratio(double number, char *text, size_t size);
// The heading "culling radius, m" for "culling_radius_m": a name with its unit after it. `unit` is
// the parameter's, with which the name may end; NULL: not a parameter, so the name decides.
void rg_digits_heading(const char *name, const char *unit, char *text, size_t size);

#endif
