// Why a picture file cannot be read or written: a sentence without the file's name, which io.c
// adds.
#ifndef RG_CORE_IMAGE_FILES_WHY_H
#define RG_CORE_IMAGE_FILES_WHY_H

#include <stdbool.h>

struct rg_why {
    char text[512];
};

// Sets the sentence and returns false.
bool rg_why_set(struct rg_why *why, const char *format, ...) __attribute__((format(printf, 2, 3)));

#endif
