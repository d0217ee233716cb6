// diff_tool A B [--background FILE] [--heatmap PREFIX] [--json]: rg_diff_files as a program, for
// the tests of its output and exit status.
#include <string.h>

#include "harness/compare/diff/files.h"

int main(int argc, char **argv)
{
    struct rg_diff_request request = {.a = argc > 2 ? argv[1] : "", .b = argc > 2 ? argv[2] : ""};
    for (int i = 3; i < argc; i++)
        if (!strcmp(argv[i], "--json"))
            request.json = true;
        else if (!strcmp(argv[i], "--background") && i + 1 < argc)
            request.background = argv[++i];
        else if (!strcmp(argv[i], "--heatmap") && i + 1 < argc)
            request.heatmap_prefix = argv[++i];
    return rg_diff_files(&request);
}
