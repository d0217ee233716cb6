#include "harness/tables/papers/published.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "core/base/alloc.h"
#include "core/techniques/technique.h"

char *rg_table_quick(const struct rg_table *table, int divisor)
{
    const char *quick = table->quick ? table->quick : "";
    const char *smaller = divisor == 4   ? table->smaller[0]
                          : divisor == 2 ? table->smaller[1]
                                         : NULL;
    const size_t size = strlen(quick) + (smaller ? strlen(smaller) : 0) + 2;
    char *text = rg_alloc(1, size, table->id);
    if (text)
        snprintf(text, size, "%s%s%s", quick, *quick && smaller ? " " : "", smaller ? smaller : "");
    return text;
}

const char *rg_table_paper(const struct rg_table *table)
{
    const struct rg_technique *technique = rg_technique_find(table->technique);
    return technique && !table->is_own ? technique->paper : "";
}

bool rg_table_is_published(const struct rg_table *table)
{
    return table->hardware != NULL;
}

double rg_table_value(const struct rg_table *table, int row, const char *column)
{
    for (int c = 0; table->columns[c]; c++)
        if (!strcmp(table->columns[c], column))
            return table->rows[row].values[c];
    return NAN;
}

// The parameter with choices that a column has; NULL for a column of numbers.
static const struct rg_param *choice_of(const struct rg_table *table, int column)
{
    const struct rg_technique *technique = rg_technique_find(table->technique);
    const struct rg_param *param =
        technique ? rg_params_find(technique->params, table->columns[column]) : NULL;
    return table->has_choices && param && param->kind == RG_PARAM_CHOICE ? param : NULL;
}

bool rg_table_is_choice(const struct rg_table *table, int column)
{
    return choice_of(table, column) != NULL;
}

void rg_table_value_text(const struct rg_table *table, int row, int column, char *text, size_t size)
{
    const struct rg_param *param = choice_of(table, column);
    const double value = table->rows[row].values[column];
    if (!param) {
        snprintf(text, size, "%.10g", value);
        return;
    }
    const int index = (int)value;
    struct rg_param alone = *param;
    alone.offset = 0;
    rg_params_text(&alone, &index, text, size);
}

double rg_table_published_fps(const struct rg_table *table, int row, int variant)
{
    const char *column = table->variants[variant].fps;
    return rg_table_is_published(table) && column ? rg_table_value(table, row, column) : NAN;
}

bool rg_table_is_extra(const struct rg_table *table, int column)
{
    for (int v = 0; table->variants[v].name; v++)
        if (table->variants[v].fps && !strcmp(table->variants[v].fps, table->columns[column]))
            return false;
    return column >= table->key_count;
}
