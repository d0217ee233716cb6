// The user's own files that settings name: reads them, and copies them for a case.
#ifndef RG_HARNESS_COMPARE_SHRINK_FILES_H
#define RG_HARNESS_COMPARE_SHRINK_FILES_H

#include "harness/devices/frames/subject.h"

// The file name's ending, such as ".json"; "" if it has other characters than letters and digits.
void rg_file_ending(const char *path, char *ending, size_t size);
// Reads a file, with a zero byte after it; the caller frees it. NULL, and one logged line, on
// failure.
char *rg_file_load(const char *path, size_t *size);

// Whether a case at this path, with its folder of files and its kernel's folder, would overwrite
// none of the files. False, and one logged line, if it would.
bool rg_files_spared_by_case(const struct rg_subject *subject, const char *path);

enum { RG_FILE_NAME = 96 };
// The name of a parameter's file in a case's folder: "lights_file.json".
void rg_file_sent_name(const struct rg_param *param, const char *path, char name[RG_FILE_NAME]);

// Copies the user's own files that settings name into the folder CASE.files. False, and one logged
// line, on failure.
bool rg_files_send(const struct rg_subject *subject, const char *path);
// Sets a parameter to the file of this name in that folder. False, and one logged line, if there is
// none.
bool rg_file_receive(const struct rg_technique *technique, void *settings, const char *assignment,
                     const char *path);

#endif
