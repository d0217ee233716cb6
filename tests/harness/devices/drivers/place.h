// A temporary folder with files as driver packages have them, and the lines that were logged about
// them.
#ifndef RG_TESTS_HARNESS_DEVICES_DRIVERS_PLACE_H
#define RG_TESTS_HARNESS_DEVICES_DRIVERS_PLACE_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "core/base/files/user.h"
#include "core/base/log.h"

// The folder, without links.
static char place[PATH_MAX];
static char logged[2048];
static int lines;

static inline void keep_line(enum rg_log_level level, const char *line, void *user)
{
    (void)user;
    lines++;
    snprintf(logged, sizeof(logged), "%s%.2000s", level == RG_LOG_WARNING ? "warning: " : "", line);
}

static inline void forget_lines(void)
{
    lines = 0;
    *logged = 0;
}

// A text that stays until 32 more were made.
static inline const char *text_of(const char *format, ...) __attribute__((format(printf, 1, 2)));

static inline const char *text_of(const char *format, ...)
{
    static char all[32][PATH_MAX];
    static int next;
    char *text = all[next++ % 32];
    va_list args;
    va_start(args, format);
    vsnprintf(text, PATH_MAX, format, args);
    va_end(args);
    return text;
}

// The path of a name in the folder.
static inline const char *in_place(const char *name)
{
    return text_of("%s/%s", place, name);
}

// Writes a file, and makes its folders.
static inline const char *put_bytes(const char *name, const void *bytes, size_t size)
{
    const char *path = in_place(name);
    char why[256];
    assert_true(rg_user_make_folders(path, why));
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
    return path;
}

static inline const char *put_text(const char *name, const char *text)
{
    return put_bytes(name, text, strlen(text));
}

// A manifest as loaders of Vulkan and EGL read it, or, if its name ends in ".icd", that of OpenCL.
static inline const char *put_manifest(const char *name, const char *library)
{
    const bool is_icd = !strcmp(name + strlen(name) - 4, ".icd");
    return put_text(name, is_icd ? text_of("%s\n", library)
                                 : text_of("{\"ICD\": {\"library_path\": \"%s\", \"api_version\": "
                                           "\"1.1.0\"}, \"file_format_version\": \"1.0.1\"}",
                                           library));
}

// A copy of the beginning of this program, with another value in one of its bytes.
static inline const char *put_library(const char *name, size_t at, unsigned char value)
{
    unsigned char head[256];
    FILE *file = fopen("/proc/self/exe", "r");
    assert_non_null(file);
    assert_int_equal(fread(head, 1, sizeof(head), file), sizeof(head));
    fclose(file);
    head[at] = value;
    return put_bytes(name, head, sizeof(head));
}

// --- beginning and end of each test ---

static inline int begin_place(void **state)
{
    char made[] = "/tmp/raingauge-drivers-XXXXXX";
    (void)state;
    forget_lines();
    rg_log_listen(keep_line, NULL);
    return !mkdtemp(made) || !realpath(made, place);
}

static inline int end_place(void **state)
{
    (void)state;
    rg_log_listen(NULL, NULL);
    return system(text_of("rm -rf %s", place));
}

#define IN_A_PLACE(test) cmocka_unit_test_setup_teardown(test, begin_place, end_place)

// The failure that was just logged, in one line that holds this text.
#define assert_refused(of_fault, says)                                                             \
    do {                                                                                           \
        assert_int_equal(rg_failure_take().fault, of_fault);                                       \
        assert_int_equal(lines, 1);                                                                \
        if (!strstr(logged, says))                                                                 \
            fail_msg("%s does not say: %s", logged, says);                                         \
        forget_lines();                                                                            \
    } while (0)

#endif
