// Writing results: a file is there whole or not at all.
#ifndef RG_HARNESS_RECORD_OUTPUT_H
#define RG_HARNESS_RECORD_OUTPUT_H

#include <stdbool.h>

// Writes `text` to FOLDER/NAME by a temporary file that is renamed. The folder is made if only its
// last part is missing. False, with one logged line and nothing left behind, on failure.
bool rg_output_write(const char *folder, const char *name, const char *text);

// Makes a folder for what is written next, if only its last part is missing. False, with one logged
// line, where that fails.
bool rg_output_folder(const char *folder);

#endif
