// Files of a user's own that settings name: read, and sent along with a case.
#ifndef RG_HARNESS_COMPARE_SHRINK_FILES_H
#define RG_HARNESS_COMPARE_SHRINK_FILES_H

#include "harness/frames/subject.h"

// Whether a value of a parameter names a file of the user's own, and not a model or a map.
bool rg_file_is_own(const char *value);
// ".json": its ending, or "" where that has other characters than letters and digits.
void rg_file_ending(const char *path, char *ending, size_t size);
// Its bytes, with a zero behind them, which the caller frees. NULL, and one logged line, on
// failure.
char *rg_file_load(const char *path, size_t *size);

// The next parameter that names such a file, from the place `at` in the technique's table on, which
// is moved behind it; `value` gets the file. NULL: there is none.
const struct rg_param *rg_file_own_next(const struct rg_subject *subject, int *at,
                                        char value[RG_PATH_SIZE]);
// Whether what is written there replaces none of them. False, and one logged line.
bool rg_files_spared_by(const struct rg_subject *subject, const char *output);
// The same of a case, of its folder of files and of its kernel's.
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
