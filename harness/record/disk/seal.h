// A journal's checksum, which detects any accidental change or overwriting.
#ifndef RG_HARNESS_RECORD_DISK_SEAL_H
#define RG_HARNESS_RECORD_DISK_SEAL_H

#include <jansson.h>
#include <stdbool.h>

// Sets the document's checksum over the rest of its content.
bool rg_seal(json_t *document);

enum rg_sealed { RG_SEAL_ABSENT, RG_SEAL_BROKEN, RG_SEAL_WHOLE };
// Removes the checksum from the document and tells whether it matches the rest.
enum rg_sealed rg_unseal(json_t *document);

#endif
