// The checksum that a journal carries: a row that was changed or copied over another by accident is
// noticed, whatever it says.
#ifndef RG_HARNESS_RECORD_DISK_SEAL_H
#define RG_HARNESS_RECORD_DISK_SEAL_H

#include <jansson.h>
#include <stdbool.h>

// Sets the document's checksum, of all that it holds besides.
bool rg_seal(json_t *document);

enum rg_sealed { RG_SEAL_ABSENT, RG_SEAL_BROKEN, RG_SEAL_WHOLE };
// Takes the checksum out of the document and says whether it is that of the rest.
enum rg_sealed rg_unseal(json_t *document);

#endif
