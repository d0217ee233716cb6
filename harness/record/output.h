// Writing results: a file is there whole or not at all.
#ifndef RG_HARNESS_RECORD_OUTPUT_H
#define RG_HARNESS_RECORD_OUTPUT_H

#include <stdbool.h>

struct rg_output_file {
    const char *name, *text;
};
enum { RG_MAX_OUTPUT_FILES = 8 };

// Writes files that belong together: all are there, or what was there before. They are written
// beside their names first, which takes what can fail, and then renamed. The folder is made as
// below.
bool rg_output_write_set(const char *folder, const struct rg_output_file *files, int count);

// Writes `text` to FOLDER/NAME by a temporary file that is renamed. The folder is made if only its
// last part is missing. False, with one logged line and nothing left behind, on failure.
bool rg_output_write(const char *folder, const char *name, const char *text);

// Makes a folder for what is written next, if only its last part is missing. False, with one logged
// line, where that fails.
bool rg_output_folder(const char *folder);

#endif
