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

// Writes files that belong together: either all are replaced or none. First writes them under other
// names, when failures occur, and then renames them. The folder is made as below.
bool rg_output_write_set(const char *folder, const struct rg_output_file *files, int count);

// Writes `text` to FOLDER/NAME by a temporary file that is renamed. The last part of the folder's
// path is made if missing. False, with one logged line and no partial file, on failure.
bool rg_output_write(const char *folder, const char *name, const char *text);

// The same for a path.
bool rg_output_write_file(const char *path, const char *text);

// Checks before any work that files of this many bytes can be written into a folder. A missing last
// part counts as writable, and is not made yet. False, and one logged line, if not.
bool rg_output_can_be_written(const char *folder, int64_t bytes);

// The same for a file of this many bytes, whose folder must exist.
bool rg_output_file_can_be_written(const char *path, int64_t bytes);

// Whether a file of this name in a folder can be replaced (false if read-only), or does not exist.
bool rg_output_can_be_replaced(const char *folder, const char *name);

// Makes a name part of a file's name. Characters that could steer a shell or name a folder become
// '_'. If that could make two names equal, or if the name is too long, a hash of the whole name is
// added.
enum { RG_OUTPUT_PART = 120 };
void rg_output_part(const char *name, char part[RG_OUTPUT_PART]);

// Makes the last part of a folder's path if it is missing. False, with one logged line, on failure.
bool rg_output_folder(const char *folder);

#endif
