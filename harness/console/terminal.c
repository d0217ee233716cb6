#include "harness/console/terminal.h"

#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include "core/base/text/wrap.h"

enum { LEAST_WIDTH = 60 };

static bool is_terminal(FILE *out)
{
    const int file = fileno(out); // -1 for a stream in memory
    return file >= 0 && isatty(file);
}

bool rg_has_colours(FILE *out)
{
    const char *no = getenv("NO_COLOR"), *term = getenv("TERM");
    return is_terminal(out) && !(no && *no) && !(term && !strcmp(term, "dumb"));
}

int rg_page_width(FILE *out)
{
    struct winsize size = {0};
    if (!is_terminal(out) || ioctl(fileno(out), TIOCGWINSZ, &size) || !size.ws_col)
        return RG_PAGE_WIDTH;
    return size.ws_col > LEAST_WIDTH ? size.ws_col : LEAST_WIDTH;
}

void rg_print_wrapped(FILE *out, const char *lead, const char *text)
{
    const int indent = (int)strlen(lead), room = rg_page_width(out) - indent;
    const char *next;
    for (const char *line = text; *line; line = next) {
        const int length = rg_wrap(line, room, &next);
        fprintf(out, "%*s%.*s\n", indent, line == text ? lead : "", length, line);
    }
}
