// JSON documents on disk.
//
// Functions that fail give the reason in one line, which names the file, the place and `mend`. This
// is the remedy, such as "name a file as `raingauge table -o` writes it".
#ifndef RG_HARNESS_RECORD_DISK_DOCUMENT_H
#define RG_HARNESS_RECORD_DISK_DOCUMENT_H

#include "harness/record/schema/schema.h"

// The contents of a file, followed by a zero, which the caller frees. NULL if it cannot be read.
char *rg_document_load(const char *path, size_t *size, const char *mend, char why[RG_WHY_SIZE]);

// Parses the document at offset `at`, and advances `at` past it and the blanks after it; the caller
// releases it. NULL if there is none.
json_t *rg_document_next(const char *path, const char *text, size_t size, size_t *at,
                         const char *mend, char why[RG_WHY_SIZE]);

// Parses the first document of a file, and tells whether nothing follows it; the caller releases
// it. NULL if there is none.
json_t *rg_document_first(const char *path, bool *is_alone, const char *mend,
                          char why[RG_WHY_SIZE]);

// Removes the checksum from a document. False if it does not match the rest, or if `is_sealed` and
// it is missing: stored results have a checksum, printed ones do not.
bool rg_document_unseal(const char *path, json_t *document, bool is_sealed, char why[RG_WHY_SIZE]);

// The only, sealed document of a file; the caller releases it. NULL if there is none, or if
// anything follows it.
json_t *rg_document_read(const char *path, const char *mend, char why[RG_WHY_SIZE]);

#endif
