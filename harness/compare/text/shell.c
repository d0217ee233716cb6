#include "harness/compare/text/shell.h"

#include <ctype.h>
#include <stdbool.h>
#include <string.h>

static bool is_plain(const char *text, size_t length)
{
    for (size_t i = 0; i < length; i++)
        if (!isalnum((unsigned char)text[i]) && !strchr("_@%+=:,./-", text[i]))
            return false;
    return length > 0;
}

// Puts shell quotes around a text; a quote within it has to end them first.
void rg_shell_word(FILE *out, const char *text, size_t length)
{
    const bool is_quoted = !is_plain(text, length);
    fputs(is_quoted ? "'" : "", out);
    for (size_t i = 0; i < length; i++)
        if (text[i] == '\'')
            fputs("'\\''", out);
        else
            fputc(text[i], out);
    fputs(is_quoted ? "'" : "", out);
}
