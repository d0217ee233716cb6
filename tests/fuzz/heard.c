#include "tests/fuzz/heard.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/base/log.h"

static int errors, others;
static char last_line[1024];

static char folder[64], path[128];

_Noreturn void fuzz_complain(const char *fault)
{
    fprintf(stderr, "fault: %s; %d errors and %d other lines, the last: %s\n", fault, errors,
            others, last_line);
    abort();
}

static void listen(enum rg_log_level level, const char *line, void *user)
{
    (void)user;
    *(level == RG_LOG_ERROR ? &errors : &others) += 1;
    snprintf(last_line, sizeof(last_line), "%s", line);
    for (const unsigned char *c = (const unsigned char *)line; *c; c++)
        if (*c < ' ' || *c == 127)
            fuzz_complain("a line with a control character");
}

void fuzz_listen(void)
{
    errors = others = 0;
    last_line[0] = 0;
    rg_log_listen(listen, NULL);
}

void fuzz_judge_lines(bool taken, int most_warnings)
{
    if (taken && (errors || others > most_warnings))
        fuzz_complain("taken, with words");
    if (!taken && (errors != 1 || others))
        fuzz_complain("refused, not in one line");
}

static void remove_folder(void)
{
    if (*path)
        unlink(path);
    rmdir(folder);
}

const char *fuzz_write(const char *name, const uint8_t *data, size_t size)
{
    if (!*folder) {
        snprintf(folder, sizeof(folder), "/tmp/raingauge-fuzz-XXXXXX");
        if (!mkdtemp(folder) || atexit(remove_folder))
            abort();
    }
    if (*path)
        unlink(path);
    snprintf(path, sizeof(path), "%s/%s", folder, name);
    FILE *file = fopen(path, "wb");
    if (!file || (size && fwrite(data, 1, size, file) != size) || fclose(file))
        abort();
    return path;
}
