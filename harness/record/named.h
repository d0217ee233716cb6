// Named values in a record: facts of an instance, and keys that identify a row. Plain data without
// pointers, so that records can be copied.
#ifndef RG_HARNESS_RECORD_NAMED_H
#define RG_HARNESS_RECORD_NAMED_H

#include <jansson.h>

#include "core/base/outcome.h"
#include "core/techniques/technique.h"

enum { RG_NAME_SIZE = 48, RG_FACTS_TEXT = 2048 };

// The digits of a fractional number, in every machine format.
enum { RG_NUMBER_DIGITS = 9 };

struct rg_named {
    char name[RG_NAME_SIZE];
    char text[RG_FACT_SIZE]; // UTF-8; "": the value is the number
    double number;
};

struct rg_count {
    char name[RG_NAME_SIZE];
    int64_t value;
};

// Copies text so that JSON and terminals accept it: whole UTF-8 characters, as many as fit,
// question marks for all bytes beyond ASCII if these are no UTF-8, control characters replaced
// (core/base/text/plain.h).
void rg_text_copy(char *to, size_t size, const char *from);
// A number as it is after writing and reading a document: rounded to RG_NUMBER_DIGITS; NAN if JSON
// has no such number.
double rg_number_kept(double number);

void rg_named_set_text(struct rg_named *named, const char *name, const char *text);
void rg_named_set_number(struct rg_named *named, const char *name, double number);

// Copy `count` facts or counters of an instance.
void rg_facts_copy(struct rg_named *named, const struct rg_fact *facts, int count);
void rg_counters_copy(struct rg_count *counts, const struct rg_counter *counters, int count);

// Prints "model bunny.obj, faces 69666": the values whose names are not in `except`
// (NULL-terminated; NULL: all). "" if there is none.
void rg_named_text(const struct rg_named *named, int count, const char *const *except, char *text,
                   size_t size);

// The number of this name, or NULL.
const double *rg_named_number(const struct rg_named *named, int count, const char *name);

// A JSON object with a field for each value, by its name; the caller owns it.
json_t *rg_named_json(const struct rg_named *named, int count);
json_t *rg_counts_json(const struct rg_count *counts, int count);

// A JSON number, without a point if it is whole; null for infinity and NaN, which JSON lacks.
json_t *rg_number_json(double number);
// Sets "status" to an outcome's word. RG_LACKING and RG_SETUP have the word "error", which older
// readers know, and a "fault" that tells which.
void rg_outcome_set(json_t *json, enum rg_outcome outcome);

// A JSON string of text from outside, of any length: as it is if it is UTF-8, else with question
// marks for all bytes beyond ASCII.
json_t *rg_json_text(const char *text);

// An object's text; "" if it has none of this name. Its number; NAN likewise.
const char *rg_json_text_of(const json_t *object, const char *name);
double rg_json_number_of(const json_t *object, const char *name);

#endif
