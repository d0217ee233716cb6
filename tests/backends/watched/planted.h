// Work with one planted fault, which ThreadSanitizer or valgrind must find, so that their silence
// elsewhere means something. The same work without the fault must leave them silent.
#ifndef RG_TESTS_BACKENDS_WATCHED_PLANTED_H
#define RG_TESTS_BACKENDS_WATCHED_PLANTED_H

#include <stdbool.h>

struct planted {
    const char *name;
    void (*run)(bool is_right);
};

extern const struct planted planted_races[]; // the last has no name
extern const struct planted planted_values;  // a value that nobody has set

#endif
