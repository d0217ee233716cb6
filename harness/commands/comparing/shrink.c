// raingauge shrink: writes a minimal reproducer with which two devices still differ in the same
// way.
#define _GNU_SOURCE // getdents64
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/base/log.h"
#include "core/base/memory.h"
#include "core/base/program.h"
#include "harness/commands/cli/command.h"
#include "harness/commands/cli/shared.h"
#include "harness/commands/cli/subject.h"
#include "core/base/text/plain.h"
#include "harness/compare/shrink/files.h"
#include "harness/compare/shrink/folder.h"
#include "harness/compare/shrink/shrink.h"
#include "harness/console/clock.h"
#include "harness/console/interrupt.h"
#include "harness/record/output.h"

struct shrink_options {
    struct rg_words sets;
    struct rg_size size;
    int frames, seconds;
    struct rg_devices_asked devices;
    char *output; // a file
    int64_t memory_bytes;
};

#define AT(field) offsetof(struct shrink_options, field)

static const struct rg_option options[] = {
    RG_GROUP("What to shrink"),
    {RG_OPTION_OPERAND, .argument = "TECHNIQUE",
     .about = "the technique whose pictures differ; `raingauge list techniques` prints the names",
     .names = RG_NAMES_TECHNIQUE, .first = 1, .last = 1},
    RG_INCLUDE(rg_settings_option, AT(sets), NULL),
    RG_INCLUDE(rg_frame_option, AT(frames), "5"),
    RG_INCLUDE(rg_size_option, AT(size), RG_DEFAULT_SIZE),
    {RG_OPTION_INT, "seconds", .argument = "S", .about = "stops trying after this many seconds",
     .offset = AT(seconds), .initial = "45", .least = 1, .most = 86400},
    RG_GROUP("Devices"),
    {RG_OPTION_TEXT, "device", .argument = "A,B",
     .about = "the suspected device, then the trusted device", .offset = AT(devices.names),
     .initial = "vulkan,cpu:reference", .names = RG_NAMES_DEVICES},
    RG_INCLUDE(rg_asked_options, AT(devices), NULL),
    RG_INCLUDE(rg_memory_option, AT(memory_bytes), NULL),
    RG_GROUP("Output"),
    {RG_OPTION_TEXT, "output", .argument = "FILE",
     .about = "the reproducer, which `raingauge render --case FILE` replays", .offset = AT(output),
     .letter = 'o', .initial = "case.txt", .names = RG_NAMES_FILE},
    {RG_OPTION_END},
};

enum { KERNEL_SECONDS = 20 }; // time for reducing a kernel's items and inputs

// Finds the kernel that causes the difference, and writes all files, the case last.
static bool write_found(const struct rg_case *found, const struct rg_blame *blame,
                        const struct rg_devices *devices, const char *path)
{
    struct rg_device *device = devices->devices[0], *truth = devices->devices[1];
    struct rg_culprit culprit;
    char plain[RG_PATH_SIZE];
    const double end_ms = rg_now_ms() + 1000.0 * KERNEL_SECONDS;
    bool ok = rg_culprit_find(&found->run, blame, &found->fall, device, truth, end_ms, &culprit) &&
              rg_case_write(found, blame->text, path);
    if (ok && culprit.found)
        ok = rg_kernel_folder_write(path, &culprit, blame->text, device, truth);
    else if (ok)
        rg_kernel_folder_remove(path);
    snprintf(plain, sizeof(plain), "%s", path);
    rg_plain(plain);
    if (ok)
        printf("the case is in %s\n", plain);
    if (ok && culprit.found)
        printf("%s alone, %lld of its %lld items, is in %s.kernel: %s\n", culprit.due.kernel->name,
               (long long)culprit.items, (long long)culprit.of_items, plain,
               rg_kernel_folder_command(&culprit, device));
    else if (ok)
        printf("no kernel alone: %s\n", culprit.why_not);
    rg_culprit_free(&culprit);
    return ok;
}

