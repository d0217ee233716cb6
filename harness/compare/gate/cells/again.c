#include "harness/compare/gate/cells/again.h"

#include <ctype.h>
#include <string.h>

static bool is_plain(const char *text, size_t length)
{
    for (size_t i = 0; i < length; i++)
        if (!isalnum((unsigned char)text[i]) && !strchr("_@%+=:,./-", text[i]))
            return false;
    return length > 0;
}

// Quotes of a shell are put around a text, and end before each that stands in it.
static void put_word(FILE *out, const char *text, size_t length)
{
    const bool is_quoted = !is_plain(text, length);
    fputs(is_quoted ? " '" : " ", out);
    for (size_t i = 0; i < length; i++)
        if (text[i] == '\'')
            fputs("'\\''", out);
        else
            fputc(text[i], out);
    fputs(is_quoted ? "'" : "", out);
}

void rg_gate_cell_again(FILE *out, const struct rg_gate_cell *cell, const char *a, const char *b)
{
    char devices[2 * RG_DEVICE_NAME_SIZE + 2];
    fprintf(out, "raingauge diff %s --size %dx%d --frame %d", cell->technique->name, cell->width,
            cell->height, cell->frames);
    for (const char *word = cell->assignments; *(word += strspn(word, " "));) {
        const size_t length = strcspn(word, " ");
        fputs(" --set", out);
        put_word(out, word, length);
        word += length;
    }
    snprintf(devices, sizeof(devices), "%s,%s", a, b);
    fputs(" --device", out);
    put_word(out, devices, strlen(devices));
    fputs(" --mutants", out);
}
