#include "harness/console/colour.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

bool rg_has_colours(FILE *out)
{
    const char *no = getenv("NO_COLOR"), *term = getenv("TERM");
    const int file = fileno(out); // -1 for a stream in memory
    return file >= 0 && isatty(file) && !(no && *no) && !(term && !strcmp(term, "dumb"));
}
