// A folder for tests that read and write pictures, and the lines that they log.
#ifndef RG_TESTS_CORE_IMAGE_FILES_SCRATCH_H
#define RG_TESTS_CORE_IMAGE_FILES_SCRATCH_H

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/base/log.h"
#include "core/image/picture.h"
#include "tests/core/image/rain_picture.h"
#include "tests/tools/process/folder.h"

enum { WIDTH = 37, HEIGHT = 23 };

static char errors[4096];
static int error_count, warning_count;

static inline void listen(enum rg_log_level level, const char *line, void *user)
{
    (void)user;
    error_count += level == RG_LOG_ERROR;
    warning_count += level == RG_LOG_WARNING;
    snprintf(errors, sizeof(errors), "%s", line);
}

static inline int files_in_folder(void)
{
    int count = 0;
    DIR *dir = opendir(folder);
    for (struct dirent *entry; (entry = readdir(dir));)
        count += strcmp(entry->d_name, ".") && strcmp(entry->d_name, "..");
    closedir(dir);
    return count;
}

static inline struct rg_picture noise_picture(int channels)
{
    struct rg_picture picture;
    assert_true(rg_picture_create(&picture, WIDTH, HEIGHT, channels, "noise"));
    for (int64_t i = 0; i < rg_picture_values(&picture); i++)
        picture.texels[i] = (float)(rain_noise((uint32_t)i + 3) >> 8) * 0x1p-24f;
    return picture;
}

static inline void write_bytes(const char *name, const void *bytes, size_t size)
{
    FILE *file = fopen(in_folder(name), "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    fclose(file);
}

static inline int make_scratch(void **state)
{
    rg_log_listen(listen, NULL);
    return make_folder(state);
}

static inline int remove_scratch(void **state)
{
    rg_log_listen(NULL, NULL);
    return remove_folder(state); // every test removed what it made
}

#endif
