// raingauge_pages: prints pages that the build generates from the tables of commands, options,
// techniques and papers: the manual page, and bash's completion.
#include <stdio.h>
#include <string.h>

#include "harness/commands/pages/pages.h"

int main(int argc, char **argv)
{
    if (argc == 2 && !strcmp(argv[1], "manual"))
        rg_print_manual();
    else if (argc == 2 && !strcmp(argv[1], "completion"))
        rg_print_completion();
    else
        return fputs("raingauge_pages manual|completion, run by the build\n", stderr), 2;
    return fflush(stdout) || ferror(stdout);
}
