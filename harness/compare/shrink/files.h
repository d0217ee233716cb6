// Files of a user's own that settings name: read, and sent along with a case.
#ifndef RG_HARNESS_COMPARE_SHRINK_FILES_H
#define RG_HARNESS_COMPARE_SHRINK_FILES_H

#include "harness/devices/frames/subject.h"

// ".json": its ending, or "" where that has other characters than letters and digits.
void rg_file_ending(const char *path, char *ending, size_t size);
// Its bytes, with a zero behind them, which the caller frees. NULL, and one logged line, on
// failure.
char *rg_file_load(const char *path, size_t *size);

// Whether a case that is written there, its folder of files and its kernel's replace none of them.
// False, and one logged line.
bool rg_files_spared_by_case(const struct rg_subject *subject, const char *path);

enum { RG_FILE_NAME = 96 };
// What the file of a parameter is called beside a case: "lights_file.json".
void rg_file_sent_name(const struct rg_param *param, const char *path, char name[RG_FILE_NAME]);

// Copies the user's own files that settings name into a folder, the case with .files behind its
// name. False, and one logged line, on failure.
bool rg_files_send(const struct rg_subject *subject, const char *path);
// Sets a parameter to the file of this name there. False, and one logged line, where it is none.
bool rg_file_receive(const struct rg_technique *technique, void *settings, const char *assignment,
                     const char *path);

#endif
