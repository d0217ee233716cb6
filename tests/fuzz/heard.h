// What all fuzz targets share: the lines that raingauge says of a file, and the file.
#ifndef RG_TESTS_FUZZ_HEARD_H
#define RG_TESTS_FUZZ_HEARD_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

// Prints what is wrong with the lines since fuzz_listen, and aborts.
_Noreturn void fuzz_complain(const char *fault);

// Counts lines from now on.
void fuzz_listen(void);
// Aborts unless what was read was taken with at most so many warnings and no error, or refused with
// one error and no more; and where a line steers a terminal.
void fuzz_judge_lines(bool taken, int most_warnings);

// Writes a file of this name into a folder that is removed at the end. Its path, which is valid
// until the next call.
const char *fuzz_write(const char *name, const uint8_t *data, size_t size);

#endif