// The folder for temporary files; "": none.
static char folder[512];

// Removes the folder with its files. It may run in a signal handler, so it uses no readdir.
static void remove_folder(void)
{
    char entries[2048];
    ssize_t bytes;
    const int fd = *folder ? open(folder, O_RDONLY | O_DIRECTORY | O_CLOEXEC) : -1;
    while (fd >= 0 && (bytes = getdents64(fd, entries, sizeof(entries))) > 0)
        for (ssize_t at = 0; at < bytes;) {
            const struct dirent64 *entry = (const void *)(entries + at);
            unlinkat(fd, entry->d_name, 0); // fails for "." and ".."
            at += entry->d_reclen;
        }
    if (fd >= 0)
        close(fd);
    rmdir(folder);
    *folder = 0;
}

static bool make_folder(void)
{
    const char *parent = getenv("TMPDIR");
    snprintf(folder, sizeof(folder), "%s/raingauge-XXXXXX", parent && *parent ? parent : "/tmp");
    if (mkdtemp(folder)) {
        rg_program_before_end(remove_folder);
        return true;
    }
    rg_system_error(errno, "%s: cannot be made: %s; set TMPDIR to a folder that takes files",
                    folder, strerror(errno));
    *folder = 0;
    return false;
}

static int shrink_on(const struct rg_devices *devices, const struct rg_subject *subject,
                     const struct shrink_options *o)
{
    const struct rg_shrink_request request = {.run = {*subject, o->frames < 1 ? 1 : o->frames},
                                              .device = devices->devices[0],
                                              .truth = devices->devices[1],
                                              .seconds = o->seconds,
                                              .folder = folder};
    struct rg_case found;
    struct rg_blame blame;
    int tried;
    rg_interrupt_watch();
    if (!make_folder())
        return rg_exit_of_error();
    int exit = rg_shrink_case(&request, &found, &blame, &tried);
    if (exit == RG_EXIT_PASS && !rg_interrupted()) {
        printf("%s\n%d runs tried\n", blame.text, tried);
        if (!write_found(&found, &blame, devices, o->output))
            exit = rg_exit_of_error(); // a full disk says nothing of the devices
    }
    rg_case_free(&found);
    remove_folder();
    return rg_interrupted() ? RG_EXIT_SIGNALLED + rg_interrupt_signal() : exit;
}

static int shrink(const void *values, const struct rg_words *arguments)
{
    enum { CASE_BYTES = 1 << 12 };
    const struct shrink_options *o = values;
    void *settings;
    rg_memory_allow(o->memory_bytes);
    if (!rg_output_file_can_be_written(o->output, CASE_BYTES))
        return rg_exit_of_error();
    const struct rg_technique *technique = rg_subject_find(arguments, &o->sets, &settings);
    if (!technique)
        return rg_exit_of_error();
    const struct rg_subject subject = {technique, settings, o->size.width, o->size.height};
    struct rg_devices devices = {0};
    int exit = rg_files_spared_by_case(&subject, o->output)
                   ? rg_devices_open_asked(&o->devices, &devices)
                   : rg_exit_of_error();
    if (exit == RG_EXIT_PASS)
        exit = rg_devices_exit(&devices);
    if (exit == RG_EXIT_PASS && devices.count != 2) {
        rg_error("--device %s: shrink takes two devices, the one in doubt first", o->devices.names);
        exit = rg_exit_of_error();
    } else if (exit == RG_EXIT_PASS) {
        exit = shrink_on(&devices, &subject, o);
    }
    exit = rg_devices_end(&devices, exit);
    free(settings);
    return exit;
}

const struct rg_command rg_command_shrink = {
    .name = "shrink",
    .reader = RG_FOR_DRIVERS,
    .usage = "TECHNIQUE --device A,B [--set KEY=VALUE]... [-o FILE]",
    .about = "reduces a difference between two devices to a minimal reproducer",
    .options = options,
    .options_size = sizeof(struct shrink_options),
    .run = shrink,
};
