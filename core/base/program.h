// Starting other programs, which inherit only what they are given, and ending this process and
// everything it started on a signal.
#ifndef RG_CORE_BASE_PROGRAM_H
#define RG_CORE_BASE_PROGRAM_H

#include <limits.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <stdnoreturn.h>
#include <sys/types.h>

// Starts args[0], found along PATH unless it contains a slash. `args` ends in NULL. fds[i] becomes
// the child's descriptor i, /dev/null where it is -1, and the child gets no other; `fds` stay the
// caller's. The child ignores and blocks no signal, and Ctrl-C does not reach it: the caller ends
// it and waits for it. Returns 0 or the errno.
int rg_program_start(const char *const args[], const int fds[], int fd_count, pid_t *child);

// The same with an environment of its own, which ends in NULL.
int rg_program_start_in(char *const environment[], const char *const args[], const int fds[],
                        int fd_count, pid_t *child);

// A clause, without a full stop, that says how to mend an errno of rg_program_start.
const char *rg_program_mend(int error);

// Whether a program has ended, and how (waitpid(2)), without waiting. Also true where it cannot be
// waited for, since its number may be another process's by now; `status` then stays as it is.
bool rg_program_has_ended(pid_t child, int *status);
// Waits until a program ends, however long that takes.
void rg_program_wait(pid_t child, int *status);

// The last words of a program that failed: ": " and the last printed line with a letter in it, ""
// where it printed none.
void rg_program_last_line(FILE *printed, char *last, size_t size);

// --- this program ---

// A path by which this program can be started again while it runs: /proc/self/exe, or its own path
// where there is no /proc.
const char *rg_program_self(void);
// The folder of this program, without a slash at its end; "" where that cannot be found.
void rg_program_folder(char place[PATH_MAX]);
// The path of a file that belongs to this program, another one or a module: beside it, installed,
// or in the build. False where there is none that can be read; `path` is then this program's
// folder.
bool rg_program_part(const char *name, char *path, size_t size);

// --- its own end ---

// Registers `act`, which rg_program_end_by calls first; it may do only what a signal handler may
// (signal-safety(7)). Registering twice counts once; there is room for eight.
void rg_program_before_end(void (*act)(void));

// Ends this process by the signal's default action, even where the signal is ignored, as for a
// container's first process: the status is then 128 and the number. Kills the process groups of
// programs started here that still run. A signal handler may call it.
noreturn void rg_program_end_by(int number);

#endif
