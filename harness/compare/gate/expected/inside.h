// Shared by the files of this folder alone.
#ifndef RG_HARNESS_COMPARE_GATE_EXPECTED_INSIDE_H
#define RG_HARNESS_COMPARE_GATE_EXPECTED_INSIDE_H

#include "harness/compare/gate/expected/expected.h"

enum { RG_KNOWN_ANY = 1 << RG_FAIL | 1 << RG_ERROR | 1 << RG_CRASH | 1 << RG_TIMEOUT };

// Adds an empty row to the last file; the caller fills it in. NULL, and one logged line, without
// memory.
struct rg_expectation *rg_known_new(struct rg_known *expected, enum rg_known_kind kind,
                                    int64_t line);

// Read the last file's lines into rows. False, and one logged line, if a line is refused.
bool rg_known_read_own(struct rg_known *expected);
bool rg_known_read_mesa(struct rg_known *expected, enum rg_known_form form);

// Whether a row has begun by this day and matches the cell, device and driver; a NULL driver
// matches any.
bool rg_known_holds(const struct rg_known *expected, const struct rg_expectation *row,
                    const char *cell, const char *device, const char *driver, int today);

extern const char *const rg_known_kinds[];  // "skip", "flake", "fail"
extern const char *const rg_known_fields[]; // "device", ...

// For how many days a newly written expectation holds.
enum { RG_KNOWN_LEASE_DAYS = 90 };

// Write an expectation, each line with `end`. A character that a line cannot hold becomes a ?,
// which still matches it.
void rg_known_write_head(FILE *out, enum rg_known_kind kind, const char *cell, const char *end);
void rg_known_write_field(FILE *out, int field, const char *value, const char *end);
void rg_known_write_new(FILE *out, const struct rg_known_result *result, int today,
                        const char *end);
void rg_known_write_outcomes(unsigned outcomes, char *text, size_t size);
// Writes Mesa's line; nothing if that form cannot hold the name.
void rg_known_write_mesa(FILE *out, const char *cell, unsigned outcomes, const char *end);

#endif
