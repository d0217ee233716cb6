// What was logged. log_last or log_all is given to rg_log_listen.
#ifndef RG_TESTS_TOOLS_PROCESS_LOGGED_H
#define RG_TESTS_TOOLS_PROCESS_LOGGED_H

#include <stdio.h>
#include <string.h>

#include "core/base/log.h"

static char logged[8192];
static int logged_lines;

static inline void log_forget(void)
{
    *logged = 0;
    logged_lines = 0;
}

// Keeps the last line.
static inline void log_last(enum rg_log_level level, const char *line, void *user)
{
    (void)level;
    (void)user;
    logged_lines++;
    snprintf(logged, sizeof(logged), "%s", line);
}

// Keeps all lines, each with its end.
static inline void log_all(enum rg_log_level level, const char *line, void *user)
{
    const size_t used = strlen(logged);
    (void)level;
    (void)user;
    logged_lines++;
    snprintf(logged + used, sizeof(logged) - used, "%s\n", line);
}

#endif
