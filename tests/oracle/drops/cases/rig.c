#include "tests/oracle/drops/cases/rig.h"

#include "tests/oracle/drops/drops.h"
#include "tests/oracle/drops/map.h"

struct oracle_drops_settings quiet(int columns, int rows)
{
    struct oracle_drops_settings s = oracle_drops_defaults();
    s.columns = columns;
    s.rows = rows;
    s.drops_a_step = 0;
    s.meander_rad = 0;
    s.residual = false;
    return s;
}

struct oracle_drops_settings still(int columns, int rows)
{
    struct oracle_drops_settings s = quiet(columns, rows);
    s.smooth = s.erode = s.merge = false;
    return s;
}

void even_affinity(struct oracle_drops *o)
{
    for (int i = 0; i < o->settings.columns * o->settings.rows; i++)
        o->affinity[i] = 0.5;
}

double water(const struct oracle_drops *o)
{
    double sum = 0;
    for (int i = 0; i < o->settings.columns * o->settings.rows; i++)
        sum += o->height_mm[i];
    return sum;
}

int owned(const struct oracle_drops *o, uint32_t id)
{
    int cells = 0;
    for (int i = 0; i < o->settings.columns * o->settings.rows; i++)
        cells += o->id[i] == id;
    return cells;
}

uint32_t owner(const struct oracle_drops *o, double x_mm, double y_mm)
{
    const struct oracle_drops_cell at = oracle_drops_cell_at(o, x_mm, y_mm);
    return o->id[at.row * o->settings.columns + at.column];
}
