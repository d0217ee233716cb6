// Picks the fault whose number is in the environment's RG_MUTANT, or none. It is for a copy of the
// source that has all faults; mutants.py puts this line into each file that it changes. The file of
// RG_MUTANTS_REACHED gets the numbers of those that code comes by (drawn.py).
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
// By names that no file gives a function of its own.
extern int rg_mutant_open(const char *, int, ...) __asm__("__open");
extern int rg_mutant_say(int, const char *, ...) __asm__("dprintf");
extern int rg_mutant_close(int) __asm__("__close");

static inline void rg_mutant_reached(int number)
{
    enum { NUMBERS = 1 << 14, WRITE_AND_APPEND = 02001 };
    static const char *path;
    static char is_told[NUMBERS];
    if (!path && !(path = getenv("RG_MUTANTS_REACHED")))
        path = "";
    if (!*path || number >= NUMBERS || is_told[number])
        return;
    is_told[number] = 1;
    const int file = rg_mutant_open(path, WRITE_AND_APPEND);
    if (file >= 0) {
        rg_mutant_say(file, "%d\n", number);
        rg_mutant_close(file);
    }
}

static inline int rg_mutant(int number)
{
    rg_mutant_reached(number);
    static int picked = -1;
    if (picked < 0) {
        const char *text = getenv("RG_MUTANT");
        picked = text ? atoi(text) : 0;
    }
    return picked == number;
}

#endif
