// Work in a child process, so that a driver that crashes, hangs or prints harms nothing else.
//
// The child is a fork: fork before this process has used a driver or OpenMP, never after.
#ifndef RG_HARNESS_DEVICES_CHILD_H
#define RG_HARNESS_DEVICES_CHILD_H

#include <stddef.h>

#include "core/base/outcome.h"

// Memory that a child's writes reach us through, zeroed; NULL and one logged line when there is
// none.
void *rg_child_answer_create(size_t size);
void rg_child_answer_destroy(void *answer, size_t size);

// Runs work(answer) in a child for up to `timeout_s` seconds. Nothing of what it prints is shown.
// When it did not end well, it crashed, timed out or, as an error, could not be started; `why` says
// how, in one line, with the last line that it printed.
enum rg_outcome rg_child_run(void (*work)(void *answer), void *answer, int timeout_s, char *why,
                             size_t why_size);

#endif
