// JSON documents that lie on disk.
//
// Functions that fail say why in one line, which names the file, the place and the `mend`: what to
// do instead, such as "name a file as `raingauge table -o` writes it".
#ifndef RG_HARNESS_RECORD_DISK_DOCUMENT_H
#define RG_HARNESS_RECORD_DISK_DOCUMENT_H

#include "harness/record/schema/schema.h"

// What a file holds, with a zero behind it, which the caller frees. NULL where it cannot be read.
char *rg_document_load(const char *path, size_t *size, const char *mend, char why[RG_WHY_SIZE]);

// The document that begins at `at`, which goes on behind it and the blanks that follow; the caller
// releases it. NULL where there is none.
json_t *rg_document_next(const char *path, const char *text, size_t size, size_t *at,
                         const char *mend, char why[RG_WHY_SIZE]);

// Takes the checksum out of a document. False where it is not that of the rest, or missing though
// the document `is_sealed`: results that were printed carry none, and what is kept does.
bool rg_document_unseal(const char *path, json_t *document, bool is_sealed, char why[RG_WHY_SIZE]);

// The one sealed document of a file; the caller releases it. NULL where the file holds none, or
// something behind it.
json_t *rg_document_read(const char *path, const char *mend, char why[RG_WHY_SIZE]);

#endif
