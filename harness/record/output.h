// Writing results: a file is there whole or not at all.
#ifndef RG_HARNESS_RECORD_OUTPUT_H
#define RG_HARNESS_RECORD_OUTPUT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct rg_output_file {
    const char *name, *text;
    size_t size; // in bytes; 0: the text ends with a zero
};
enum {
    RG_MAX_OUTPUT_FILES = 48,
    RG_OUTPUT_TABLE_BYTES = 1 << 13, // of a table's files, at least
};

// Writes files that belong together: all are there, or what was there before. They are written
// beside their names first, which takes what can fail, and then renamed. The folder is made as
// below.
bool rg_output_write_set(const char *folder, const struct rg_output_file *files, int count);

// Writes `text` to FOLDER/NAME by a temporary file that is renamed. The folder is made if only its
// last part is missing. False, with one logged line and nothing left behind, on failure.
bool rg_output_write(const char *folder, const char *name, const char *text);

// The same of a path, whose folder has to be there, or its last part be missing.
bool rg_output_write_file(const char *path, const char *text);

// Whether files of so many bytes can be written into a folder, as is found out before any work; one
// that is not there can be made as below, and is not yet. False, and one logged line.
bool rg_output_can_be_written(const char *folder, int64_t bytes);

// The same of a file of so many bytes, whose folder has to be there.
bool rg_output_file_can_be_written(const char *path, int64_t bytes);

// Whether what has this name in a folder can be replaced, such as no read-only file; nothing can.
bool rg_output_can_be_replaced(const char *folder, const char *name);

// Makes a folder for what is written next, if only its last part is missing. False, with one logged
// line, where that fails.
bool rg_output_folder(const char *folder);

#endif
