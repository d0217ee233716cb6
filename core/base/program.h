// Starting another program, which shares nothing with this one but what it is given; and how a
// signal ends this one, with all that it has started.
#ifndef RG_CORE_BASE_PROGRAM_H
#define RG_CORE_BASE_PROGRAM_H

#include <limits.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <stdnoreturn.h>
#include <sys/types.h>

// Starts args[0], which is looked for along PATH where it has no slash in it. `args` ends in NULL.
// fds[i] becomes its descriptor i, /dev/null where that is -1, and it gets no other; `fds` stay the
// caller's. No signal is ignored or blocked in it, and Ctrl-C does not reach it: the caller ends
// it, and waits for it. 0, or the errno.
int rg_program_start(const char *const args[], const int fds[], int fd_count, pid_t *child);

// The same with variables of its own, which end in NULL.
int rg_program_start_in(char *const environment[], const char *const args[], const int fds[],
                        int fd_count, pid_t *child);

// What mends an errno with which none could be started: a clause, without a point.
const char *rg_program_mend(int error);

// Whether it has ended, and how (waitpid(2)): at once. Also where it cannot be waited for: its
// number may be another process's by now, and `status` stays as it is.
bool rg_program_has_ended(pid_t child, int *status);
// Waits for its end, however long that takes.
void rg_program_wait(pid_t child, int *status);

// What a program that failed said last: ": " and the last line with a letter in it, "" where it
// printed none.
void rg_program_last_line(FILE *printed, char *last, size_t size);

// --- this program ---

// A path that this program can be started again by, for as long as it runs: /proc/self/exe, or its
// own path where there is no /proc.
const char *rg_program_self(void);
// The folder in which it lies, without a slash behind it; "" where that cannot be found.
void rg_program_folder(char place[PATH_MAX]);

// --- its own end ---

// Has rg_program_end_by call `act` first, which does only what a signal's handler may
// (signal-safety(7)). One that was given before counts once; there is room for eight.
void rg_program_before_end(void (*act)(void));

// Ends this process as the signal does by default, also where that is ignored, as it is of a
// container's first process: the status is then 128 and the number. What rg_program_start started
// and has not ended is killed, with its process group. A signal's handler may call it.
noreturn void rg_program_end_by(int number);

#endif
