// The machines that records come from, told apart by the comparison keys of their devices.
//
// Two records come from one machine if all that their keys say of the machine is equal, and the key
// of each device that both have. A machine with another driver is therefore another one.
#ifndef RG_HARNESS_RECORD_PASSPORT_ORIGINS_H
#define RG_HARNESS_RECORD_PASSPORT_ORIGINS_H

#include <stdint.h>

#include "harness/record/passport/key.h"

struct rg_origin {
    char key[RG_KEY_SIZE];  // of its only device, or of all together
    char text[RG_KEY_TEXT]; // "Intel Xeon E5, 8 cores"
    // Owned: the parts of a key without a device, and those of each device's key by its name.
    json_t *host, *devices;
};

// Zeroed: none. The owner calls rg_origins_free.
struct rg_origins {
    int64_t count, room;
    struct rg_origin *all; // in the order in which they were found
};

// The index of the origin of a record, by its passport; it is added if it is new. -1, with one
// logged line, when memory runs out.
int rg_origins_find(struct rg_origins *origins, const json_t *passport);
// The same of an origin that is there; -1 if it is not.
int rg_origins_known(const struct rg_origins *origins, const json_t *passport);
void rg_origins_free(struct rg_origins *origins);

// The key of a passport's only device, or of all together, and the words for its machine.
void rg_origin_key(const json_t *passport, char key[RG_KEY_SIZE]);
void rg_origin_text(const json_t *passport, char text[RG_KEY_TEXT]);

// The name of an origin by its index: "A", and so on; "AA" after "Z".
enum { RG_ORIGIN_NAME = 8 };
void rg_origin_name(int origin, char name[RG_ORIGIN_NAME]);

// "cores 8 and not 2; driver Mesa 25 and not Mesa 22": the parts that differ between an origin and
// another one, each once.
void rg_origin_difference(const struct rg_origin *origin, const struct rg_origin *other,
                          char text[RG_KEY_TEXT]);

#endif
