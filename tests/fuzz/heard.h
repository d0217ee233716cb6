// The common part of all fuzz targets: the lines that raingauge logs about a file, and the file.
#ifndef RG_TESTS_FUZZ_HEARD_H
#define RG_TESTS_FUZZ_HEARD_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

// Prints the fault of the lines since fuzz_listen, and aborts.
_Noreturn void fuzz_complain(const char *fault);

// Counts lines from now on.
void fuzz_listen(void);
// Aborts unless the input was taken with no error and at most so many warnings, or refused with one
// error alone. Also aborts if a line controls a terminal.
void fuzz_judge_lines(bool taken, int most_warnings);

// Writes a file of this name into a folder that is removed at the end. Returns its path, which is
// valid until the next call.
const char *fuzz_write(const char *name, const uint8_t *data, size_t size);

#endif
