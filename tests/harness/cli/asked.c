#include "tests/harness/cli/asked.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/base/log.h"
#include "core/base/memory.h"
#include "harness/commands/commands.h"
#include "harness/devices/devices.h"
#include "tests/tools/process/folder.h"
#include "tests/tools/process/printed.h"

char asked_seen[4096], asked_logged[1024];
const char *asked_printed;
int asked_opening, asked_left_out, asked_closing;
struct rg_device asked_devices[2] = {
    {.info = {.name = "first", .device = "one", .driver = "1.0"}},
    {.info = {.name = "second", .device = "two", .driver = "2.0"}},
};

void asked_note(const char *format, ...)
{
    const size_t used = strlen(asked_seen);
    va_list args;
    va_start(args, format);
    vsnprintf(asked_seen + used, sizeof(asked_seen) - used, format, args);
    va_end(args);
}

const char *asked_text(const char *text)
{
    return text && *text ? text : "-";
}

void asked_note_subject(const struct rg_subject *subject)
{
    char seed[RG_PATH_SIZE] = "";
    const struct rg_param_table *params = subject->technique->params;
    for (int i = 0; i < params->count; i++)
        if (!strcmp(params->rows[i].name, "seed"))
            rg_params_text(&params->rows[i], subject->settings, seed, sizeof(seed));
    asked_note("%s seed %s, %dx%d", subject->technique->name, seed, subject->width,
               subject->height);
}

// --- stand-ins ---

void rg_memory_allow(int64_t bytes)
{
    asked_note("memory %lld; ", (long long)bytes);
}

int rg_devices_open_asked(const struct rg_devices_asked *asked, struct rg_devices *devices)
{
    asked_note("open %s, require %s, %d s; ", asked->names, asked_text(asked->require),
               asked->timeout_s);
    *devices = (struct rg_devices){.count = 2, .devices = {&asked_devices[0], &asked_devices[1]}};
    return asked_opening;
}

int rg_devices_exit(const struct rg_devices *devices)
{
    (void)devices;
    return asked_left_out;
}

int rg_devices_end(struct rg_devices *devices, int exit)
{
    asked_note("close %d", devices->count);
    return rg_exit_worse(exit, asked_closing);
}

// --- running a command ---

static void hear(enum rg_log_level level, const char *line, void *user)
{
    (void)level;
    (void)user;
    snprintf(asked_logged, sizeof(asked_logged), "%s", line);
}

int asked_run(const char *line)
{
    char copy[1024], *rest = copy;
    const char *argv[64];
    int argc = 0;
    snprintf(copy, sizeof(copy), "%s", line);
    for (char *word; (word = strtok_r(rest, " ", &rest));)
        argv[argc++] = word;
    *asked_seen = *asked_logged = 0;
    rg_log_listen(hear, NULL);
    printed_begin();
    const int exit = rg_command_run(rg_command_find(argv[0]), argc, argv);
    asked_printed = printed_end();
    rg_log_listen(NULL, NULL);
    return exit;
}

void asked_expect(const char *line, const char *seen, int exit)
{
    const int found = asked_run(line);
    if (strcmp(asked_seen, seen) != 0)
        fail_msg("%s:\n'%s'\n instead of\n'%s'\n %s", line, asked_seen, seen, asked_logged);
    if (found != exit)
        fail_msg("%s: status %d instead of %d, %s", line, found, exit, asked_logged);
}

int asked_setup(void **state)
{
    asked_opening = asked_left_out = asked_closing = RG_EXIT_PASS;
    return make_folder(state) || chdir(folder);
}

int asked_teardown(void **state)
{
    return chdir("/") || remove_whole_folder(state);
}
