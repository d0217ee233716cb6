// Random numbers for the tests of decisions: the same in each run, from a state that a test sets.
#ifndef RG_TESTS_HARNESS_GATE_DECIDE_CHANCE_H
#define RG_TESTS_HARNESS_GATE_DECIDE_CHANCE_H

#include <stdint.h>

extern uint64_t state_of_chance;

// A uniform number above 0 and below 1 (splitmix64).
double uniform(void);
// A normal number, of a standard deviation of 1 (Box and Muller).
double normal(void);

#endif
