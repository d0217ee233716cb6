// Days of the Gregorian calendar, "2026-11-23".
#ifndef RG_HARNESS_COMPARE_GATE_TEXT_DATE_H
#define RG_HARNESS_COMPARE_GATE_TEXT_DATE_H

#include <stdbool.h>

enum { RG_DATE_SIZE = 16 };

// Reads "YYYY-MM-DD" of the years 1970 to 9999 as days since 1970-01-01. False for anything else,
// such as a 30th of February.
bool rg_date_read(const char *text, int *day);
// Writes a day that rg_date_read can read.
void rg_date_write(int day, char text[RG_DATE_SIZE]);

#endif
