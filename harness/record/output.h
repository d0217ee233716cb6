// Writes results atomically: a file is complete or not there.
#ifndef RG_HARNESS_RECORD_OUTPUT_H
#define RG_HARNESS_RECORD_OUTPUT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct rg_output_file {
    const char *name, *text;
    size_t size; // in bytes; 0: the text is terminated by a zero
};
enum {
    RG_MAX_OUTPUT_FILES = 48,
    RG_OUTPUT_TABLE_BYTES = 1 << 13, // least bytes of a table's files
};

// Writes files that belong together: either all are replaced or none. They are first written under
// other names, which is where failures occur, and then renamed. The folder is made as below.
bool rg_output_write_set(const char *folder, const struct rg_output_file *files, int count);

// Writes `text` to FOLDER/NAME by a temporary file that is renamed. The last part of the folder's
// path is made if missing. False, with one logged line and nothing left behind, on failure.
bool rg_output_write(const char *folder, const char *name, const char *text);

// The same for a path.
bool rg_output_write_file(const char *path, const char *text);

// Whether files of this many bytes can be written into a folder, to be asked before any work. A
// missing last part counts as writable, and is not made yet. False, and one logged line.
bool rg_output_can_be_written(const char *folder, int64_t bytes);

// The same for a file of this many bytes, whose folder must exist.
bool rg_output_file_can_be_written(const char *path, int64_t bytes);

// Whether a file of this name in a folder can be replaced (false if read-only), or does not exist.
bool rg_output_can_be_replaced(const char *folder, const char *name);

// A name as a part of a file's: what may steer a shell or name a folder becomes '_', and what would
// make two names one, or one too long, is told apart by a hash of the whole.
enum { RG_OUTPUT_PART = 120 };
void rg_output_part(const char *name, char part[RG_OUTPUT_PART]);

// Makes the last part of a folder's path if it is missing. False, with one logged line, on failure.
bool rg_output_folder(const char *folder);

#endif
