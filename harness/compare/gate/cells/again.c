#include "harness/compare/gate/cells/again.h"

#include <string.h>

#include "harness/compare/gate/text/shell.h"
#include "harness/devices/names.h"

enum { WHOLE = 2 * RG_DEVICE_NAME_SIZE + 2 };

// A short name with what it stands for.
static const char *whole_name(const char *name, char whole[WHOLE])
{
    const char *full = rg_device_name_full(name);
    snprintf(whole, WHOLE, "%s%s%s", name, full == name ? "" : "=", full == name ? "" : full);
    return whole;
}

void rg_gate_cell_again(FILE *out, const struct rg_gate_cell *cell, const char *a, const char *b)
{
    char devices[2 * WHOLE], whole_a[WHOLE], whole_b[WHOLE];
    fprintf(out, "raingauge diff %s --size %dx%d --frame %d", cell->technique->name, cell->width,
            cell->height, cell->frames);
    for (const char *word = cell->assignments; *(word += strspn(word, " "));) {
        const size_t length = strcspn(word, " ");
        fputs(" --set ", out);
        rg_shell_word(out, word, length);
        word += length;
    }
    snprintf(devices, sizeof(devices), "%s,%s", whole_name(a, whole_a), whole_name(b, whole_b));
    fputs(" --device ", out);
    rg_shell_word(out, devices, strlen(devices));
    fputs(" --mutants", out);
}
