// Starting another program, which shares nothing with this one but what it is given.
#ifndef RG_CORE_BASE_PROGRAM_H
#define RG_CORE_BASE_PROGRAM_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <sys/types.h>

// Starts args[0], which is looked for along PATH where it has no slash in it. `args` ends in NULL.
// fds[i] becomes its descriptor i, /dev/null where that is -1, and it gets no other; `fds` stay the
// caller's. No signal is ignored or blocked in it, and Ctrl-C does not reach it: the caller ends
// it, and waits for it. 0, or the errno.
int rg_program_start(const char *const args[], const int fds[], int fd_count, pid_t *child);

// The same with variables of its own, which end in NULL.
int rg_program_start_in(char *const environment[], const char *const args[], const int fds[],
                        int fd_count, pid_t *child);

// Whether it has ended, and how (waitpid(2)): at once. Also where it cannot be waited for: its
// number may be another process's by now, and `status` stays as it is.
bool rg_program_has_ended(pid_t child, int *status);

// What a program that failed said last: ": " and the last line with a letter in it, "" where it
// printed none.
void rg_program_last_line(FILE *printed, char *last, size_t size);

#endif
