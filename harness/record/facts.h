// What an instance tells of itself, its facts and its counters, in words and as JSON.
#ifndef RG_HARNESS_RECORD_FACTS_H
#define RG_HARNESS_RECORD_FACTS_H

#include <jansson.h>

#include "core/techniques/technique.h"

enum { RG_FACTS_TEXT = 2048 };

// "model bunny.obj, faces 69666": the facts whose names are not among `except` (NULL-terminated;
// NULL: no exception). "" where there is none.
void rg_facts_text(const struct rg_fact *facts, int count, const char *const *except, char *text,
                   size_t size);

// The number that is told under this name, or NULL.
const double *rg_facts_number(const struct rg_fact *facts, int count, const char *name);

// Objects with a field a fact or counter; the caller owns them.
json_t *rg_facts_json(const struct rg_fact *facts, int count);
json_t *rg_counters_json(const struct rg_counter *counters, int count);

// A whole number as one, any other as it is; null for what JSON cannot say.
json_t *rg_number_json(double number);

#endif
