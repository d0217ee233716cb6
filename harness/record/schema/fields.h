// Reads a document's fields. Each must have the type and the bounds of the schema; otherwise one
// line names the file, the place and the mend.
#ifndef RG_HARNESS_RECORD_SCHEMA_FIELDS_H
#define RG_HARNESS_RECORD_SCHEMA_FIELDS_H

#include <jansson.h>
#include <stdbool.h>
#include <stdint.h>

#include "harness/record/record.h"

struct rg_reader {
    const char *file, *mend; // "name a file as `raingauge table -o` writes it"
    // The object that is read: "cells[3].measured"; "": the document.
    char place[96];
    char *why; // receives the line
    size_t why_size;
};

// Sets the place; "" for the document.
void rg_reader_enter(struct rg_reader *reader, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
// Writes what is wrong with `field` ("": the place itself): "is no number above 0". False.
bool rg_reader_refuse(struct rg_reader *reader, const char *field, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

// A field of an object, of this type. NULL, and the reader refuses, if it is missing or of another
// type.
json_t *rg_field(struct rg_reader *reader, const json_t *object, const char *name, json_type type);

// An array of 1 to `most` elements. NULL, with *count 0, if it is none.
json_t *rg_field_array(struct rg_reader *reader, const json_t *object, const char *name, int most,
                       int *count);

bool rg_field_text(struct rg_reader *reader, const json_t *object, const char *name, char *text,
                   size_t size);
// The same, but null means "".
bool rg_field_text_or_null(struct rg_reader *reader, const json_t *object, const char *name,
                           char *text, size_t size);
bool rg_field_bool(struct rg_reader *reader, const json_t *object, const char *name, bool *value);
bool rg_field_int(struct rg_reader *reader, const json_t *object, const char *name, int least,
                  int most, int *value);
// A number that is not negative.
bool rg_field_number(struct rg_reader *reader, const json_t *object, const char *name,
                     double *value);

// A whole number that is not negative; -1 for null.
bool rg_field_count(struct rg_reader *reader, const json_t *object, const char *name,
                    int64_t *value);

// The counts of a tally.
bool rg_field_tally(struct rg_reader *reader, const json_t *object, const char *name,
                    struct rg_tally *tally);

// An object whose fields are named values, or counts; at most `most` of them.
bool rg_field_named(struct rg_reader *reader, const json_t *object, const char *name,
                    struct rg_named *named, int most, int *count);
bool rg_field_counts(struct rg_reader *reader, const json_t *object, const char *name,
                     struct rg_count *counts, int most, int *count);

#endif
