// Why a picture file cannot be read or written: a sentence without the file's name, which io.c
// adds.
#ifndef RG_CORE_IMAGE_FILES_WHY_H
#define RG_CORE_IMAGE_FILES_WHY_H

#include <stdbool.h>

struct rg_why {
    char text[512];
    bool is_machine; // the machine's fault, and neither the file's nor the user's
};

// Sets the sentence and returns false.
bool rg_why_set(struct rg_why *why, const char *format, ...) __attribute__((format(printf, 2, 3)));
// The same of what the machine refuses.
bool rg_why_refused(struct rg_why *why, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
// The same of a file that could not be written whole; errno says what mends that.
bool rg_why_unwritten(struct rg_why *why, const char *reason);
// Logs the sentence behind the file's name, as whose fault it is, and returns false.
bool rg_why_tell(const struct rg_why *why, const char *path);

#endif
