// Files of a gate's cells. A file that is taken can be drawn as it is: each cell has its own name,
// a technique, settings and a picture.
#include <string.h>

#include "harness/compare/gate/cells/cells.h"
#include "tests/fuzz/heard.h"

static bool is_sound(const struct rg_gate_cells *cells, int64_t i)
{
    const struct rg_gate_cell *cell = &cells->cells[i];
    bool sound = *cell->name && cell->subject.technique && cell->subject.settings &&
                 cell->assignments && cell->subject.width > 0 && cell->subject.height > 0 &&
                 cell->frames >= 0 && cell->line > (i ? cell[-1].line : 0);
    for (int64_t k = 0; k < i; k++)
        sound = sound && strcmp(cell->name, cells->cells[k].name) != 0;
    return sound;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    struct rg_gate_cells cells;
    const char *path = fuzz_write("fuzz.txt", data, size);
    fuzz_listen();
    const bool taken = rg_gate_cells_read(path, &cells);
    fuzz_judge_lines(taken, 0);
    for (int64_t i = 0; taken && i < cells.count; i++)
        if (!is_sound(&cells, i))
            fuzz_complain("a cell that cannot be");
    rg_gate_cells_free(&cells);
    return 0;
}
