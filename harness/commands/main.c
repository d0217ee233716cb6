// raingauge: measures how correctly and how fast graphics drivers draw rain.
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "core/base/log.h"
#include "core/base/program.h"
#include "core/base/text/words.h"
#include "harness/commands/commands.h"
#include "harness/console/interrupt.h"
#include "harness/console/threads.h"
#include "harness/devices/measure/serving/serving.h"
#include "harness/record/passport/build_info.h"
#include "harness/devices/workers/worker.h"

static void print_usage(void)
{
    static const char *const titles[RG_READERS] = {
        [RG_FOR_DRIVERS] = "Drivers: correct, and as fast as before",
        [RG_FOR_PAPERS] = "Papers: their tables, claims and figures",
        [RG_FOR_ALL] = "Pictures, names and pages"};
    printf("raingauge COMMAND [OPTION]...\n%s\n", rg_program_about);
    for (int reader = 0; reader < RG_READERS; reader++) {
        printf("\n%s\n", titles[reader]);
        for (int i = 0; rg_commands[i]; i++)
            if ((int)rg_commands[i]->reader == reader)
                printf("  %-8s %s\n", rg_commands[i]->name, rg_commands[i]->about);
    }
    printf("\n`raingauge COMMAND --help` prints a command's options.\n");
}

// Opens standard streams that are closed, in a mode in which their use fails. Otherwise the next
// opened file would take such a descriptor, and output would be written into it.
static void open_standard_streams(void)
{
    static const int modes[] = {O_WRONLY, O_RDONLY, O_RDONLY};
    for (int fd = STDIN_FILENO; fd <= STDERR_FILENO; fd++)
        if (fcntl(fd, F_GETFD) < 0)
            open("/dev/null", modes[fd]); // takes the lowest free descriptor
}

// A full disk may show only at the last write.
static int finish(int exit)
{
    if (!fflush(stdout) && !ferror(stdout))
        return exit;
    rg_stdout_error(); // logs only once: a command may have reported it
    return rg_exit_worse(exit, RG_EXIT_HARNESS);
}

static int refuse(const char *name)
{
    struct rg_nearest nearest = {0};
    for (int i = 0; rg_commands[i]; i++)
        rg_nearest_try(&nearest, name, rg_commands[i]->name);
    rg_error("command '%s': unknown; the nearest is '%s', and `raingauge --help` lists them", name,
             nearest.name);
    return RG_EXIT_USAGE;
}

// Prints the program's help, or that of the named command.
static int help(const char *name)
{
    const struct rg_command *command = name ? rg_command_find(name) : NULL;
    if (name && !command)
        return refuse(name);
    if (command)
        rg_command_print_help(command);
    else
        print_usage();
    return RG_EXIT_PASS;
}

static int run(int argc, char **argv)
{
    if (!strcmp(argv[1], "help"))
        return help(argv[2]);
    if (!strcmp(argv[1], "--help") || !strcmp(argv[1], "-h"))
        return help(NULL);
    if (!strcmp(argv[1], "--version") || !strcmp(argv[1], "version")) {
        printf("raingauge %s, commit %s\n", rg_build_version, rg_build_commit);
        return RG_EXIT_PASS;
    }
    const struct rg_command *command = rg_command_find(argv[1]);
    if (command)
        return rg_command_run(command, argc - 1, (const char **)argv + 1);
    return refuse(argv[1]);
}

// Skips drivers' destructors, some of which crash after the work is done. Sanitizers need the usual
// exit to look for leaks.
static int serve(const char *argument)
{
    rg_threads_fit();
    const int status = rg_serving(argument);
#ifndef __SANITIZE_ADDRESS__
    _exit(status);
#endif
    return status;
}

int main(int argc, char **argv)
{
    rg_interrupt_hold(); // a signal before rg_interrupt_heed would be lost to a first process
    if (argc == 3 && !strcmp(argv[1], RG_WORKER_ARGUMENT))
        return serve(argv[2]);
    open_standard_streams();
    rg_threads_settle(argv);
    rg_interrupt_heed();
    rg_threads_fit();
    rg_workers.program = rg_program_self();
    rg_workers.hello = rg_serving_hello();
    // A write past a file-size limit then fails with EFBIG and is reported, instead of ending us.
    signal(SIGXFSZ, SIG_IGN);
    // While SIGCHLD is ignored, no child can be waited for, and our parent may have left it
    // ignored.
    signal(SIGCHLD, SIG_DFL);
    if (argc > 1)
        return finish(run(argc, argv));
    rg_error("no command; `raingauge --help` lists them");
    return RG_EXIT_USAGE;
}
