// Picks the fault whose number is in the environment's RG_MUTANT, or none. It is for a copy of the
// source that has all faults; mutants.py puts this line into each file that it changes.
#ifndef RG_TESTS_MUTANTS_SWITCH_H
#define RG_TESTS_MUTANTS_SWITCH_H

// A fault may leave something unused, or make a senseless comparison.
#pragma GCC diagnostic ignored "-Wextra"
#pragma GCC diagnostic ignored "-Wunused-but-set-variable"
#pragma GCC diagnostic ignored "-Wunused-variable"
#pragma GCC diagnostic ignored "-Wsign-compare"
#pragma GCC diagnostic ignored "-Wint-in-bool-context"
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#pragma GCC diagnostic ignored "-Wdiv-by-zero"
#pragma GCC diagnostic ignored "-Wformat-truncation"
#pragma GCC diagnostic ignored "-Wstringop-overflow"

// Declared here, since a file may define macros for system headers after this line.
extern char *getenv(const char *);
extern int atoi(const char *);

static inline int rg_mutant(int number)
{
    static int picked = -1;
    if (picked < 0) {
        const char *text = getenv("RG_MUTANT");
        picked = text ? atoi(text) : 0;
    }
    return picked == number;
}

#endif
