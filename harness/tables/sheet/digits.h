// Numbers as a reader takes them in: two or three significant digits.
#ifndef RG_HARNESS_TABLES_SHEET_DIGITS_H
#define RG_HARNESS_TABLES_SHEET_DIGITS_H

#include <stddef.h>

// "0.034", "1.27", "27.4", "314": three digits, but whole numbers whole.
void rg_digits_rate(double number, char *text, size_t size);
// "0.03", "0.96", "1.3", "14": two digits.
void rg_digits_ratio(double number, char *text, size_t size);
// "culling radius, m" of "culling_radius_m": the name of a number with its unit behind. The unit is
// that of the parameter, which the name may end in; NULL: it is no parameter, and the name tells.
void rg_digits_heading(const char *name, const char *unit, char *text, size_t size);

#endif
