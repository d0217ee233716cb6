// Why a picture file cannot be read or written: a sentence without the file's name, which io.c
// adds.
#ifndef RG_CORE_IMAGE_FILES_WHY_H
#define RG_CORE_IMAGE_FILES_WHY_H

#include <stdbool.h>

#include "core/base/log.h"
#include "core/image/picture.h"

struct rg_why {
    char text[512];
    enum rg_fault fault; // the input's, raingauge's own, or nobody's: the machine allows no reader
};

// Sets the sentence and returns false.
bool rg_why_set(struct rg_why *why, const char *format, ...) __attribute__((format(printf, 2, 3)));
// The same for a system call that set errno to `error`, like rg_system_error.
bool rg_why_system(struct rg_why *why, int error, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
// The same for a file that could not be written whole; errno selects the mend.
bool rg_why_unwritten(struct rg_why *why, const char *reason);
// rg_picture_allocate, with its sentence in `why`.
bool rg_why_allocate(struct rg_picture *picture, int64_t width, int64_t height, int64_t channels,
                     struct rg_why *why);
// Logs the sentence after the file's name, as an error of its `fault`, and returns false.
bool rg_why_tell(const struct rg_why *why, const char *path);

#endif
