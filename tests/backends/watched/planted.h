// Work that is wrong in one way: what ThreadSanitizer must find, or valgrind, so that its silence
// elsewhere means something; and the same work as it should be, of which it must be silent.
#ifndef RG_TESTS_BACKENDS_WATCHED_PLANTED_H
#define RG_TESTS_BACKENDS_WATCHED_PLANTED_H

#include <stdbool.h>

struct planted {
    const char *name;
    void (*run)(bool is_right);
};

extern const struct planted planted_races[]; // the last has no name
extern const struct planted planted_values;  // that nobody has set

#endif
